//! The kinds of mistakes a problem file can have, and of warnings, by the words that reports call them.

use std::fmt;

macro_rules! codes {
    ($($variant:ident = $name:literal,)*) => {
        /// What kind of mistake or warning it is: `ribopt explain` says what each means, by its name.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        #[allow(missing_docs)] // docs/mistakes.md explains each by its name
        pub enum MistakeCode {
            $($variant,)*
        }

        impl MistakeCode {
            /// All of them, in the order of `docs/mistakes.md`.
            pub const ALL: &[MistakeCode] = &[$(MistakeCode::$variant,)*];

            /// The word it is called by.
            ///
            /// ```
            /// assert_eq!(ribopt::problem::mistake_code::MistakeCode::UnknownKey.name(), "unknown-key");
            /// ```
            pub const fn name(self) -> &'static str {
                match self {
                    $(MistakeCode::$variant => $name,)*
                }
            }
        }
    };
}

codes! {
    File = "file",
    Toml = "toml",
    UnknownKey = "unknown-key",
    MissingKey = "missing-key",
    WrongType = "wrong-type",
    NoNumber = "no-number",
    OutOfRange = "out-of-range",
    UnknownChoice = "unknown-choice",
    BothGiven = "both-given",
    DuplicateName = "duplicate-name",
    ReservedName = "reserved-name",
    Table = "table",
    EmptyCell = "empty-cell",
    Set = "set",
    Objective = "objective",
    Expression = "expression",
    UnknownName = "unknown-name",
    UnknownFunction = "unknown-function",
    UnknownItem = "unknown-item",
    Scope = "scope",
    NotConstant = "not-constant",
    NoValue = "no-value",
    ArraySize = "array-size",
    TextAndNumber = "text-and-number",
    Circle = "circle",
    NumberRange = "number-range",
    Units = "units",
    Bounds = "bounds",
    List = "list",
    Catalogue = "catalogue",
    NeverTrue = "never-true",
    Group = "group",
    Profile = "profile",
    Dimensions = "dimensions",
    ImpossibleSection = "impossible-section",
    Outline = "outline",
    RibEnds = "rib-ends",
    NoStructure = "no-structure",
    Coordinates = "coordinates",
    Material = "material",
    SkewBending = "skew-bending",
    Support = "support",
    Load = "load",
    Mechanism = "mechanism",
    Response = "response",
    Check = "check",
    TooDense = "too-dense",
    // Warnings: such a file is read.
    TableFormat = "table-format",
    StartMoved = "start-moved",
    NothingChosen = "nothing-chosen",
    AlwaysTrue = "always-true",
    HiddenName = "hidden-name",
    ChosenAtStart = "chosen-at-start",
    OddFactor = "odd-factor",
    MayVanish = "may-vanish",
    MayCross = "may-cross",
    TwoUnits = "two-units",
    Unused = "unused",
    TwinNodes = "twin-nodes",
    DefaultHeight = "default-height",
    ManyRows = "many-rows",
    BeyondCode = "beyond-code",
}

impl MistakeCode {
    /// The first of the warnings: those after it are warnings, too.
    const FIRST_WARNING: MistakeCode = MistakeCode::TableFormat;

    /// Whether a file that has it can be read all the same.
    pub const fn is_warning(self) -> bool {
        self as usize >= Self::FIRST_WARNING as usize
    }
}

impl fmt::Display for MistakeCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
