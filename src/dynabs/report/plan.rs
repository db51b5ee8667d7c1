//! The plan that a lower layer follows: which cells steer where, and by which law.

use super::formulas::{block, matrix_of};
use super::heat_map::map_frame;
use super::markup::{Plot, group, table};
use super::material::Material;
use super::numbers::{coordinate, tuple};
use super::outlines::outlines;
use super::palette::distinct;
use super::paths::field;
use super::regions::{hatch, regions};
use super::tiles::tiles;
use super::view::Axis;
use crate::problem::TargetId;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// So many regions are listed, the largest ones.
const LISTED: usize = 12;

/// A region of the plan: the cells that steer to one target.
struct PlanRegion {
    target: TargetId,
    cells: usize,
}

/// The regions of the plan, the largest ones first; `None` if none is followed.
fn plan_regions(material: &Material<'_>) -> Option<Vec<PlanRegion>> {
    let plan = material.run.abstraction.plan.as_ref()?;
    let mut cells: BTreeMap<TargetId, usize> = BTreeMap::new();
    plan.headings().flatten().for_each(|target| *cells.entry(target).or_default() += 1);
    let mut regions: Vec<_> = cells.into_iter().map(|(target, cells)| PlanRegion { target, cells }).collect();
    regions.sort_by_key(|region| Reverse(region.cells));
    Some(regions)
}

/// The plan over the plane that is shown first: regions by colour, arrows towards their targets; `None` if none is followed.
pub(super) fn plan(material: &Material<'_>) -> Option<Plot> {
    let plan = material.run.abstraction.plan.as_ref()?;
    let parts = plan_regions(material)?;
    let (scene, view, id) = (&material.scene, &material.view, "plan");
    let number: BTreeMap<TargetId, usize> = (0..).zip(&parts).map(|(i, part)| (part.target, i)).collect();
    let point = |target: TargetId| material.controller.action(target.0);
    let frame = map_frame(scene, view);
    let (across, up) = view.names(scene);
    let region = |columns: Range<u32>, rows: Range<u32>| {
        let (cell, _) = view.cell(scene, columns.start, rows.start);
        plan.heading(cell).and_then(|target| number.get(&target).copied())
    };
    let tiles = tiles((scene, view), &frame, parts.len(), region);
    let tiles: String = (0..)
        .zip(&tiles)
        .filter(|(_, d)| !d.is_empty())
        .map(|(i, d)| format!("<path fill=\"{}\" d=\"{d}\"/>", distinct(i)))
        .collect();
    let [arrows, _] =
        field((scene, view), &frame, |cell, _| plan.heading(cell).map(|target| (0, point(target).to_vec())));
    let (columns, rows) = view.size(scene);
    let shown = (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j)));
    let targets: BTreeSet<TargetId> =
        shown.filter_map(|(i, j)| plan.heading(view.cell(scene, i, j).0)).collect();
    let place = |target: &TargetId| {
        let Axis::State(dimension) = view.across else { return None };
        let x = point(*target);
        Some(format!("M{} {}h0", coordinate(frame.x.at(x[dimension])), coordinate(frame.y.at(x[view.up]))))
    };
    let dot = |target: &TargetId| {
        let (d, region) = (place(target)?, number.get(target)?);
        Some(format!("<path class=\"heading\" stroke=\"{}\" d=\"{d}\"/>", distinct(*region)))
    };
    let dots: String = targets.iter().filter_map(dot).collect();
    let around: String = targets.iter().filter_map(place).collect();
    let around = match &around[..] {
        "" => String::new(),
        d => format!("<path class=\"around heading\" d=\"{d}\"/>"),
    };
    let inside = [
        group("heat", &tiles),
        group("regions", &(regions(scene, view, &frame, id) + &outlines(scene, view, &frame))),
        group("headings", &(around + &dots)),
        group("arrows", &format!("<path class=\"arrow on-light\" d=\"{arrows}\"/>")),
    ];
    let at = view.at(scene, view.fixed());
    Some(Plot {
        id: id.to_owned(),
        width: 720.0,
        height: frame.height + 64.0,
        title: format!("{}: the plan over {across} and {up}{at}", scene.name),
        description:
            "Cells of one colour steer to one target, a dot of that colour; arrows point from their centers towards it."
                .into(),
        content: format!(
            "<defs>{}{}</defs>\n<g clip-path=\"url(#{id}-clip)\">\n{}</g>\n{}",
            frame.clip(id),
            hatch(id),
            inside.concat(),
            group("axes", &frame.axes(&across, &up))
        ),
    })
}

/// The section about the plan; empty if none is followed.
pub(super) fn section(material: &Material<'_>) -> String {
    let (Some(plot), Some(parts)) = (plan(material), plan_regions(material)) else { return String::new() };
    let law = &material.run.abstraction.law;
    let (by_target, by_state, constant) = (law.target_gain(), law.state_gain(), law.constant());
    // The law of a region: its constant takes up where it steers to.
    let constant_of = |d: &[f64]| -> Vec<f64> {
        let row =
            |i: usize| d.iter().enumerate().fold(constant[(i, 0)], |sum, (j, d)| sum + by_target[(i, j)] * d);
        (0..constant.nrows()).map(row).collect()
    };
    let row = |part: &PlanRegion| {
        let target = material.controller.action(part.target.0);
        vec![tuple(target), part.cells.to_string(), tuple(&constant_of(target))]
    };
    let rows: Vec<_> = parts.iter().take(LISTED).map(row).collect();
    let input = if material.problem().group_steps() > 1 { "û" } else { "u" };
    let formula = block(&format!(
        "<msub><mi>{input}</mi><mtext>plan</mtext></msub><mo>(</mo><mi>x</mi><mo>)</mo><mo>=</mo><msub><mi>c</mi><mi>i</mi></msub>\
         <mo>+</mo>{}<mi>x</mi>",
        matrix_of(by_state.shape(), |i, j| by_state[(i, j)])
    ));
    let caption = match parts.len() {
        1..=LISTED => "The regions, and their constants".to_owned(),
        all => format!("The {LISTED} largest of {all} regions, and their constants"),
    };
    let header = ["steers to", "cells", "c<sub>i</sub>"];
    format!(
        "<section>\n<h2>The plan</h2>\n<figure>\n{}<figcaption><p>Cells of one colour are a region of the plan: the lower layer \
         steers from all of them to one target, the dot of that colour, towards which the arrows point. Beside it the upper layer may choose \
         what differs by inputs in U′.</p></figcaption></figure>\n<p>The lower layer is affine on every region i, with one gain, \
         and without noise brings any state of the region to its target:</p>\n{formula}{}</section>\n",
        plot.inline(),
        table(&caption, &header, &rows)
    )
}
