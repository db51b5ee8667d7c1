//! What is asked of every reader, whatever bytes it is given: no panic, no abort, no endless loop, and what it accepts
//! can be written, read again and solved with a certificate that the checker accepts.

use dynabs::abstraction::compile;
use dynabs::imdp::certificate::{self, Certificate, Statement};
use dynabs::imdp::evaluation::check_derivation;
use dynabs::imdp::formats::umb::Compression;
use dynabs::imdp::formats::{Format, ModelWriter, native};
use dynabs::imdp::model::IntervalMdp;
use dynabs::imdp::property::{Property, parse_properties, parse_property};
use dynabs::imdp::solver::{Answer, SolverOptions, Status};
use dynabs::imdp::verify;
use dynabs::model_file::Document;
use dynabs::noise::{DecimalMark, parse_csv};
use std::cell::OnceCell;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;
use tempfile::TempDir;

/// Larger models are read and written, but not solved.
const FEW: usize = 64;

thread_local! {
    static SCRATCH: OnceCell<TempDir> = const { OnceCell::new() };
}

/// A file of this process, in memory where the system has such a place.
fn scratch(name: &str) -> PathBuf {
    let directory = || {
        let memory = Path::new("/dev/shm");
        let created = if memory.is_dir() { tempfile::tempdir_in(memory) } else { tempfile::tempdir() };
        created.expect("a scratch directory")
    };
    SCRATCH.with(|scratch| scratch.get_or_init(directory).path().join(name))
}

fn write(name: &str, bytes: &[u8]) -> PathBuf {
    let path = scratch(name);
    fs::write(&path, bytes).expect("a scratch file");
    path
}

/// PRISM's three files: the input is that for transitions, that for labels and that for states, separated by a byte 0.
pub fn prism(data: &[u8]) {
    let mut parts = data.splitn(3, |&byte| byte == 0);
    let tra = write("m.tra", parts.next().unwrap_or_default());
    write("m.lab", parts.next().unwrap_or_default());
    match parts.next() {
        Some(states) => drop(write("m.sta", states)),
        None => drop(fs::remove_file(scratch("m.sta"))),
    }
    import(Format::Prism, &tra);
}

/// Storm's explicit format.
pub fn drn(data: &[u8]) {
    import(Format::Drn, &write("m.drn", data));
}

/// The unified Markov binary format.
pub fn umb(data: &[u8]) {
    import(Format::Umb, &write("m.umb", data));
}

/// The format of this project. Its checksum is made right, or hardly anything would be read.
pub fn native(data: &[u8]) {
    let mut bytes = data.to_owned();
    if let Some(at) = bytes.len().checked_sub(32) {
        let digest = sha256(&bytes[..at]);
        bytes[at..].copy_from_slice(&digest);
    }
    if let Ok(model) = native::read_from(bytes.as_slice(), bytes.len() as u64) {
        exercise(&model);
    }
}

