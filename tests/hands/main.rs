//! In safe hands: nothing is lost, nothing hangs, what is shown is what happened. Each case is one that a user met.

mod ending;
mod language;
mod overwriting;
mod place;
mod shown;
mod words;
