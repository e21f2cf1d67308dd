//! The numbers of a method in one documented table: constants for its code, the same table for whoever asks what was measured by.

/// One number of a method.
#[derive(Debug, Clone, Copy)]
pub struct Parameter {
    /// The test it belongs to.
    pub group: &'static str,
    /// Its name there.
    pub name: &'static str,
    /// Its value, as Rust writes it.
    pub value: fn() -> String,
    /// The inequality it stands in.
    pub meaning: &'static str,
}

/// Declares groups of documented constants, each group a module, and `PARAMETERS`, the table of all.
macro_rules! parameters {
    ($(#[doc = $about:literal] $group:ident { $($(#[doc = $meaning:literal])+ $name:ident: $kind:ty = $value:expr;)+ })+) => {
        $(
            #[doc = $about]
            pub(crate) mod $group {
                $($(#[doc = $meaning])+ pub(crate) const $name: $kind = $value;)+
            }
        )+

        /// Every number of this room with the inequality it stands in, group by group.
        pub const PARAMETERS: &[$crate::math::parameters::Parameter] = &[$($($crate::math::parameters::Parameter {
            group: stringify!($group),
            name: stringify!($name),
            value: || format!("{:?}", $group::$name),
            meaning: concat!($($meaning),+),
        },)+)+];
    };
}
pub(crate) use parameters;
