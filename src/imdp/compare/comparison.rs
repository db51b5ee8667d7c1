//! What a comparison found.

use serde::Serialize;

/// The outcome of a comparison.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Differences {
    /// One section for each part that both sides have.
    pub sections: Vec<Section>,
    /// What could not be compared, and why.
    pub notes: Vec<String>,
}

/// The comparison of one part: sizes, labels, intervals, …
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Section {
    /// The part.
    pub part: &'static str,
    /// How many items were compared.
    pub compared: u64,
    /// How many of them differ.
    pub differences: u64,
    /// The worst of them, worst first.
    pub worst: Vec<Difference>,
    #[serde(skip)]
    most: usize,
}

/// One difference.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// Where.
    pub place: String,
    /// What is there on the left.
    pub left: String,
    /// What is there on the right.
    pub right: String,
    /// How far apart they are; `None` if that has no measure.
    pub by: Option<f64>,
}

impl Differences {
    /// Whether no part differs.
    pub fn is_same(&self) -> bool {
        self.sections.iter().all(|section| section.differences == 0)
    }

    /// The section about a part, if both sides have it.
    pub fn section(&self, part: &str) -> Option<&Section> {
        self.sections.iter().find(|section| section.part == part)
    }
}

impl Section {
    /// Nothing compared yet; at most `most` differences are kept.
    pub(super) fn new(part: &'static str, most: usize) -> Self {
        Self { part, compared: 0, differences: 0, worst: vec![], most }
    }

    /// Notes that so many items differ by this much; described only if it is among the worst.
    pub(super) fn add(
        &mut self,
        items: u64,
        by: Option<f64>,
        describe: impl FnOnce() -> (String, String, String),
    ) {
        self.differences += items;
        // What has no measure may be arbitrarily bad.
        let badness = |by: Option<f64>| by.unwrap_or(f64::INFINITY);
        let at = self.worst.partition_point(|other| badness(other.by) >= badness(by));
        if at < self.most {
            let (place, left, right) = describe();
            self.worst.insert(at, Difference { place, left, right, by });
            self.worst.truncate(self.most);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Section;

    #[test]
    fn the_worst_come_first_and_the_rest_is_counted() {
        let mut section = Section::new("values", 3);
        for (place, by) in
            [("a", Some(1.0)), ("b", Some(3.0)), ("c", Some(1.0)), ("d", None), ("e", Some(2.0))]
        {
            section.add(2, by, || (place.to_owned(), String::new(), String::new()));
        }
        let places: Vec<_> = section.worst.iter().map(|difference| difference.place.as_str()).collect();
        assert_eq!((section.differences, places), (10, vec!["d", "b", "e"]));
    }
}
