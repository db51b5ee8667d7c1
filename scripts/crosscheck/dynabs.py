"""`dynabs-check` as a program: what it solves, and what other engines say according to it."""

import json
import shutil
import subprocess
from pathlib import Path


class Failure(Exception):
    """There is no answer."""


class Dynabs:
    """`dynabs-check`; `engines` are the arguments that say where PRISM and Storm are."""

    def __init__(self, command, engines=()):
        self.command, self.engines = command, list(engines)

    def run(self, *arguments):
        """The object that a subcommand prints."""
        command = [self.command, *map(str, arguments), "--json", "--quiet"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        try:
            return json.loads(done.stdout)
        except ValueError:
            raise Failure(f"{' '.join(map(str, arguments))}: {done.stderr.strip()}") from None

    def results(self, model, props, epsilon=1e-6):
        """What is known about each property in the initial states."""
        return self.run("solve", model, *named(props), "--epsilon", epsilon)["results"]

    def values(self, model, prop, epsilon=1e-6):
        """The lower bounds of all states."""
        out = Path(model).with_suffix(".dynabs-values")
        [result] = self.run("solve", model, "-p", prop, "--values", out, "--epsilon", epsilon)["results"]
        if result["status"] not in ("converged", "horizon reached"):
            raise Failure(f"{prop}: {result['status']}")
        return [float(line) for line in out.read_text().split()]

    def crosscheck(self, model, props, *options):
        """What each engine that is there says about each property."""
        found = self.run("crosscheck", model, *named(props), *self.engines, *options)
        return found["findings"]

    def diff(self, left, right):
        """Whether two models are the same."""
        return self.run("diff", left, right)["same"]


def named(props):
    return [argument for prop in props for argument in ("-p", prop)]


def find(command):
    """The path of a command that exists, or None."""
    if command and Path(command).exists():
        return str(Path(command).resolve())
    return shutil.which(command) if command else None


def add_engine_options(parser):
    """Where the engines are, as `dynabs-check crosscheck` takes it."""
    parser.add_argument("--prism", metavar="PATH", help="default: $PRISM, or prism in PATH")
    parser.add_argument("--python", metavar="PATH", help="a Python with stormpy; default: $DYNABS_PYTHON, $VIRTUAL_ENV, python3")
    parser.add_argument("--with", dest="engines", choices=["prism", "storm", "all"], default="all")


def engine_options(arguments):
    """The same options for `dynabs-check crosscheck`."""
    options = ["--with", arguments.engines]
    options += ["--prism", arguments.prism] if arguments.prism else []
    return options + (["--python", arguments.python] if arguments.python else [])
