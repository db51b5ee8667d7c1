//! Reports: complete, self-contained, well-formed, truthful; driven in a real browser if there is one.
use crate::common::{document, reference_mode, root, shipped_models};
use assert_cmd::Command;
use dynabs::abstraction::compile;
use dynabs::controller::Controller;
use dynabs::report::{CROSS_CHECK, Material, MaterialOptions, Picture, page, pictures, read_cross_checks};
use dynabs::run::{Manifest, Run, WriteOptions, write_run};
use imdp::formats::sha256_hex;
use imdp::solver::{Answer, SolverOptions};
use serde_json::{Value, json};
use std::f64::consts::PI;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;
use tempfile::TempDir;

/// A run directory of a shipped model.
fn compiled(scratch: &TempDir, model: &str, sets: &[&str]) -> PathBuf {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let document = document(model, &sets);
    let problem = document.problem().unwrap();
    let abstraction = compile(&problem, &()).unwrap();
    let manifest = Manifest::new(&document, "", &problem, &abstraction);
    let directory = scratch.path().join(model);
    let options = WriteOptions { force: true, ..WriteOptions::default() };
    write_run(&directory, &document, &problem, &abstraction, manifest, options, &()).unwrap();
    directory
}

struct Reported {
    answer: Answer,
    run: Run,
    page: String,
    pictures: Vec<Picture>,
}

fn reported(directory: &Path, times: Vec<(&'static str, Duration)>) -> Reported {
    let run = Run::open(directory, &()).unwrap();
    let solver = SolverOptions { policy: true, ..SolverOptions::default() };
    let answer = run.solve(&solver).unwrap();
    let controller = Controller::new(&run.problem, &run.abstraction, &answer).unwrap();
    let cross_checks = read_cross_checks(directory, &run.manifest).unwrap();
    let options = MaterialOptions { seed: 1, runs: 300, drawn: 12, times, cross_checks };
    let (page, pictures) = {
        let material = Material::new(&run, &answer, &controller, options, &());
        (page(&material).unwrap(), pictures(&material))
    };
    Reported { answer, run, page, pictures }
}

/// The text between two marks.
fn between<'a>(text: &'a str, start: &str, end: &str) -> &'a str {
    text.split_once(start).unwrap().1.split_once(end).unwrap().0
}

fn data(page: &str) -> Value {
    serde_json::from_str(between(page, "<script type=\"application/json\" id=\"data\">", "</script>"))
        .unwrap()
}

/// Every element that is opened is closed, in order; attributes are quoted; no stray `<` or `&`.
fn assert_well_formed(markup: &str) {
    let mut open: Vec<&str> = vec![];
    let mut rest = markup;
    while let Some((text, after)) = rest.split_once('<') {
        for entity in text.split('&').skip(1) {
            let name = entity.split_once(';').unwrap_or_else(|| panic!("a stray & before {entity:.40}")).0;
            assert!(["amp", "lt", "gt", "quot", "#39"].contains(&name), "&{name};");
        }
        let (tag, after) = after.split_once('>').unwrap();
        rest = after;
        if tag.starts_with("!DOCTYPE") {
            continue;
        }
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "before {after:.60}");
            continue;
        }
        assert_eq!(tag.matches('"').count() % 2, 0, "<{tag}>");
        let name = tag.split([' ', '\n', '/']).next().unwrap();
        if ["script", "style"].contains(&name) {
            rest = after.split_once(&format!("</{name}>")).unwrap().1;
        } else if name != "meta" && !tag.ends_with('/') {
            open.push(name);
        }
    }
    assert_eq!(open, Vec::<&str>::new());
}

/// Nothing is loaded: the only addresses are names of namespaces.
fn assert_self_contained(text: &str) {
    let namespaces = ["http://www.w3.org/2000/svg\"", "http://www.w3.org/1998/Math/MathML\""];
    for (i, _) in text.match_indices("http") {
        let known = namespaces.iter().any(|name| text[i..].starts_with(name));
        assert!(known || text[i..].starts_with("http-equiv"), "{:.60}", &text[i..]);
    }
    for sign in [" src=", " href=", "@import", "url(\"", "url('", "//cdn"] {
        assert!(!text.contains(sign), "{sign}");
    }
    assert_eq!(text.matches("url(").count(), text.matches("url(#").count());
}

