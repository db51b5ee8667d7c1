#!/usr/bin/env python3
"""Times dynabs, Storm and PRISM on one large explicit model.

    benchmark-explicit.py [--states N] [--runs R] [--directory DIR] [--dynabs PATH] [--prism PATH] [--python PATH]

Writes a random model of about 16 million transitions without repeated rows (scripts/random-model.py), then asks
every solver, one after the other, the others by `dynabs-check crosscheck --as-is`, for Pmaxmin=? [ F<=16 "goal" ] in state 0.
Prints wall time (the best of R runs), peak memory and ratios, and checks the targets: at most a quarter of Storm's
time, a tenth of PRISM's, 40 bytes per transition. Solvers that are missing are skipped. Ends with 1 if values
differ or a target is missed. Nothing else should be running.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from crosscheck.dynabs import Dynabs, Failure, add_engine_options, engine_options, find

ROOT = Path(__file__).resolve().parent.parent
PROPERTY = 'Pmaxmin=? [ F<=16 "goal" ]'
CHOICES, SUCCESSORS = 4, 20


def measure(command):
    """(seconds, peak bytes, output) of a command and its children."""
    read, write = os.pipe()
    start = time.monotonic()
    pid = os.fork()
    if pid == 0:
        # A process of its own, so that the peak of its children is that of this one command.
        os.close(read)
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024
        with os.fdopen(write, "w") as pipe:
            json.dump({"peak": peak, "output": done.stdout + done.stderr, "code": done.returncode}, pipe)
        os._exit(0)
    os.close(write)
    with os.fdopen(read) as pipe:
        report = json.load(pipe)
    os.waitpid(pid, 0)
    seconds = time.monotonic() - start
    if report["code"] != 0:
        sys.exit(f"{command[0]} failed:\n{report['output'][-2000:]}")
    return seconds, report["peak"], report["output"]


def measure_engine(dynabs, engine, path):
    """(seconds, peak bytes, value) of an engine that `dynabs-check crosscheck` hands this file; None if it is missing."""
    try:
        [finding] = dynabs.crosscheck(path, [PROPERTY], "--with", engine, "--as-is", "--memory", "12g", "--timeout", 3600)
    except Failure as failure:
        print(f"skipped: {failure}")
        return None
    if finding["value"] is None:
        sys.exit(f"{engine} failed: {'; '.join(finding['notes'])}")
    return finding["seconds"], (finding["peak_mib"] or 0) << 20, finding["value"][0]


def write_model(stem, states):
    if not stem.with_suffix(".drn").exists():
        command = [sys.executable, str(ROOT / "scripts/random-model.py")]
        size = [str(states), str(CHOICES), str(SUCCESSORS), "1"]
        subprocess.run([*command, *size, str(stem), "--drn"], check=True)
    with open(stem.with_suffix(".tra")) as tra:
        return int(tra.readline().split()[2])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--states", type=int, default=202_000)
    parser.add_argument("--runs", type=int, default=1)
    parser.add_argument("--directory", type=Path, help="keep the files here and reuse them")
    parser.add_argument("--dynabs", default=os.environ.get("DYNABS_CHECK", str(ROOT / "target/release/dynabs-check")))
    add_engine_options(parser)
    arguments = parser.parse_args()
    dynabs = find(arguments.dynabs) or find("dynabs-check")
    if dynabs is None:
        sys.exit(f"{arguments.dynabs} is missing: cargo build --release, or --dynabs PATH")

    with tempfile.TemporaryDirectory() as temporary:
        directory = arguments.directory or Path(temporary)
        directory.mkdir(parents=True, exist_ok=True)
        stem = directory / f"random-{arguments.states}"
        transitions = write_model(stem, arguments.states)
        print(f"{transitions} transitions, {stem.with_suffix('.tra').stat().st_size >> 20} MB; {PROPERTY}")

        tra, drn = str(stem.with_suffix(".tra")), str(stem.with_suffix(".drn"))
        engines = Dynabs(dynabs, engine_options(arguments)[2:])
        solve = [dynabs, "solve", tra, "-p", PROPERTY, "--json", "--quiet"]
        runs = [measure(solve) for _ in range(arguments.runs)]
        seconds, peak, output = min(runs)
        results = {"dynabs": (seconds, peak, json.loads(output)["results"][0]["lower"])}
        for name, engine, path in (("Storm", "storm", drn), ("PRISM", "prism", tra)):
            if arguments.engines in (engine, "all"):
                runs = [measure_engine(engines, engine, path) for _ in range(arguments.runs)]
                results |= {name: min(runs)} if None not in runs else {}
    sys.exit(0 if report(results, transitions) else 1)


def report(results, transitions):
    """Prints the table and whether every target is met."""
    seconds, peak, value = results["dynabs"]
    print(f"{'solver':8} {'seconds':>8} {'ratio':>6} {'peak MB':>8} {'bytes/transition':>16}  value")
    for name, (own_seconds, own_peak, own_value) in results.items():
        ratio = own_seconds / seconds
        per_transition = own_peak / transitions
        print(f"{name:8} {own_seconds:8.2f} {ratio:6.1f} {own_peak / 1e6:8.0f} {per_transition:16.1f}  {own_value:.15f}")
    checks = [(f"{name} agrees to 1e-12", abs(other - value) <= 1e-12) for name, (_, _, other) in results.items()]
    for name, factor in (("Storm", 4), ("PRISM", 10)):
        if name in results:
            checks.append((f"1/{factor} of {name}'s time", results[name][0] >= factor * seconds))
    checks.append(("40 bytes per transition", peak <= 40 * transitions))
    for what, holds in checks:
        print(f"{'ok    ' if holds else 'MISSED'} {what}")
    return all(holds for _, holds in checks)


if __name__ == "__main__":
    main()
