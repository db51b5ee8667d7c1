#!/usr/bin/env python3
"""Compares rewards, LTL and nested probabilities on random interval models with PRISM and with exact fractions.

    crosscheck-expressions.py [--seed N] [--models N] [--prism PATH] [--dynabs PATH]

Every model is small, and its intervals have lower bounds above 0 or, for the fractions only, of 0. It is asked ten
properties of each kind: R (reach, cumulative, instantaneous, co-safe), LTL, and P nested in P. PRISM's values (-epsilon
1e-10) must be within the bounds or 1e-6 of them. Exact values are those of all memoryless policies and of all corners of
nature, by linear equations in fractions: of R [F ...], R [C<=k], R [I=k] and of P nested in P; they must be within the
bounds, without any allowance. Ends with 1 if a value differs, and with 77 if PRISM is missing and all else agrees.
Needs nothing but Python's standard library.
"""

import argparse
import itertools
import json
import math
import random
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

from crosscheck.dynabs import find

KINDS = ("maxmin", "maxmax", "minmin", "minmax")
TOLERANCE = 1e-6


class Model:
    """States with choices; a choice is a list of (successor, lower, upper) in fractions, and what it earns."""

    def __init__(self, numbers, zeros):
        self.states = numbers.randint(3, 5)
        self.choices, self.rewards = [], []
        for state in range(self.states):
            rows = []
            for _ in range(numbers.randint(1, 2)):
                size = numbers.randint(1, min(3, self.states))
                successors = sorted(numbers.sample(range(self.states), size))
                weights = [numbers.randint(1, 5) for _ in successors]
                row = []
                for successor, weight in zip(successors, weights):
                    middle = Fraction(weight, sum(weights))
                    lower = max(middle - Fraction(numbers.randint(0, 3), 10), Fraction(0))
                    if lower == 0 or zeros and numbers.random() < 0.4:
                        lower = Fraction(0) if zeros else Fraction(1, 100)
                    lower = Fraction(math.floor(lower * 100), 100)
                    upper = min(middle + Fraction(numbers.randint(0, 3), 10), Fraction(1))
                    row.append((successor, lower if zeros else max(lower, Fraction(1, 100)), Fraction(math.ceil(upper * 100), 100)))
                if size == 1:
                    row = [(successors[0], Fraction(1), Fraction(1))]
                if sum(entry[1] for entry in row) > 1 or sum(entry[2] for entry in row) < 1:
                    row = [(successors[0], Fraction(1), Fraction(1))]
                rows.append(row)
            self.choices.append(rows)
            self.rewards.append(Fraction(numbers.randint(0, 8), 4))
        self.labels = {name: {s for s in range(self.states) if numbers.random() < 0.4} for name in "abg"}

    def write(self, stem):
        """Writes the model as PRISM's files."""
        choices = sum(map(len, self.choices))
        entries = [
            f"{s} {c} {t} [{float(low)!r},{float(high)!r}] a{c}\n"
            for s, rows in enumerate(self.choices)
            for c, row in enumerate(rows)
            for t, low, high in row
        ]
        Path(f"{stem}.tra").write_text(f"{self.states} {choices} {len(entries)}\n" + "".join(entries))
        Path(f"{stem}.sta").write_text("(s)\n" + "".join(f"{s}:({s})\n" for s in range(self.states)))
        names = ["init", "deadlock", *self.labels]
        sets = [set(range(1)), set(), *self.labels.values()]
        lines = [" ".join(f'{i}="{name}"' for i, name in enumerate(names))]
        for s in range(self.states):
            own = [str(i) for i, members in enumerate(sets) if s in members]
            lines += [f"{s}: {' '.join(own)}"] if own else []
        Path(f"{stem}.lab").write_text("\n".join(lines) + "\n")
        earning = [f"{s} {float(r)!r}\n" for s, r in enumerate(self.rewards) if r]
        Path(f"{stem}.srew").write_text(
            f'# Reward structure "r"\n# State rewards\n{self.states} {len(earning)}\n' + "".join(earning)
        )


def corners(row):
    """The corners of a row: all but one successor at a bound."""
    found = []
    for free in range(len(row)):
        others = [entry for i, entry in enumerate(row) if i != free]
        for ends in itertools.product((1, 2), repeat=len(others)):
            mass = {entry[0]: entry[end] for entry, end in zip(others, ends)}
            rest = 1 - sum(mass.values(), Fraction(0))
            if row[free][1] <= rest <= row[free][2]:
                mass[row[free][0]] = rest
                if mass not in found:
                    found.append(mass)
    return found


def solve(matrix, right):
    """The solution of a regular system in fractions."""
    size = len(right)
    rows = [[*line, value] for line, value in zip(matrix, right)]
    for i in range(size):
        pivot = next(j for j in range(i, size) if rows[j][i] != 0)
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [x / rows[i][i] for x in rows[i]]
        for j in range(size):
            if j != i and rows[j][i] != 0:
                factor = rows[j][i]
                rows[j] = [x - factor * y for x, y in zip(rows[j], rows[i])]
    return [row[-1] for row in rows]


