"""LTL formulas with deterministic parity automata made by hand: (start, step(q, letter), priority(q)).

An automaton reads the labels of the first state first; a run is accepted if the greatest priority met infinitely often is even.
"""


def recurring(priority):
    """Only the letter counts: `priority(letter)`."""
    return None, lambda _, letter: letter, priority


def both_recurring(a, b):
    """a and b, each infinitely often: waits for one after the other."""

    def step(q, letter):
        if q == "b":
            return "met" if b in letter else "b"
        return ("met" if b in letter else "b") if a in letter else "a"

    return "a", step, lambda q: 2 if q == "met" else 1


def then(a, b):
    """a, and b some time after it."""

    def step(q, letter):
        if q == 0:
            return 1 if a in letter else 0
        return 2 if q == 2 or b in letter else 1

    return 0, step, lambda q: 2 if q == 2 else 1


def met_without(a, b):
    """a at some time, b never."""

    def step(q, letter):
        if q == "lost" or b in letter:
            return "lost"
        return "met" if q == "met" or a in letter else "open"

    return "open", step, lambda q: 2 if q == "met" else 1


def two_untils(a, b, g):
    """a U (b U g): which of the two untils may still be going on."""

    def step(q, letter):
        if q in ("met", "lost"):
            return q
        first, second = q
        if g in letter:
            return "met"
        q = (first and a in letter, (first or second) and b in letter)
        return q if any(q) else "lost"

    return (True, False), step, lambda q: 2 if q == "met" else 1


def answered(a, b):
    """Whenever a, then b at that time or later."""

    def step(q, letter):
        return False if b in letter else q or a in letter

    return False, step, lambda q: 1 if q else 2


def third_or_fourth(a, b):
    """a in the third state or b in the fourth."""

    def step(q, letter):
        if q in ("met", "lost"):
            return q
        if q < 2:
            return q + 1
        if q == 2:
            return "met" if a in letter else 3
        return "met" if b in letter else "lost"

    return 0, step, lambda q: 2 if q == "met" else 1


def or_next(a, b):
    """In every state a, or b in the next."""

    def step(q, letter):
        if q == "lost" or q == "owed" and b not in letter:
            return "lost"
        return "free" if a in letter else "owed"

    return "free", step, lambda q: 1 if q == "lost" else 2


def later(a):
    """a in some state but the first."""

    def step(q, letter):
        return q if q == "met" else "open" if q == "first" else "met" if a in letter else "open"

    return "first", step, lambda q: 2 if q == "met" else 1


def both(a, b):
    """a at some time, and b at some time."""

    def step(q, letter):
        if q == "met":
            return q
        q = q | ({a, b} & letter)
        return "met" if q == {a, b} else frozenset(q)

    return frozenset(), step, lambda q: 2 if q == "met" else 1


def cosafe_formulas(a, b):
    """Formulas of which a beginning of a run shows that they hold, with automata whose state is then "met"."""
    start, step, priority = then(a, b)
    named = lambda q: "met" if q == 2 else q
    after = (start, lambda q, letter: named(step(2 if q == "met" else q, letter)), priority)
    return [(f'X (F "{a}")', later(a)), (f'F ("{a}" & (X (F "{b}")))', after), (f'(F "{a}") & (F "{b}")', both(a, b))]


def formulas(a, b, g):
    """Formulas over three labels, with their automata."""
    return [
        (f'G (F "{a}")', recurring(lambda letter: 2 if a in letter else 1)),
        (f'F (G "{a}")', recurring(lambda letter: 2 if a in letter else 3)),
        (f'(G (F "{a}")) & (G (F "{b}"))', both_recurring(a, b)),
        (f'(F (G "{a}")) | (G (F "{b}"))', recurring(lambda letter: 4 if b in letter else 2 if a in letter else 3)),
        (f'(G (F "{a}")) => (G (F "{b}"))', recurring(lambda letter: 4 if b in letter else 3 if a in letter else 2)),
        (f'F ("{a}" & (X (F "{b}")))', then(a, b)),
        (f'(F "{a}") & (G !"{b}")', met_without(a, b)),
        (f'"{a}" U ("{b}" U "{g}")', two_untils(a, b, g)),
        (f'G ("{a}" => (F "{b}"))', answered(a, b)),
        (f'X (X ("{a}" | (X "{b}")))', third_or_fourth(a, b)),
        (f'(F (G "{a}")) & (G (F (X "{b}")))', recurring(lambda letter: 3 if a not in letter else 2 if b in letter else 1)),
        (f'G ("{a}" | (X "{b}"))', or_next(a, b)),
    ]
