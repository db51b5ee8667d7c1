//! Models written in one format and read again, in any other.
mod commands;
mod drn;
mod recorded;
mod rewards;
mod round_trips;
mod row_states;
mod tiny;
mod umb;

use imdp::formats::umb::Compression;
use imdp::formats::{Format, ModelWriter};
use imdp::model::*;
use std::fs::File;
use std::path::{Path, PathBuf};

/// Writes a model into a directory.
fn write(model: &IntervalMdp, format: Format, directory: &Path) -> PathBuf {
    let writer = ModelWriter::new(model, format, Compression::Gzip).unwrap();
    let path = directory.join("m").with_extension(format.extension());
    for extension in writer.extensions() {
        writer.write(extension, &mut File::create(path.with_extension(extension)).unwrap(), &()).unwrap();
    }
    path
}

fn read(path: &Path) -> IntervalMdp {
    Format::of_path(path).unwrap().import(path, &()).unwrap().model
}

/// The parts of a model, to change some of them.
fn parts(model: &IntervalMdp) -> Parts {
    Parts {
        kind: model.kind(),
        rows: model.rows().clone(),
        choices: model.choices().clone(),
        actions: model.actions().clone(),
        initial: model.initial().clone(),
        labels: model.labels().clone(),
        variables: model.variables().clone(),
    }
}
