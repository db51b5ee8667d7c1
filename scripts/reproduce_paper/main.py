"""See ../reproduce-paper.sh."""

import argparse
import sys
import time
from pathlib import Path

import integrator
import page
import spacecraft
from runs import ROOT, Dynabs


def main():
    parser = argparse.ArgumentParser(prog="reproduce-paper.sh")
    parser.add_argument("directory", nargs="?", type=Path, default=ROOT / "out/paper")
    parser.add_argument("--dynabs", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--keep", action="store_true", help="keep the compiled models with their PRISM files")
    arguments = parser.parse_args()
    directory = arguments.directory
    directory.mkdir(parents=True, exist_ok=True)
    dynabs = Dynabs(arguments.dynabs, arguments.keep)
    start = time.monotonic()
    rows = integrator.reproduce(dynabs, directory)
    cases = spacecraft.reproduce(dynabs, directory)
    tables = page.tables(rows, cases)
    text = page.markdown(tables)
    (directory / "results.md").write_text(text)
    (directory / "index.html").write_text(page.page(tables, rows, cases))
    print(text)
    print(f"{directory / 'index.html'} written after {time.monotonic() - start:.0f} s")
    checks = [row[name] for row in rows + cases for name in ("same_size", "same_values")]
    if False in checks:
        sys.exit("A published number was not reproduced.")


if __name__ == "__main__":
    main()
