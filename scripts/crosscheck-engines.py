#!/usr/bin/env python3
"""Compares dynabs with exact values, PRISM and Storm.

    crosscheck-engines.py [--dynabs PATH] [--models N] [--seed S] [--with ENGINE] [--prism PATH] [--python PATH]

The cases of tests/cases go through `dynabs-check solve`, whose values are compared with the exact ones, and with N random
models of either kind through `dynabs-check crosscheck`, which asks PRISM and Storm and compares the values of all states.
Random models become disjoint unions, so that an engine starts once for each property. Prints what agrees and the largest
differences; ends with 1 if anything disagrees, and with 77 if an engine is missing while all else agrees.
Needs nothing but Python's standard library.
"""

import argparse
import os
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

from crosscheck.dynabs import Dynabs, Failure, add_engine_options, engine_options, find
from crosscheck.models import OPERATORS, load_cases, random_model, union

ROOT = Path(__file__).resolve().parent.parent
PATHS = (
    'F "goal"',
    '!"bad" U "goal"',
    'G !"bad"',
    'X "goal"',
    'F<=7 "goal"',
    '!"bad" U<=13 "goal"',
    'G<=5 !"bad"',
)
# How many random models make one union: a slow one keeps the others waiting.
UNION = 500
# How far lower bounds of unbounded properties may be below the exact values.
EPSILON = 1e-6


class Table:
    """What engines said, by model and outcome."""

    def __init__(self):
        self.rows, self.failures, self.notes, self.engines = {}, [], {}, set()

    def exact(self, what, found, exact, slack):
        """Lower bounds against exact values: never above, and at most `slack` below."""
        row = self.rows.setdefault(("dynabs", what, "exact"), [0, 0.0])
        for state, (bound, value) in enumerate(zip(found, exact, strict=True)):
            difference = value - Fraction(bound)
            row[0] += 1
            row[1] = max(row[1], float(abs(difference)))
            if not 0 <= difference <= slack:
                self.failures.append(f"dynabs, {what}, state {state}: {bound} instead of {value}")

    def findings(self, what, findings):
        for finding in findings:
            self.engines.add(finding["engine"])
            row = self.rows.setdefault((finding["engine"], what, finding["agreement"]), [0, 0.0])
            row[0] += 1
            row[1] = max(row[1], finding["difference"] or 0.0)
            text = f"{finding['engine']}, {what}, {finding['property']}: {'; '.join(finding['notes'])}"
            if finding["agreement"] == "disagrees":
                self.failures.append(f"{text} {finding['value']} against {finding['ours']}, difference {finding['difference']}")
            elif finding["agreement"] in ("failed", "undecided"):
                self.notes.setdefault(text.split(": ", 1)[1][:100], []).append(text)

    def print(self):
        print(f"{'engine':8} {'models':8} {'outcome':10} {'number':>8}  largest difference")
        for (engine, what, outcome), (number, largest) in sorted(self.rows.items()):
            print(f"{engine:8} {what:8} {outcome:10} {number:8}  {largest:.1e}")
        for note, texts in sorted(self.notes.items()):
            print(f"not answered or undecided {len(texts)}, such as {texts[0][:200]}")
        for failure in self.failures[:50]:
            print(f"DISAGREES {failure}")
        print(f"{len(self.failures)} disagreements")


def check_cases(dynabs, directory, table):
    """Every case against its exact values, and what engines say of it."""
    for number, (model, questions, verdicts) in enumerate(load_cases(ROOT / "tests" / "cases")):
        stem = directory / f"case{number}"
        model.write_prism(stem)
        tra = stem.with_suffix(".tra")
        props = [f"P{q.operator}=? [ {q.path} ]" for q in questions]
        for question, prop in zip(questions, props):
            table.exact("cases", dynabs.values(tra, prop, EPSILON), question.values, EPSILON)
        for verdict, result in zip(verdicts, dynabs.results(tra, [v["property"] for v in verdicts]) if verdicts else []):
            if result["satisfied"] is not verdict["satisfied"]:
                table.failures.append(f"dynabs, {model.name}: {verdict['property']}: {result['satisfied']}")
        ask(dynabs, tra, props, "cases", table)


def ask(dynabs, tra, props, what, table):
    try:
        table.findings(what, dynabs.crosscheck(tra, props, "--epsilon", 1e-10, "--timeout", 120))
    except Failure as failure:
        table.notes.setdefault(str(failure)[:100], []).append(str(failure))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dynabs", default=os.environ.get("DYNABS_CHECK", str(ROOT / "target/release/dynabs-check")))
    parser.add_argument("--models", type=int, default=1000, help="random models of each of the two kinds (1000)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--no-cases", action="store_true", help="random models only")
    add_engine_options(parser)
    arguments = parser.parse_args()
    command = find(arguments.dynabs) or find("dynabs-check")
    if command is None:
        sys.exit(f"{arguments.dynabs} is missing: cargo build --release, or --dynabs PATH")
    dynabs, table = Dynabs(command, engine_options(arguments)), Table()
    with tempfile.TemporaryDirectory() as directory:
        directory = Path(directory)
        if not arguments.no_cases:
            check_cases(dynabs, directory, table)
        props = [f"P{operator}=? [ {path} ]" for path in PATHS for operator in OPERATORS]
        for zeros, what in ((False, "random"), (True, "zeros")):
            models = [random_model(seed, zeros) for seed in range(arguments.seed, arguments.seed + arguments.models)]
            for first in range(0, len(models), UNION):
                stem = directory / f"{what}{first}"
                union(models[first : first + UNION]).write_prism(stem)
                ask(dynabs, stem.with_suffix(".tra"), props, what, table)
    table.print()
    wanted = {"prism": {"PRISM"}, "storm": {"Storm"}, "all": {"PRISM", "Storm"}}[arguments.engines]
    for engine in sorted(wanted - table.engines):
        print(f"skipped: {engine} is missing")
    sys.exit(1 if table.failures else 77 if wanted - table.engines else 0)


if __name__ == "__main__":
    main()
