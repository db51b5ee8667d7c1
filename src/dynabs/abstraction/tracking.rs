//! Actions near a plan.

use super::enabled::EnabledActions;
use super::plan::Plan;
use super::targets::Targets;
use crate::geometry::Polytope;
use crate::partition::CellId;
use crate::problem::TargetId;
use crate::system::FeedbackLaw;
use imdp::model::RowRange;
use rayon::prelude::*;

/// By which part of what is subtracted from each other deviations may be off: what the plan says is never left out.
const RELAXED: f64 = 1e-9;

/// Cells per parallel task.
const CELLS_PER_TASK: usize = 256;

/// How far targets are off a planned one, in terms of inputs.
pub(super) struct Deviations {
    /// Per half-space of `U′`, its offset.
    offsets: Vec<f64>,
    /// Target after target, `G′ M d`.
    of_targets: Vec<f64>,
}

impl Deviations {
    pub(super) fn new(law: &FeedbackLaw, abstract_input: &Polytope, targets: &Targets) -> Self {
        let (normals, offsets): (Vec<Vec<f64>>, Vec<f64>) =
            law.deviations(abstract_input).into_iter().unzip();
        let mut point = vec![0.0; targets.dimension()];
        let mut of_targets = Vec::with_capacity(targets.num_originals() * normals.len());
        for target in targets.ids().take(targets.num_originals()) {
            targets.point(target, &mut point);
            let product = |normal: &Vec<f64>| normal.iter().zip(&point).map(|(a, d)| a * d).sum::<f64>();
            of_targets.extend(normals.iter().map(product));
        }
        Self { offsets, of_targets }
    }

    /// Whether `u′ = M (d − d̄)` is in `U′`.
    fn are_small(&self, target: TargetId, planned: TargetId) -> bool {
        let of =
            |target: TargetId| &self.of_targets[target.index() * self.offsets.len()..][..self.offsets.len()];
        let pairs = of(target).iter().zip(of(planned)).zip(&self.offsets);
        pairs
            .into_iter()
            .all(|((d, planned), offset)| d - planned <= offset + RELAXED * (d.abs() + planned.abs()))
    }

    /// The actions, out of those enabled in each of `cells`, that are near a plan; none where there is no plan.
    pub(super) fn near(
        &self,
        plan: &Plan,
        targets: &Targets,
        cells: &[CellId],
        actions: &EnabledActions,
    ) -> EnabledActions {
        let starts = actions.starts();
        let of_task = |(task, cells): (usize, &[CellId])| {
            let mut near = EnabledActions::default();
            for (i, &cell) in (task * CELLS_PER_TASK..).zip(cells) {
                let before = near.ranges.len();
                if let Some(planned) = plan.heading(cell) {
                    for range in &actions.ranges[starts[i]..starts[i + 1]] {
                        self.parts_near(*range, targets, planned, &mut near.ranges);
                    }
                }
                near.ranges_per_cell.push((near.ranges.len() - before) as u32);
            }
            near
        };
        let parts: Vec<_> = cells.par_chunks(CELLS_PER_TASK).enumerate().map(of_task).collect();
        let mut near = EnabledActions::default();
        parts.into_iter().for_each(|part| near.append(part));
        near.ranges.shrink_to_fit();
        near
    }

    /// Appends the parts of a range of rows whose targets are near a planned one.
    fn parts_near(&self, range: RowRange, targets: &Targets, planned: TargetId, near: &mut Vec<RowRange>) {
        let mut open: Option<RowRange> = None;
        for row in range.rows() {
            if self.are_small(targets.original(TargetId::from_index(row.index())), planned) {
                open = Some(RowRange { first: open.map_or(row, |run| run.first), last: row });
            } else {
                near.extend(open.take());
            }
        }
        near.extend(open);
    }
}
