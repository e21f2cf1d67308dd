//! Verdicts by scripted backends.