fn assert_numbers(svg: &str) {
    for wrong in ["NaN", "inf", "null"] {
        assert!(!svg.contains(wrong), "{wrong}");
    }
    let mut numbers = 0;
    for path in svg.split(" d=\"").skip(1) {
        let path = path.split('"').next().unwrap();
        for number in
            path.split(|c: char| c.is_ascii_alphabetic() || c == ' ').filter(|text| !text.is_empty())
        {
            let number: f64 = number.parse().unwrap_or_else(|_| panic!("{number}"));
            assert!(number.is_finite() && number.abs() < 1e7, "{number}");
            numbers += 1;
        }
    }
    assert!(numbers > 20, "{numbers} numbers only");
}

fn decoded(base64: &str) -> Vec<u8> {
    let digit = |c: u8| match c {
        b'A'..=b'Z' => u32::from(c - b'A'),
        b'a'..=b'z' => u32::from(c - b'a') + 26,
        b'0'..=b'9' => u32::from(c - b'0') + 52,
        b'+' => 62,
        _ => 63,
    };
    let padding = base64.matches('=').count();
    let mut bytes: Vec<u8> = base64
        .as_bytes()
        .chunks(4)
        .flat_map(|four| {
            let bits = four.iter().fold(0, |bits, &c| bits << 6 | if c == b'=' { 0 } else { digit(c) });
            bits.to_be_bytes()[1..].to_vec()
        })
        .collect();
    bytes.truncate(bytes.len() - padding);
    bytes
}

/// What is embedded is what was computed, rounded down.
fn assert_truthful(reported: &Reported) {
    let Reported { answer, run, page, .. } = reported;
    let data = data(page);
    let bytes = decoded(data["values"]["data"].as_str().unwrap());
    let values: Vec<f64> =
        bytes.chunks_exact(4).map(|bytes| f64::from(f32::from_le_bytes(bytes.try_into().unwrap()))).collect();
    let cells = run.problem.grid().num_cells() as usize;
    let steps = run.problem.horizon().unwrap_or(0) as usize + 1;
    assert_eq!(values.len(), cells * steps);
    for (value, &state) in values.iter().zip(&run.abstraction.state_of_cell) {
        let exact = answer.values.lower[state.index()];
        assert!(*value <= exact && exact - value < 1e-6, "{value} for {exact}");
    }
    // With nothing left to do only the goal counts, and less time never helps.
    if steps > 1 {
        assert!(values[cells * (steps - 1)..].iter().all(|&value| value == 0.0 || value == 1.0));
        assert!((0..cells * (steps - 1)).all(|i| values[i] >= values[i + cells]));
    }
    let model = &run.abstraction.model;
    let enabled: usize = run.abstraction.state_of_cell.iter().map(|&s| model.choices().ranges(s).len()).sum();
    let width = match data["ranges"]["length"]["type"].as_str().unwrap() {
        "u8" => 1,
        "u16" => 2,
        _ => 4,
    };
    assert_eq!(decoded(data["ranges"]["length"]["data"].as_str().unwrap()).len(), enabled * width);
}

#[test]
fn every_shipped_model_in_both_modes() {
    let scratch = TempDir::new().unwrap();
    for model in shipped_models() {
        for reference in [false, true] {
            let set = reference_mode();
            let sets: &[&str] = if reference { &[&set] } else { &[] };
            let reported = reported(&compiled(&scratch, &model, sets), vec![]);
            let Reported { page, pictures, run, answer } = &reported;
            assert!(page.len() < 3 << 20, "{model}: {} bytes", page.len());
            assert_self_contained(page);
            assert_well_formed(page);
            assert_truthful(&reported);
            for picture in pictures {
                assert_self_contained(&picture.svg);
                assert_well_formed(&picture.svg);
                assert_numbers(&picture.svg);
                assert!(
                    picture.svg.len() < 100 << 10,
                    "{model}: {} of {} bytes",
                    picture.name,
                    picture.svg.len()
                );
            }
            let promise = between(page, "<h2>What is promised</h2>", "</section>");
            assert_eq!(promise.contains("No guarantee"), reference, "{model}");
            assert_eq!(promise.contains("confidence <strong>0.99</strong>"), !reference, "{model}");
            assert_eq!(promise.contains("nothing is guaranteed"), reference, "{model}");
            assert_eq!(page.contains("promised probability"), !reference, "{model}");
            let bound = dynabs::guarantee::lower_bound_text(answer.lower);
            assert!(promise.contains(&bound), "{model}: {bound}");
            for allocation in run.manifest.guarantee.samples().iter().flat_map(|samples| &samples.budget) {
                assert!(page.contains(&format!("<th scope=\"row\">{}</th>", allocation.family)));
            }
            assert!(!page.contains("<h2>Cross-check</h2>"));
            assert_eq!(data(page)["runs"].as_array().unwrap().len(), 12);
        }
    }
}

