#!/usr/bin/env python3
"""Compares the values of actions "inputs" with those of the exported models: by dynabs's general solver, PRISM and Storm.

    crosscheck-inputs.py [--dynabs DIR] [--prism PATH] [--python PATH] [--each N] [--seed S] [--only KIND ...]

Makes N random small problems of every kind (noise × task), compiles each, and asks everyone about both bounds. Prints the
largest differences; ends with 1 if any exceeds 1e-9 with a bound on the steps, or 1e-6 without, and with 77 if PRISM or Storm
is missing while all else agrees. Needs Python's standard library.
"""

import argparse
import itertools
import json
import random
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NOISES = ("known", "gaussian", "joint", "intervals", "bands")
TASKS = ("reach", "reach for ever", "stay", "reach_at", "sequence", "formula", "finite words")
# By matrices, and by expressions.
MAPS = (
    ({"A": [[0.8, 0.3], [0, 0.7]], "B": [[1], [-0.2]]}),
    ({"A": [[1, 1], [0, 1]], "B": [[0.5], [1]]}),
    ({"next": ["x1 + 0.5*sin(2*x2) + u1", "0.9*x2 + 0.3*u1*cos(x1)"]}),
    ({"next": ["p*x1 + u1", "0.8*x2 + 0.2*abs(x1)"], "parameters": {"p": [0.7, 0.9]}}),
    ({"next": ["max(x1 - 0.4, 0.5*x1) + u1", "clip(x2 + u1, -1.4, 1.4)"]}),
    ({"A": [[0.6, 0.2], [0.1, 0.7]]}),
)


def component(r):
    """A known distribution, or none."""
    return r.choice(
        [
            {"gaussian": {"deviation": r.randint(4, 10) / 20}},
            {"uniform": {"lower": -r.randint(4, 16) / 20, "upper": r.randint(2, 16) / 20}},
            {"triangular": {"lower": -0.8, "mode": 0, "upper": r.randint(4, 16) / 20}},
            {"laplace": {"scale": r.randint(2, 6) / 20}},
            {"logistic": {"scale": r.randint(2, 5) / 20}},
            {"student_t": {"scale": 0.2, "degrees": r.randint(2, 9)}},
            {"atoms": {"values": [-0.5, 0, r.randint(2, 16) / 20], "weights": [1, 2, 1]}},
            None,
        ]
    )


def noise(kind, r):
    if kind == "known":
        return {"components": [component(r), component(r)]}
    a, b = r.randint(2, 6) / 20, r.randint(2, 6) / 20
    c = r.choice([-1, 1]) * min(a, b) / 2
    found = {"gaussian": {"covariance": [[a, c], [c, b]]}}
    if kind != "gaussian":
        found |= {"count": 3000, "seed": r.randint(0, 99)}
    if kind in ("intervals", "bands"):
        found["independent"] = kind
    return found


def task(kind, r):
    steps = r.randint(1, 4)
    goal = [{"lower": [r.randint(0, 8) / 20, -2], "upper": [2, 2]}]
    unsafe = [{"lower": [-2, 1], "upper": [-1, 2]}]
    legs = [{"reach": "a"}, {"reach": "b", "avoid": ["c"]}]
    return {
        "reach": {"goal": goal, "unsafe": unsafe, "horizon": steps},
        "reach for ever": {"goal": goal, "unsafe": unsafe, "horizon": "infinite"},
        "stay": {"type": "stay", "safe": [{"lower": [-1.5, -2], "upper": [2, 2]}], "horizon": steps},
        "reach_at": {"type": "reach_at", "goal": goal, "horizon": steps},
        "sequence": {"type": "sequence", "sequence": legs, "horizon": steps + 1},
        "formula": {"type": "formula", "formula": "F (a & X (!c U b))", "horizon": steps + 1},
        "finite words": {"type": "formula", "logic": "ltlf", "formula": "(G (a -> X (!c))) & (F b)", "horizon": steps},
    }[kind]


