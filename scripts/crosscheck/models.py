"""Interval models as lists, and the files that solvers read."""

import json
import random
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path

OPERATORS = ("maxmin", "maxmax", "minmin", "minmax")


@dataclass
class Model:
    """states[s] lists choices, a choice lists (successor, lower, upper) with the bounds as text."""

    name: str
    states: list
    labels: dict
    variables: dict = field(default_factory=dict)
    chain: bool = False

    def write_prism(self, stem):
        """Writes stem.tra, stem.sta and stem.lab."""
        lines, choices, transitions = [], 0, 0
        for source, rows in enumerate(self.states):
            for choice, row in enumerate(rows):
                choices += 1
                transitions += len(row)
                head = f"{source}" if self.chain else f"{source} {choice}"
                for target, lower, upper in row:
                    lines.append(f"{head} {target} [{lower},{upper}]\n")
        counts = [len(self.states), transitions] if self.chain else [len(self.states), choices, transitions]
        stem.with_suffix(".tra").write_text(" ".join(map(str, counts)) + "\n" + "".join(lines))

        columns = self.variables or {"s": range(len(self.states))}
        text = lambda value: str(value).lower() if isinstance(value, bool) else str(value)
        rows = (f"{i}:({','.join(map(text, values))})\n" for i, values in enumerate(zip(*columns.values())))
        stem.with_suffix(".sta").write_text(f"({','.join(columns)})\n" + "".join(rows))

        names = ["init", "deadlock"] + [name for name in self.labels if name != "init"]
        held = {}
        for i, name in enumerate(names):
            for state in self.labels.get(name, []):
                held.setdefault(state, []).append(str(i))
        header = " ".join(f'{i}="{name}"' for i, name in enumerate(names))
        body = "".join(f"{state}: {' '.join(held[state])}\n" for state in sorted(held))
        stem.with_suffix(".lab").write_text(f"{header}\n{body}")


@dataclass
class Question:
    """A path formula with the exact values of all states for one operator."""

    path: str
    operator: str
    values: list


def load_cases(directory):
    """Yields (model, questions, verdicts) of every case in a directory."""
    for path in sorted(Path(directory).glob("*.json")):
        for case in json.loads(path.read_text()):
            states = [[[entry_of(text) for text in row.split(" + ")] for row in rows] for rows in case["states"]]
            chain = case.get("kind") == "idtmc"
            model = Model(case["name"], states, case["labels"], case.get("variables", {}), chain)
            questions = [
                Question(values["path"], operator, [Fraction(value) for value in exact.split()])
                for values in case["values"]
                for operator, exact in values.items()
                if operator != "path"
            ]
            yield model, questions, case.get("verdicts", [])


def entry_of(text):
    successor, bounds = text.split(" ", 1)
    lower, _, upper = bounds.strip("[]").partition(",")
    return int(successor), lower, upper or lower


def thousandths(x):
    return f"{x / 1000:.3f}".rstrip("0").rstrip(".")


def random_row(rng, states, own, zeros):
    if rng.random() < 0.12:
        # A sure move: end components, and choices that hand over to each other.
        return [(rng.randrange(states), "1", "1")]
    successors = rng.sample(range(states), rng.randint(2, min(4, states)))
    if rng.random() < 0.06:
        # Slowish: nearly everything stays.
        if own not in successors:
            successors[0] = own
        leave = [0 if s == own else rng.randint(3, 9) for s in successors]
        return sorted(
            (s, *map(thousandths, (900, 1000 - sum(leave)) if s == own else (share, share * rng.randint(2, 4))))
            for s, share in zip(successors, leave)
        )
    # Shares of at least 0.1, of which 0.06 are certain: an adversary could make smaller ones too slow to wait for.
    cuts = sorted(rng.sample(range(1, 10), len(successors) - 1))
    shares = [100 * (b - a) for a, b in zip([0, *cuts], [*cuts, 10])]
    spread = 0 if rng.random() < 0.15 else rng.choice((40, 100, 300))
    row = []
    for successor, share in zip(successors, shares):
        lower = max(share - spread, 0 if zeros and rng.random() < 0.5 else 60)
        row.append((successor, thousandths(lower), thousandths(min(1000, share + spread))))
    return sorted(row)


def random_model(seed, zeros):
    """A small model with goal and bad states, deadlocks, ties and end components; zeros: lower bounds of 0."""
    rng = random.Random(f"{seed} {zeros}")
    size = rng.randint(2, 9)
    states = []
    for state in range(size):
        if rng.random() < 0.1:
            states.append([])
        elif rng.random() < 0.1:
            states.append([[(state, "1", "1")]])
        elif states and states[-1] and rng.random() < 0.1:
            # A tie: the choices of the state before.
            states.append(states[-1])
        else:
            states.append([random_row(rng, size, state, zeros) for _ in range(rng.randint(1, 3))])
    goal = [size - 1] + [s for s in range(size - 1) if rng.random() < 0.08]
    bad = [s for s in range(size) if rng.random() < 0.1]
    return Model(f"random {seed}", states, {"init": [0], "goal": goal, "bad": bad})


def union(models):
    """The disjoint union: many models in one start of a solver."""
    states, labels, first = [], {"init": [], "goal": [], "bad": []}, 0
    for model in models:
        states += [[[(to + first, *bounds) for to, *bounds in row] for row in rows] for rows in model.states]
        for name, members in model.labels.items():
            labels[name] += [state + first for state in members]
        first += len(model.states)
    return Model(f"union of {len(models)}", states, labels)
