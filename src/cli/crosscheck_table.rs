//! What a cross-check found, for people.

use super::thousands;
use imdp::engines::Finding;
use std::collections::BTreeSet;
use std::fmt::Write as _;

const HEADER: [&str; 9] =
    ["engine", "version", "value", "ours", "difference", "strategy", "time", "memory", "outcome"];

/// One line for each property and engine, then what there is to know about them.
pub(super) fn table(findings: &[Finding]) -> String {
    let mut rows: Vec<Vec<String>> = vec![HEADER.map(String::from).to_vec()];
    rows.extend(findings.iter().map(|finding| cells(finding).to_vec()));
    let widths: Vec<usize> =
        (0..HEADER.len()).map(|i| rows.iter().map(|row| row[i].chars().count()).max().unwrap_or(0)).collect();
    let mut text = String::new();
    for (i, row) in rows.iter().enumerate() {
        let cells = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}"));
        let property = i.checked_sub(1).map_or("property", |i| findings[i].property.as_str());
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}  {property}", cells.collect::<Vec<_>>().join("  "));
    }
    let notes = findings.iter().flat_map(|finding| {
        finding.notes.iter().map(move |note| format!("{}, {}: {note}", finding.engine, finding.property))
    });
    notes.for_each(|note| {
        let _ = writeln!(text, "{note}");
    });
    let allowed = findings.iter().filter(|finding| finding.difference.is_some());
    let allowed: BTreeSet<String> =
        allowed.map(|finding| format!("{}: allowed {}", finding.engine, finding.tolerance)).collect();
    allowed.iter().for_each(|line| {
        let _ = writeln!(text, "{line}");
    });
    text
}

fn cells(finding: &Finding) -> [String; HEADER.len()] {
    let or_dash = |text: Option<String>| text.unwrap_or_else(|| "-".to_owned());
    let value = finding.value.map(|[least, greatest]| match least == greatest {
        true => format!("{least:.12}"),
        false => format!("{least:.12}..{greatest:.12}"),
    });
    let [lower, upper] = finding.ours;
    let strategy = finding.strategy.map(|strategy| match strategy.shortfall {
        short if short > 0.0 => format!("{short:.1e} short"),
        _ => "attains".to_owned(),
    });
    [
        finding.engine.clone(),
        or_dash(finding.version.clone()),
        or_dash(value),
        format!("[{lower:.12}, {upper:.12}]"),
        or_dash(finding.difference.map(|difference| format!("{difference:.1e}"))),
        or_dash(strategy),
        or_dash(finding.seconds.map(|seconds| format!("{seconds:.2} s"))),
        or_dash(finding.peak_mib.map(|mib| format!("{} MiB", thousands(mib)))),
        finding.agreement.to_string(),
    ]
}
