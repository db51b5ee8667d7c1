#!/usr/bin/env python3
"""Checks that PRISM, Storm and umbi read what dynabs writes, and the other way round.

    check-formats.py [--dynabs DIRECTORY] [--prism PATH] [MODEL.json ...]

Compiles each model (default: models/room_temperature.json) as .tra, .drn and .umb, as it is and with row states, and hands
these very files to PRISM (--prism, $PRISM or the search path) and Storm (if stormpy can be imported) by `dynabs-check
crosscheck --as-is`; then lets PRISM, Storm and umbi write the model and compares what dynabs reads.
Ends with 1 if anything differs, and with 77 if a tool is missing while all else agrees.

tests/formats/data has small files written in these ways: `prism -importmodel m.tra,sta,lab -ex -exportmodel m.umb`,
stormpy's `export_to_umb` and `export_to_drn`, and umbi's `write` of what PRISM wrote.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from crosscheck.dynabs import Dynabs, Failure, find

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


def compile_model(directory, model, out, *options):
    code, text = run(directory / "dynabs-compile", model, "-o", out, "--quiet", "--format", "prism,drn,umb", *options)
    if code:
        sys.exit(text)


def value_property(path):
    """The first property of a file, without its threshold."""
    operator, formula = re.search(r"P(\w+)=\? \[ (.*) \]", path.read_text().splitlines()[0]).groups()
    return f"P{operator}=? [ {formula} ]"


def check_engine(dynabs, engine, path, props, report):
    """What an engine says of this very file."""
    name = f"{'PRISM' if engine == 'prism' else 'Storm'} reads {path.name}"
    try:
        [finding] = dynabs.crosscheck(path, [value_property(props)], "--with", engine, "--as-is")
    except Failure as failure:
        return report.line(name, failure, False)
    outcome = f"{finding['agreement']}, largest difference {finding['difference']}"
    report.line(name, "; ".join([outcome, *finding["notes"]]), finding["agreement"] == "agrees")


def error_in(text):
    errors = [line for line in text.splitlines() if "rror" in line]
    return (errors or [text[-200:]])[0]


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
    same = dynabs.diff(original, again)
    report.line("dynabs reads what umbi writes", "the same" if same else "another model", same)


def check_model(model, tools, out, report):
    dynabs = tools["dynabs"]
    print(f"-- {model.stem}")
    compile_model(tools["directory"], model, out / "plain")
    compile_model(tools["directory"], model, out / "rows", "--encoding", "rows")
    original = out / "plain" / "model.dynabs"
    expected = dynabs.values(original, value_property(out / "plain" / "model.props"))
    for stem in (out / "plain" / "model", out / "rows" / "rows"):
        tra, drn, umb, props = (stem.with_suffix(f".{end}") for end in ("tra", "drn", "umb", "props"))
        for path in (tra, drn, umb):
            report.compare(f"dynabs reads {path.name}", dynabs.values(path, value_property(props)), expected)
        for engine, paths in (("prism", (tra, umb)), ("storm", (drn, umb))):
            for path in paths if tools[engine] else ():
                check_engine(dynabs, engine, path, props, report)
        if umbi := tools["umbi"]:
            check_umbi(umbi, dynabs, umb, original if stem.name == "model" else umb, out, report)
    plain = out / "plain" / "model"
    if prism := tools["prism"]:
        written = out / "prism.umb"
        _, text = run(prism, "-importmodel", plain.with_suffix(".umb"), "-ex", "-exportmodel", written)
        # Not the same model: PRISM leaves out the label "deadlock" where it is empty.
        if written.exists():
            found = dynabs.values(written, value_property(plain.with_suffix(".props")))
            report.compare("dynabs reads the .umb that PRISM writes", found, expected)
        else:
            report.line("PRISM writes .umb", error_in(text), False)
    if stormpy := tools["storm"]:
        loaded = stormpy.build_model_from_umb(str(plain.with_suffix(".umb")))
        written = out / "storm.umb"
        from stormpy.core import _io
        from stormpy.developer import DirectEncodingExporterOptions

        _io.export_to_umb(loaded, str(written))
        found = dynabs.values(written, value_property(plain.with_suffix(".props")))
        report.compare("dynabs reads the .umb that Storm writes", found, expected)
        options = DirectEncodingExporterOptions()
        options.output_precision = 17
        _io.export_to_drn(loaded, str(out / "storm.drn"), options=options)
        found = dynabs.values(out / "storm.drn", value_property(plain.with_suffix(".props")))
        report.compare("dynabs reads the .drn that Storm writes", found, expected)


def find_tools(arguments, report):
    prism = find(arguments.prism or os.environ.get("PRISM", "prism"))
    engines = ["--python", sys.executable] + (["--prism", prism] if prism else [])
    tools = {"directory": arguments.dynabs, "prism": prism}
    tools["dynabs"] = Dynabs(arguments.dynabs / "dynabs-check", engines)
    if not prism:
        report.missing.append("PRISM 4.10 or newer: give --prism PATH or set $PRISM")
    for name, package, module in (("storm", "stormpy", "stormpy"), ("umbi", "umbi", "umbi.umb")):
        try:
            tools[name] = __import__(module)
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
    if not tools["dynabs"].command.exists():
        sys.exit(f"{tools['dynabs'].command}: not there; run cargo build --release or give --dynabs DIRECTORY")
    for model in arguments.models:
        with tempfile.TemporaryDirectory() as scratch:
            check_model(model, tools, Path(scratch), report)
    for missing in sorted(set(report.missing)):
        print(f"not tried: {missing}")
    print(f"{report.failed} disagreements")
    return 1 if report.failed else 77 if report.missing else 0


if __name__ == "__main__":
    sys.exit(main())