def chain_value(chain, safe, goal, rewards):
    """P(safe U goal) of a Markov chain, or, with rewards, what is earned before the goal (None: infinite)."""
    states = range(len(chain))
    can = set(goal)
    while True:
        more = {s for s in states if s not in can and s in safe and any(p > 0 and t in can for t, p in chain[s].items())}
        if not more:
            break
        can |= more
    inside = [s for s in sorted(can) if s not in goal]
    index = {s: i for i, s in enumerate(inside)}
    infinite = set(states) - can
    if rewards is not None:
        while True:
            more = {s for s in inside if s not in infinite and any(p > 0 and t in infinite for t, p in chain[s].items())}
            if not more:
                break
            infinite |= more
        inside = [s for s in inside if s not in infinite]
        index = {s: i for i, s in enumerate(inside)}
    matrix = [[Fraction(int(i == j)) for j in range(len(inside))] for i in range(len(inside))]
    right = [Fraction(0) if rewards is None else rewards[s] for s in inside]
    for s in inside:
        for t, p in chain[s].items():
            if t in index:
                matrix[index[s]][index[t]] -= p
            elif t in goal and rewards is None:
                right[index[s]] += p
    values = solve(matrix, right)
    start = Fraction(0)
    result = [start] * len(chain)
    for s in states:
        if s in goal:
            result[s] = Fraction(0) if rewards is not None else Fraction(1)
        elif s in index:
            result[s] = values[index[s]]
        elif rewards is not None:
            result[s] = math.inf
    return result


def optimum(model, kind, safe, goal, rewards=None):
    """The exact value of every state, over all memoryless policies and all corners of nature."""
    outer, inner = (max if kind[:3] == "max" else min), (max if kind[3:] == "max" else min)
    all_corners = [[corners(row) for row in rows] for rows in model.choices]
    moving = [s for s in range(model.states) if s not in goal and s in safe]
    best = None
    for policy in itertools.product(*(range(len(model.choices[s])) for s in moving)):
        worst = None
        for nature in itertools.product(*(all_corners[s][c] for s, c in zip(moving, policy))):
            chain = [{s: Fraction(1)} for s in range(model.states)]
            for s, mass in zip(moving, nature):
                chain[s] = mass
            values = chain_value(chain, safe, goal, rewards)
            worst = values if worst is None else [inner(a, b) for a, b in zip(worst, values)]
        best = worst if best is None else [outer(a, b) for a, b in zip(best, worst)]
    return best


def size(model, safe, goal):
    """How many chains `optimum` looks at."""
    count = 1
    for s in range(model.states):
        if s not in goal and s in safe:
            count *= sum(len(corners(row)) for row in model.choices[s])
    return count


def steps(model, kind, horizon, values, rewards):
    """`horizon` steps of the Bellman operator, exactly."""
    outer, inner = (max if kind[:3] == "max" else min), (max if kind[3:] == "max" else min)
    for _ in range(horizon):
        values = [
            rewards[s]
            + outer(inner(sum((p * values[t] for t, p in mass.items()), Fraction(0)) for mass in corners(row)) for row in rows)
            for s, rows in enumerate(model.choices)
        ]
    return values


def reward_question(model, numbers, kind):
    """An R property and its exact value in state 0; None if it is not computed."""
    everything, zero = set(range(model.states)), [Fraction(0)] * model.states
    label, horizon = numbers.choice("abg"), numbers.randint(0, 6)
    match numbers.randint(0, 5):
        case 0:
            return f"R{kind}=? [ C<={horizon} ]", steps(model, kind, horizon, zero, model.rewards)[0]
        case 1:
            return f"R{kind}=? [ I={horizon} ]", steps(model, kind, horizon, model.rewards, zero)[0]
        case 2:
            other = numbers.choice("abg")
            path = numbers.choice([f'X (F "{label}")', f'F ("{label}" & (X (F "{other}")))', f'(F "{label}") & (F "{other}")'])
            return f"R{kind}=? [ {path} ]", None
        case _:
            goal = model.labels[label]
            value = optimum(model, kind, everything, goal, model.rewards)[0] if size(model, everything, goal) <= 3000 else None
            return f'R{kind}=? [ F "{label}" ]', value


def ltl_question(_, numbers, kind):
    """An LTL property."""
    a, b, g = numbers.choice("abg"), numbers.choice("abg"), numbers.choice("abg")
    path = numbers.choice(
        [
            f'G (F "{a}")',
            f'F (G "{a}")',
            f'(G (F "{a}")) & (G (F "{b}"))',
            f'(F (G "{a}")) | (G (F "{b}"))',
            f'(G (F "{a}")) => (G (F "{b}"))',
            f'F ("{a}" & (X (F "{b}")))',
            f'(F "{a}") & (G !"{b}")',
            f'"{a}" U ("{b}" U "{g}")',
            f'G ("{a}" => (F "{b}"))',
            f'X (X ("{a}" | (X "{b}")))',
            f'(F (G "{a}")) & (G (F (X "{b}")))',
            f'G ("{a}" | (X "{b}"))',
        ]
    )
    return f"P{kind}=? [ {path} ]", None


