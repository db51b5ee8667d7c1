#!/usr/bin/env python3
"""Checks that PRISM, Storm and umbi read what dynabs writes, and the other way round.

    check-formats.py [--dynabs DIRECTORY] [--prism PATH] [MODEL.json ...]

Compiles each model (default: models/room_temperature.json) as .tra, .drn and .umb, as it is and with row states, and
compares the values of all states that dynabs, PRISM (--prism, $PRISM or the search path) and Storm (if stormpy can be
imported) compute; then lets PRISM, Storm and umbi write the model and reads it back with `dynabs-check diff`.
Ends with 1 if anything differs, and with 77 if a tool is missing while all else agrees.

tests/formats/data has small files written in these ways: `prism -importmodel m.tra,sta,lab -ex -exportmodel m.umb`,
stormpy's `export_to_umb` and `export_to_drn`, and umbi's `write` of what PRISM wrote.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TOLERANCE = 1e-9


class Report:
    """What agreed, what did not, what could not be tried."""

    def __init__(self):
        self.failed, self.missing = 0, []

    def line(self, what, outcome, fine=True):
        self.failed += not fine
        print(f"{'ok  ' if fine else 'FAIL'} {what}: {outcome}")

    def compare(self, what, found, expected):
        states = len(expected)
        if len(found) < states:
            return self.line(what, f"{len(found)} values for {states} states", False)
        difference = max(abs(a - b) for a, b in zip(found, expected))
        self.line(what, f"{states} values, largest difference {difference:.1e}", difference <= TOLERANCE)


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


class Dynabs:
    def __init__(self, directory):
        self.compiler, self.checker = directory / "dynabs-compile", directory / "dynabs-check"

    def compile(self, model, out, *options):
        code, text = run(self.compiler, model, "-o", out, "--quiet", "--format", "prism,drn,umb", *options)
        if code:
            sys.exit(text)

    def values(self, path, props, out):
        """The lower bounds of all states."""
        code, text = run(self.checker, "solve", path, "-p", value_property(props), "--quiet", "--values", out)
        if code not in (0, 1):
            sys.exit(text)
        return numbers(out)

    def diff(self, left, right):
        code, text = run(self.checker, "diff", left, right)
        return code == 0, text.strip().splitlines()[-1] if text.strip() else "the same"


def numbers(path):
    return [float(line) for line in Path(path).read_text().split()]


def operator_and_formula(path):
    """Those of the first property of a file."""
    text = path.read_text().splitlines()[0]
    return re.search(r"P(\w+)=\? \[ (.*) \]", text).groups()


def value_property(path):
    """The first property of a file, without its threshold."""
    operator, formula = operator_and_formula(path)
    return f"P{operator}=? [ {formula} ]"


def check_prism(prism, files, props, expected, out, report):
    for what in files:
        vector = out / "prism.txt"
        vector.unlink(missing_ok=True)
        prop = value_property(props)
        _, text = run(prism, "-importmodel", what, "-ex", "-pf", prop, "-exportvector", vector)
        name = f"PRISM reads {Path(str(what).split(',')[0]).name}"
        if vector.exists():
            report.compare(name, numbers(vector), expected)
        else:
            report.line(name, error_in(text), False)


def error_in(text):
    errors = [line for line in text.splitlines() if "rror" in line]
    return (errors or [text[-200:]])[0]


def load_storm(stormpy, path):
    if path.suffix == ".umb":
        return stormpy.build_model_from_umb(str(path))
    return stormpy.build_model_from_drn[stormpy.Interval](str(path))


def check_storm(stormpy, files, props, expected, report):
    operator, formula = operator_and_formula(props)
    modes = stormpy.UncertaintyResolutionMode
    nature = modes.MINIMIZE if operator.endswith("min") else modes.MAXIMIZE
    for path in files:
        model = load_storm(stormpy, path)
        prop = stormpy.parse_properties(f"P{operator[:3]}=? [ {formula} ]")[0]
        result = stormpy.model_checking(model, prop, uncertainty_resolution_mode=nature)
        report.compare(f"Storm reads {path.name}", [result.get_value(s) for s in range(model.nr_states)], expected)


def check_umbi(umbi, dynabs, path, original, out, report):
    try:
        archive = umbi.umb.read(path)
    except ValueError as error:
        # umbi 0.2 reads variables with a function that bitstring 5 has removed.
        if "BitArray.from_bytes" not in str(error):
            raise
        report.missing.append("umbi needs bitstring below 5 (pip install 'bitstring<5')")
        return
    counts = archive.index.transition_system
    report.line(f"umbi reads {path.name}", f"{counts.num_states} states, {counts.num_branches} branches")
    again = out / "umbi.umb"
    umbi.umb.write(archive, again)
    same, last = dynabs.diff(original, again)
    report.line("dynabs reads what umbi writes", last, same)


def check_model(model, tools, out, report):
    dynabs = tools["dynabs"]
    print(f"-- {model.stem}")
    dynabs.compile(model, out / "plain")
    dynabs.compile(model, out / "rows", "--encoding", "rows")
    original = out / "plain" / "model.dynabs"
    expected = dynabs.values(out / "plain", out / "plain" / "model.props", out / "values.txt")
    for stem in (out / "plain" / "model", out / "rows" / "rows"):
        tra, drn, umb, props = (stem.with_suffix(f".{end}") for end in ("tra", "drn", "umb", "props"))
        for path in (tra, drn, umb):
            report.compare(f"dynabs reads {path.name}", dynabs.values(path, props, out / "values.txt"), expected)
        if prism := tools["PRISM"]:
            check_prism(prism, [f"{tra},sta,lab", umb], props, expected, out, report)
        if stormpy := tools["Storm"]:
            check_storm(stormpy, [drn, umb], props, expected, report)
        if umbi := tools["umbi"]:
            check_umbi(umbi, dynabs, umb, original if stem.name == "model" else umb, out, report)
    plain = out / "plain" / "model"
    if prism := tools["PRISM"]:
        written = out / "prism.umb"
        _, text = run(prism, "-importmodel", plain.with_suffix(".umb"), "-ex", "-exportmodel", written)
        # Not the same model: PRISM leaves out the label "deadlock" where it is empty.
        if written.exists():
            found = dynabs.values(written, plain.with_suffix(".props"), out / "values.txt")
            report.compare("dynabs reads the .umb that PRISM writes", found, expected)
        else:
            report.line("PRISM writes .umb", error_in(text), False)
    if stormpy := tools["Storm"]:
        loaded = load_storm(stormpy, plain.with_suffix(".umb"))
        written = out / "storm.umb"
        from stormpy.core import _io
        from stormpy.developer import DirectEncodingExporterOptions

        _io.export_to_umb(loaded, str(written))
        found = dynabs.values(written, plain.with_suffix(".props"), out / "values.txt")
        report.compare("dynabs reads the .umb that Storm writes", found, expected)
        options = DirectEncodingExporterOptions()
        options.output_precision = 17
        _io.export_to_drn(loaded, str(out / "storm.drn"), options=options)
        found = dynabs.values(out / "storm.drn", plain.with_suffix(".props"), out / "values.txt")
        report.compare("dynabs reads the .drn that Storm writes", found, expected)


def find_tools(arguments, report):
    tools = {"dynabs": Dynabs(arguments.dynabs)}
    prism = arguments.prism or os.environ.get("PRISM") or shutil.which("prism")
    tools["PRISM"] = prism
    if not prism:
        report.missing.append("PRISM 4.10 or newer: give --prism PATH or set $PRISM")
    for name, package in (("Storm", "stormpy"), ("umbi", "umbi")):
        try:
            tools[name] = __import__("umbi.umb" if package == "umbi" else package)
        except ImportError as error:
            tools[name] = None
            report.missing.append(f"{name}: pip install {package} ({error})")
    return tools


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dynabs", type=Path, default=ROOT / "target" / "release", help="where the tools are")
    parser.add_argument("--prism")
    parser.add_argument("models", nargs="*", type=Path, default=[ROOT / "models" / "room_temperature.json"])
    arguments = parser.parse_args()
    report = Report()
    tools = find_tools(arguments, report)
    if not tools["dynabs"].checker.exists():
        sys.exit(f"{tools['dynabs'].checker}: not there; run cargo build --release or give --dynabs DIRECTORY")
    for model in arguments.models:
        with tempfile.TemporaryDirectory() as scratch:
            check_model(model, tools, Path(scratch), report)
    for missing in sorted(set(report.missing)):
        print(f"not tried: {missing}")
    print(f"{report.failed} disagreements")
    return 1 if report.failed else 77 if report.missing else 0


if __name__ == "__main__":
    sys.exit(main())
