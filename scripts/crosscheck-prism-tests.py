#!/usr/bin/env python3
"""Runs PRISM's own test cases of interval models through dynabs.

    crosscheck-prism-tests.py PRISM_TESTS [--prism PATH] [--dynabs PATH]

PRISM_TESTS is a checkout of prism-tests. PRISM exports every model below functionality/verify/imdps and
idtmcs to explicit files in a temporary directory; dynabs answers those properties that it supports and is
compared with the RESULT comments beside them, to the 1e-5 that PRISM's own tests allow. Ends with 1 if a
value differs, and with 77 if PRISM or the tests are missing. Needs nothing but Python's standard library.
"""

import argparse
import itertools
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from crosscheck.dynabs import Dynabs, Failure, find

TOLERANCE = 1e-5
FUNCTIONS = {"min": min, "max": max, "true": True, "false": False, "__builtins__": {}}


def evaluate(text, constants):
    """The value of an arithmetic expression in the files, or None."""
    try:
        return eval(text, FUNCTIONS, dict(constants))  # Of PRISM's tests, without builtins.
    except (NameError, SyntaxError, TypeError):
        return None


def runs(model):
    """The constants of every run: one dictionary for each combination in the .args files."""
    names = [model.with_name(model.name + ".props.args"), model.with_name(model.name + ".args")]
    lines = [line for name in names if name.exists() for line in name.read_text().splitlines()]
    for line in [line for line in lines if line.strip() and not line.startswith("#")] or [""]:
        axes = []
        for assignment in itertools.chain(*(part.split(",") for part in re.findall(r"-const (\S+)", line))):
            name, text = assignment.split("=")
            values = [text]
            if text.count(":") == 2:
                low, step, high = map(float, text.split(":"))
                values = [f"{low + i * step:.10g}" for i in range(int((high - low) / step + 1.5))]
            axes.append([(name, value) for value in values])
        yield from map(dict, itertools.product(*axes))


def definitions(text, constants):
    """Constants with the values of `const` lines, as far as they can be computed."""
    known = {name: evaluate(value, {}) for name, value in constants.items()}
    for name, value in re.findall(r"^const\s+(?:\w+\s+)?(\w+)\s*=\s*([^;]+);", text, flags=re.MULTILINE):
        known[name] = evaluate(value, known)
    return known


def properties(text):
    """(property, its RESULT comments) of a .props file."""
    comments = []
    for line in text.splitlines():
        line = line.strip()
        if line.startswith("//"):
            comments.append(line)
        elif line and not line.startswith("const"):
            yield re.sub(r'^"\w+":\s*', "", line.split("//")[0].strip().rstrip(";")), comments
            comments = []


def expected(comments, constants):
    """The RESULT for these constants, as a number or truth value."""
    for comment in comments:
        found = re.match(r"//\s*RESULT\s*(?:\(([^)]*)\))?\s*:\s*([^/]*(?:/[^/]+)*)", comment)
        if not found:
            continue
        wanted = [pair.split("=") for pair in (found[1] or "").split(",") if pair]
        same = lambda name, value: name in constants and constants[name] == evaluate(value.strip(), {})
        if all(same(name.strip(), value) for name, value in wanted):
            return evaluate(found[2].split("//")[0].strip(), constants)
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tests", type=Path)
    parser.add_argument("--prism", default=os.environ.get("PRISM", "prism"))
    root = Path(__file__).resolve().parent.parent
    parser.add_argument("--dynabs", default=os.environ.get("DYNABS_CHECK", str(root / "target/release/dynabs-check")))
    arguments = parser.parse_args()
    folders = [arguments.tests / "functionality" / "verify" / kind for kind in ("imdps", "idtmcs")]
    prism, dynabs = find(arguments.prism), find(arguments.dynabs) or find("dynabs-check")
    if dynabs is None:
        sys.exit(f"{arguments.dynabs} is missing: cargo build --release, or --dynabs PATH")
    if prism is None or not all(folder.is_dir() for folder in folders):
        print(f"skipped: needs PRISM (--prism PATH) and its tests in {arguments.tests}")
        sys.exit(77)

    agree, wrong, unsupported, largest = 0, [], {}, 0.0
    with tempfile.TemporaryDirectory() as directory:
        stem = Path(directory) / "m"
        for model in sorted(itertools.chain(*(folder.glob("*.prism") for folder in folders))):
            for given in runs(model):
                constants = [f"{name}={value}" for name, value in given.items()]
                export = f"{stem.with_suffix('.tra')},sta,lab"
                command = [prism, str(model), "-ex", "-exportmodel", export]
                command += ["-const", ",".join(constants)] if constants else []
                subprocess.run(command, capture_output=True, check=False, cwd=directory)
                for props in sorted(model.parent.glob(model.name + "*.props")):
                    texts = props.read_text()
                    known = definitions(texts, {}) | definitions(model.read_text(), given)
                    for text, comments in properties(texts):
                        value = expected(comments, known)
                        if not text.startswith("P") or value is None:
                            continue
                        spelled = re.sub(r'"\w+"|\b[A-Za-z_]\w*\b', lambda m: substitute(m[0], known), text)
                        # dynabs has no division; one of the tests has this one.
                        spelled = re.sub(r"(\w+)/(\d+)<0\.1", r"10*\1<\2", spelled)
                        at = f"{model.name} {' '.join(constants)}: {text}"
                        try:
                            [result] = Dynabs(dynabs).results(stem.with_suffix(".tra"), [spelled], 1e-7)
                        except Failure as failure:
                            unsupported.setdefault(str(failure).split("error: ")[-1].split("column")[-1].lstrip(" 0123456789:")[:90], []).append(at)
                            continue
                        if isinstance(value, bool):
                            difference = 0.0 if result["satisfied"] is value else 1.0
                        else:
                            difference = max(result["lower"] - value, value - result["upper"], 0.0)
                            largest = max(largest, difference)
                        if difference > TOLERANCE:
                            wrong.append(f"{at}: {result} instead of {value}")
                        else:
                            agree += 1
    print(f"{agree} agree, {len(wrong)} differ; furthest outside of dynabs' bounds: {largest:.1e}")
    for reason, places in unsupported.items():
        print(f"skipped {len(places)}: {reason}")
    for line in wrong:
        print(f"DIFFERS {line}")
    sys.exit(1 if wrong else 0)


def substitute(word, constants):
    value = constants.get(word)
    return word if value is None or isinstance(value, bool) else f"{value:g}" if isinstance(value, float) else str(value)


if __name__ == "__main__":
    main()
