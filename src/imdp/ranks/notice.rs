//! What processes tell each other before they exchange anything.

/// What a process is about to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notice {
    /// To work on an input with this digest.
    Input {
        /// Its first bits.
        digest: u32,
    },
    /// To exchange the parts of an array with so many numbers.
    Exchange {
        /// How many.
        numbers: u64,
    },
    /// To tell for which reason it would stop, 0 for none.
    Limit {
        /// The number of the reason.
        reason: u8,
    },
    /// To work alone.
    Dismissed,
    /// To end.
    End {
        /// The exit code of an error, 0 if there is none.
        failure: u8,
    },
}

/// The number of bits that tell notices apart.
const KIND_BITS: u32 = 3;

impl Notice {
    /// The notice as a number.
    pub fn word(self) -> u64 {
        let (kind, detail) = match self {
            Self::Exchange { numbers } => (0, numbers),
            Self::Limit { reason } => (1, reason.into()),
            Self::Dismissed => (2, 0),
            Self::End { failure } => (3, failure.into()),
            Self::Input { digest } => (4, digest.into()),
        };
        detail << KIND_BITS | kind
    }

    /// The notice of a [`word`](Self::word).
    pub fn of_word(word: u64) -> Self {
        let detail = word >> KIND_BITS;
        match word & ((1 << KIND_BITS) - 1) {
            0 => Self::Exchange { numbers: detail },
            1 => Self::Limit { reason: detail as u8 },
            2 => Self::Dismissed,
            3 => Self::End { failure: detail as u8 },
            _ => Self::Input { digest: detail as u32 },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Notice;

    #[test]
    fn words_are_read_as_they_were_written() {
        let exchanges = [0, 7, 1 << 40].map(|numbers| Notice::Exchange { numbers });
        let input = Notice::Input { digest: u32::MAX };
        let others = [Notice::Limit { reason: 3 }, Notice::Dismissed, Notice::End { failure: 4 }, input];
        for notice in exchanges.into_iter().chain(others) {
            assert_eq!(Notice::of_word(notice.word()), notice);
        }
    }
}
