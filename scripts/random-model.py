#!/usr/bin/env python3
"""Writes a random interval MDP without repeated rows, for measuring.

    random-model.py STATES CHOICES SUCCESSORS SEED STEM [--drn] [--no-prism]

writes STEM.tra, STEM.sta and STEM.lab for PRISM and, with --drn, STEM.drn for Storm. State 0 is initial;
every hundredth state, the last one always, is a goal and has no way out. Needs nothing but Python.
"""

import argparse
import random


def choices_of(state, arguments, rng):
    """Lists of (successor, lower, upper) with lower sums below 1 and upper sums above it."""
    n = arguments.successors
    for _ in range(arguments.choices):
        successors = set()
        while len(successors) < n:
            successors.add(int(rng.random() * arguments.states))
        # Ten-thousandths, so that the written decimals are short: a share of 1 and something around it.
        weights = [0.5 + rng.random() for _ in range(n)]
        scale = 10000 / sum(weights)
        yield [
            (successor, max(1, int(weight * scale * 0.8)) / 10000, min(10000, int(weight * scale * 1.2) + 1) / 10000)
            for successor, weight in zip(sorted(successors), weights)
        ]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    for name in ("states", "choices", "successors", "seed"):
        parser.add_argument(name, type=int)
    parser.add_argument("stem")
    parser.add_argument("--drn", action="store_true", help="write STEM.drn too")
    parser.add_argument("--no-prism", action="store_true", help="write no files for PRISM")
    arguments = parser.parse_args()
    if not 1 <= arguments.successors <= min(arguments.states, 5000) or arguments.choices < 1:
        parser.error("needs 1 ≤ SUCCESSORS ≤ min(STATES, 5000) and CHOICES ≥ 1")

    states = arguments.states
    goals = [state for state in range(states) if state % 100 == 99 or state == states - 1]
    ordinary = states - len(goals)
    num_choices = ordinary * arguments.choices + len(goals)
    num_transitions = ordinary * arguments.choices * arguments.successors + len(goals)
    is_goal = bytearray(states)
    for state in goals:
        is_goal[state] = 1

    tra = None if arguments.no_prism else open(arguments.stem + ".tra", "w")
    drn = open(arguments.stem + ".drn", "w") if arguments.drn else None
    if tra:
        tra.write(f"{states} {num_choices} {num_transitions}\n")
    if drn:
        drn.write("@type: MDP\n@value_type: double-interval\n@parameters\n\n@reward_models\n\n")
        drn.write(f"@nr_states\n{states}\n@nr_choices\n{num_choices}\n@model\n")
    rng = random.Random(arguments.seed)
    for state in range(states):
        rows = [[(state, 1, 1)]] if is_goal[state] else choices_of(state, arguments, rng)
        if drn:
            drn.write(f"state {state}" + (" init" if state == 0 else "") + (" goal" if is_goal[state] else "") + "\n")
        for choice, row in enumerate(rows):
            if tra:
                tra.write("".join(f"{state} {choice} {to} [{lo},{hi}] a{choice}\n" for to, lo, hi in row))
            if drn:
                drn.write(f"\taction a{choice}\n" + "".join(f"\t\t{to} : [{lo}, {hi}]\n" for to, lo, hi in row))
    for file in filter(None, (tra, drn)):
        file.close()
    if arguments.no_prism:
        return
    with open(arguments.stem + ".sta", "w") as sta:
        sta.write("(x)\n")
        sta.writelines(f"{state}:({state})\n" for state in range(states))
    with open(arguments.stem + ".lab", "w") as lab:
        lab.write('0="init" 1="deadlock" 2="goal"\n')
        if not is_goal[0]:
            lab.write("0: 0\n")
        lab.writelines(f"{state}: {'0 2' if state == 0 else '2'}\n" for state in goals)


if __name__ == "__main__":
    main()
