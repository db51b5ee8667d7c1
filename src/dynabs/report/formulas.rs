//! The model in formulas, as MathML.

use super::markup::escape;
use super::material::Material;
use super::numbers::{short, subscripted, tuple};
use super::scene::Scene;
use super::task::{boxes, task};
use crate::geometry::Polytope;
use crate::linear_algebra::ExactMatrix;
use crate::partition::GridAxis;
use crate::problem::Stabilizer;
use crate::system::LinearSystem;
use imdp::numeric::to_f64;
use num_traits::{Signed, Zero};

/// System, inputs, lower layer, partition, task.
pub(super) fn model(material: &Material<'_>) -> String {
    let problem = material.problem();
    let d = problem.group_steps();
    let mut text = format!("<p>One step:</p>\n{}", system(problem.step_system(), "A", "B", "q", "u"));
    text += &format!("<p>Inputs {}</p>\n", input_set(problem.step_input(), "u", "U"));
    if d > 1 {
        text += &format!(
            "<p>{d} steps grouped into one, with the inputs of the first step first, and inputs in {} :</p>\n{}",
            math(&format!("<msup><mi>U</mi><mn>{d}</mn></msup>")),
            system(problem.system(), "Â", "B̂", "q̂", "û")
        );
    }
    if let Some(stabilizer) = problem.stabilizer().and_then(Stabilizer::feedback) {
        let layers = &stabilizer.layers;
        let input = if d > 1 { "û" } else { "u" };
        let about = layers.about();
        let state = match is_zero(about) {
            true => "<mi>x</mi>".to_owned(),
            false => format!("<mo>(</mo><mi>x</mi><mo>−</mo>{}<mo>)</mo>", matrix(about)),
        };
        text += &format!(
            "<p>Two layers: the lower one stabilises, the upper one chooses u′ (eigenvalues of the closed loop: {}).</p>\n{}",
            eigenvalues(&layers.eigenvalues()),
            block(&format!(
                "<mi>{input}</mi><mo>=</mo><mo>−</mo>{}{state}<mo>+</mo><msup><mi>u</mi><mo>′</mo></msup>",
                matrix(layers.gain())
            ))
        );
        text += &format!(
            "<p>Inputs left to the upper layer, {}</p>\n",
            input_set(layers.abstract_input(), "u′", "U′")
        );
    }
    if let Some(tracking) = problem.stabilizer().and_then(Stabilizer::tracking) {
        let input = if d > 1 { "û" } else { "u" };
        text += &format!(
            "<p>Two layers: the lower one steers from every cell where a plan says, the upper one chooses u′.</p>\n{}<p>Inputs \
             left to the upper layer, {}</p>\n",
            block(&format!(
                "<mi>{input}</mi><mo>=</mo><msub><mi>{input}</mi><mtext>plan</mtext></msub><mo>(</mo><mi>x</mi><mo>)</mo><mo>+</mo>\
                 <msup><mi>u</mi><mo>′</mo></msup>"
            )),
            input_set(tracking.abstract_input(), "u′", "U′")
        );
    }
    text += &partition(&material.scene);
    let steps = problem.horizon().map(|steps| steps * d as u64);
    text += &task(problem.objective(), &material.run.document.value, &material.scene, steps);
    text += &boxes("Unsafe region", &material.scene.names, problem.unsafe_regions());
    let noise = match problem.noise().samples() {
        None => "the distribution is known".to_owned(),
        Some(noise) => {
            let seed = noise.seed().map_or(String::new(), |seed| format!(", drawn with seed {seed}"));
            let file = noise.file().map_or(String::new(), |(name, _)| format!(", from {}", escape(name)));
            let of = if d > 1 { format!("{d} steps together") } else { "one step".to_owned() };
            format!("{} samples of {of}{seed}{file}", noise.samples.len())
        }
    };
    text += &format!("<p>Noise: {noise}, of mean {}.</p>\n", tuple(&material.noise_mean));
    text
}

/// The cells.
pub(super) fn partition(scene: &Scene<'_>) -> String {
    let axis = |(axis, name): (&GridAxis, &String)| {
        format!(
            "{} ∈ [{}, {}) in {} cells of width {}",
            escape(name),
            short(to_f64(axis.lower())),
            short(to_f64(axis.upper())),
            axis.cells(),
            short(to_f64(axis.width()))
        )
    };
    let axes: Vec<_> = scene.grid.axes().iter().zip(&scene.names).map(axis).collect();
    format!("<p>Partition: {}; everything outside counts as failed.</p>\n", axes.join(", "))
}