/// Where a plan is followed: its regions, where they steer to, and their law.
#[test]
fn plans_are_drawn() {
    let scratch = TempDir::new().unwrap();
    fs::create_dir(scratch.path().join("tracking")).unwrap();
    let track = "/stabilizer={\"track\":\"auto\"}";
    for (model, sets) in [("room_temperature", &[track][..]), ("tracking/double_integrator", &[])] {
        let Reported { page, pictures, run, .. } = reported(&compiled(&scratch, model, sets), vec![]);
        assert_well_formed(&page);
        let plan = run.manifest.plan.unwrap();
        let section = between(&page, "<h2>The plan</h2>", "</section>");
        let (rows, targets) = (section.matches("<th scope=\"row\">").count() as u64, plan.targets);
        assert_eq!(rows, targets.min(12), "{model}");
        assert_eq!(section.contains(&format!("12 largest of {targets} regions")), targets > 12, "{model}");
        let svg = &pictures.iter().find(|picture| picture.name == "plan").unwrap().svg;
        assert_well_formed(svg);
        assert_numbers(svg);
        let tiles = between(svg, "<g class=\"heat\">", "</g>").matches("<path").count() as u64;
        let dots = svg.matches("<path class=\"heading\"").count() as u64;
        // All regions of one dimension, or of two, are in the picture; over time a target has no place.
        assert_eq!(
            (tiles, dots),
            (targets, if model == "room_temperature" { 0 } else { targets }),
            "{model}"
        );
    }
    let Reported { page, pictures, .. } = reported(&compiled(&scratch, "double_integrator", &[]), vec![]);
    assert!(!page.contains("<h2>The plan</h2>") && pictures.iter().all(|picture| picture.name != "plan"));
}

#[test]
fn the_same_page_every_time() {
    let scratch = TempDir::new().unwrap();
    let directory = compiled(&scratch, "room_temperature", &[]);
    let on = |threads, times| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| reported(&directory, times).page)
    };
    assert_eq!(on(1, vec![]), on(3, vec![]));
    let timed = on(1, vec![("thinking", Duration::from_millis(1500))]);
    assert!(timed.contains("<th scope=\"row\">thinking</th><td>1.500 s</td>"));
}

#[test]
fn names_are_disarmed() {
    let scratch = TempDir::new().unwrap();
    let name = "/name=\"</script><script>alert(1)</script>&'\"";
    let description = "/description=<img src=x onerror=alert(2)>";
    let reported = reported(&compiled(&scratch, "room_temperature", &[name, description]), vec![]);
    assert!(reported.page.contains("&lt;script&gt;alert(1)&lt;/script&gt;&amp;&#39;"));
    for text in reported.pictures.iter().map(|picture| &picture.svg).chain([&reported.page]) {
        assert!(!text.contains("<script>alert") && !text.contains("<img"));
        assert_well_formed(text);
    }
}

/// The vehicle with coordinates and a region that would be markup.
fn hostile() -> Value {
    let mut model = vehicle();
    let names = ["<b>v</b>", "\"><img src=q onerror=alert(1)>", "</script><script>alert(2)</script>&lt;"];
    model["dynamics"]["states"] = json!(names);
    model["dynamics"]["inputs"] = json!(["<b>", "'&amp;"]);
    model["dynamics"]["units"] = json!({(names[0]): "<b>", (names[1]): "m", (names[2]): "m"});
    model["partition"]["periodic"] = json!([true, false, false]);
    model
}

#[test]
fn names_of_coordinates_are_disarmed() {
    let scratch = TempDir::new().unwrap();
    let model = hostile();
    let (path, pictures) = page_of(&scratch, "hostile", &model);
    let page = fs::read_to_string(path).unwrap();
    for text in pictures.iter().chain([&page]) {
        assert!(!text.contains("<b>") && !text.contains("<img") && !text.contains("<script>alert"));
        assert_well_formed(text);
    }
    // What the script gets are the names themselves; it makes them safe where it makes markup of them.
    assert_eq!(data(&page)["names"], model["dynamics"]["states"]);
}

