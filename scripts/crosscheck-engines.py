#!/usr/bin/env python3
"""Compares dynabs with exact values, PRISM and Storm.

    crosscheck-engines.py [--dynabs PATH] [--prism PATH] [--models N] [--seed S] [--only ENGINE ...]

Runs the cases of tests/cases and N random models through `dynabs-check solve`, PRISM (--prism, $PRISM or the
search path) and Storm (if stormpy can be imported). Random models become one disjoint union, so
that a solver starts once for each property. Prints the largest differences; ends with 1 if any is too large, and with 77 if
PRISM or Storm, or one given by --only, is missing while all else agrees.

Needs nothing but Python's standard library. PRISM stops when values change little: on models that move slowly
its error exceeds its epsilon, hence a tolerance of 1e-6 without a step bound. Bounded values agree to 1e-12.
"""

import argparse
import os
import re
import sys
import tempfile
import time
from fractions import Fraction
from pathlib import Path

from crosscheck.engines import Dynabs, Failure, NotConverged, Prism, Storm, find, is_unbounded
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
BOUNDED, UNBOUNDED = 1e-12, 1e-6


class Table:
    """The largest differences, by what was compared."""

    def __init__(self):
        self.rows, self.failures, self.skipped = {}, [], {}

    def compare(self, what, found, expected, tolerance, at):
        """Counts values; `tolerance` is (below, above)."""
        row = self.rows.setdefault(what, [0, 0, 0.0])
        row[0] += 1
        row[1] += len(expected)
        if len(found) != len(expected):
            self.failures.append(f"{at}: {len(found)} values for {len(expected)} states")
            return
        for state, (value, exact) in enumerate(zip(found, expected)):
            difference = float(value - exact)
            row[2] = max(row[2], abs(difference))
            if not -tolerance[0] <= difference <= tolerance[1]:
                self.failures.append(f"{at}: state {state}: {value} instead of {float(exact)}")

    def fail(self, message):
        self.failures.append(message)

    def skip(self, reason):
        self.skipped[reason] = self.skipped.get(reason, 0) + 1

    def print(self):
        print(f"{'engine':8} {'models':8} {'operator':8} {'kind':10} {'queries':>7} {'values':>8}  largest difference")
        for (engine, models, operator, kind), (queries, values, largest) in sorted(self.rows.items()):
            print(f"{engine:8} {models:8} {operator:8} {kind:10} {queries:7} {values:8}  {largest:.1e}")
        for reason, count in sorted(self.skipped.items()):
            print(f"skipped {count}: {reason}")
        for failure in self.failures[:50]:
            print(f"DISAGREES {failure}")
        print(f"{len(self.failures)} disagreements")


def kind_of(path):
    return "unbounded" if is_unbounded(path) else "bounded"


def symmetric(path):
    tolerance = UNBOUNDED if is_unbounded(path) else BOUNDED
    return tolerance, tolerance


def check_cases(engines, directory, table):
    """Every case against its exact values."""
    for number, (model, questions, verdicts) in enumerate(load_cases(ROOT / "tests" / "cases")):
        stem = directory / f"case{number}"
        model.write_prism(stem)
        props = [f"P{q.operator}=? [ {q.path} ]" for q in questions] + [v["property"] for v in verdicts]
        initial = model.labels["init"]

        if dynabs := engines.get("dynabs"):
            for question, prop in zip(questions, props):
                what = ("dynabs", "cases", question.operator, kind_of(question.path))
                # Lower bounds: not above the exact value, compared as rationals.
                below = (symmetric(question.path)[0], 0)
                found = [Fraction(value) for value in dynabs.values(stem, prop, UNBOUNDED)]
                table.compare(what, found, question.values, below, f"dynabs, {model.name}: {prop}")
            for result, prop in zip(dynabs.results(stem, props, UNBOUNDED), props):
                check_result(result, model, prop, questions, verdicts, initial, table)

        if prism := engines.get("PRISM"):
            check_case_with_prism(prism, stem, model, questions, verdicts, props, table)

        if storm := engines.get("Storm"):
            model.write_drn(stem.with_suffix(".drn"))
            loaded = storm.load(stem.with_suffix(".drn"))
            for question in questions:
                if not storm.supports(question.path, model.has_zeros()):
                    table.skip("Storm has no bounded G, a wrong unbounded G, no unbounded properties with lower bounds 0")
                elif any(f'"{name}"' in question.path for name, states in model.labels.items() if not states):
                    table.skip("Storm's DRN has no labels without states")
                elif re.sub(r'"\w+"|\b(true|false|U|X|F)\b', "", question.path).strip(" !&|()<=0123456789"):
                    table.skip("Storm's DRN has no variables")
                else:
                    try:
                        # A chain is an MDP with one choice each.
                        operator = question.operator if not model.chain else 2 * question.operator
                        found = storm.values(loaded, re.sub(r"<(\d+)", at_most, question.path), operator)
                    except Failure as failure:
                        table.fail(f"Storm, {model.name}: {failure}")
                        continue
                    what = ("Storm", "cases", question.operator, kind_of(question.path))
                    at = f"Storm, {model.name}: P{operator} {question.path}"
                    table.compare(what, found, question.values, symmetric(question.path), at)


def at_most(match):
    """`F<k` as `F<=k-1`: Storm reads it otherwise for k=1."""
    return f"<={int(match[1]) - 1}"


