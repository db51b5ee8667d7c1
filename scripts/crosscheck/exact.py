"""Exact values of tiny interval models in fractions, by looking at all strategies."""

import itertools
import math
from fractions import Fraction


def corners(row):
    """The corners of a row [(successor, lower, upper)]: all but one successor at a bound."""
    found = []
    for free in range(len(row)):
        others = [entry for i, entry in enumerate(row) if i != free]
        for ends in itertools.product((1, 2), repeat=len(others)):
            mass = {entry[0]: entry[end] for entry, end in zip(others, ends)}
            rest = 1 - sum(mass.values(), Fraction(0))
            if row[free][1] <= rest <= row[free][2]:
                mass[row[free][0]] = rest
                mass = {successor: p for successor, p in mass.items() if p > 0}
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


def backwards(chain, goal, inside):
    """The states that meet the goal with positive probability on a way inside."""
    can = set(goal)
    while True:
        more = {s for s in inside if s not in can and any(t in can for t, p in chain[s].items() if p > 0)}
        if not more:
            return can
        can |= more


def chain_value(chain, safe, goal, rewards=None):
    """P(safe U goal) of a Markov chain, or, with rewards, what is earned before the goal (infinite where it may be missed)."""
    states = range(len(chain))
    can = backwards(chain, goal, [s for s in states if s in safe])
    infinite = set(states) - can
    if rewards is not None:
        infinite = backwards(chain, infinite, [s for s in states if s not in goal])
    inside = [s for s in sorted(can) if s not in goal and (rewards is None or s not in infinite)]
    index = {s: i for i, s in enumerate(inside)}
    matrix = [[Fraction(int(i == j)) for j in range(len(inside))] for i in range(len(inside))]
    right = [Fraction(0) if rewards is None else rewards[s] for s in inside]
    for s in inside:
        for t, p in chain[s].items():
            if t in index:
                matrix[index[s]][index[t]] -= p
            elif t in goal and rewards is None:
                right[index[s]] += p
    result = [Fraction(0)] * len(chain)
    for s, value in zip(inside, solve(matrix, right)):
        result[s] = value
    for s in goal:
        result[s] = Fraction(0) if rewards is not None else Fraction(1)
    if rewards is not None:
        for s in infinite:
            result[s] = math.inf
    return result


def directions(kind):
    """max or min for the policy and for nature of "maxmin" and the like."""
    return (max if kind[:3] == "max" else min), (max if kind[3:] == "max" else min)


def flipped(kind):
    """The kind of the complement."""
    return kind.replace("max", "?").replace("min", "max").replace("?", "min")


def size(choices, moving):
    """How many chains `optimum` looks at."""
    return math.prod(sum(len(corners(row)) for row in choices[s]) for s in moving)


def optimum(choices, kind, safe, goal, rewards=None):
    """The exact value of every state, over all memoryless policies and all corners of nature."""
    outer, inner = directions(kind)
    states = range(len(choices))
    moving = [s for s in states if s not in goal and s in safe]
    all_corners = [[corners(row) for row in rows] for rows in choices]
    best = None
    for policy in itertools.product(*(range(len(choices[s])) for s in moving)):
        worst = None
        for nature in itertools.product(*(all_corners[s][c] for s, c in zip(moving, policy))):
            chain = [{s: Fraction(1)} for s in states]
            for s, mass in zip(moving, nature):
                chain[s] = mass
            values = chain_value(chain, safe, goal, rewards)
            worst = values if worst is None else list(map(inner, worst, values))
        best = worst if best is None else list(map(outer, best, worst))
    return best


def steps(choices, kind, horizon, values, rewards):
    """`horizon` steps of the Bellman operator, exactly."""
    outer, inner = directions(kind)
    expectation = lambda mass: sum((p * values[t] for t, p in mass.items()), Fraction(0))
    for _ in range(horizon):
        values = [
            rewards[s] + outer(inner(map(expectation, corners(row))) for row in rows) for s, rows in enumerate(choices)
        ]
    return values


