#!/usr/bin/env python3
"""Runs PRISM's own interval models, with the properties shipped beside them, through dynabs.

    crosscheck-prism-tests.py PRISM_TESTS [PRISM_EXAMPLES …] [--prism PATH] [--dynabs PATH]

Every model with intervals below the directories (checkouts of prism-tests and of prism's prism-examples) is exported by
PRISM in every format that it has: .tra with .sta, .lab and rewards, DRN, UMB and .pexp. dynabs answers all properties of the
model from each of them, with the constants that PRISM's .args files or `auto` scripts name. `dynabs-check crosscheck` asks
PRISM the same, and compares all states; the RESULT comments of its tests must lie within dynabs' bounds or the 1e-5 that
PRISM's own tests allow; all formats must give the same bounds. A property counts as agreeing if it agrees for all constants.
PRISM's DRN has no variables and no rewards of transitions: properties that need them are left out there, and intervals
compared instead.

Prints a line for every model. Ends with 1 if anything differs, and with 77 if PRISM or its models are missing. Needs nothing
but Python's standard library.
"""

import argparse
import itertools
import json
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from crosscheck.dynabs import Dynabs, Failure, find

TOLERANCE = 1e-5
FORMATS = ("tra", "drn", "umb", "pexp")
FUNCTIONS = {"min": min, "max": max, "true": True, "false": False, "__builtins__": {}}
# What the models that come without any constants are asked with: those of the RESULT comments of prism-tests.
USUAL = {"delta": "0.1", "K": "2", "bias1": "0.01", "p": "0.4", "q": "0.6"}


def evaluate(text, constants):
    """The value of an arithmetic expression in the files, or None."""
    try:
        return eval(text, FUNCTIONS, dict(constants))  # Of PRISM's tests, without builtins.
    except (NameError, SyntaxError, TypeError, AttributeError):
        return None


def has_intervals(text):
    return re.search(r"\[[^\[\]\n]*,[^\[\]\n]*\]\s*:", text) is not None


def property_files(model):
    """The files of properties that belong to a model."""
    own = sorted(model.parent.glob(model.name + "*.props"))
    near = model.with_suffix(".props")
    used = [model.parent / name for name in re.findall(rf"^prism {model.name} (\S+\.props)", scripts(model), flags=re.MULTILINE)]
    return own or ([near] if near.exists() else sorted(set(used)))


def scripts(model):
    auto = model.with_name("auto")
    return auto.read_text() if auto.exists() else ""


def runs(model, props):
    """The constants of every run: one dictionary for each combination that is named beside the model."""
    names = {p.with_name(p.name + ".args") for p in props} | {model.with_name(model.name + ".args")}
    lines = [line for name in sorted(names) if name.exists() for line in name.read_text().splitlines()]
    lines += [line for line in scripts(model).splitlines() if line.startswith(f"prism {model.name} ")]
    needed = re.findall(r"^\s*const\s+(?:\w+\s+)?(\w+)\s*;", model.read_text(), flags=re.MULTILINE)
    found = []
    for line in [line for line in lines if line.strip() and not line.startswith("#")] or [""]:
        axes = []
        for assignment in itertools.chain(*(part.split(",") for part in re.findall(r"-const (\S+)", line))):
            name, text = assignment.split("=")
            values = [text]
            if text.count(":") == 2:
                low, step, high = map(float, text.split(":"))
                values = [f"{low + i * step:.10g}" for i in range(int((high - low) / step + 1.5))]
            axes.append([(name, value) for value in values])
        for combination in map(dict, itertools.product(*axes)):
            missing = {name: USUAL[name] for name in needed if name not in combination and name in USUAL}
            if combination | missing not in found:
                found.append(combination | missing)
    return found


def definitions(text):
    """Constants and formulas of a model, which its properties may use but its exports do not have."""
    plain = re.sub(r"//[^\n]*", "", text)
    return re.findall(r"^\s*((?:const|formula)\b[^;]*;)", plain, flags=re.MULTILINE)


def known_constants(texts, given):
    """Constants with their values, as far as they can be computed."""
    known = {name: evaluate(value, {}) for name, value in given.items()}
    for name, value in re.findall(r"^\s*const\s+(?:\w+\s+)?(\w+)\s*=\s*([^;]+);", "\n".join(texts), flags=re.MULTILINE):
        known.setdefault(name, evaluate(value, known))
    return known


