//! The page.

use super::data::embed;
use super::heat_map::heat_map;
use super::markup::{PLOT_STYLE, escape};
use super::material::Material;
use super::picked::facts;
use super::section::section;
use super::view::View;
use super::{formulas, tables, words};
use crate::rendered::ended;
use askama::Template;

const STYLE: &str = include_str!("../templates/report.css");
const SCRIPT: &str = include_str!("../templates/report.js");

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
    guarantee: String,
    warnings: String,
    map: String,
    value_name: String,
    about_runs: String,
    facts: String,
    section: String,
    left_out: String,
    simulation: String,
    model: String,
    sizes: String,
    budget: String,
    cross_checks: String,
    provenance: String,
    data: String,
    script: String,
}

/// The whole report as one HTML page that loads nothing.
///
/// # Errors
/// [`ReportError`] if the embedded template is broken.
pub fn page(material: &Material<'_>) -> Result<String, ReportError> {
    let (run, problem) = (material.run, material.problem());
    let view = View::first(material);
    let embedded = embed(material, &view);
    let description = run.document.description().unwrap_or_default();
    let left_out = match &embedded.left_out[..] {
        [] => String::new(),
        list => format!("<p>Left out of this page for its size: {}.</p>\n", escape(&list.join("; "))),
    };
    let page = Page {
        name: escape(problem.name()),
        description: escape(description),
        mode: escape(&run.manifest.mode),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        style: format!("{PLOT_STYLE}{STYLE}"),
        guarantee: words::guarantee(material),
        warnings: words::warnings(run),
        map: heat_map(material, &view).inline(),
        value_name: material.value_name().to_owned(),
        about_runs: words::about_runs(material),
        facts: picked_cell(material),
        section: section(material, &view).inline(),
        left_out,
        simulation: tables::simulation(material),
        model: formulas::model(material),
        sizes: tables::sizes(material),
        budget: tables::budget(run),
        cross_checks: tables::cross_checks(material.options.cross_checks.as_ref()),
        provenance: tables::provenance(run),
        data: embedded.json,
        script: SCRIPT.to_owned(),
    };
    page.render().map(ended).map_err(|error| ReportError::Template { found: error.to_string() })
}

/// The facts about the cell where runs start.
fn picked_cell(material: &Material<'_>) -> String {
    let Some(cell) = material.controller.cell(&material.start) else { return String::new() };
    let fact = |(id, name, value): &(&str, &str, String)| {
        format!("<div><dt>{}</dt><dd id=\"fact-{id}\">{}</dd></div>\n", escape(name), escape(value))
    };
    facts(material, cell, 0).iter().map(fact).collect()
}
