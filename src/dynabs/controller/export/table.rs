//! One table of numbers that an exported controller reads.

/// A table, row by row.
pub(super) struct Table {
    pub(super) name: &'static str,
    /// Rows and columns; a list has no columns.
    pub(super) rows: usize,
    pub(super) columns: Option<usize>,
    pub(super) numbers: Numbers,
}

/// The numbers of a table.
pub(super) enum Numbers {
    Doubles(Vec<f64>),
    Whole(Vec<u32>),
}

/// The narrowest type that holds all numbers of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Width {
    Double,
    Byte,
    Short,
    Word,
}

impl Table {
    /// A list of doubles.
    pub(super) fn doubles(name: &'static str, numbers: Vec<f64>) -> Self {
        Self { name, rows: numbers.len(), columns: None, numbers: Numbers::Doubles(numbers) }
    }

    /// A matrix of doubles.
    pub(super) fn matrix(name: &'static str, [rows, columns]: [usize; 2], numbers: Vec<f64>) -> Self {
        Self { name, rows, columns: Some(columns), numbers: Numbers::Doubles(numbers) }
    }

    /// A list of whole numbers.
    pub(super) fn whole(name: &'static str, numbers: Vec<u32>) -> Self {
        Self { name, rows: numbers.len(), columns: None, numbers: Numbers::Whole(numbers) }
    }

    pub(super) fn width(&self) -> Width {
        match &self.numbers {
            Numbers::Doubles(_) => Width::Double,
            Numbers::Whole(all) => match all.iter().max().copied().unwrap_or(0) {
                0..=0xff => Width::Byte,
                0x100..=0xffff => Width::Short,
                _ => Width::Word,
            },
        }
    }

    /// The numbers in little-endian order, in their narrowest type.
    pub(super) fn bytes(&self) -> Vec<u8> {
        match (&self.numbers, self.width()) {
            (Numbers::Doubles(all), _) => all.iter().flat_map(|x| x.to_le_bytes()).collect(),
            (Numbers::Whole(all), Width::Byte) => all.iter().map(|&i| i as u8).collect(),
            (Numbers::Whole(all), Width::Short) => {
                all.iter().flat_map(|&i| (i as u16).to_le_bytes()).collect()
            }
            (Numbers::Whole(all), _) => all.iter().flat_map(|i| i.to_le_bytes()).collect(),
        }
    }

    /// The table with rows and columns exchanged: MATLAB keeps columns together. A list is a column.
    pub(super) fn by_columns(&self) -> Self {
        let columns = self.columns.unwrap_or(1);
        let order = || (0..columns).flat_map(|j| (0..self.rows).map(move |i| i * columns + j));
        let numbers = match &self.numbers {
            Numbers::Doubles(all) => Numbers::Doubles(order().map(|i| all[i]).collect()),
            Numbers::Whole(all) => Numbers::Whole(order().map(|i| all[i]).collect()),
        };
        Self { name: self.name, rows: self.rows, columns: Some(columns), numbers }
    }
}

impl Width {
    /// NumPy's name of the type.
    pub(super) fn dtype(self) -> &'static str {
        match self {
            Self::Double => "<f8",
            Self::Byte => "|u1",
            Self::Short => "<u2",
            Self::Word => "<u4",
        }
    }

    /// C's name of the type.
    pub(super) fn c_type(self) -> &'static str {
        match self {
            Self::Double => "double",
            Self::Byte => "uint8_t",
            Self::Short => "uint16_t",
            Self::Word => "uint32_t",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_as_narrow_as_can_be() {
        for (greatest, width, size) in [
            (255, Width::Byte, 2),
            (256, Width::Short, 4),
            (65_535, Width::Short, 4),
            (65_536, Width::Word, 8),
        ] {
            let table = Table::whole("t", vec![1, greatest]);
            assert_eq!((table.width(), table.bytes().len()), (width, size));
        }
        assert_eq!(Table::whole("t", vec![1, 256]).bytes(), [1, 0, 0, 1]);
        assert_eq!(Table::whole("t", vec![]).width(), Width::Byte);
    }

    #[test]
    fn columns_are_kept_together_for_matlab() {
        let table = Table::matrix("t", [2, 3], vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]).by_columns();
        assert!(matches!(table.numbers, Numbers::Doubles(all) if all == [1.0, 4.0, 2.0, 5.0, 3.0, 6.0]));
    }
}