#[test]
fn unbounded_tasks_and_no_initial_state() {
    let scratch = TempDir::new().unwrap();
    for model in ["room_temperature", "double_integrator"] {
        let sets = ["/task/horizon=\"infinite\"", "/initial_state=null"];
        let reported = reported(&compiled(&scratch, model, &sets), vec![]);
        assert!(reported.page.contains("the model names no initial state"), "{model}");
        assert_truthful(&reported);
        for picture in &reported.pictures {
            assert_numbers(&picture.svg);
        }
    }
}

#[test]
fn large_models_leave_things_out_and_say_so() {
    let scratch = TempDir::new().unwrap();
    let few_targets = "/targets={\"lower\":[0],\"upper\":[12],\"cells\":[48]}";
    for (cells, left_out) in [
        (150_000, "Left out of this page for its size: values after step 1 of 6"),
        (300_001, "300001 cells are too many to embed: the plots cannot be changed"),
    ] {
        let set = format!("/partition/cells=[{cells}]");
        // Less noise makes rows shorter and the test faster.
        let quiet = "/noise/gaussian/covariance=[[0.000001]]";
        let reported = reported(&compiled(&scratch, "room_temperature", &[&set, few_targets, quiet]), vec![]);
        assert!(reported.page.contains(left_out), "{cells}");
        assert!(reported.page.len() < 5_000_000, "{cells}: {} bytes", reported.page.len());
        assert_eq!(data(&reported.page).is_null(), cells > 300_000);
        for picture in &reported.pictures {
            assert_numbers(&picture.svg);
        }
    }
}

/// Where runs remember something, too.
#[test]
fn large_models_with_a_memory_leave_things_out_and_say_so() {
    let scratch = TempDir::new().unwrap();
    let sets = [
        "/targets={\"lower\":[0],\"upper\":[12],\"cells\":[48]}",
        "/noise/gaussian/covariance=[[0.000001]]",
        "/partition/cells=[48000]",
        "/regions={\"a\":{\"lower\":[5],\"upper\":[7]},\"b\":{\"lower\":[8],\"upper\":[9]}}",
        "/task={\"type\":\"sequence\",\"sequence\":[{\"reach\":\"a\"},{\"reach\":\"b\"}],\"horizon\":6}",
    ];
    let reported = reported(&compiled(&scratch, "room_temperature", &sets), vec![]);
    assert_eq!(data(&reported.page)["memories"], 2);
    let last = data(&reported.page)["lastStep"].as_u64().unwrap();
    assert!(last < 6 && reported.page.contains(&format!("values after step {last} of 6")), "{last}");
}

#[test]
fn the_tool_and_its_mistakes() {
    let scratch = TempDir::new().unwrap();
    let directory = compiled(&scratch, "room_temperature", &[]);
    let output = scratch.path().join("page.html");
    let check = |expected: i32| {
        let mut command = Command::cargo_bin("dynabs-check").unwrap();
        command
            .arg("report")
            .arg(&directory)
            .arg("-o")
            .arg(&output)
            .arg("--svg")
            .arg(scratch.path().join("svg"));
        command.args(["--no-times", "--runs", "100", "--seed", "1"]);
        let run = command.output().unwrap();
        assert_eq!(run.status.code(), Some(expected), "{}", String::from_utf8_lossy(&run.stderr));
        String::from_utf8(run.stderr).unwrap()
    };
    check(0);
    let plain = fs::read_to_string(&output).unwrap();
    assert_well_formed(&fs::read_to_string(scratch.path().join("svg/value.svg")).unwrap());

    // What other engines said is shown, whatever they are called.
    let model = fs::read(directory.join("model.dynabs")).unwrap();
    let model = serde_json::json!([{"kind": "dynabs", "sha256": sha256_hex(&model)}]);
    let findings = serde_json::json!({"model": model, "findings": [{
        "engine": "PRISM", "version": "<4>", "property": "Pmaxmin=? [ !\"failed\" U<=6 \"reached\" ]",
        "value": [0.99, 0.99], "ours": [0.99, 0.99], "difference": 1.5e-14, "seconds": 1.25, "agreement": "agrees",
    }]});
    fs::write(directory.join(CROSS_CHECK), findings.to_string()).unwrap();
    check(0);
    let page = fs::read_to_string(&output).unwrap();
    assert!(
        page.contains("<h2>Cross-check</h2>") && page.contains("PRISM &lt;4&gt;") && page.contains("1.5e-14")
    );
    assert_well_formed(&page);

    fs::write(directory.join(CROSS_CHECK), "{}").unwrap();
    let error = check(2);
    assert!(error.contains("crosscheck.json: found something else"), "{error}");
    assert_eq!(fs::read_to_string(&output).unwrap(), page, "a failed report leaves the old one alone");

    fs::remove_file(directory.join(CROSS_CHECK)).unwrap();
    check(0);
    assert_eq!(fs::read_to_string(&output).unwrap(), plain);
}

