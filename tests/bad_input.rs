//! Every mistake gives one clear error: which file, which field, what was found, what to do.
use crate::common::root;
use assert_cmd::Command;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A shipped model, what is changed about it, and the words that the error must contain.
struct Mistake {
    model: &'static str,
    set: &'static str,
    words: &'static [&'static str],
}

const fn mistake(model: &'static str, set: &'static str, words: &'static [&'static str]) -> Mistake {
    Mistake { model, set, words }
}

const TWO_LAYER: &str = "double_integrator_two_layer";
const ONE_LAYER: &str = "double_integrator";
const ROOM: &str = "room_temperature";

const MISTAKES: &[Mistake] = &[
    // Dynamics.
    mistake(ONE_LAYER, "/dynamics/A=[[2,1],[4,2]]", &["/dynamics/A", "singular", "rank 1"]),
    mistake(ONE_LAYER, "/dynamics/A=[[0.1,0.2],[0.3,0.6]]", &["/dynamics/A", "singular"]),
    mistake(ONE_LAYER, "/dynamics/B=[[1],[0]]", &["/dynamics", "uncontrollable", "rank 1"]),
    mistake(ONE_LAYER, "/dynamics/A=[[2,1],[0]]", &["/dynamics/A/1", "1 number", "2 numbers"]),
    mistake(ONE_LAYER, "/dynamics/A=[[2,1],[0,null]]", &["/dynamics/A/1/1", "null", "a number, such as 0.5"]),
    mistake(ONE_LAYER, "/dynamics/A=[[2,1],[0,1e999]]", &["/dynamics/A"]),
    mistake(ONE_LAYER, "/dynamics/B=[[0.5]]", &["/dynamics/B", "1 row", "2 rows"]),
    mistake(ONE_LAYER, "/dynamics/B=[[0.5,1]]", &["1 row", "2 rows", "such as [[0.5], [1]]"]),
    mistake(ONE_LAYER, "/dynamics/A=5", &["/dynamics/A", "a list of rows, such as [[1, 0], [0, 1]]"]),
    mistake(
        ONE_LAYER,
        "/dynamics/A=[[0,1],[0,0]]",
        &["/dynamics/A", "singular", "discrete-time", "\"sample_time\""],
    ),
    mistake(ONE_LAYER, "/dynamics/q=[1,2,3]", &["/dynamics/q", "3 numbers", "such as [1, 2]"]),
    mistake(ONE_LAYER, "/dynamics/group_steps=1", &["/dynamics/group_steps", "rank 1", "\"auto\" or 2"]),
    mistake(ONE_LAYER, "/dynamics/group_steps=0", &["/dynamics/group_steps", "positive integer or \"auto\""]),
    mistake(ONE_LAYER, "/dynamics/B=[[],[]]", &["/dynamics/B", "no inputs", "leave B and /input out"]),
    mistake(
        ONE_LAYER,
        "/task/goal=[{\"lower\":[50,0],\"upper\":[60,4]}]",
        &["/task/goal", "outside of the partition", "Enlarge /partition"],
    ),
    mistake(ONE_LAYER, "/task/goal=[]", &["/task/goal", "an empty list", "\"type\": \"stay\""]),
    // Inputs.
    mistake(ONE_LAYER, "/input/lower=[61]", &["/input", "61", "60", "empty"]),
    mistake(ONE_LAYER, "/input={\"G\":[[1],[-1]],\"g\":[1,-2]}", &["/input", "no point in common"]),
    mistake(ONE_LAYER, "/input={\"lower\":[1]}", &["/input", "only lower", "{G, g}"]),
    mistake(ONE_LAYER, "/input={\"lower\":[-0.001],\"upper\":[0.001]}", &["/input", "no action is enabled"]),
    // The lower layer.
    mistake(
        TWO_LAYER,
        "/stabilizer/abstract_input={\"lower\":[1,1],\"upper\":[2,2]}",
        &["/stabilizer/abstract_input", "without 0", "contains 0"],
    ),
    mistake(
        TWO_LAYER,
        "/stabilizer/abstract_input={\"lower\":[-1e-3,-1e-3],\"upper\":[1e-3,1e-3]}",
        &["/stabilizer/abstract_input", "no action is enabled", "Enlarge U′"],
    ),
    mistake(TWO_LAYER, "/stabilizer/lqr/R=[[1,0],[0,-1]]", &["/stabilizer/lqr/R", "positive definite"]),
    mistake(TWO_LAYER, "/stabilizer/lqr/Q=[[1,0],[0,0]]", &["/stabilizer/lqr/Q", "positive definite"]),
    mistake(TWO_LAYER, "/stabilizer/lqr/Q=[[1,0],[0.5,1]]", &["/stabilizer/lqr/Q", "symmetric", "0.5"]),
    mistake(TWO_LAYER, "/stabilizer/gain=[[1,0],[0,1]]", &["/stabilizer", "both lqr and gain"]),
    mistake(TWO_LAYER, "/stabilizer/track=\"auto\"", &["/stabilizer", "lqr, track", "exactly one of"]),
    mistake(TWO_LAYER, "/stabilizer={\"lqr\":{\"Q\":[[1]],\"R\":[[1]]}}", &["/stabilizer", "abstract_input"]),
    // The same with a plan.
    mistake(TWO_LAYER, "/stabilizer={\"track\":\"fast\"}", &["/stabilizer/track", "\"auto\" or a list"]),
    mistake(
        TWO_LAYER,
        "/stabilizer={\"track\":\"auto\",\"about\":[0,0]}",
        &["/stabilizer/about", "beside track", "where the plan goes"],
    ),
    mistake(
        TWO_LAYER,
        "/stabilizer={\"track\":\"auto\",\"abstract_input\":{\"lower\":[1,1],\"upper\":[2,2]}}",
        &["/stabilizer/abstract_input", "without 0", "u′ = 0"],
    ),
    mistake(
        TWO_LAYER,
        "/stabilizer={\"track\":[{\"from\":[-20,0],\"to\":[50,0]}]}",
        &["/stabilizer/track/0/to", "[50", "[-41, 41)"],
    ),
    mistake(
        TWO_LAYER,
        "/stabilizer={\"track\":[{\"from\":[-20,0],\"to\":[0]}]}",
        &["/stabilizer/track/0/to", "1 number", "expected 2"],
    ),
    mistake(
        TWO_LAYER,
        "/stabilizer={\"track\":[{\"from\":[-20,0],\"to\":[0,0]},{\"from\":[-20.5,0.5],\"to\":[0,0]}]}",
        &["/stabilizer/track/1/from", "one heading for every cell"],
    ),
    // Noise.
    mistake(
        ROOM,
        "/noise/gaussian/covariance=[[-0.04]]",
        &["/noise/gaussian/covariance", "negative", "positive semidefinite"],
    ),
    mistake(
        "spacecraft_aligned",
        "/noise={\"gaussian\":{\"covariance\":[[1,2,0,0],[2,1,0,0],[0,0,1,0],[0,0,0,1]]},\"count\":100}",
        &["/noise/gaussian/covariance", "negative eigenvalue"],
    ),
    mistake(
        ONE_LAYER,
        "/noise={\"gaussian\":{\"covariance\":[[1,2],[1,5]]},\"count\":100}",
        &["/noise/gaussian/covariance", "symmetric", "(0,1) = 2", "(1,0) = 1"],
    ),
    mistake(ROOM, "/noise/count=5", &["/noise", "8 samples", "at least"]),
    mistake(ROOM, "/probabilities/discard=1500", &["/noise", "2000 samples", "at least"]),
    mistake(ROOM, "/probabilities/discard=-1", &["/probabilities/discard", "-1"]),
    mistake(ROOM, "/noise/samples={\"file\":\"x.csv\",\"of\":\"step\"}", &["/noise", "expected {samples}"]),
    mistake(
        ONE_LAYER,
        "/noise/samples/values=[[1,2]]",
        &["/noise/samples", "both", "exactly one of file and values"],
    ),
    mistake(
        ONE_LAYER,
        "/noise/samples={\"values\":[[1,2],[3]],\"of\":\"step\"}",
        &["/noise/samples/values/1", "1 numbers", "2, one per dimension"],
    ),
    mistake(ONE_LAYER, "/noise/samples/file=\"noise/none.csv\"", &["/noise/samples/file", "none.csv"]),
    // Partition and task.
    mistake(ONE_LAYER, "/partition/cells=[41,0]", &["/partition/cells/1", "0", "at least one cell"]),
    mistake(ONE_LAYER, "/partition/cells=[70000,70000]", &["/partition/cells", "4900000000 cells"]),
    mistake(ONE_LAYER, "/partition/upper=[-41,41]", &["/partition/upper/0", "lower < upper"]),
    mistake(ONE_LAYER, "/partition/cells=[41]", &["/partition/cells", "1 number"]),
    mistake(
        ONE_LAYER,
        "/task/goal=[{\"lower\":[-0.5,-0.5],\"upper\":[0.5,0.5]}]",
        &["/task/goal", "contains no cell", "2 × 2", "Enlarge the goal"],
    ),
    mistake(
        ONE_LAYER,
        "/task/unsafe=[{\"lower\":[2,2],\"upper\":[9,9]}]",
        &["/task/goal/0", "overlaps /task/unsafe/0"],
    ),
    mistake(ONE_LAYER, "/task/goal=[{\"lower\":[3,3],\"upper\":[-3,3]}]", &["/task/goal/0", "lower < upper"]),
    mistake(ONE_LAYER, "/task/horizon=1", &["/task/horizon", "at least 2"]),
    mistake(ONE_LAYER, "/task/horizon=\"forever\"", &["/task/horizon", "forever", "infinite"]),
    mistake(ONE_LAYER, "/task/threshold=1.5", &["/task/threshold", "1.5", "[0, 1]"]),
    mistake(ONE_LAYER, "/initial_state=[50,0]", &["/initial_state/0", "50", "[-41, 41)"]),
    mistake(ONE_LAYER, "/targets=[[0,0],[1]]", &["/targets/1", "1 number"]),
    // The file itself.
    mistake(ONE_LAYER, "/dynamics/C=[[1]]", &["/dynamics/C", "unknown field `C`", "`A`"]),
    mistake(ONE_LAYER, "/dynamic={}", &["/dynamic", "unknown field `dynamic`", "Did you mean \"dynamics\"?"]),
    mistake(ONE_LAYER, "/name=7", &["/name", "7", "string"]),
    mistake(ONE_LAYER, "/name=\"a\\n  satisfied\"", &["/name", "more than one line", "one line"]),
    mistake(ONE_LAYER, "/probabilities/confidence=1", &["/probabilities/confidence", "strictly between"]),
    mistake(ONE_LAYER, "/probabilities/beta=0.01", &["/probabilities", "both confidence and beta"]),
    mistake(ONE_LAYER, "/missing/field=1", &["/missing/field", "--set", "nothing at /missing"]),
];

