//! Cells of a plane as tiles.

use super::frame::Frame;
use super::numbers::coordinate;
use super::scene::Scene;
use super::view::View;
use std::ops::Range;

/// One path for each of so many keys, neighbours in a row merged; `key` says what is in some columns and rows.
pub(super) fn tiles(
    (scene, view): (&Scene<'_>, &View),
    frame: &Frame,
    keys: usize,
    key: impl Fn(Range<u32>, Range<u32>) -> Option<usize>,
) -> Vec<String> {
    let (columns, rows) = view.size(scene);
    let (block_x, block_y) = view.blocks(scene);
    let faces = &scene.faces()[view.up];
    let mut paths = vec![String::new(); keys];
    for j in (0..rows).step_by(block_y as usize) {
        let top = (j + block_y).min(rows);
        let (y0, y1) = (frame.y.at(faces[j as usize]), frame.y.at(faces[top as usize]));
        let mut add = |from: u32, to: u32, key: usize| {
            let (x0, x1) = (view.face_across(scene, from), view.face_across(scene, to));
            let (x0, x1) = (coordinate(frame.x.at(x0)), coordinate(frame.x.at(x1)));
            paths[key] += &format!("M{x0} {}H{x1}V{}H{x0}Z", coordinate(y0), coordinate(y1));
        };
        let mut open = (0, None);
        for i in (0..columns).step_by(block_x as usize) {
            let here = key(i..(i + block_x).min(columns), j..top);
            if here != open.1 {
                if let (from, Some(key)) = open {
                    add(from, i, key);
                }
                open = (i, here);
            }
        }
        if let (from, Some(key)) = open {
            add(from, columns, key);
        }
    }
    paths
}
