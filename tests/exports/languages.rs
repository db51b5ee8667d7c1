//! Exports written down, run and compared with the library, state by state and bit by bit.

use super::asked::{Answered, Exported, Looks, RUN, STEPS};
use crate::common::{c_compiler, compile_c, root};
use dynabs::controller::export::{
    c_header, c_source, mat, matlab_source, npz, python_source, ros2_source, s_function_source,
};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// A controller in all languages, with states and what the library says there.
pub struct Comparison {
    exported: Exported,
    looks: Looks,
    answers: Vec<Answered>,
    step_by_step: Vec<Answered>,
    scratch: TempDir,
}

/// An interpreter that a variable of the environment names; without it a test can only say so.
pub fn interpreter(variable: &str) -> Option<String> {
    let named = std::env::var(variable).ok().filter(|named| !named.is_empty());
    if named.is_none() {
        skipped(&format!("{variable} names no interpreter, what is exported for it was not tested"));
    }
    named
}

/// Not by eprintln!, which nobody sees when a test passes.
pub fn skipped(what: &str) {
    std::io::stderr().write_all(format!("SKIPPED: {what}\n").as_bytes()).unwrap();
}

impl Comparison {
    pub fn new(exported: Exported, runs: usize, rounds: usize) -> Self {
        let looks = exported.looks(runs, rounds, 1);
        let (answers, step_by_step) = (exported.answers(&looks), exported.step_by_step(&looks));
        let scratch = TempDir::new().unwrap();
        fs::write(scratch.path().join("looks"), looks.bytes()).unwrap();
        Self { exported, looks, answers, step_by_step, scratch }
    }