fn compile(arguments: &[&str]) -> (i32, String, String) {
    let output = Command::cargo_bin("dynabs-compile").unwrap().args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// Expects exit code 2, one error with these words, an empty stdout and nothing written.
fn expect_refusal(model: &Path, set: &[&str], words: &[&str]) {
    let scratch = TempDir::new().unwrap();
    let out = scratch.path().join("out");
    let mut arguments = vec![model.to_str().unwrap(), "-o", out.to_str().unwrap()];
    set.iter().for_each(|set| arguments.extend(["--set", set]));
    let (code, stdout, stderr) = compile(&arguments);
    assert_eq!(code, 2, "{set:?}: {stderr}");
    assert_eq!(stdout, "", "{set:?}");
    assert!(stderr.starts_with("error: ") && stderr.matches("error").count() <= 2, "{set:?}: {stderr}");
    for word in words {
        assert!(stderr.contains(word), "{set:?}: no \"{word}\" in: {stderr}");
    }
    assert_eq!(fs::read_dir(scratch.path()).unwrap().count(), 0, "{set:?}: something was written");
}

#[test]
fn mistakes_in_a_model_are_named() {
    for Mistake { model, set, words } in MISTAKES {
        let path = root().join("models").join(format!("{model}.json"));
        expect_refusal(&path, &[set], words);
    }
}

/// The double integrator with line 731 of its samples replaced.
fn with_line_731(line: &str) -> TempDir {
    let directory = TempDir::new().unwrap();
    fs::create_dir(directory.path().join("noise")).unwrap();
    let text = fs::read_to_string(root().join("models/noise/double_integrator.csv")).unwrap();
    let mut lines: Vec<&str> = text.lines().collect();
    lines[730] = line;
    fs::write(directory.path().join("noise/double_integrator.csv"), lines.join("\n")).unwrap();
    fs::copy(root().join("models/double_integrator.json"), directory.path().join("m.json")).unwrap();
    directory
}

#[test]
fn mistakes_in_samples_have_line_and_column() {
    for (line, words) in [
        ("0.5,NaN", ["line 731, column 2", "\"NaN\"", "finite number"]),
        ("0.5,inf", ["line 731, column 2", "\"inf\"", "finite number"]),
        ("0.5,0.25,1", ["line 731", "3 columns", "2, one per dimension"]),
        ("x,0.25", ["line 731, column 1", "\"x\"", "double_integrator.csv"]),
        ("0,5;0,25", ["line 731, column 1", "\"0,5\"", "\"decimal\": \",\" in /noise/samples"]),
    ] {
        let directory = with_line_731(line);
        expect_refusal(&directory.path().join("m.json"), &[], &words);
    }
}

/// What a spreadsheet writes of the same samples says the same.
#[test]
fn samples_of_spreadsheets_are_read() {
    let directory = with_line_731("0.5,0.25");
    let (model, samples) =
        (directory.path().join("m.json"), directory.path().join("noise/double_integrator.csv"));
    let (model, plain) = (model.to_str().unwrap(), fs::read_to_string(&samples).unwrap());
    let bound = |set: &[&str]| {
        let (code, text, error) = compile(&[&[model, "--dry-run", "--solve", "--json"], set].concat());
        assert_eq!(code, 0, "{error}");
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        value["results"][0]["lower"].clone()
    };
    let expected = bound(&[]);
    assert!(expected.is_f64(), "{expected}");
    fs::write(&samples, format!("\u{feff}x1;x2\r\n{}", plain.replace(',', ";").replace('\n', "\r\n")))
        .unwrap();
    assert_eq!(bound(&[]), expected);
    fs::write(&samples, plain.replace(',', ";").replace('.', ",")).unwrap();
    assert_eq!(bound(&["--set", "/noise/samples/decimal=,"]), expected);
}

#[test]
fn mistakes_in_files_are_named() {
    let directory = TempDir::new().unwrap();
    let file = directory.path().join("m.json");
    for (text, words) in [
        ("{\"name\": \"x\",\n \"name\": \"y\"}", ["line 2", "\"name\" twice"]),
        ("{\"name\": }", ["line 1", "expected value"]),
        ("{\"name\": \"x\"} trailing", ["line 1", "trailing"]),
        ("{\n  // a car\n  \"name\": \"x\"}", ["line 2", "JSON has no comments"]),
        ("{\"name\": /* a car */ \"x\"}", ["line 1, column 10", "JSON has no comments"]),
        ("[]", ["m.json", "an object, in { and }"]),
        ("{\"name\": \"x\"}", ["no field `dynamics`", "m.json"]),
    ] {
        fs::write(&file, text).unwrap();
        expect_refusal(&file, &[], &words);
    }
    expect_refusal(&directory.path().join("none.json"), &[], &["no such file", "--init"]);
    expect_refusal(directory.path(), &[], &["not text"]);
}

#[test]
fn places_that_are_taken_stay_as_they_are() {
    let scratch = TempDir::new().unwrap();
    let model = root().join("models/room_temperature.json");
    let foreign = scratch.path().join("foreign");
    fs::create_dir(&foreign).unwrap();
    fs::write(foreign.join("thesis.tex"), "precious").unwrap();
    fs::write(scratch.path().join("file"), "precious").unwrap();
    for (target, force, words) in
        [("foreign", false, "other files"), ("foreign", true, "other files"), ("file", true, "a file")]
    {
        let out = scratch.path().join(target);
        let mut arguments = vec![model.to_str().unwrap(), "-o", out.to_str().unwrap()];
        arguments.extend(force.then_some("--force"));
        let (code, _, stderr) = compile(&arguments);
        assert_eq!(code, 2, "{stderr}");
        assert!(stderr.contains(words), "{stderr}");
    }
    assert_eq!(fs::read_to_string(foreign.join("thesis.tex")).unwrap(), "precious");
    assert_eq!(fs::read_dir(scratch.path()).unwrap().count(), 2);
}

#[test]
fn wrong_usage_is_exit_code_2() {
    for arguments in
        [&["--no-such-option"][..], &[], &["model.json"], &["m.json", "--dry-run", "--threads", "0"]]
    {
        assert_eq!(compile(arguments).0, 2, "{arguments:?}");
    }
    let model = root().join("models/room_temperature.json");
    let (code, _, stderr) = compile(&[model.to_str().unwrap(), "--dry-run", "--set", "task=1"]);
    assert_eq!(code, 2);
    assert!(stderr.contains("starts with '/'"), "{stderr}");
}