def properties(text):
    """(property, its RESULT comments) of files of properties."""
    comments = []
    for line in map(str.strip, text.splitlines()):
        if line.startswith("//"):
            comments.append(line)
        elif line and not line.startswith(("const", "label", "formula")):
            yield re.sub(r'^"\w+":\s*', "", line.split("//")[0].strip().rstrip(";")), comments
            comments = []


def promised(comments, constants):
    """The RESULT for these constants, as a number or truth value."""
    for comment in comments:
        found = re.match(r"//\s*RESULT\s*(?:\(([^)]*)\))?\s*:\s*(.*)", comment)
        if not found:
            continue
        wanted = [pair.split("=") for pair in (found[1] or "").split(",") if pair]
        same = lambda name, value: name in constants and constants[name] == evaluate(value.strip(), FUNCTIONS)
        if all(same(name.strip(), value) for name, value in wanted):
            return evaluate(found[2].split("//")[0].strip(), constants)
    return None


def difference(result, value):
    """How far a value lies outside of dynabs' bounds; relative above 1, infinite for another truth value."""
    if isinstance(value, bool) or value is None:
        return 0.0 if value is None or result.get("satisfied") is value else math.inf
    number = lambda end: math.nan if result.get(end) is None else float(str(result[end]).replace("Infinity", "inf"))
    lower, upper = number("lower"), number("upper")
    if lower <= value <= upper:
        return 0.0
    gap = max(lower - value, value - upper) / max(1.0, abs(value))
    return math.inf if math.isnan(gap) else gap


