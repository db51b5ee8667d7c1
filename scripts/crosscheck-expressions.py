#!/usr/bin/env python3
"""Compares rewards, LTL and nested probabilities on random interval models with PRISM and with exact fractions.

    crosscheck-expressions.py [--seed N] [--wanted N] [--prism PATH] [--dynabs PATH]

Models are small, with lower bounds and rewards above 0 or, for the fractions only, of 0; many stand side by side in one file, so that one
start of a solver answers a question for all of them: R (reach, cumulative, instantaneous, co-safe), LTL, and P nested in P.
`dynabs-check crosscheck` compares the bounds of all states with PRISM. Exact values are those of all memoryless policies
and of all corners of nature, for LTL on the product with a deterministic automaton made by hand; they must be within the
bounds, without any allowance. Goes on until every kind has been compared in so many models with both. Ends with 1 if a value
differs, and with 77 if PRISM is missing and all else agrees. Needs nothing but Python's standard library.
"""

import argparse
import math
import os
import random
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

from crosscheck.dynabs import Dynabs, find
from crosscheck.exact import earned_before, flipped, optimum, parity_value, size, steps
from crosscheck.formulas import cosafe_formulas, formulas

KINDS = ("maxmin", "maxmax", "minmin", "minmax")
# How many models stand side by side, how many questions of a kind they are asked, and how many chains a value may take.
SIDE_BY_SIDE, QUESTIONS, MOST_CHAINS = 25, 8, 1000


class Model:
    """States with choices; a choice is a list of (successor, lower, upper) in fractions; what a state earns, and its labels."""

    def __init__(self, numbers, zeros):
        self.states = numbers.randint(3, 5)
        self.choices, self.rewards = [], []
        for _ in range(self.states):
            self.choices.append([random_row(numbers, self.states, zeros) for _ in range(numbers.randint(1, 2))])
            # Where nothing is earned in a cycle, PRISM's iteration from below can stay too low.
            self.rewards.append(Fraction(numbers.randint(0 if zeros else 1, 8), 4))
        self.labels = {name: {s for s in range(self.states) if numbers.random() < 0.4} for name in "abg"}

    def letters(self):
        """The labels of every state."""
        return [frozenset(name for name, members in self.labels.items() if s in members) for s in range(self.states)]


def random_row(numbers, states, zeros):
    successors = sorted(numbers.sample(range(states), numbers.randint(1, min(3, states))))
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
    one = len(row) == 1 or sum(entry[1] for entry in row) > 1 or sum(entry[2] for entry in row) < 1
    return [(successors[0], Fraction(1), Fraction(1))] if one else row


def write(models, stem):
    """Writes models side by side as PRISM's files; the first state of each is initial."""
    first, entries, earning, marks, choices = 0, [], [], [], 0
    names = ["init", "deadlock", "a", "b", "g"]
    for model in models:
        for s, rows in enumerate(model.choices):
            choices += len(rows)
            for c, row in enumerate(rows):
                entries += [f"{first + s} {c} {first + t} [{float(low)!r},{float(high)!r}] a{c}\n" for t, low, high in row]
            earning.append(f"{first + s} {float(model.rewards[s])!r}\n")
            own = ["0"] if s == 0 else []
            own += [str(names.index(name)) for name in "abg" if s in model.labels[name]]
            marks += [f"{first + s}: {' '.join(own)}\n"] if own else []
        first += model.states
    Path(f"{stem}.tra").write_text(f"{first} {choices} {len(entries)}\n" + "".join(entries))
    Path(f"{stem}.sta").write_text("(s)\n" + "".join(f"{s}:({s})\n" for s in range(first)))
    header = " ".join(f'{i}="{name}"' for i, name in enumerate(names)) + "\n"
    Path(f"{stem}.lab").write_text(header + "".join(marks))
    Path(f"{stem}.srew").write_text(
        f'# Reward structure "r"\n# State rewards\n{first} {len(earning)}\n' + "".join(earning)
    )


def reach(model, kind, safe, goal, rewards=None):
    """The exact values of all states; None if they would take too long."""
    moving = [s for s in range(model.states) if s in safe and s not in goal]
    return optimum(model.choices, kind, safe, goal, rewards) if size(model.choices, moving) <= MOST_CHAINS else None


def reward_question(numbers, kind):
    """An R property and how to compute its exact value in state 0 of a model."""
    label, horizon = numbers.choice("abg"), numbers.randint(0, 6)
    zero = lambda model: [Fraction(0)] * model.states
    match numbers.randint(0, 4):
        case 0:
            return f"R{kind}=? [ C<={horizon} ]", lambda m: steps(m.choices, kind, horizon, zero(m), m.rewards)[0]
        case 1:
            return f"R{kind}=? [ I={horizon} ]", lambda m: steps(m.choices, kind, horizon, m.rewards, zero(m))[0]
        case 2:
            path, automaton = numbers.choice(cosafe_formulas(label, numbers.choice("abg")))
            known = lambda m: earned_before(m.choices, kind, m.letters(), m.rewards, automaton, MOST_CHAINS)
            return f"R{kind}=? [ {path} ]", known
        case _:

            def value(model):
                values = reach(model, kind, set(range(model.states)), model.labels[label], model.rewards)
                return values and values[0]

            return f'R{kind}=? [ F "{label}" ]', value


