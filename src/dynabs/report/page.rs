//! The page.

use super::data::{Embedded, embed, inputs, steering};
use super::heat_map::heat_map;
use super::input_material::InputMaterial;
use super::legend::legend;
use super::markup::{PLOT_STYLE, escape};
use super::material::Material;
use super::picked::facts;
use super::scene::Scene;
use super::section::section;
use super::view::View;
use super::words::Promise;
use super::{formulas, input_formulas, plan, tables, words};
use crate::controller::Controller;
use crate::model_file::Document;
use crate::rendered::ended;
use crate::run::Manifest;
use askama::Template;
use imdp::engines::CrossCheckFile;

const STYLE: &str = include_str!("../templates/report.css");
/// The script, part by part; the page makes one function of them.
const SCRIPT: &str = concat!(
    include_str!("../templates/report/data.js"),
    include_str!("../templates/report/plane.js"),
    include_str!("../templates/report/regions.js"),
    include_str!("../templates/report/paths.js"),
    include_str!("../templates/report/draw.js"),
    include_str!("../templates/report/controls.js"),
);

/// Why there is no page.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReportError {
    /// The template cannot be rendered: a mistake in this program.
    #[error("the template of the report cannot be rendered: {found}")]
    Template {
        /// What the template engine says.
        found: String,
    },
}

/// The page; every field is safe markup.
#[derive(Template)]
#[template(path = "report.html", escape = "none")]
struct Page {
    name: String,
    description: String,
    mode: String,
    version: String,
    style: String,
    verdict: String,
    guarantee: String,
    warnings: String,
    map: String,
    legend: String,
    value_name: String,
    wanted_name: &'static str,
    scale: &'static str,
    about_runs: String,
    facts: String,
    section: String,
    over_time: String,
    noise: String,
    plan: String,
    left_out: String,
    simulation: String,
    model: String,
    sizes: String,
    budget: String,
    cross_checks: String,
    provenance: String,
    method: String,
    data: String,
    script: String,
}

/// Where everything on a page comes from that is said of both kinds of actions.
struct Sources<'a> {
    document: &'a Document,
    manifest: &'a Manifest,
    controller: &'a Controller,
    cross_checks: Option<&'a CrossCheckFile>,
    /// Whether the probability asked for is promised, where that is decided.
    satisfied: Option<bool>,
}

/// What is only said of one kind of actions.
struct Specifics {
    leads: &'static str,
    /// Whether there are upper bounds too.
    has_upper: bool,
    embedded: Embedded,
    model: String,
    /// The section of the plan, if one is followed.
    plan: String,
    sizes: String,
    method: &'static str,
}

/// What is said of colours that do not go from 0 to 1.
const FITTED: &str = " The scale is that of cells in which something is to be done; values beyond its ends have the colours there.";

/// Where arrows of targets point.
const TO_TARGETS: &str = "target plus mean noise";
/// Where arrows of inputs point.
const TO_IMAGES: &str = "what the dynamics make of the center, plus mean noise";

const METHOD: &str = " The method is that of Thom Badings, Licio Romao, Alessandro Abate, Nils Jansen: <cite>A
Stability-Based Abstraction Framework for Reach-Avoid Control of Stochastic Dynamical Systems with Unknown Noise
Distributions</cite>, European Control Conference 2024.";

/// The whole report as one HTML page that loads nothing.
///
/// # Errors
/// [`ReportError`] if the embedded template is broken.
pub fn page(material: &Material<'_>) -> Result<String, ReportError> {
    let Material { run, controller, options, scene, view, .. } = material;
    let sources = Sources {
        document: &run.document,
        manifest: &run.manifest,
        controller,
        cross_checks: options.cross_checks.as_ref(),
        satisfied: material.answer.satisfied(),
    };
    let specifics = Specifics {
        leads: TO_TARGETS,
        has_upper: false,
        embedded: embed(scene, view, || steering(material)),
        model: formulas::model(material),
        plan: plan::section(material),
        sizes: tables::sizes(material),
        method: METHOD,
    };
    rendered(scene, view, &sources, specifics)
}

/// The same for a run whose actions are inputs.
///
/// # Errors
/// [`ReportError`] if the embedded template is broken.
pub fn input_page(material: &InputMaterial<'_>) -> Result<String, ReportError> {
    let InputMaterial { run, controller, options, scene, view, .. } = material;
    let sources = Sources {
        document: &run.document,
        manifest: &run.manifest,
        controller,
        cross_checks: options.cross_checks.as_ref(),
        satisfied: material.satisfied,
    };
    let specifics = Specifics {
        leads: TO_IMAGES,
        has_upper: true,
        embedded: embed(scene, view, || inputs(material)),
        model: input_formulas::model(material),
        plan: String::new(),
        sizes: tables::input_sizes(material),
        method: "",
    };
    rendered(scene, view, &sources, specifics)
}

fn rendered(
    scene: &Scene<'_>,
    view: &View,
    sources: &Sources<'_>,
    specifics: Specifics,
) -> Result<String, ReportError> {
    let Sources { document, manifest, controller, cross_checks, satisfied } = *sources;
    let promise = Promise {
        guarantee: controller.guarantee(),
        sentences: controller.promise(),
        bound: controller.promised().bound,
        threshold: scene.threshold.map(|threshold| (threshold, satisfied)),
        has_upper: specifics.has_upper,
    };
    let left_out = match &specifics.embedded.left_out[..] {
        [] => String::new(),
        list => format!("<p>Left out of this page for its size: {}.</p>\n", escape(&list.join("; "))),
    };
    let map = heat_map(scene, view).inline();
    let page = Page {
        name: escape(scene.name),
        description: escape(document.description().unwrap_or_default()),
        mode: escape(&manifest.mode),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        style: format!("{PLOT_STYLE}{STYLE}"),
        verdict: words::verdict(&promise),
        guarantee: words::guarantee(&promise),
        warnings: words::warnings(manifest),
        legend: legend(scene, &map, specifics.leads),
        map,
        value_name: scene.value_name().to_owned(),
        wanted_name: scene.wanted_name,
        scale: if scene.scale.from > 0.0 || scene.scale.to < 1.0 { FITTED } else { "" },
        about_runs: words::about_runs(scene),
        facts: picked_cell(scene),
        section: section(scene, view).inline(),
        over_time: words::over_time(scene),
        noise: words::noise(scene, view),
        plan: specifics.plan,
        left_out,
        simulation: tables::simulation(scene),
        model: specifics.model,
        sizes: specifics.sizes,
        budget: tables::budget(manifest),
        cross_checks: tables::cross_checks(cross_checks),
        provenance: tables::provenance(manifest),
        method: specifics.method.to_owned(),
        data: specifics.embedded.json,
        script: SCRIPT.to_owned(),
    };
    page.render().map(ended).map_err(|error| ReportError::Template { found: error.to_string() })
}

/// The facts about the cell where runs start.
fn picked_cell(scene: &Scene<'_>) -> String {
    let Some(cell) = scene.start_cell else { return String::new() };
    let fact = |(id, name, value): &(&str, &str, String)| {
        format!("<div><dt>{}</dt><dd id=\"fact-{id}\">{}</dd></div>\n", escape(name), escape(value))
    };
    facts(scene, cell, 0).iter().map(fact).collect()
}