def end_components(states, moves):
    """The maximal end components: (states, {state: its staying distributions})."""
    states, found = set(states), []
    staying = {s: [mass for mass in moves[s] if set(mass) <= states] for s in states}
    while True:
        empty = {s for s in states if not staying[s]}
        if empty:
            states -= empty
            staying = {s: [mass for mass in staying[s] if set(mass) <= states] for s in states}
            continue
        parts = components(states, staying)
        if len(parts) == 1:
            return [(states, staying)]
        for part in parts:
            found += end_components(part, {s: [mass for mass in staying[s] if set(mass) <= part] for s in part})
        return found


def components(states, staying):
    """Strongly connected components."""
    reach = {s: backwards_of(s, states, staying) for s in states}
    parts = {frozenset(t for t in reach[s] if s in reach[t]) for s in states}
    return list(parts)


def backwards_of(state, states, staying):
    seen, open_ones = {state}, [state]
    while open_ones:
        for mass in staying[open_ones.pop()]:
            for t in mass:
                if t in states and t not in seen:
                    seen.add(t)
                    open_ones.append(t)
    return seen


def best_parity(moves, priorities):
    """The greatest probability, over all strategies of one player, that the greatest priority met infinitely often is even."""
    good = set()
    for top in {p for p in priorities if p % 2 == 0}:
        low = [s for s in range(len(moves)) if priorities[s] <= top]
        for part, _ in end_components(low, {s: moves[s] for s in low}):
            if any(priorities[s] == top for s in part):
                good |= part
    everything = set(range(len(moves)))
    # From a strategy of some value, strict improvements lead to the greatest.
    chosen = [mass[0] for mass in moves]
    while True:
        values = chain_value(chosen, everything, good)
        improved = False
        for s in everything - good:
            for mass in moves[s]:
                if sum((p * values[t] for t, p in mass.items()), Fraction(0)) > values[s]:
                    values_of = lambda m: sum((p * values[t] for t, p in m.items()), Fraction(0))
                    chosen[s] = max(moves[s], key=values_of)
                    improved = True
                    break
        if not improved:
            return values


def product(choices, letters, automaton):
    """The pairs of a state and an automaton's state that are met from state 0, and where they stand in that list."""
    start, step, _ = automaton
    first = (0, step(start, letters[0]))
    order, index = [first], {first: 0}
    for s, q in order:
        for row in choices[s]:
            for t, _, _ in row:
                pair = (t, step(q, letters[t]))
                if pair not in index:
                    index[pair] = len(order)
                    order.append(pair)
    return order, index


def earned_before(choices, kind, letters, rewards, automaton, most):
    """What is earned from state 0 before the automaton is in a state "met"; None if that would take too long."""
    order, index = product(choices, letters, automaton)
    step = automaton[1]
    own = [[[(index[t, step(q, letters[t])], low, high) for t, low, high in row] for row in choices[s]] for s, q in order]
    goal = {i for i, (_, q) in enumerate(order) if q == "met"}
    moving = [i for i in range(len(order)) if i not in goal]
    if size(own, moving) > most:
        return None
    return optimum(own, kind, set(range(len(order))), goal, [rewards[s] for s, _ in order])[0]


def parity_value(choices, kind, letters, automaton, most=256):
    """The value in state 0 of a deterministic parity automaton's language; None if that would take too long.

    `automaton` is (start, step(q, letter), priority(q)); both players may do with strategies without further memory.
    """
    _, step, priority = automaton
    order, index = product(choices, letters, automaton)
    if math.prod(len(choices[s]) for s, _ in order) > most or len(order) > 14:
        return None
    outer, _ = directions(kind)
    priorities = [priority(q) for _, q in order]
    if kind[3:] == "min":
        priorities = [p + 1 for p in priorities]
    all_corners = [
        [[{index[t, step(q, letters[t])]: p for t, p in mass.items()} for mass in corners(row)] for row in choices[s]]
        for s, q in order
    ]
    best = None
    for policy in itertools.product(*(range(len(rows)) for rows in all_corners)):
        moves = [rows[choice] for rows, choice in zip(all_corners, policy)]
        value = best_parity(moves, priorities)[0]
        value = 1 - value if kind[3:] == "min" else value
        best = value if best is None else outer(best, value)
    return best
