"""Runs dynabs on one model after another."""

import json
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
MODES = {
    "reference": {"mode": "reference", "beta_per_interval": 0.01},
    "pac": {"mode": "pac", "confidence": 0.99},
}


class Dynabs:
    def __init__(self, binaries, keep):
        self.binaries = Path(binaries)
        self.keep = keep

    def run(self, tool, *arguments, accepted=(0,)):
        command = [str(self.binaries / tool), *map(str, arguments)]
        result = subprocess.run(command, capture_output=True, text=True)
        if result.returncode not in accepted:
            sys.exit(f"{' '.join(command)}\nended with {result.returncode}\n{result.stderr}")
        return result.stdout

    def compile(self, model, mode, directory, sets=()):
        """Compiles a model with its PRISM files in reference mode; returns what there is to say about it."""
        settings = [f"/probabilities={json.dumps(MODES[mode])}", *sets]
        arguments = [ROOT / "models" / f"{model}.json", "-o", directory, "--force", "--quiet"]
        for setting in settings:
            arguments += ["--set", setting]
        arguments += ["--no-tra"] if mode == "pac" else ["--format", "prism"]
        start = time.monotonic()
        self.run("dynabs-compile", *arguments)
        seconds = time.monotonic() - start
        manifest = json.loads((directory / "manifest.json").read_text())
        # A threshold that is not met is exit code 1.
        solved = json.loads(self.run("dynabs-check", "solve", directory, "--json", "--quiet", accepted=(0, 1)))
        values = directory.with_suffix(".values")
        self.run("dynabs-check", "solve", directory, "--quiet", "-p", question(manifest), "--values", values)
        run = Run(manifest, solved["results"][0], [float(line) for line in values.read_text().split()], seconds)
        values.unlink()
        return run

    def clean(self, directory):
        """Deletes a compiled model, unless it is to be kept."""
        if not self.keep:
            shutil.rmtree(directory)


def question(manifest):
    """The value that a task asks for, without its threshold."""
    task = manifest["property"]
    return task[1 : task.rindex(")>=")] if task.startswith("(") else task


class Run:
    def __init__(self, manifest, result, values, seconds):
        self.size = [manifest[name] for name in ("states", "choices", "transitions")]
        self.lower, self.upper = result["lower"], result["upper"]
        self.seconds = seconds
        self.bytes = sum(file["bytes"] for file in manifest["outputs"])
        self.values = values
        self.mode = manifest["mode"]
