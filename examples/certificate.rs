//! A result with a certificate, checked in exact arithmetic by code that shares nothing with the solver.

use dynabs::abstraction::compile;
use dynabs::model_file::Document;
use imdp::certificate::{self, FileDigest};
use imdp::formats::{native, sha256_hex};
use imdp::solver::{Answer, SolverOptions};
use imdp::verify::check;
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/models/room_temperature.json"));
    let problem = Document::parse(path, &std::fs::read_to_string(path)?)?.problem()?;
    let abstraction = compile(&problem, &())?;
    let mut model = Vec::new();
    native::write(&abstraction.model, &mut model)?;
    let files = vec![FileDigest { kind: "dynabs".to_owned(), sha256: sha256_hex(&model) }];

    let options = SolverOptions { evidence: true, ..SolverOptions::default() };
    let mut answer = Answer::new(&abstraction.model, &abstraction.property, &options)?;
    let certificate =
        answer.certificate(&abstraction.property, files.clone()).ok_or("no evidence was kept")?;
    let mut text = Vec::new();
    certificate::write(&certificate, &mut text)?;
    println!("a certificate of {} bytes", text.len());

    // Somebody else reads it, with the model's files at hand.
    let received = certificate::read(&text)?;
    let proved = check(&received, &abstraction.model, &files)?;
    println!("proved: {} in [{}, {}]", received.property, proved.lower, proved.upper);
    Ok(())
}
