//! The repository's own order: arrows between rooms, sizes of files and functions, references, the documentation as a book.

mod arrows;
mod book;
mod circles;
mod documentation;
mod sizes;
