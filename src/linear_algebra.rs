//! Sparse symmetric indefinite factorisation, by a library.