/// `x⁺ = A x + B u + q + η` with the matrices written out.
fn system(system: &LinearSystem, a: &str, b: &str, q: &str, u: &str) -> String {
    let constant = !is_zero(system.q());
    let names = if constant { format!("<mo>+</mo><mi>{q}</mi>") } else { String::new() };
    let column = if constant { format!("<mo>+</mo>{}", matrix(system.q())) } else { String::new() };
    let noise = if u == "u" { "η" } else { "η̂" };
    block(&format!(
        "<msup><mi>x</mi><mo>+</mo></msup><mo>=</mo><mi>{a}</mi><mi>x</mi><mo>+</mo><mi>{b}</mi><mi>{u}</mi>{names}\
         <mo>+</mo><mi>{noise}</mi><mo>=</mo>{}<mi>x</mi><mo>+</mo>{}<mi>{u}</mi>{column}<mo>+</mo><mi>{noise}</mi>",
        matrix(system.a()),
        matrix(system.b())
    ))
}

fn math(content: &str) -> String {
    format!("<math xmlns=\"http://www.w3.org/1998/Math/MathML\"><mrow>{content}</mrow></math>")
}

/// A formula on lines of its own.
pub(super) fn block(content: &str) -> String {
    format!(
        "<div class=\"wide\"><math xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"block\"><mrow>{content}</mrow></math></div>\n"
    )
}

fn matrix(m: &ExactMatrix) -> String {
    matrix_of((m.rows(), m.columns()), |i, j| to_f64(m.get(i, j)))
}

/// A matrix of so many rows and columns.
pub(super) fn matrix_of((rows, columns): (usize, usize), entry: impl Fn(usize, usize) -> f64) -> String {
    let entry = |i, j| format!("<mtd><mn>{}</mn></mtd>", short(entry(i, j)));
    let row = |i| format!("<mtr>{}</mtr>", (0..columns).map(|j| entry(i, j)).collect::<String>());
    let rows: String = (0..rows).map(row).collect();
    format!("<mtable>{rows}</mtable>")
}

fn is_zero(m: &ExactMatrix) -> bool {
    m.entries().iter().all(Zero::is_zero)
}

/// `U` as intervals if it is a box, else as `G u ≤ g`.
pub(super) fn input_set(set: &Polytope, input: &str, name: &str) -> String {
    if let Some(sides) = box_sides(set) {
        let interval = |(j, [lower, upper]): (usize, &[f64; 2])| {
            let (lower, upper) = (short(*lower), short(*upper));
            format!("{} ∈ [{lower}, {upper}]", subscripted(input, j + 1))
        };
        return format!("{name}: {}", sides.iter().enumerate().map(interval).collect::<Vec<_>>().join(", "));
    }
    let offsets = ExactMatrix::from_fn(set.offsets().len(), 1, |i, _| set.offsets()[i].clone());
    let (normals, offsets) = (matrix(set.normals()), matrix(&offsets));
    math(&format!("<mi>{name}</mi><mo>:</mo>{normals}<mi>{input}</mi><mo>≤</mo>{offsets}"))
}

/// The sides of a box: one pair of opposite half-spaces per dimension.
fn box_sides(set: &Polytope) -> Option<Vec<[f64; 2]>> {
    let normals = set.normals();
    let mut sides = vec![[f64::NEG_INFINITY, f64::INFINITY]; set.dimension()];
    for (i, offset) in set.offsets().iter().enumerate() {
        let row: Vec<_> = (0..set.dimension()).filter(|&j| !normals.get(i, j).is_zero()).collect();
        let [j] = row[..] else { return None };
        let (normal, bound) = (normals.get(i, j), to_f64(&(offset / normals.get(i, j))));
        let [lower, upper] = &mut sides[j];
        if normal.is_positive() {
            *upper = upper.min(bound);
        } else {
            *lower = lower.max(bound);
        }
    }
    sides.iter().flatten().all(|side| side.is_finite()).then_some(sides)
}

fn eigenvalues(values: &[(f64, f64)]) -> String {
    let shown = values.iter().map(|&(re, im)| match (format!("{re:.3}"), format!("{:.3}", im.abs())) {
        (re, _) if im == 0.0 => re,
        (re, size) => format!("{re} {} {size}i", if im < 0.0 { "−" } else { "+" }),
    });
    shown.collect::<Vec<_>>().join(", ")
}