def check_result(result, model, prop, questions, verdicts, initial, table):
    """Bounds and verdict of one property as dynabs prints them for the initial states."""
    at = f"dynabs, {model.name}: {prop}"
    for verdict in verdicts:
        if verdict["property"] == prop and result["satisfied"] is not verdict["satisfied"]:
            table.fail(f"{at}: {result['satisfied']}")
    for question in questions:
        if prop == f"P{question.operator}=? [ {question.path} ]":
            exact = [question.values[state] for state in initial]
            if Fraction(result["lower"]) > min(exact) or Fraction(result["upper"]) < max(exact):
                table.fail(f"{at}: {exact} is not within [{result['lower']},{result['upper']}]")


def check_case_with_prism(prism, stem, model, questions, verdicts, props, table):
    """The initial states only: one start for all properties."""
    fragile = [is_unbounded(prop) and model.fragile for prop in props]
    asked = [prop for prop, skip in zip(props, fragile) if not skip]
    for _ in range(sum(fragile)):
        table.skip("PRISM needs lower bounds above 0, which would change the value")
    if not asked:
        return
    model.write_prism(stem, raise_zeros=True)
    try:
        found = dict(zip(asked, prism.results(stem, asked)))
    except Failure as failure:
        table.fail(f"PRISM, {model.name}: {failure}")
        return
    for prop in asked:
        if isinstance(found[prop], Failure):
            table.fail(f"PRISM, {model.name}: {prop}: {found[prop]}")
    for question, prop in zip(questions, props):
        if prop in found and isinstance(found[prop], tuple):
            exact = [question.values[state] for state in model.labels["init"]]
            what = ("PRISM", "cases", question.operator, kind_of(question.path))
            at = f"PRISM, {model.name}: {prop}"
            table.compare(what, found[prop], (min(exact), max(exact)), symmetric(question.path), at)
    for verdict in verdicts:
        answer = found.get(verdict["property"])
        if isinstance(answer, bool) and answer is not verdict["satisfied"]:
            table.fail(f"PRISM, {model.name}: {verdict['property']}: {answer}")


def check_random(engines, directory, table, models, zeros, what):
    """All engines against dynabs, whose lower bounds are at most 1e-9 (bounded: 1e-13) below the value."""
    stem = directory / what
    model = union(models)
    model.write_prism(stem)
    raised = directory / f"{what}-raised"
    model.write_prism(raised, raise_zeros=True)
    storm = engines.get("Storm")
    if storm:
        model.write_drn(stem.with_suffix(".drn"))
        loaded = storm.load(stem.with_suffix(".drn"))
    times = {}
    for path in PATHS:
        for operator in OPERATORS:
            prop = f"P{operator}=? [ {path} ]"
            runs = {"dynabs": lambda: engines["dynabs"].values(stem, prop, 1e-9)}
            if "PRISM" in engines and not (zeros and is_unbounded(path)):
                runs["PRISM"] = lambda: engines["PRISM"].values(raised, prop)
            if storm and storm.supports(path, zeros):
                runs["Storm"] = lambda: storm.values(loaded, path, operator)
            if len(runs) == 1:
                continue
            found = {}
            for engine, run in runs.items():
                start = time.monotonic()
                try:
                    found[engine] = run()
                except NotConverged as failure:
                    table.skip(str(failure))
                except Failure as failure:
                    table.fail(f"{engine}, {what}: {failure}")
                times[engine] = times.get(engine, 0) + time.monotonic() - start
            for engine, values in found.items():
                if engine != "dynabs" and "dynabs" in found:
                    key = (engine, what, operator, kind_of(path))
                    at = f"{engine}, {what}: {prop}"
                    table.compare(key, values, found["dynabs"], symmetric(path), at)
    print(f"{what}: {len(models)} models, {len(model.states)} states, seconds", {k: round(v, 1) for k, v in times.items()})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dynabs", default=os.environ.get("DYNABS_CHECK", str(ROOT / "target/release/dynabs-check")))
    parser.add_argument("--prism", default=os.environ.get("PRISM", "prism"))
    parser.add_argument("--models", type=int, default=1000, help="random models of each of the two kinds (1000)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--no-cases", action="store_true", help="random models only")
    parser.add_argument("--only", nargs="+", choices=["PRISM", "Storm"], default=["PRISM", "Storm"])
    arguments = parser.parse_args()

    command = find(arguments.dynabs) or find("dynabs-check")
    if command is None:
        sys.exit(f"{arguments.dynabs} is missing: cargo build --release, or --dynabs PATH")
    engines, missing = {"dynabs": Dynabs(command)}, []
    if "PRISM" in arguments.only:
        prism = find(arguments.prism)
        engines |= {"PRISM": Prism(prism)} if prism else {}
        missing += [] if prism else ["PRISM (--prism PATH)"]
    if "Storm" in arguments.only:
        try:
            engines["Storm"] = Storm("1/10000000000000")
        except ImportError:
            missing.append("Storm (pip install stormpy)")
    for engine in missing:
        print(f"skipped: {engine} is missing")

    table = Table()
    with tempfile.TemporaryDirectory() as directory:
        directory = Path(directory)
        if not arguments.no_cases:
            check_cases(engines, directory, table)
        for zeros, what in ((False, "random"), (True, "zeros")):
            seeds = range(arguments.seed, arguments.seed + arguments.models)
            models = [random_model(seed, zeros) for seed in seeds]
            for first in range(0, len(models), UNION):
                check_random(engines, directory, table, models[first : first + UNION], zeros, what)
    table.print()
    sys.exit(1 if table.failures else 77 if missing else 0)


if __name__ == "__main__":
    main()
