//! What a user who mistyped a name may have meant.

/// The name with the fewest edits from `name`, if these are at most a third of its letters, and not all.
pub fn closest_name<'a>(name: &str, names: &'a [String]) -> Option<&'a str> {
    let allowed = name.len().div_ceil(3).min(name.len().saturating_sub(1));
    names
        .iter()
        .map(String::as_str)
        // The difference in length bounds the distance from below: long names cost nothing.
        .filter(|other| other.len().abs_diff(name.len()) <= allowed)
        .map(|other| (edit_distance(name, other), other))
        .filter(|(distance, _)| *distance <= allowed)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, other)| other)
}

/// Levenshtein's distance, regardless of case.
fn edit_distance(a: &str, b: &str) -> usize {
    let mut distances: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.bytes().enumerate() {
        let mut diagonal = i;
        distances[0] = i + 1;
        for (j, y) in b.bytes().enumerate() {
            let substituted = diagonal + usize::from(!x.eq_ignore_ascii_case(&y));
            diagonal = distances[j + 1];
            distances[j + 1] = substituted.min(diagonal + 1).min(distances[j] + 1);
        }
    }
    distances[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn typing_errors_are_recognised() {
        let names = ["reached", "failed", "goal"].map(str::to_owned);
        for (name, closest) in [
            ("reach", Some("reached")),
            ("Failed", Some("failed")),
            ("gaol", Some("goal")),
            ("unsafe", None),
            ("x", None),
            ("", None),
        ] {
            assert_eq!(closest_name(name, &names), closest, "{name}");
        }
    }
}