class Model:
    """A model of PRISM's, its properties, and what came of them."""

    def __init__(self, path):
        self.path, self.text = path, path.read_text()
        files = property_files(path)
        self.shipped = "\n".join(file.read_text() for file in files)
        self.properties = list(properties(self.shipped))
        self.runs = runs(path, files)
        self.faults = {}
        self.prism_only_refuses = set()
        self.formats = set()
        self.compared = 0

    def fault(self, index, text):
        self.faults.setdefault(index, text)

    def check(self, arguments, given, scratch):
        constants = [f"{name}={value}" for name, value in given.items()]
        named = ["-const", ",".join(constants)] if constants else []
        exports = itertools.chain(["-exportmodel", "m.tra,sta,lab,srew,trew"], *(["-exportmodel", f"m.{end}"] for end in FORMATS[1:]))
        command = [arguments.prism, str(self.path), "-ex", *named, *exports, "-exportmodelprecision", "17"]
        subprocess.run(command, capture_output=True, check=False, cwd=scratch)
        known = known_constants([self.text, self.shipped], given)
        # The model's own constants and formulas in front; labels are in the exports.
        props = scratch / "asked.props"
        props.write_text("\n".join(definitions(self.text)) + "\n" + self.shipped)
        first = None
        for end in FORMATS:
            answers = self.ours(arguments, scratch / f"m.{end}", props, given)
            if isinstance(answers, str):
                self.fault(f".{end}", f"{end} {' '.join(constants)}: {answers}")
                continue
            self.formats.add(end)
            lost = [end == "drn" and self.needs_more_than_drn(scratch, text, answer) for (text, _), answer in zip(self.properties, answers)]
            for index, ((text, comments), answer) in enumerate(zip(self.properties, answers)):
                if lost[index]:
                    continue
                at = f"{end} {' '.join(constants)}: {text}"
                if "error" in answer:
                    self.fault(index, f"{at}: {answer['error']}")
                value = promised(comments, known)
                if difference(answer, value) > TOLERANCE:
                    self.fault(index, f"{at}: [{answer.get('lower')}, {answer.get('upper')}] {answer.get('satisfied')}, RESULT {value}")
                self.compared += value is not None
            ends = [[answer.get(key) for key in ("lower", "upper", "satisfied")] for answer in answers]
            if first is not None and any(a != b for a, b, is_lost in zip(ends, first, lost) if not is_lost):
                self.fault(f".{end}", f"{end} {' '.join(constants)}: other bounds than from .tra")
            if first is None and self.properties:
                self.crosscheck(arguments, (scratch / f"m.{end}", props), given, known)
            first = first or ends
            if end == "drn":
                self.same_intervals(arguments, scratch, constants)

    def crosscheck(self, arguments, asked, given, known):
        """What PRISM says of all states."""
        dynabs = Dynabs(arguments.dynabs, ["--with", "prism", "--prism", arguments.prism])
        constants = [f"--const={name}={value}" for name, value in given.items()]
        try:
            findings = dynabs.run("crosscheck", *asked, *constants, *dynabs.engines)["findings"]
        except Failure as failure:
            self.fault("crosscheck", str(failure))
            return
        if len(findings) != len(self.properties):
            self.fault("crosscheck", f"PRISM was asked {len(findings)} of {len(self.properties)} properties")
            return
        for index, ((text, comments), finding) in enumerate(zip(self.properties, findings)):
            at = f"{' '.join(constants)}: {text}: {'; '.join(finding['notes'])}"
            if finding["agreement"] == "disagrees":
                self.fault(index, f"{at}: {finding['ours']}, PRISM {finding['value']}, {finding['difference']} apart in state {finding['state']}")
            elif finding["agreement"] == "agrees":
                self.compared += 1
            else:
                self.prism_only_refuses.add(index)
                if promised(comments, known) is None:
                    self.fault(index, f"{at}: nothing to compare with")

    def needs_more_than_drn(self, scratch, text, answer):
        """Whether a property is about variables or rewards of transitions."""
        earned = any(len(path.read_text().splitlines()) > 3 for path in scratch.glob("m*.trew"))
        return "found no variable" in answer.get("error", "") or (text.startswith("R") and earned and self.is_chain())

    def is_chain(self):
        return re.search(r"^\s*(dtmc|idtmc)\b", self.text, flags=re.MULTILINE) is not None

    def same_intervals(self, arguments, scratch, constants):
        command = [arguments.dynabs, "diff", scratch / "m.drn", scratch / "m.tra"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if not re.search(r"^intervals +same", done.stdout, flags=re.MULTILINE):
            self.fault(".drn", f"drn {' '.join(constants)}: {done.stdout}{done.stderr}")

    def ours(self, arguments, path, props, given):
        """The answers of dynabs, or why there are none."""
        if not path.exists():
            return "not exported"
        if not self.properties:
            command = [arguments.dynabs, "diff", path, path.with_suffix(".tra")]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            return [] if done.returncode == 0 else done.stdout + done.stderr
        constants = [f"--const={name}={value}" for name, value in given.items()]
        command = [arguments.dynabs, "solve", path, props, *constants, "--json", "-q", "--epsilon", "1e-8"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        try:
            results = json.loads(done.stdout)["results"]
        except ValueError:
            return done.stderr.strip()
        return results if len(results) == len(self.properties) else f"{len(results)} answers"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", type=Path, nargs="+")
    parser.add_argument("--prism", default=os.environ.get("PRISM", "prism"))
    root = Path(__file__).resolve().parent.parent
    parser.add_argument("--dynabs", default=os.environ.get("DYNABS_CHECK", str(root / "target/release/dynabs-check")))
    arguments = parser.parse_args()
    arguments.prism, wanted = find(arguments.prism), arguments.dynabs
    arguments.dynabs = find(wanted) or find("dynabs-check")
    if arguments.dynabs is None:
        sys.exit(f"{wanted} is missing: cargo build --release, or --dynabs PATH")
    paths = [path for folder in arguments.folders for path in sorted(folder.rglob("*.prism")) if has_intervals(path.read_text())]
    if arguments.prism is None or not paths:
        print("skipped: needs PRISM (--prism PATH) and directories with its interval models")
        sys.exit(77)

    agree = total = files = 0
    models = []
    for path in paths:
        model = Model(path)
        models.append(model)
        for given in model.runs:
            with tempfile.TemporaryDirectory() as scratch:
                model.check(arguments, given, Path(scratch))
        good = sum(index not in model.faults for index in range(len(model.properties)))
        read = sum(f".{end}" not in model.faults for end in model.formats)
        agree, total, files = agree + good, total + len(model.properties), files + read
        name = "/".join(path.parts[-3:])
        print(f"{good:3} of {len(model.properties):2} properties, {read} of {len(FORMATS)} formats, {len(model.runs):2} runs: {name}", flush=True)
        for fault in model.faults.values():
            print(f"    {fault}", flush=True)
    refused = sum(len(model.prism_only_refuses) for model in models)
    compared = sum(model.compared for model in models)
    print(f"{agree} of {total} properties agree ({refused} of which PRISM refuses itself), {compared} values compared")
    print(f"{files} of {len(FORMATS) * len(models)} exports of {len(models)} models read with the same bounds")
    sys.exit(0 if agree == total and files == len(FORMATS) * len(models) else 1)


if __name__ == "__main__":
    main()
