//! Rewards keep their values through every format that can hold them.

use assert_cmd::Command;
use imdp::formats::prism::import_combined;
use imdp::model::{IntervalMdp, StateId};
use std::path::Path;

/// Rewards of states, of choices (twice: with and without others), of branches, of an absorbing state and none at all; state
/// 2 has no choice in PRISM's sense but a self-loop.
const MODEL: &str = "# Transitions (IMDP)\n3 4 6\n0 0 1 [0.25,0.5] a\n0 0 2 [0.5,0.75] a\n0 1 0 [0,0.5] b\n0 1 2 [0.5,1] b\n\
    1 0 0 1 a\n2 0 2 1 loop\n# States\n(s)\n0:(0)\n1:(1)\n2:(2)\n# Labels\n0=\"init\" 1=\"deadlock\" 2=\"goal\"\n0: 0\n2: 2\n\
    # Reward structure \"time\"\n# State rewards\n3 2\n0 1\n1 0.1\n\
    # Reward structure \"time\"\n# Transition rewards\n3 4 3\n0 0 1 0.2\n0 0 2 0.2\n2 0 2 7\n\
    # Reward structure \"energy\"\n# State rewards\n3 0\n\
    # Reward structure \"energy\"\n# Transition rewards\n3 4 3\n0 1 0 0.3\n0 1 2 1e-9\n1 0 0 2.5\n\
    # Reward structure \"none\"\n# State rewards\n3 0\n# Reward structure \"none\"\n# Transition rewards\n3 4 0\n";

fn check(arguments: &[&str]) -> String {
    let output = Command::cargo_bin("dynabs-check").unwrap().args(arguments).output().unwrap();
    let text = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    assert!(output.status.success(), "{arguments:?}: {text}");
    text
}

/// What every choice earns on each of its branches, by structure.
fn earned(model: &IntervalMdp) -> Vec<(String, Vec<Vec<f64>>)> {
    let first = model.choices().first_choices();
    let of_structure = |structure: &imdp::model::RewardStructure| {
        let mut all = vec![];
        for (state, &first) in first.iter().enumerate().take(model.num_states()) {
            let lengths: Vec<usize> = match model.choices().is_absorbing(StateId::from_index(state)) {
                true => vec![1],
                false => model
                    .choices()
                    .rows(StateId::from_index(state))
                    .map(|row| model.rows().row_len(row))
                    .collect(),
            };
            for (choice, length) in (first..).zip(lengths) {
                let of_choice = structure.of_state(state) + structure.of_choice(choice);
                all.push((0..length).map(|i| of_choice + structure.of_branch(choice, i)).collect());
            }
        }
        (structure.name.clone(), all)
    };
    model.rewards().iter().map(of_structure).collect()
}

fn read(path: &Path) -> IntervalMdp {
    let path = path.with_extension("pexp");
    import_combined(&path, &mut |_| {}).unwrap().model
}

#[test]
fn rewards_survive_every_format_that_holds_them() {
    let scratch = tempfile::tempdir().unwrap();
    let at = |name: &str| scratch.path().join(name).to_str().unwrap().to_owned();
    std::fs::write(at("m.pexp"), MODEL).unwrap();
    let original = earned(&read(&scratch.path().join("m")));
    let names: Vec<_> = original.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["time", "energy", "none"]);
    // By way of each format and back to PRISM's files.
    check(&["convert", &at("m.pexp"), &at("a.tra")]);
    check(&["convert", &at("a.tra"), &at("b.umb")]);
    let text = check(&["convert", &at("b.umb"), &at("c.tra")]);
    assert!(!text.contains("not written"), "{text}");
    for file in ["1.srew", "1.trew", "2.srew", "2.trew", "3.srew", "3.trew"] {
        let read = |stem: &str| std::fs::read_to_string(at(&format!("{stem}{file}"))).unwrap();
        assert_eq!(read("a"), read("c"), "{file}");
    }
    let files = imdp::formats::prism::ExplicitFiles::of(Path::new(&at("c.tra")));
    let model = imdp::formats::prism::import_files(&files, &mut |_| {}).unwrap().model;
    assert_eq!(earned(&model), original);
    // DRN has no rewards of branches: that structure is left out, and said to be.
    let text = check(&["convert", &at("a.tra"), &at("d.drn")]);
    assert!(text.contains("the rewards \"energy\" are not written"), "{text}");
    check(&["convert", &at("d.drn"), &at("e.tra")]);
    assert_eq!(std::fs::read(at("a1.trew")).unwrap(), std::fs::read(at("e1.trew")).unwrap());
    assert_eq!(std::fs::read(at("a1.srew")).unwrap(), std::fs::read(at("e1.srew")).unwrap());
    // What lies beside a .tra file would be read with it: it is not left there in silence.
    std::fs::remove_file(at("c.tra")).unwrap();
    let output =
        Command::cargo_bin("dynabs-check").unwrap().args(["convert", &at("m.pexp"), &at("c.tra")]).output();
    assert_eq!(output.unwrap().status.code(), Some(2));
    let text = check(&["convert", &at("m.pexp"), &at("f.dynabs")]);
    assert!(!text.contains("not written"), "{text}");
    assert_eq!(earned(&imdp::formats::native::read(Path::new(&at("f.dynabs"))).unwrap()), original);
    // Rewards of a model that is replaced would be read as those of the new one.
    check(&["convert", &at("d.drn"), &at("a.tra"), "--force"]);
    let files = imdp::formats::prism::ExplicitFiles::of(Path::new(&at("a.tra")));
    assert_eq!((files.srew.len(), files.trew.len()), (2, 2), "{files:?}");
    let text = check(&["convert", &at("m.pexp"), &at("f.txt")]);
    assert!(text.contains("the rewards \"time\", \"energy\", \"none\" are not written"), "{text}");
}

/// Half of the time 4 are earned on the way to where nothing is: `V = 2 + γ V/2`.
#[test]
fn rewards_of_branches_are_earned_today() {
    let text = "# Transitions (IMDP)\n2 2 3\n0 0 0 [0.5,0.5]\n0 0 1 [0.5,0.5]\n1 0 1 1\n# Labels\n0=\"init\"\n0: 0\n\
        # Reward structure \"r\"\n# Transition rewards\n2 2 1\n0 0 1 4\n";
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("m.pexp");
    std::fs::write(&path, text).unwrap();
    let path = path.to_str().unwrap();
    let values = |options: &[&str]| {
        let text = check(&[&["solve", path, "--json"], options].concat());
        let results: serde_json::Value = serde_json::from_str(&text).unwrap();
        ["lower", "upper"].map(|side| results["results"][0][side].as_f64().unwrap())
    };
    for (asked, expected) in [
        ("C<=1, discount=0.5", 2.0),
        ("C<=2, discount=0.5", 2.5),
        ("C<=3, discount=0.5", 2.625),
        ("C, discount=0.5", 8.0 / 3.0),
        ("C<=2", 3.0),
    ] {
        let property = format!("R{{\"r\"}}maxmin=? [ {asked} ]");
        let [lower, upper] = values(&["--property", &property]);
        assert!(lower <= expected && expected <= upper, "{property}: [{lower}, {upper}]");
        assert!(upper - lower < 1e-5, "{property}: [{lower}, {upper}]");
        let certificate = scratch.path().join("c").to_str().unwrap().to_owned();
        check(&["solve", path, "--property", &property, "--certificate", &certificate]);
        check(&["verify", &certificate, path]);
    }
}