/// A certificate, parsed, written and checked. Its checksum is made right.
pub fn certificate(data: &[u8]) {
    let mut bytes = data.to_owned();
    if !bytes.ends_with(b"\n") {
        bytes.push(b'\n');
    }
    let digest: String = sha256(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    bytes.extend_from_slice(format!("end {digest}\n").as_bytes());
    if let Ok(Statement::Expression(derivation)) = certificate::read_statement(&bytes) {
        // Whatever it says about this model, it is judged.
        let _ = check_derivation(&derivation, &small_model(), &derivation.files);
    }
    let Ok(certificate) = certificate::read(&bytes) else { return };
    assert_eq!(again(&certificate), certificate, "a certificate is read as it was written");
    let model = small_model();
    if let Ok(proved) = verify::check(&certificate, &model, &certificate.files) {
        let options = SolverOptions { time_limit: Some(Duration::from_secs(5)), ..SolverOptions::default() };
        if let Ok(answer) = Answer::new(&model, &certificate.property, &options) {
            assert!(
                proved.lower <= answer.upper && answer.lower <= proved.upper,
                "an accepted certificate proves nothing false: {proved:?} against [{}, {}]",
                answer.lower,
                answer.upper
            );
        }
    }
}

/// Properties, one by one and as a file.
pub fn property(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    if let Ok(property) = parse_property(text) {
        reads_back(&property);
        let options = SolverOptions { time_limit: Some(Duration::from_secs(5)), ..SolverOptions::default() };
        // It need not be about this model.
        let _ = Answer::new(&small_model(), &property, &options);
    }
    for property in parse_properties(text).into_iter().flatten() {
        reads_back(&property);
    }
}

/// A model file, compiled if it is small.
pub fn model_file(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let path = scratch("m.json");
    let Ok(document) = Document::parse(&path, text) else { return };
    // Samples of other files are not what this is about, nor what takes long.
    if names_a_file(&document) || number(&document, "/noise/count") > 2000.0 || cells(&document) > 2000.0 {
        return;
    }
    if let Ok(problem) = document.problem() {
        let _ = compile(&problem, &());
    }
}

/// Noise samples; the first byte is their dimension, and how their numbers are written.
pub fn csv(data: &[u8]) {
    let Some((&dimension, text)) = data.split_first() else { return };
    let Ok(text) = std::str::from_utf8(text) else { return };
    let mark = if dimension & 8 == 0 { DecimalMark::Point } else { DecimalMark::Comma };
    if let Ok(samples) = parse_csv(text, usize::from(dimension % 8) + 1, mark) {
        let written = samples.to_csv();
        let again = parse_csv(&written, samples.dimension(), DecimalMark::Point);
        let again = again.expect("samples are read as they were written");
        assert_eq!(again, samples);
        assert!(samples.iter().flatten().all(|x| x.is_finite()));
    }
}

/// Reads a model; what is accepted is a model.
fn import(format: Format, path: &Path) {
    if let Ok(imported) = format.import(path, &()) {
        exercise(&imported.model);
    }
}

/// Writes a model in every format that has words for it, reads it again, and proves its values if it is small.
fn exercise(model: &IntervalMdp) {
    for format in Format::ALL {
        // Compression only takes time.
        let Ok(writer) = ModelWriter::new(model, format, Compression::None) else { continue };
        if writer.bytes() > 1 << 20 {
            continue;
        }
        let path = scratch(&format!("written.{}", format.extension()));
        for extension in writer.extensions() {
            let mut bytes = Vec::new();
            writer.write(extension, &mut bytes, &()).expect("a buffer takes everything");
            fs::write(path.with_extension(extension), bytes).expect("a scratch file");
        }
        let read = format.import(&path, &());
        let read = read.unwrap_or_else(|error| panic!("{format}: what was written is not read: {error}")).model;
        assert_eq!(read.num_states(), model.num_states(), "{format}");
        if format == Format::Native {
            assert_eq!(read, *model, "{format}: what was written is read otherwise");
        }
        let _ = fs::remove_file(path.with_extension("sta"));
    }
    if model.num_states() > FEW || model.size().transitions > 1000 {
        return;
    }
    let label = model.labels().iter().map(|(name, _)| name).find(|name| is_identifier(name));
    let Some(label) = label else { return };
    for text in [format!("Pmaxmin=? [ F<=3 \"{label}\" ]"), format!("Pminmax=? [ F \"{label}\" ]")] {
        let property = parse_property(&text).expect("a property");
        let options = SolverOptions {
            evidence: true,
            policy: true,
            max_iterations: 2000,
            time_limit: Some(Duration::from_secs(5)),
            ..SolverOptions::default()
        };
        let Ok(mut answer) = Answer::new(model, &property, &options) else { continue };
        assert!(answer.lower <= answer.upper, "{text}: [{}, {}]", answer.lower, answer.upper);
        let converged = answer.solution.status == Status::Converged;
        let Some(certificate) = answer.certificate(&property, vec![]).filter(|_| converged) else { continue };
        let certificate = again(&certificate);
        if let Err(rejection) = verify::check(&certificate, model, &[]) {
            panic!("{text}: our own certificate is rejected: {rejection}");
        }
    }
}

/// A certificate, written and read.
fn again(written: &Certificate) -> Certificate {
    let mut bytes = Vec::new();
    certificate::write(written, &mut bytes).expect("a buffer takes everything");
    certificate::read(&bytes).unwrap_or_else(|error| panic!("what was written is not read: {error}"))
}

/// What is printed is read as the same property.
fn reads_back(property: &Property) {
    let text = property.to_string();
    match parse_property(&text) {
        Ok(again) => assert_eq!(again.to_string(), text),
        Err(error) => panic!("what was written is not read: {text}: {error}"),
    }
}

fn small_model() -> IntervalMdp {
    thread_local! {
        static MODEL: OnceCell<IntervalMdp> = const { OnceCell::new() };
    }
    let read = || {
        let tra = write(
            "small.tra",
            b"4 5 8\n0 0 0 [0,0.5] a\n0 0 1 [0.5,1] a\n0 1 2 [0.2,0.7] b\n0 1 3 [0.3,0.8] b\n1 0 1 1\n2 0 0 [0.1,0.9]\n2 0 3 [0.1,0.9]\n3 0 3 [1,1]\n",
        );
        write("small.lab", b"0=\"init\" 1=\"deadlock\" 2=\"goal\" 3=\"bad\"\n0: 0\n1: 3\n3: 2\n");
        write("small.sta", b"(x,b)\n0:(0,true)\n1:(1,false)\n2:(-2,true)\n3:(3,false)\n");
        Format::Prism.import(&tra, &()).expect("the small model").model
    };
    MODEL.with(|model| model.get_or_init(read).clone())
}

fn sha256(bytes: &[u8]) -> [u8; 32] {
    let text = dynabs::imdp::formats::sha256_hex(bytes);
    std::array::from_fn(|i| u8::from_str_radix(&text[2 * i..2 * i + 2], 16).expect("hexadecimal digits"))
}

fn is_identifier(name: &str) -> bool {
    name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
        && name.bytes().next().is_some_and(|first| !first.is_ascii_digit())
}

fn names_a_file(document: &Document) -> bool {
    document.value.to_string().contains("\"file\"")
}

fn number(document: &Document, pointer: &str) -> f64 {
    document.value.pointer(pointer).map_or(0.0, |value| value.as_f64().unwrap_or(0.0))
}

fn cells(document: &Document) -> f64 {
    let cells = document.value.pointer("/partition/cells").and_then(|cells| cells.as_array());
    cells.map_or(0.0, |cells| cells.iter().map(|cells| cells.as_f64().unwrap_or(0.0)).product())
}