def nested_question(model, numbers, kind):
    """A probability of reaching or keeping the states of another one, and its exact value in state 0."""
    inner_kind = "minmin" if numbers.random() < 0.5 else "maxmax"
    relation = ">" if inner_kind == "minmin" else "<"
    threshold = Fraction(numbers.randint(1, 9), 10) + Fraction(1, 97)
    a, b, everything = numbers.choice("abg"), numbers.choice("abg"), set(range(model.states))
    inside = f'P{relation}{float(threshold)!r} [ "{a}" U "{b}" ]'
    goal, safe = model.labels[b], model.labels[a]
    inner = None
    if size(model, safe | goal, goal) <= 3000:
        values = optimum(model, inner_kind, safe | goal, goal)
        inner = {s for s in everything if (values[s] > threshold if relation == ">" else values[s] < threshold)}
    if numbers.random() < 0.5:
        value = optimum(model, kind, everything, inner)[0] if inner is not None and size(model, everything, inner) <= 3000 else None
        return f"P{kind}=? [ F ({inside}) ]", value
    outside = everything - inner if inner is not None else set()
    flipped = kind.translate(str.maketrans("", "")).replace("max", "?").replace("min", "max").replace("?", "min")
    value = None
    if inner is not None and size(model, everything, outside) <= 3000:
        value = 1 - optimum(model, flipped, everything, outside)[0]
    return f"P{kind}=? [ G ({inside}) ]", value


def ours(dynabs, stem, questions):
    """The bounds of dynabs."""
    Path(f"{stem}.props").write_text("".join(f"{question};\n" for question in questions))
    output = subprocess.run(
        [dynabs, "solve", f"{stem}.tra", f"{stem}.props", "--json", "-q", "--epsilon", "1e-8"],
        capture_output=True, text=True, check=False,
    )
    try:
        results = json.loads(output.stdout)["results"]
    except ValueError:
        sys.exit(f"{stem}: {output.stderr}")
    number = lambda value: math.nan if value is None else float(str(value).replace("Infinity", "inf"))
    return [(number(result["lower"]), number(result["upper"])) for result in results]


def prisms(prism, stem):
    """The values of PRISM; None where it has none."""
    output = subprocess.run(
        [prism, "-importmodel", f"{stem}.tra,sta,lab,srew", f"{stem}.props", "-ex", "-epsilon", "1e-10", "-maxiters", "1000000"],
        capture_output=True, text=True, check=False,
    ).stdout
    values = []
    for part in output.split("Model checking: ")[1:]:
        words = [line.split()[1] for line in part.splitlines() if line.startswith("Result: ")]
        try:
            values.append(float(words[0].replace("Infinity", "inf")))
        except (IndexError, ValueError):
            values.append(None)
    return values


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=14001)
    parser.add_argument("--models", type=int, default=100)
    parser.add_argument("--prism", default=find("prism"))
    parser.add_argument("--dynabs", default="dynabs-check")
    arguments = parser.parse_args()
    numbers = random.Random(arguments.seed)
    compared = {(kind, engine): 0 for kind in ("R", "LTL", "nested") for engine in ("PRISM", "exact")}
    differences = 0
    with tempfile.TemporaryDirectory() as scratch:
        for index in range(arguments.models):
            zeros = index % 2 == 1
            model, stem = Model(numbers, zeros), f"{scratch}/m"
            model.write(stem)
            asked = []
            for name, make in (("R", reward_question), ("LTL", ltl_question), ("nested", nested_question)):
                asked += [(name, *make(model, numbers, numbers.choice(KINDS))) for _ in range(20)]
            bounds = ours(arguments.dynabs, stem, [question for _, question, _ in asked])
            others = [None] * len(asked)
            if arguments.prism and not zeros:
                others = prisms(arguments.prism, stem) or others
            for (name, question, exact), (lower, upper), other in zip(asked, bounds, others):
                wrong = []
                if exact is not None:
                    compared[name, "exact"] += 1
                    # Comparisons of floats with fractions are exact.
                    if not lower <= exact <= upper:
                        wrong.append(f"exactly {exact}")
                if other is not None:
                    compared[name, "PRISM"] += 1
                    slack = TOLERANCE * max(1.0, abs(other)) if math.isfinite(other) else 0.0
                    if not lower - slack <= other <= upper + slack:
                        wrong.append(f"PRISM {other}")
                if wrong:
                    differences += 1
                    print(f"model {index}: {question}: [{lower}, {upper}], {', '.join(wrong)}")
                    Path(f"difference-{differences}.tra").write_text(Path(f"{stem}.tra").read_text())
    for (name, engine), count in compared.items():
        print(f"{name:7} {engine:6} {count} compared")
    print(f"{differences} differences")
    if differences:
        sys.exit(1)
    sys.exit(0 if arguments.prism else 77)


if __name__ == "__main__":
    main()
