//! What can be wrong with a typed formula.

use thiserror::Error;

/// A formula that cannot be read. Positions count characters from 0; the sentences count from 1, as people do.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FormulaError {
    /// Nothing is typed.
    #[error("nothing is typed; a formula was expected")]
    Empty,
    /// Something else stands where the formula should go on.
    #[error("at character {}: expected {expected}, found {found}", position + 1)]
    Unexpected {
        /// Index of the character.
        position: usize,
        /// What could stand there.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// A word that is no variable, constant or function.
    #[error("at character {}: the name {name} is unknown; the variables are {variables}", position + 1)]
    UnknownName {
        /// Index of its first character.
        position: usize,
        /// The word.
        name: String,
        /// The variables, separated by commas.
        variables: String,
    },
    /// A bracket without its partner.
    #[error("at character {}: the bracket {bracket} has no partner", position + 1)]
    UnbalancedBracket {
        /// Index of the bracket.
        position: usize,
        /// `(` or `)`.
        bracket: char,
    },
    /// A function with too many or too few arguments.
    #[error("at character {}: {function} takes {expected}, found {found}", position + 1)]
    ArgumentCount {
        /// Index of the first character of the function's name.
        position: usize,
        /// The function.
        function: String,
        /// How many it takes, in words.
        expected: &'static str,
        /// How many were given.
        found: usize,
    },
    /// Digits and points that make no finite number.
    #[error("at character {}: {text} cannot be read as a number", position + 1)]
    NumberUnreadable {
        /// Index of its first character.
        position: usize,
        /// The characters.
        text: String,
    },
    /// Brackets, signs or powers nested too deeply.
    #[error("at character {}: nested more than {limit} deep", position + 1)]
    TooDeep {
        /// Index of the character that exceeds the limit.
        position: usize,
        /// The limit.
        limit: usize,
    },
}

impl FormulaError {
    /// The name of the error, for example `UnknownName`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Empty => "Empty",
            Self::Unexpected { .. } => "Unexpected",
            Self::UnknownName { .. } => "UnknownName",
            Self::UnbalancedBracket { .. } => "UnbalancedBracket",
            Self::ArgumentCount { .. } => "ArgumentCount",
            Self::NumberUnreadable { .. } => "NumberUnreadable",
            Self::TooDeep { .. } => "TooDeep",
        }
    }

    /// Index of the character where reading stopped, counted from 0; `None` if nothing is typed.
    pub fn position(&self) -> Option<usize> {
        match self {
            Self::Empty => None,
            Self::Unexpected { position, .. }
            | Self::UnknownName { position, .. }
            | Self::UnbalancedBracket { position, .. }
            | Self::ArgumentCount { position, .. }
            | Self::NumberUnreadable { position, .. }
            | Self::TooDeep { position, .. } => Some(*position),
        }
    }
}
