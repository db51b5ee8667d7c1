"""Runs models/benchmarks and writes a table; called by reproduce-benchmarks.sh. Needs Python's standard library."""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# What is published, the bound that is to be reached, and where: "start", "best" cell, or nowhere. Sources are in the
# models' descriptions.
PUBLISHED = {
    "anaesthesia": ("AMYTISS .9998 (no bound), 2.3 s", None, None),
    "bas_4d": ("IMPaCT, IntervalMDP.jl, Storm .4533 at the initial cell", 0.60, "best"),
    "bas_7d": ("IMPaCT 1.47 + 2.03 h, 91.9 GB, synthesis > 24 h", None, None),
    "bicycle": ("IMPaCT 89 + 114 + 286 s, 7.4 GB", None, None),
    "car_parking_a": ("IntervalMDPAbstractions, rows as products of intervals on 40²: .78 in 70 s", 0.76, "start"),
    "car_parking_b": ("SySCoRe > .999", 0.99, "start"),
    "drone_2d": ("imdp-synthesis .534 on 90,000 × 9", 0.99, "start"),
    "drone_3d_obstacles": ("imdp-synthesis .00036 on 2.62 M × 27, 0 on 657 k × 125", None, None),
    "dubins_3d": ("imdp-synthesis .9903", 0.999, "start"),
    "dubins_4d": ("imdp-synthesis .509 on 2.10 M × 9", 0.509, "start"),
    "dubins_4d_certain": ("the same, parameters known", None, None),
    "dubins_4d_wide": ("the same, parameters ± .1", None, None),
    "epistemic_drone": ("AAAI 2023", None, None),
    "epistemic_drone_spring": ("AAAI 2023", None, None),
    "mountain_car": ("imdp-synthesis .9657 on 36,806 × 3", 0.99, "start"),
    "pendulum": ("imdp-synthesis .9900", 0.999, "start"),
    "robot_2d": ("IMPaCT 20.7 + 59.8 + 1,047 s, 8.8 GB a matrix", 0.998, "start"),
    "rooms_3": ("IMPaCT 80 + 154 s, 24.7 GB; AMYTISS .9599 (no bound)", None, None),
    "scaling_14": ("IMPaCT 699 + 987 + 67.7 s", None, None),
    "traffic_3": ("AMYTISS", None, None),
    "van_der_pol": ("SySCoRe", None, None),
}
RUNS = 10_000


def run(command):
    """Runs a command: its output, wall-clock and processor seconds, and peak memory in MB."""
    with tempfile.TemporaryFile("w+") as out:
        began = time.monotonic()
        process = subprocess.Popen(command, stdout=out, stderr=subprocess.PIPE, text=True)
        stderr = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - began
        out.seek(0)
        code = os.waitstatus_to_exitcode(status)
        if code not in (0, 4):
            sys.exit(f"{' '.join(map(str, command))} ended with {code}:\n{stderr}")
        return out.read(), wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def shown(value):
    """A lower bound, rounded down."""
    if value == 0 or value >= 1e-3:
        return f"{int(value * 1e5) / 1e5:.5f}"
    return f"{value * (1 - 1e-3):.2e}"


def measure(name, bins, scratch):
    """One row of the table."""
    directory = scratch / name
    model = ROOT / "models" / "benchmarks" / f"{name}.json"
    compile_ = [bins / "dynabs-compile", model, "--output", directory, "--no-tra", "--solve", "--json", "--quiet"]
    text, wall, cpu, memory = run(compile_)
    found = json.loads(text)
    result = found["result"]
    row = {
        "name": name,
        "cells": found["cells"],
        "inputs": found["inputs"],
        "resolution": found["resolution"],
        "lower": result["lower"],
        "best": result["best"],
        "start": json.loads(model.read_text()).get("initial_state"),
        "seconds": wall,
        "processor_seconds": cpu,
        "megabytes": memory,
        "published": PUBLISHED[name][0],
    }
    if row["start"] is not None:
        simulate = [bins / "dynabs-check", "simulate", directory, "--runs", str(RUNS), "--json", "--quiet"]
        row["simulated"] = json.loads(run(simulate)[0])
    return row


def table(rows):
    """The rows as Markdown."""
    lines = [
        "| model | cells × inputs | resolution | bound at the start | in the best cell | simulated | time (processor) "
        "| memory | published |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        start = shown(row["lower"]) if row["start"] is not None else "–"
        simulated = row.get("simulated")
        lines.append(
            f"| `{row['name']}` | {row['cells']:,} × {row['inputs']} | {' '.join(map(str, row['resolution']))} | {start} "
            f"| {shown(row['best'])} | {'–' if simulated is None else simulated} | {row['seconds']:.1f} s "
            f"({row['processor_seconds']:.1f} s) | {row['megabytes']:.0f} MB | {row['published']} |"
        )
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--dynabs", type=Path, required=True)
    parser.add_argument("--only", action="append", choices=sorted(PUBLISHED), metavar="NAME")
    parser.add_argument("directory", nargs="?", type=Path, default=ROOT / "out" / "benchmarks")
    arguments = parser.parse_args()
    missing = {path.stem for path in (ROOT / "models" / "benchmarks").glob("*.json")} - set(PUBLISHED)
    if missing:
        sys.exit(f"models without published figures: {', '.join(sorted(missing))}")
    arguments.directory.mkdir(parents=True, exist_ok=True)
    rows, short = [], []
    with tempfile.TemporaryDirectory() as scratch:
        for name in arguments.only or sorted(PUBLISHED):
            row = measure(name, arguments.dynabs, Path(scratch))
            rows.append(row)
            print(table([row]).splitlines()[-1], flush=True)
            _, wanted, where = PUBLISHED[name]
            if wanted is not None and row["best" if where == "best" else "lower"] < wanted:
                short.append(name)
    (arguments.directory / "results.md").write_text(table(rows))
    (arguments.directory / "results.json").write_text(json.dumps(rows, indent=1))
    print(f"wrote {arguments.directory / 'results.md'}")
    if short:
        sys.exit(f"below the bound that is to be reached: {', '.join(short)}")


if __name__ == "__main__":
    main()
