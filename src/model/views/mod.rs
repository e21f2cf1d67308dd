//! A model seen in another way: every view is a model itself and passes the same derivative check.
//!
//! | view | what it shows |
//! |---|---|
//! | [`scaled`] | variables, objective and rows in other units |
//! | [`logarithmic`] | positive variables by their logarithms |
//! | [`flange_substitution`] | flange thickness in place of overall height |
//! | [`with_bounds`] | other bounds |
//! | [`bounds_only`] | no rows |
//! | [`bounded_states`] | bounds of states in place of rows of one |
//! | [`freed`] | without some limits |
//! | [`mapped`] | variables and rows behind constant linear maps |
//! | [`composed`] | inputs that are the rows of another model |
//! | [`reduced`] | without its states, which are solved for |
//! | [`elastic`] | rows that may be violated at a price |
//! | [`augmented`] | rows multiplied out into the objective: the augmented Lagrangian |
//! | [`substitution`] | what views in other variables have in common: the way there and back |
//! | [`chained`] | one substitution after another |

pub mod augmented;
pub mod bounded_states;
pub mod bounds_only;
pub mod chained;
pub mod composed;
pub mod elastic;
pub mod flange_substitution;
pub mod freed;
pub mod logarithmic;
pub mod mapped;
pub mod reduced;
pub mod scaled;
pub mod substitution;
pub mod with_bounds;

pub use elastic::Elastic;
pub use freed::{Freed, Limit};
pub use substitution::Substitution;
pub use with_bounds::WithBounds;