def ltl_question(numbers, kind):
    """An LTL property and how to compute its exact value."""
    path, automaton = numbers.choice(formulas(*(numbers.choice("abg") for _ in range(3))))
    return f"P{kind}=? [ {path} ]", lambda model: parity_value(model.choices, kind, model.letters(), automaton)


def nested_question(numbers, kind):
    """The probability of reaching or keeping the states of another one, and how to compute its exact value."""
    inner_kind = numbers.choice(["minmin", "maxmax"])
    relation = ">" if inner_kind == "minmin" else "<"
    threshold = Fraction(numbers.randint(1, 9), 10) + Fraction(1, 97)
    a, b, always = numbers.choice("abg"), numbers.choice("abg"), numbers.random() < 0.5

    def value(model):
        everything, goal = set(range(model.states)), model.labels[b]
        values = reach(model, inner_kind, model.labels[a] | goal, goal)
        if values is None:
            return None
        inner = {s for s in everything if (values[s] > threshold if relation == ">" else values[s] < threshold)}
        values = reach(model, flipped(kind), everything, everything - inner) if always else reach(model, kind, everything, inner)
        return None if values is None else 1 - values[0] if always else values[0]

    inside = f'P{relation}{float(threshold)!r} [ "{a}" U "{b}" ]'
    return f"P{kind}=? [ {'G' if always else 'F'} ({inside}) ]", value


QUESTION = {"R": reward_question, "LTL": ltl_question, "nested": nested_question}


def number(value):
    return math.nan if value is None else float(str(value).replace("Infinity", "inf"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=14001)
    parser.add_argument("--wanted", type=int, default=1000)
    parser.add_argument("--prism", default=os.environ.get("PRISM", "prism"))
    parser.add_argument("--dynabs", default="dynabs-check")
    arguments = parser.parse_args()
    numbers = random.Random(arguments.seed)
    prism = find(arguments.prism)
    dynabs = Dynabs(arguments.dynabs, ["--with", "prism", "--prism", prism])
    engines = ("PRISM", "exact") if prism else ("exact",)
    compared = {(kind, engine): 0 for kind in QUESTION for engine in engines}
    batch = differences = 0
    with tempfile.TemporaryDirectory() as scratch:
        stem = f"{scratch}/m"
        while min(compared.values()) < arguments.wanted:
            zeros, batch = batch % 2 == 1, batch + 1
            models = [Model(numbers, zeros) for _ in range(SIDE_BY_SIDE)]
            write(models, stem)
            asked = [(name, *make(numbers, numbers.choice(KINDS))) for name, make in QUESTION.items() for _ in range(QUESTIONS)]
            questions = [question for _, question, _ in asked]
            tra = f"{stem}.tra"
            bounds = [result["initial"] for result in dynabs.results(tra, questions, 1e-8)]
            for (name, question, exact), own in zip(asked, bounds, strict=True):
                for index, (model, ends) in enumerate(zip(models, own, strict=True)):
                    lower, upper = number(ends["lower"]), number(ends["upper"])
                    value = exact(model)
                    if value is None:
                        continue
                    compared[name, "exact"] += 1
                    # Comparisons of floats with fractions are exact.
                    if not lower <= value <= upper:
                        differences += 1
                        print(f"batch {batch}, model {index}: {question}: [{lower}, {upper}], exactly {value}")
                        write([model], f"difference-{differences}")
            findings = dynabs.crosscheck(tra, questions) if prism and not zeros else []
            for (name, question, _), finding in zip(asked, findings):
                if finding["agreement"] == "agrees":
                    compared[name, "PRISM"] += len(models)
                elif finding["agreement"] == "disagrees":
                    differences += 1
                    at = f"{finding['value']} against {finding['ours']} in state {finding['state']}"
                    print(f"batch {batch}: {question}: PRISM has {at}: {'; '.join(finding['notes'])}")
                    write(models, f"difference-{differences}")
                else:
                    print(f"batch {batch}: {question}: {finding['agreement']}: {'; '.join(finding['notes'])}")
            print(", ".join(f"{kind} {engine} {count}" for (kind, engine), count in compared.items()), flush=True)
    print(f"seed {arguments.seed}: {differences} differences")
    sys.exit(1 if differences else 0 if prism else 77)


if __name__ == "__main__":
    main()
