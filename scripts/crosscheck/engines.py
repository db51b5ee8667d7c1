"""The solvers, each giving the values of all states."""

import json
import re
import subprocess
from pathlib import Path


class Failure(Exception):
    """A solver did not answer."""


class NotConverged(Failure):
    """A solver gave up."""


class Dynabs:
    """`dynabs-check solve`."""

    name = "dynabs"

    def __init__(self, command):
        self.command = command

    def start(self, arguments):
        done = subprocess.run([self.command, "solve", *arguments], capture_output=True, text=True)
        try:
            return json.loads(done.stdout)["results"]
        except (ValueError, KeyError):
            raise Failure(f"{' '.join(map(str, arguments))}: {done.stderr.strip()}") from None

    def values(self, stem, prop, epsilon):
        """The lower bounds of all states."""
        out = stem.with_suffix(".dynabs-values")
        tra = stem.with_suffix(".tra")
        [result] = self.start([tra, "-p", prop, "--json", "--quiet", "--values", out, "--epsilon", str(epsilon)])
        if result["status"] not in ("converged", "horizon reached"):
            raise Failure(f"{prop}: {result['status']}")
        return [float(line) for line in out.read_text().split()]

    def results(self, stem, props, epsilon):
        """What --json says about each property."""
        named = [argument for prop in props for argument in ("-p", prop)]
        return self.start([stem.with_suffix(".tra"), *named, "--json", "--quiet", "--epsilon", str(epsilon)])


class Prism:
    """PRISM's explicit engine."""

    name = "PRISM"

    def __init__(self, command):
        self.command = command

    def start(self, stem, arguments, epsilon, iterations):
        # It stops when no value changes by more than epsilon (relatively): no bound on the error.
        options = ["-ex", "-epsilon", str(epsilon), "-maxiters", str(iterations), "-javamaxmem", "4g"]
        files = f"{stem.with_suffix('.tra')},sta,lab"
        command = [self.command, "-importmodel", files, *options, *arguments]
        done = subprocess.run(command, capture_output=True, text=True)
        return done.stdout + done.stderr

    def values(self, stem, prop):
        out = stem.with_suffix(".prism-values")
        out.unlink(missing_ok=True)
        log = self.start(stem, ["-pf", prop, "-exportvector", str(out)], 1e-12, 200_000)
        if not out.exists():
            if "did not converge" in log:
                raise NotConverged("PRISM did not converge within 200000 iterations")
            raise Failure(f"{prop}: {error_in(log)}")
        return [float(line) for line in out.read_text().split()]

    def results(self, stem, props):
        """(least, greatest) of the initial states, a truth value or a Failure for each property."""
        path = stem.with_suffix(".props")
        path.write_text("\n".join(f"{prop};" for prop in props) + "\n")
        # A property's output starts with its text.
        sections = re.split(r"^Model checking: .*$", self.start(stem, [str(path)], 1e-13, 1_000_000_000), flags=re.MULTILINE)
        if len(sections) != len(props) + 1:
            raise Failure(error_in(sections[-1]))
        return [result_in(section) for section in sections[1:]]


def error_in(log):
    errors = [line for line in log.splitlines() if line.startswith("Error")]
    return errors[0] if errors else log[-300:]


def result_in(section):
    found = re.search(r"^Result: (\S+)", section, flags=re.MULTILINE)
    if not found:
        return Failure(error_in(section))
    text = found[1]
    if text in ("true", "false"):
        return text == "true"
    ends = [float(end) for end in text.strip("[]").split(",")]
    return min(ends), max(ends)


class Storm:
    """Storm by its Python bindings (version 2), from its DRN format."""

    name = "Storm"

    def __init__(self, precision):
        import stormpy

        # For interval models it always warns that it takes robust value iteration.
        stormpy.developer.set_log_level(stormpy.developer.LogLevel.ERR)
        self.stormpy = stormpy
        self.precision = precision
        # Bounded G is not part of its language; its unbounded G takes the wrong side of nature.
        self.unsupported = re.compile(r"\bG\b")

    def supports(self, path, has_zeros):
        """Whether it can answer; with lower bounds of 0 it has bounded and next only."""
        return not self.unsupported.search(path) and not (has_zeros and is_unbounded(path))

    def load(self, drn):
        model = self.stormpy.build_model_from_drn[self.stormpy.Interval](str(drn))
        environment = self.stormpy.environments.default(model)
        settings = environment.solver().min_max()
        settings.precision = self.stormpy.Rational(str(self.precision))
        settings.relative_termination_criterion = False
        settings.maximal_number_of_iterations = 1_000_000_000
        return model, environment

    def values(self, loaded, path, operator):
        model, environment = loaded
        modes = self.stormpy.UncertaintyResolutionMode
        policy, nature = operator[:3], operator[3:]
        try:
            prop = self.stormpy.parse_properties(f"P{policy}=? [ {path} ]")[0]
            result = self.stormpy.model_checking(
                model,
                prop,
                uncertainty_resolution_mode=modes.MINIMIZE if nature == "min" else modes.MAXIMIZE,
                environment=environment,
            )
            return [result.get_value(state) for state in range(model.nr_states)]
        except RuntimeError as error:
            raise Failure(f"P{operator} {path}: {error}") from None


def is_unbounded(path):
    return not re.search(r"\bX\b|[FGU]<", path)


def find(command):
    """The path of a command that exists, or None."""
    if command and (Path(command).exists()):
        return str(Path(command).resolve())
    from shutil import which

    return which(command) if command else None
