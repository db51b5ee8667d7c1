"""Asks Storm what questions.json says; written and started by `dynabs-check crosscheck --with storm`.

For question N: N.values, one little-endian double per state; N.strategy, lines state=choice, if it was wanted and
there is one; last of all N.json, {"seconds", "error"}, by which the others are known to be complete.
"""

import array
import json
import os
import sys
import time

import stormpy


def write(name, data):
    with open(name + ".part", "wb") as out:
        out.write(data)
    os.replace(name + ".part", name)


def read(path):
    if path.endswith(".drn"):
        return stormpy.build_model_from_drn[stormpy.Interval](path)
    return stormpy.build_model_from_umb(path)


def answer(model, environment, number, question):
    mode = stormpy.UncertaintyResolutionMode
    result = stormpy.model_checking(
        model,
        stormpy.parse_properties(question["formula"])[0],
        uncertainty_resolution_mode=mode.MINIMIZE if question["nature"] == "min" else mode.MAXIMIZE,
        environment=environment,
        extract_scheduler=question["strategy"],
    )
    values = array.array("d", (result.get_value(state) for state in range(model.nr_states)))
    if sys.byteorder == "big":
        values.byteswap()
    write(f"{number}.values", values.tobytes())
    if question["strategy"] and result.has_scheduler():
        scheduler = result.get_scheduler()
        choices = (scheduler.get_choice(state) for state in range(model.nr_states))
        lines = (
            f"{state}={choice.get_deterministic_choice()}\n" for state, choice in enumerate(choices) if choice.defined
        )
        write(f"{number}.strategy", "".join(lines).encode())


def main():
    start = time.monotonic()
    with open(sys.argv[1]) as file:
        request = json.load(file)
    model = read(request["model"])
    environment = stormpy.environments.default(model)
    solver = environment.solver().min_max()
    solver.precision = stormpy.Rational(request["precision"])
    solver.relative_termination_criterion = False
    # The time limit is the caller's.
    solver.maximal_number_of_iterations = 2**62
    for number, question in enumerate(request["questions"]):
        error = None
        try:
            answer(model, environment, number, question)
        except RuntimeError as refused:
            error = str(refused)
        report = {"seconds": time.monotonic() - start, "error": error}
        write(f"{number}.json", json.dumps(report).encode())
        # Reading the model counts once.
        start = time.monotonic()


main()