/// The page and the plots of a model.
fn page_of(scratch: &TempDir, name: &str, model: &Value) -> (PathBuf, Vec<String>) {
    let (file, directory) = (scratch.path().join(format!("{name}.json")), scratch.path().join(name));
    fs::write(&file, model.to_string()).unwrap();
    let run = |tool: &str, arguments: &[&Path]| {
        let output = Command::cargo_bin(tool).unwrap().args(arguments).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    };
    run("dynabs-compile", &[&file, Path::new("-o"), &directory, Path::new("--no-tra"), Path::new("-q")]);
    let (page, svg) = (scratch.path().join(format!("{name}.html")), directory.join("svg"));
    let options = ["--runs=200", "--keep=9", "--no-times", "-q", "-o"].map(Path::new);
    run(
        "dynabs-check",
        &[&[Path::new("report"), &directory], &options[..], &[&page, Path::new("--svg"), &svg]].concat(),
    );
    let pictures =
        ["value", "section"].map(|name| fs::read_to_string(svg.join(format!("{name}.svg"))).unwrap());
    (page, pictures.to_vec())
}

/// A car of which a parameter is uncertain, and a room in one dimension.
fn input_models() -> [(&'static str, Value); 3] {
    let noise = json!({"gaussian": {"deviation": 0.3}});
    let car = json!({
        "name": "car <&>",
        "dynamics": {
            "states": ["x", "heading"], "inputs": ["turn", "speed"], "units": {"x": "m", "heading": "<rad>"},
            "parameters": {"grip": [0.8, 1]},
            "next": ["x + grip*speed*cos(heading)", "heading + 0.5*turn"]
        },
        "noise": {"components": [noise, {"uniform": {"lower": -0.1, "upper": 0.1}}]},
        "input": {"lower": [-1, 0], "upper": [1, 1], "points": [3, 2]},
        "partition": {
            "lower": [-4, -PI], "upper": [4, PI], "cells": [16, 12], "periodic": [false, true]
        },
        "task": {
            "goal": [{"lower": [2, null], "upper": [4, null]}], "unsafe": [{"lower": [-4, null], "upper": [-3, null]}],
            "horizon": 8, "threshold": 0.5
        },
        "initial_state": [-1, 0.3]
    });
    let room = json!({
        "name": "room",
        "dynamics": {"A": [[0.9]], "B": [[1]], "units": {"x1": "°C"}},
        "noise": {"components": [noise]},
        "input": {"lower": [-1], "upper": [1], "points": [3]},
        "partition": {"lower": [-2], "upper": [2], "cells": [20]},
        "task": {"type": "stay", "horizon": 12}
    });
    let mut formula = car.clone();
    formula["regions"] =
        json!({"a": {"lower": [0, -4], "upper": [1, 4]}, "b": {"G": [[-1, 0], [0.5, 1]], "g": [-2, 4]}});
    formula["task"] = json!({"type": "sequence", "sequence": [{"reach": "b"}, {"reach": "a"}], "horizon": 9});
    [("car", car), ("room", room), ("formula", formula)]
}

/// A vehicle with three coordinates, of which two have one unit and are what the task speaks of.
fn vehicle() -> Value {
    let noise = json!({"gaussian": {"deviation": 0.1}});
    json!({
        "name": "vehicle",
        "dynamics": {
            "states": ["v", "x", "y"], "units": {"x": "m", "y": "m", "v": "m/s"},
            "A": [[0.9, 0, 0], [0.3, 1, 0], [0, 0, 0.9]], "B": [[0, 1], [0, 0], [1, 0]]
        },
        "actions": "inputs", "noise": {"components": [noise, noise, noise]},
        "input": {"lower": [-1, -1], "upper": [1, 1], "points": [3, 3]},
        "partition": {"lower": [-2, -4, -2], "upper": [2, 4, 2], "cells": [4, 16, 8]},
        "task": {
            "goal": [{"lower": [null, 2, -1], "upper": [null, 4, 1]}],
            "unsafe": [{"lower": [null, 0, -2], "upper": [null, 1, 0]}], "horizon": 12
        },
        "initial_state": [1, -1, 0.6]
    })
}

#[test]
fn one_unit_has_one_scale_and_runs_outside_of_the_slice_are_faded() {
    let scratch = TempDir::new().unwrap();
    let (page, pictures) = page_of(&scratch, "vehicle", &vehicle());
    let page = fs::read_to_string(page).unwrap();
    let axes = between(&pictures[0], "<g class=\"axes\">", "</g>");
    let side = |name: &str| -> f64 { between(axes, &format!(" {name}=\""), "\"").parse().unwrap() };
    // Eight meters across, four up.
    assert!((side("width") / side("height") - 2.0).abs() < 0.01, "{axes}");
    assert!(axes.contains(">x [m]<") && axes.contains(">y [m]<"), "{axes}");
    assert!(pictures[0].contains("run faded\"") && pictures[0].contains("promised probability</text>"));
    assert!(!between(&page, "data-drawn=\"run faded\"", "</span>").starts_with(" hidden"));
}

#[test]
fn runs_over_time_and_the_noise_are_drawn() {
    let scratch = TempDir::new().unwrap();
    let mut model = vehicle();
    model["noise"]["components"][0] = json!(null);
    let (page, _) = page_of(&scratch, "vehicle", &model);
    let page = fs::read_to_string(page).unwrap();
    let picture = |name: &str| {
        let path = scratch.path().join(format!("vehicle/svg/{name}.svg"));
        path.exists().then(|| fs::read_to_string(path).unwrap())
    };
    for name in ["state-1", "state-2", "state-3", "input-1", "input-2", "noise", "noise-2", "noise-3"] {
        let svg = picture(name).unwrap_or_else(|| panic!("no {name}.svg"));
        assert_well_formed(&svg);
        assert_numbers(&svg);
        assert!(page.contains(&format!("id=\"{name}\"")), "{name} is not on the page");
    }
    assert!(picture("noise-1").is_none() && picture("state-4").is_none(), "there is nothing to draw");
    let input = picture("input-1").unwrap();
    assert_eq!(input.matches("class=\"threshold\"").count(), 2, "the limits of U");
    assert_eq!(picture("state-2").unwrap().matches("<path class=\"trace").count(), 9, "a line for every run");
    // Of a normal distribution with deviation .1 nearly all lies within half a cell, .25, of 0.
    let bars = between(&picture("noise-3").unwrap(), "<path class=\"bar\" d=\"", "\"").matches('M').count();
    assert!((1..=3).contains(&bars), "{bars} bars");
    assert_eq!(between(&picture("noise").unwrap(), "class=\"sample\" d=\"", "\"").matches('M').count(), 1000);
}

#[test]
fn inputs_are_reported() {
    let scratch = TempDir::new().unwrap();
    for (name, model) in input_models() {
        let (path, pictures) = page_of(&scratch, name, &model);
        let page = fs::read_to_string(path).unwrap();
        assert_well_formed(&page);
        assert_self_contained(&page);
        for svg in &pictures {
            assert_well_formed(svg);
            assert_numbers(svg);
        }
        let data = data(&page);
        let cells: u64 = data["cells"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).product();
        let values = decoded(data["values"]["data"].as_str().unwrap());
        let steps = data["lastStep"].as_u64().unwrap();
        let expected = if name == "formula" { 0 } else { model["task"]["horizon"].as_u64().unwrap() };
        let memories = data.get("memories").map_or(0, |count| count.as_u64().unwrap());
        assert_eq!(memories, if name == "formula" { 2 } else { 0 }, "{name}");
        // At the start and with each memory before.
        let maps = 1 + memories;
        assert_eq!((steps, values.len() as u64), (expected, 4 * cells * (steps + 1) * maps), "{name}");
        assert_eq!(data["runs"].as_array().unwrap().len(), 9);
        let (of, words) = if name == "room" { ("u1", "°C") } else { ("(turn, speed)", "[&lt;rad&gt;]") };
        assert!(data["inputs"][0].as_str().unwrap().starts_with(of), "{data}");
        assert!(page.contains(words) && !page.contains("<rad>"));
        assert!(page.contains("no controller with these inputs is worth more"));
        let verdict = between(&page, "<p class=\"verdict", "</p>");
        let asked = if name == "car" { "asked for ≥ 0.5, promised ≥ " } else { "no threshold" };
        assert!(verdict.contains(asked), "{name}: {verdict}");
        // The legend has what is drawn, and nothing else.
        for (drawn, what) in [
            ("unsafe outline", "unsafe region"),
            ("named outline", "region of the task"),
            ("run faded", "outside of the slice"),
        ] {
            let entry = between(&page, &format!("data-drawn=\"{drawn}\""), "</span>\n");
            assert!(entry.contains(what), "{entry}");
            assert_eq!(entry.starts_with(" hidden"), !pictures[0].contains(drawn), "{name}: {drawn}");
        }
        let is_safe = page.contains("> safe region</span>");
        assert_eq!(is_safe, name == "room", "{name}");
        let named = if name == "formula" { 2 } else { 0 };
        assert_eq!(pictures[0].matches("<path class=\"named outline\"").count(), named, "{name}");
        let bound = between(&page, "<strong>≥ ", "</strong>");
        assert!(bound.parse::<f64>().is_ok_and(|bound| (0.0..=1.0).contains(&bound)), "{bound}");
    }
}

#[test]
fn a_browser_opens_it() {
    let scratch = TempDir::new().unwrap();
    let mut command = std::process::Command::new(root().join("scripts/check-report.sh"));
    for (model, sets) in [
        ("room_temperature", vec![]),
        ("double_integrator", vec![reference_mode()]),
        ("spacecraft_aligned_two_layer", vec![]),
    ] {
        let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
        let file = scratch.path().join(format!("{model}.html"));
        fs::write(&file, reported(&compiled(&scratch, model, &sets), vec![]).page).unwrap();
        command.arg(file);
    }
    // Bounds from above come true here at every step: what is kept is what is not left.
    let kept = json!({
        "name": "kept", "dynamics": {"A": [[0.9]], "B": [[1]]}, "input": {"lower": [-1], "upper": [1]}, "actions": "targets",
        "noise": {"components": [{"gaussian": {"deviation": 0.3}}]},
        "partition": {"lower": [-2], "upper": [2], "cells": [20]}, "task": {"type": "stay", "horizon": 6}
    });
    for (name, model) in input_models().into_iter().chain([("kept", kept), ("three", hostile())]) {
        command.arg(page_of(&scratch, name, &model).0);
    }
    let output = command.output().unwrap();
    let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    match output.status.code() {
        // Not by eprintln!, which nobody sees when a test passes.
        Some(3) => writeln!(std::io::stderr(), "SKIPPED: no report was opened in a browser: {text}").unwrap(),
        code => assert_eq!(code, Some(0), "{text}"),
    }
}

#[test]
fn other_programs_draw_the_same() {
    let scratch = TempDir::new().unwrap();
    let mut pictures: Vec<PathBuf> = vec![];
    for (name, model) in input_models() {
        page_of(&scratch, name, &model);
        let small = ["state-2", "input-1", "noise", "noise-1"].iter().take(if name == "car" { 4 } else { 0 });
        let plots = ["value", "section"].iter().chain(small);
        pictures.extend(plots.map(|plot| scratch.path().join(format!("{name}/svg/{plot}.svg"))));
    }
    let python = std::env::var("DYNABS_PYTHON");
    let mut command = std::process::Command::new(python.as_deref().unwrap_or("python3"));
    let output = command.arg(root().join("scripts/check-pictures.py")).args(&pictures).output().unwrap();
    let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    match output.status.code() {
        Some(3) if python.is_err() => {
            writeln!(std::io::stderr(), "SKIPPED: no picture was drawn by others: {text}").unwrap();
        }
        code => assert_eq!(code, Some(0), "{text}"),
    }
}

#[test]
fn the_first_view_can_be_chosen() {
    let scratch = TempDir::new().unwrap();
    let (_, car) = input_models().into_iter().next().unwrap();
    let directory = page_of(&scratch, "car", &car).0.with_extension("");
    let output = scratch.path().join("chosen.html");
    let report = |options: &[&str]| {
        let mut command = Command::cargo_bin("dynabs-check").unwrap();
        command.arg("report").arg(&directory).arg("-o").arg(&output).args([
            "--runs=20",
            "--keep=2",
            "--no-times",
            "-q",
        ]);
        command.args(options).output().unwrap()
    };
    let view = |options: &[&str]| {
        let run = report(options);
        assert!(run.status.success(), "{options:?}: {}", String::from_utf8_lossy(&run.stderr));
        let page = fs::read_to_string(&output).unwrap();
        let picture = between(&page, "id=\"map\"", "</svg>").to_owned();
        (data(&page)["view"].clone(), picture)
    };
    let axis_names = |picture: &str, across: &str, up: &str| {
        let names: Vec<_> = picture.split("<text class=\"name\"").skip(1).collect();
        assert!(names[0].contains(across) && names[1].contains(up), "{names:?}");
    };
    // The cell of (-1, 0.3) among 16 of [-4, 4) and 12 of [-π, π).
    let start = json!([6, 6]);
    let (chosen, picture) = view(&[]);
    assert_eq!(chosen, json!({"across": 0, "up": 1, "slice": start, "step": 0}));
    axis_names(&picture, "x [m]", "heading");
    let (chosen, picture) = view(&["--across", "heading", "--up", "1", "--at", "x=1.5, heading=-3"]);
    assert_eq!(chosen, json!({"across": 1, "up": 0, "slice": [11, 0], "step": 0}));
    axis_names(&picture, "heading", "x [m]");
    assert_eq!(view(&["--up=x1"]).0["across"], 1, "the other axis gives way");
    assert_eq!(
        view(&["--across=time", "--at=2=0"]).0,
        json!({"across": -1, "up": 0, "slice": [6, 6], "step": 0})
    );

    for (options, expected) in [
        (
            &["--across=speed"][..],
            "--across: found \"speed\"; expected a coordinate of the state: x, heading, or time",
        ),
        (&["--up=3"], "--up: found \"3\"; expected a coordinate of the state: x, heading"),
        (&["--up=x", "--across=x1"], "--up: found \"x\" on both axes; expected two different ones"),
        (&["--at=x"], "--at: found \"x\"; expected a coordinate and a number, such as x3=0.5"),
        (&["--at=x=4"], "--at: found x = 4; expected a number in [-4, 4), where the partition is"),
        (&["--at=x=NaN"], "--at: found x = NaN; expected a number in [-4, 4)"),
    ] {
        let run = report(options);
        let error = String::from_utf8(run.stderr).unwrap();
        assert_eq!((run.status.code(), error.matches("expected").count()), (Some(2), 1), "{error}");
        assert!(error.contains(expected), "{error}");
    }
}

/// What the task depends on is what is seen first.
#[test]
fn the_first_view_shows_the_task() {
    let scratch = TempDir::new().unwrap();
    let noise = json!({"gaussian": {"deviation": 0.3}});
    let region = |lower: Value, upper: Value| json!([{"lower": lower, "upper": upper}]);
    let plane = |goal: Value, avoid: Value| {
        let model = json!({
            "name": "three",
            "dynamics": {"A": [[0.9, 0, 0], [0, 0.9, 0], [0, 0, 0.9]], "B": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]},
            "noise": {"components": [noise, noise, noise]},
            "input": {"list": [[0, 0, 0]]}, "actions": "inputs",
            "partition": {"lower": [-2, -2, -2], "upper": [2, 2, 2], "cells": [4, 4, 4]},
            "task": {"goal": goal, "unsafe": avoid, "horizon": 3}
        });
        let page = fs::read_to_string(page_of(&scratch, "three", &model).0).unwrap();
        fs::remove_dir_all(scratch.path().join("three")).unwrap();
        [data(&page)["view"]["across"].as_i64().unwrap(), data(&page)["view"]["up"].as_i64().unwrap()]
    };
    let everywhere = json!([]);
    assert_eq!(plane(region(json!([0, null, 0]), json!([null, null, null])), everywhere.clone()), [0, 2]);
    // A side on or beyond the border of the partition is none.
    assert_eq!(plane(region(json!([-2, 0, 0]), json!([2, 5, null])), everywhere), [1, 2]);
    // Of three, those that both regions depend on.
    let avoid = region(json!([null, -1, -1]), json!([null, 0, 0]));
    assert_eq!(plane(region(json!([1, 0, 0]), json!([2, 2, 2])), avoid), [1, 2]);
}