def problem(kinds, r):
    """A problem in the square [−2, 2]²; regions of tasks with a memory cut cells."""
    dynamics = r.choice(MAPS)
    found = {
        "name": "random",
        "dynamics": dynamics,
        "actions": "inputs",
        "noise": noise(kinds[0], r),
        "partition": {
            "lower": [-2, -2],
            "upper": [2, 2],
            "cells": [r.randint(3, 6), r.randint(3, 5)],
            "resolution": [r.randint(1, 3), 1],
            "periodic": [False, r.random() < 0.25],
        },
        "regions": {
            "a": {"lower": [0.3, -1], "upper": [2, 1.2]},
            "b": {"lower": [-2, -2], "upper": [0, 2]},
            "c": {"lower": [-1, 1], "upper": [2, 2]},
        },
        "task": task(kinds[1], r),
        "initial_state": [r.randint(-28, 28) / 20, r.randint(-38, 38) / 20],
    }
    if "B" in dynamics or "next" in dynamics:
        found["input"] = {"lower": [-0.5], "upper": [0.5], "points": [r.randint(1, 4)]}
    return found


def run(command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dynabs", type=Path, default=ROOT / "target" / "release", help="where the programs are")
    parser.add_argument("--prism")
    parser.add_argument("--python", help="a Python that can import stormpy")
    parser.add_argument("--each", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", action="append", metavar="KIND", help='such as "known, stay"')
    arguments = parser.parse_args()
    engines = [f"--{name}={path}" for name, path in vars(arguments).items() if name in ("prism", "python") and path]
    rows, failures, missing = {}, [], set()

    def compare(who, kind, found, expected, tolerance, at):
        row = rows.setdefault((kind, who), [0, 0.0])
        row[0] += 1
        row[1] = max(row[1], abs(found - expected))
        if not abs(found - expected) <= tolerance:
            failures.append(f"{at}: {who}: {found} instead of {expected}")

    with tempfile.TemporaryDirectory() as scratch:
        for kinds in itertools.product(NOISES, TASKS):
            kind = ", ".join(kinds)
            if arguments.only and kind not in arguments.only:
                continue
            r = random.Random(f"{arguments.seed} {kind}")
            for number in range(arguments.each):
                at = f"{kind}, {number}"
                model, out = Path(scratch) / "m.json", Path(scratch) / "run"
                model.write_text(json.dumps(problem(kinds, r)))
                compile_ = [arguments.dynabs / "dynabs-compile", model, "-o", out, "--force", "--solve", "--json", "--quiet"]
                code, text, error = run(compile_)
                if code not in (0, 3):
                    failures.append(f"{at}: {error.strip()}")
                    continue
                found = json.loads(text)
                result, bounded = found["result"], found["manifest"]["horizon"] is not None
                native = result.get("exported", [result["lower"], result["upper"]])
                tolerance = 1e-9 if bounded else 1e-6
                check = [arguments.dynabs / "dynabs-check", "crosscheck", out, "--json", "--quiet", *engines]
                code, text, error = run(check)
                if not text:
                    failures.append(f"{at}: {error.strip()}")
                    continue
                said = json.loads(text)
                missing.update(said["missing"])
                for finding in said["findings"]:
                    # The least value of initial states is the lower bound, the greatest one the upper.
                    end = 0 if "maxmin" in finding["property"] else 1
                    compare("general solver", kind, finding["ours"][end], native[end], tolerance, at)
                    if finding["agreement"] == "disagrees":
                        failures.append(f"{at}: {finding['engine']} disagrees about state {finding['state']}")
                    # Lower bounds of 0 that are raised for the engines may change a value without a bound on the steps
                    # altogether; crosscheck compares with that of the raised model too.
                    is_raised = any("which changes the value" in note for note in finding["notes"])
                    if is_raised and finding["agreement"] == "agrees":
                        continue
                    if finding["value"] is not None:
                        compare(finding["engine"], kind, finding["value"][end], native[end], tolerance, at)
                    elif finding["agreement"] == "failed" and "not supported" not in " ".join(finding["notes"]):
                        failures.append(f"{at}: {finding['engine']}: {finding['notes']}")
            for (_, who), (count, most) in ((key, row) for key, row in rows.items() if key[0] == kind):
                print(f"{kind:25} {who:15} {count:4} values, largest difference {most:.1e}", flush=True)
    print(*failures, sep="\n")
    if failures:
        sys.exit(1)
    if missing:
        print(f"missing: {', '.join(sorted(missing))}")
        sys.exit(77)


if __name__ == "__main__":
    main()
