//! What is drawn on the map: the legend has all there may be, and shows what there is.

use super::markup::escape;
use super::scene::Scene;

/// The entries of the legend, as the script shows and hides them too; `map` is what is drawn, `leads` says where arrows point.
pub(super) fn legend(scene: &Scene<'_>, map: &str, leads: &str) -> String {
    let arrows = format!(
        "from the center of a cell towards where its best action leads on average ({leads}), shortened"
    );
    // What a drawing has that needs the entry, its key, and what it says.
    let entries = [
        ("goal outline", "goal", scene.wanted_name),
        ("unsafe outline", "unsafe", "unsafe region"),
        ("named outline", "named", "region of the task"),
        ("satisfied run", "run", "run that satisfied the task"),
        ("failed run", "failed", "run that failed"),
        ("open run", "open", "run that was given up"),
        ("run faded", "faded", "run outside of the slice, projected onto it"),
        ("start", "start", "start"),
        ("arrow on", "arrow", &arrows),
    ];
    let entry = |(drawn, key, text): (&str, &str, &str)| {
        let hidden = if is_drawn(map, drawn) { "" } else { " hidden" };
        format!(
            "<span class=\"entry\" data-drawn=\"{drawn}\"{hidden}><span class=\"key {key}-key\"></span> {}</span>\n",
            escape(text)
        )
    };
    entries.into_iter().map(entry).collect()
}

/// Whether some element has this in its class.
fn is_drawn(map: &str, class: &str) -> bool {
    map.split("class=\"")
        .skip(1)
        .any(|rest| rest.split('"').next().is_some_and(|found| found.contains(class)))
}
