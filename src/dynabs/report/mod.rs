//! A run as one self-contained page, and its plots as SVG.
//!
//! What a page shows is gathered once ([`Material`]); plots and tables are made from it here, so that the page is
//! complete on paper and without JavaScript. The script that comes with it redraws the plots from the embedded
//! numbers when another plane, step or cell is chosen.

mod budget;
mod choice;
mod data;
mod formulas;
mod frame;
mod heat_map;
mod input_formulas;
mod input_material;
mod legend;
mod markup;
mod material;
mod noise_plots;
mod numbers;
mod outlines;
mod over_time;
mod page;
mod palette;
mod paths;
mod picked;
mod plan;
mod regions;
mod results;
mod scene;
mod section;
mod sides;
mod tables;
mod task;
mod tiles;
mod trade_off;
mod values;
mod view;
mod words;

pub use choice::{ViewChoice, ViewError};
pub use input_material::InputMaterial;
pub use material::{Material, MaterialOptions};
pub use numbers::thousands;
pub use page::{ReportError, input_page, page};
pub use results::{CROSS_CHECK, CrossCheckError, read_cross_checks};
pub use trade_off::{TradeOff, TradeOffPoint};

use heat_map::heat_map;
use noise_plots::noise_plots;
use over_time::over_time;
use plan::plan;
use scene::Scene;
use section::section;
use view::View;

/// A plot as an SVG file of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// What to call it, without an extension.
    pub name: String,
    /// The SVG.
    pub svg: String,
}

/// The plots of the page, as files: the value function with vector field and runs, its cross-section,
/// states and inputs of the runs over time, the noise, the plan if one is followed.
pub fn pictures(material: &Material<'_>) -> Vec<Picture> {
    let mut pictures = of_scene(&material.scene, &material.view);
    pictures.extend(plan(material).map(|plot| Picture { name: plot.id.clone(), svg: plot.standalone() }));
    pictures
}

/// The same for a run whose actions are inputs.
pub fn input_pictures(material: &InputMaterial<'_>) -> Vec<Picture> {
    of_scene(&material.scene, &material.view)
}

fn of_scene(scene: &Scene<'_>, view: &View) -> Vec<Picture> {
    let mut pictures = vec![
        Picture { name: "value".to_owned(), svg: heat_map(scene, view).standalone() },
        Picture { name: "section".to_owned(), svg: section(scene, view).standalone() },
    ];
    let others = over_time(scene).into_iter().chain(noise_plots(scene, view));
    pictures.extend(others.map(|plot| Picture { svg: plot.standalone(), name: plot.id }));
    pictures
}
