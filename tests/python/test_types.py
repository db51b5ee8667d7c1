"""The types that the package states: consistent, and those that programs meet."""

import pathlib

import pytest

import dynabs

PROGRAM = """
import numpy as np
import dynabs

problem = dynabs.Problem({"name": "room"})
abstraction = problem.compile()
text: str = abstraction.property
solution = abstraction.solve()
solution.controller(np.zeros((5, 1)), np.arange(5), np.zeros(5, dtype=np.uint32))
solution.controller([0.0], 3, 2)
solution.save("out")
bound: float = dynabs.open("out").bound
warnings: list[str] = abstraction.model.warnings
wrong: int = problem.name
"""


def test_types_are_consistent(tmp_path):
    mypy = pytest.importorskip("mypy.api")
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    # A copy: what is installed is no source to mypy.
    stubs = tmp_path / "_dynabs.pyi"
    stubs.write_text((pathlib.Path(dynabs.__file__).parent / "_dynabs.pyi").read_text())
    cache = ["--cache-dir", str(tmp_path / "cache")]
    said, _, code = mypy.run([*cache, "--strict", str(stubs)])
    assert code == 0, said
    said, _, code = mypy.run([*cache, "--ignore-missing-imports", str(program)])
    # What is wrong is found, and nothing else.
    line = len(PROGRAM.splitlines())
    assert code == 1 and said.count("error:") == 1 and f"program.py:{line}: error:" in said, said