    /// How often the library answered with each status.
    pub fn statuses(&self) -> [usize; 6] {
        let mut count = [0; 6];
        self.answers.iter().for_each(|(status, _)| count[*status as usize] += 1);
        count
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.scratch.path().join(name), content).unwrap();
    }

    /// `n`, `d p`, runs, rounds, whether there is a memory, the length of runs and the steps of all, for whoever answers.
    fn sizes(&self) -> [String; 7] {
        let controller = &self.exported.controller;
        let has_memory = controller.task().letters().is_some();
        [
            controller.state_dimension(),
            controller.inputs(),
            self.looks.runs,
            self.looks.rounds.len(),
            usize::from(has_memory),
            RUN,
            STEPS,
        ]
        .map(|size| size.to_string())
    }

    fn run(&self, command: &mut Command) {
        let output = command.current_dir(self.scratch.path()).args(self.sizes()).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{}: {command:?}: {said}", self.exported.name);
    }

    /// Answers are, round by round, the statuses and then the inputs, which are not looked at where there are none.
    fn compare(&self, file: &str) {
        let bytes = fs::read(self.scratch.path().join(file)).unwrap();
        let width = self.exported.controller.inputs();
        let round = self.looks.runs * (4 + 8 * width);
        assert_eq!(bytes.len(), round * self.looks.rounds.len(), "{file}");
        let states = self.looks.rounds.iter().flat_map(|round| round.states.iter().zip(&round.elapsed));
        let mut asked = states.zip(&self.answers);
        for bytes in bytes.chunks_exact(round) {
            let (statuses, inputs) = bytes.split_at(4 * self.looks.runs);
            for (i, status) in statuses.chunks_exact(4).enumerate() {
                let (at, answer) = asked.next().unwrap();
                let inputs = &inputs[8 * width * i..8 * width * (i + 1)];
                self.compare_one(file, at, answer, (number(status), inputs));
            }
        }
    }

    /// Answers are, step by step, a status and the inputs of that step.
    fn compare_steps(&self, file: &str) {
        let bytes = fs::read(self.scratch.path().join(file)).unwrap();
        let width = self.exported.controller.step_inputs();
        let size = 4 + 8 * width;
        assert_eq!(bytes.len(), size * self.step_by_step.len(), "{file}");
        for (i, (answer, bytes)) in self.step_by_step.iter().zip(bytes.chunks_exact(size)).enumerate() {
            let (status, inputs) = bytes.split_at(4);
            let found: Vec<f64> = doubles(inputs);
            assert_eq!(
                (number(status), &found),
                (answer.0, &answer.1),
                "{}: {file}, step {i}",
                self.exported.name
            );
        }
    }

    fn compare_one(&self, file: &str, at: impl std::fmt::Debug, answer: &Answered, found: (u32, &[u8])) {
        let (status, u) = answer;
        let name = &self.exported.name;
        assert_eq!(found.0, *status, "{name}: {file}: status at {at:?}");
        if *status == 0 {
            let bits = |all: &[f64]| all.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            let inputs = doubles(found.1);
            assert_eq!(bits(&inputs), bits(u), "{name}: {file}: {inputs:?}, expected {u:?} at {at:?}");
        }
    }

    /// C, its header, and the block of Simulink in what stands in for Simulink.
    pub fn c(&self) {
        let Some(compiler) = c_compiler() else {
            skipped("no C compiler (cc, gcc, clang) here, the C code was not tested");
            return;
        };
        let Exported { name, controller, .. } = &self.exported;
        let directory = self.scratch.path();
        let source = c_source(controller, name, "controller.c").unwrap();
        let function =
            source.lines().find_map(|line| line.strip_prefix(" * ")?.split_once("(x, k,")).unwrap().0;
        let prefix = function.strip_suffix("_control").unwrap();
        let start = if controller.task().letters().is_some() { "&memory," } else { "" };
        let named = |text: &str| {
            text.replace("PREFIX", &prefix.to_uppercase()).replace("prefix", prefix).replace("MEMORY,", start)
        };
        compile_c(compiler, directory, &source, &named(include_str!("../data/exports/main.c")));
        self.run(&mut Command::new(directory.join("main")));
        self.compare("c");

        self.write("controller.h", c_header(controller, name).unwrap());
        let twice = "#include \"controller.h\"\n#include \"controller.h\"\nint main(void) { return 0; }\n";
        compile_c(compiler, directory, &source, twice);

        self.write("controller_sfun.c", s_function_source(controller, name, "controller_sfun").unwrap());
        for file in ["simstruc.h", "cg_sfun.h"] {
            fs::copy(data(file), directory.join(file)).unwrap();
        }
        compile_c(compiler, directory, &source, include_str!("../data/exports/simulink.c"));
        self.run(&mut Command::new(directory.join("main")));
        self.compare_steps("simulink");
    }

    /// Python with NumPy, the node of ROS 2, `.npz`, and `.mat` as SciPy reads it.
    pub fn python(&self, interpreter: &str) {
        let Exported { name, controller, .. } = &self.exported;
        self.write("controller.py", python_source(controller, name).unwrap());
        self.write("controller_ros2.py", ros2_source(controller, name).unwrap());
        self.write("controller.npz", npz(controller).unwrap());
        self.write("controller.mat", mat(controller).unwrap());
        self.run(Command::new(interpreter).arg(data("answer.py")));
        self.compare("python");
        self.compare_steps("ros2");
    }

    /// Octave with the function, and `.mat` as it reads it: after [`python`](Self::python), which wrote the tables down.
    pub fn octave(&self, interpreter: &str) {
        let Exported { name, controller, .. } = &self.exported;
        self.write("controller.m", matlab_source(controller, name, "controller").unwrap());
        self.write("controller.mat", mat(controller).unwrap());
        self.run(Command::new(interpreter).args(["--norc", "--no-gui", "--quiet"]).arg(data("answer.m")));
        self.compare("octave");
    }
}

fn data(file: &str) -> std::path::PathBuf {
    root().join(Path::new("tests/data/exports")).join(file)
}

fn number(bytes: &[u8]) -> u32 {
    u32::from_le_bytes(bytes.try_into().unwrap())
}

fn doubles(bytes: &[u8]) -> Vec<f64> {
    bytes.chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap())).collect()
}
