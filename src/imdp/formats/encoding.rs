//! How the choices of a model are written.

/// How the choices of a model are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Every choice with all its transitions.
    #[default]
    Plain,
    /// Every choice with one transition to a state that stands for its row: see [`row_states`](super::row_states).
    Rows,
}
