#!/usr/bin/env python3
"""What fresh samples prove of one controller, on average over many sets of them.

    scripts/validate-fresh.py [-n SETS] [--samples N] [MODEL]

Compiles a model whose noise is drawn from a normal distribution with independent components (building_1_zone, unless another is
named), draws SETS (20) sets of N (3,200) samples of one step, and has `dynabs validate` say what each of them proves with
confidence 99 %. Prints the mean, the least and the greatest bound beside that of the abstraction. $DYNABS names the program.
"""

import argparse
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent


def dynabs(*arguments):
    program = os.environ.get("DYNABS", "dynabs")
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        sys.exit(f"{program} {' '.join(map(str, arguments))}\n{done.stderr}")
    return done.stdout


def deviations(model):
    """Of the components of the noise."""
    covariance = model["noise"]["gaussian"]["covariance"]
    if any(entry for i, row in enumerate(covariance) for j, entry in enumerate(row) if i != j):
        sys.exit("found components that depend on each other; expected a diagonal covariance")
    return [covariance[j][j] ** 0.5 for j in range(len(covariance))]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", nargs="?", type=pathlib.Path, default=root / "models/predecessors/building_1_zone.json")
    parser.add_argument("-n", "--sets", type=int, default=20)
    parser.add_argument("--samples", type=int, default=3200)
    given = parser.parse_args()
    spread = deviations(json.loads(given.model.read_text()))
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        dynabs("compile", given.model, "--solve", "--no-tra", "-q", "-o", scratch / "run")
        bounds, runs, promised = [], 0, 0.0
        for seed in range(given.sets):
            draws = random.Random(seed)
            lines = (",".join(repr(draws.gauss(0, deviation)) for deviation in spread) for _ in range(given.samples))
            fresh = scratch / "fresh.csv"
            fresh.write_text("\n".join(lines) + "\n")
            said = json.loads(dynabs("validate", scratch / "run", "--samples", fresh, "--json", "-q"))
            bounds.append(said["bound"])
            runs, promised = said["runs"], said["promised"]
    print(f"{given.model.stem}: {runs} runs from {given.samples} fresh samples, {given.sets} sets of them")
    print(f"  proven, with confidence 99 %: {sum(bounds) / len(bounds):.4f} on average, {min(bounds):.4f} to {max(bounds):.4f}")
    print(f"  promised by the abstraction:  {promised:.4f}")


main()
