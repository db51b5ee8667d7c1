#!/usr/bin/env python3
"""Measures how time and memory of compiling and solving grow with the number of cells, at a fixed stencil.

    benchmark-growth.py [--cells N,N,...] [--steps H] [--dynabs PATH]

A model with four states, x+ = x + u + noise with bounded noise: every row lists 5 cells in each dimension, and every cell
has 3 targets in each, whatever the size of the partition. Prints a Markdown table with the time of the processors and the
peak memory, and the exponent of the growth between the ends. Without --cells the largest has 10 million of them, which takes
some minutes and gigabytes.
"""

import argparse
import json
import math
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DIMENSION = 4
SAMPLES = 2000


def write_model(directory, cells, steps):
    """A partition with so many cells of width 1 in each dimension."""
    rng = random.Random(1)
    noise = directory / "noise.csv"
    if not noise.exists():
        # In cells around the target's, which has its center at 0: up to two of them away.
        rows = ([f"{rng.uniform(-2.4, 2.4):.6f}" for _ in range(DIMENSION)] for _ in range(SAMPLES))
        noise.write_text("\n".join(",".join(row) for row in rows) + "\n")
    identity = [[float(i == j) for j in range(DIMENSION)] for i in range(DIMENSION)]
    half = cells / 2
    model = {
        "name": f"growth_{cells}",
        "dynamics": {"A": identity, "B": identity},
        "noise": {"samples": {"file": "noise.csv", "of": "step"}},
        "input": {"lower": [-1.6] * DIMENSION, "upper": [1.6] * DIMENSION},
        "partition": {"lower": [-half] * DIMENSION, "upper": [half] * DIMENSION, "cells": [cells] * DIMENSION},
        "task": {"goal": [{"lower": [-2.0 - cells % 2 / 2] * DIMENSION, "upper": [2.0 + cells % 2 / 2] * DIMENSION}], "unsafe": [], "horizon": steps},
        "probabilities": {"mode": "pac", "confidence": 0.99},
    }
    path = directory / f"growth_{cells}.json"
    path.write_text(json.dumps(model))
    return path


def measure(command):
    """(seconds of the processors, peak bytes, output) of a command."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{command[0]} failed with status {status}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024, json.loads(output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", default="10,18,32,56", help="per dimension")
    parser.add_argument("--steps", type=int, default=8)
    parser.add_argument("--dynabs", default=str(ROOT / "target/release/dynabs"))
    arguments = parser.parse_args()
    points = []
    print("| cells | transitions | processor time | memory | bytes a cell |")
    print("|---|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory() as scratch:
        for cells in map(int, arguments.cells.split(",")):
            path = write_model(Path(scratch), cells, arguments.steps)
            command = [arguments.dynabs, "compile", str(path), "--dry-run", "--solve", "--json", "-q"]
            seconds, peak, report = measure(command)
            number = cells**DIMENSION
            points.append((number, seconds))
            print(f"| {number:,} | {report['transitions']:,} | {seconds:.1f} s | {peak / 1e6:,.0f} MB | {peak / number:.0f} |", flush=True)
    (few, short), (many, long) = points[0], points[-1]
    if many > few:
        print(f"\nGrowth exponent from {few:,} to {many:,} cells: {math.log(long / short) / math.log(many / few):.2f}")


if __name__ == "__main__":
    main()
