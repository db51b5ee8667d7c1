//! Stencils against what their definition says, cell by cell.

use super::super::cell_box::CellBox;
use super::{BoxCount, Ground, Special, Stencil};
use crate::partition::{CellId, Grid};
use imdp::model::{RowEntries, StateId};
use imdp::numeric::from_decimal;
use proptest::prelude::*;

const CELLS: [u32; 3] = [3, 4, 5];

fn ground(kinds: &[u32], heads: u32) -> Ground {
    let exact = |x: f64| vec![from_decimal(x).unwrap(); 3];
    let grid = Grid::new(&exact(0.0), &exact(1.0), &CELLS).unwrap();
    // Every fifth kind is lost, and every fifth a goal cell if there are any.
    let kind = |cell: CellId| kinds[cell.index()];
    let state = |cell: CellId| StateId(if kind(cell) < heads { kind(cell) } else { cell.0 + heads });
    Ground::new(&grid, None, heads, state)
}

/// The cells of a box at `origin` with their row-major positions, and their numbers if they are in the grid.
fn cells(hull: &CellBox, origin: &[i32]) -> Vec<(usize, Option<usize>)> {
    let mut all = vec![];
    hull.for_each(|cell| {
        let inside = (0..3).all(|j| (0..CELLS[j] as i32).contains(&(cell[j] + origin[j])));
        let number = (0..3).fold(0, |number, j| number * CELLS[j] as i32 + cell[j] + origin[j]);
        all.push((all.len(), inside.then_some(number as usize)));
    });
    all
}

proptest! {
    #[test]
    fn rows_list_what_lies_in_the_grid(
        kinds in prop::collection::vec(0u32..5, 60),
        corner in prop::array::uniform3(-3i32..2),
        extent in prop::array::uniform3(0i32..4),
        origin in prop::array::uniform3(0i32..5),
        holes in prop::collection::vec(prop::bool::weighted(0.3), 64),
        meets_goal in prop::bool::ANY,
        heads in 1u32..=2,
    ) {
        let ground = ground(&kinds, heads);
        let upper = (0..3).map(|j| corner[j] + extent[j]).collect();
        let hull = CellBox { lower: corner.to_vec(), upper };
        let interval = |position: usize| (position as f64, position as f64 + 0.5);
        let listed = |position: usize| !holes[position];
        let stencil = Stencil::new(&hull, &ground, (0.0, 0.25), |p| listed(p).then(|| interval(p)));
        let special = Special { first: (0.0, 0.5), reached: meets_goal.then_some((0.125, 0.75)) };

        let in_grid = || cells(&hull, &origin).into_iter().filter_map(|(p, cell)| Some((p, cell?)));
        let mut expected = vec![(StateId(0), (0.0, 0.5))];
        expected.extend(special.reached.map(|bounds| (StateId(1), bounds)));
        let listed_cells = in_grid().filter(|&(p, cell)| listed(p) && ground.states[cell] >= StateId(heads));
        expected.extend(listed_cells.map(|(p, cell)| (ground.states[cell], interval(p))));
        let mut entries = RowEntries::default();
        let mut listed_by = |stencil: &Stencil, special, length| {
            let row = stencil.row(&ground, &origin, (special, length), &mut entries);
            let bounds = row.lower.iter().copied().zip(row.upper.iter().copied());
            row.successors.iter().copied().zip(bounds).collect::<Vec<_>>()
        };
        prop_assert_eq!(&listed_by(&stencil, special, expected.len()), &expected);

        // Lower bounds by place: those of the cells that are listed, backwards.
        let positions: Vec<usize> = (0..hull.volume()).filter(|&position| listed(position)).collect();
        let of_places: Vec<f64> = positions.iter().rev().map(|&position| interval(position).0).collect();
        let places: Vec<u32> = (0..of_places.len() as u32).rev().collect();
        let by_place = stencil.with_lower((0.0, 0.5), of_places.into(), places.into());
        prop_assert_eq!(&listed_by(&by_place, special, expected.len()), &expected);

        // With nothing merged or cut off a row is made at once: the same as entry by entry.
        for (stencil, first) in [(&stencil, (0.0, 0.25)), (&by_place, (0.0, 0.125))] {
            let usual = Special { first, reached: None };
            let one_by_one = listed_by(stencil, usual, usize::MAX);
            prop_assert_eq!(listed_by(stencil, usual, one_by_one.len()), one_by_one);
        }

        prop_assert_eq!(ground.volume(&hull, &origin) as usize, in_grid().count());
        for kind in [StateId(0), StateId(1)] {
            let count = BoxCount::new(&ground, |state| state == kind).of(&hull, &origin);
            prop_assert_eq!(count as usize, in_grid().filter(|&(_, cell)| ground.states[cell] == kind).count());
        }
    }
}
