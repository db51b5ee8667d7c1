"""Table I and the figure of the double integrator."""

import json
import re

from runs import ROOT

CELLS = 41
# The cells of the goal, [-3, 3]², along one axis.
GOAL = range(19, 22)
AT = (-30, -20, -10, 4)


def position(i):
    return 2 * i - 40


def along_x1(run):
    """The values of the cells with x2 = 0."""
    grid = iter(run.values[3:] if run.mode == "reference" else run.values[2:])
    cells = {}
    for i in range(CELLS):
        for j in range(CELLS):
            is_goal = i in GOAL and j in GOAL
            # In pac mode all goal cells are one state.
            cells[i, j] = 1.0 if is_goal and run.mode == "pac" else next(grid)
    if next(grid, None) is not None:
        raise ValueError("more values than cells")
    return [cells[i, 20] for i in range(CELLS)]


def half_width(text):
    return int(re.match(r"\[-(\d+)", text).group(1))


def reproduce(dynabs, directory):
    """All nine rows in both modes."""
    published = json.loads((ROOT / "tests/data/table1.json").read_text())["rows"]
    rows = []
    for entry in published:
        u = half_width(entry["input"])
        sets = [f'/input={{"lower":[-{u}],"upper":[{u}]}}']
        model, name = "double_integrator", f"U=±{u}"
        if entry["abstract_input"]:
            v = half_width(entry["abstract_input"])
            sets.append(f'/stabilizer/abstract_input={{"lower":[-{v},-{v}],"upper":[{v},{v}]}}')
            model, name = "double_integrator_two_layer", f"U=±{u}, U′=±{v}"
        row = {"name": name, "layers": 2 if entry["abstract_input"] else 1, "published": entry}
        for mode in ("reference", "pac"):
            place = directory / f"{model}.{u}.{entry['abstract_input'] or ''}.{mode}".replace("..", ".")
            print(f"{name}, {mode}", flush=True)
            run = dynabs.compile(model, mode, place, sets)
            run.along = along_x1(run)
            row[mode] = run
            dynabs.clean(place)
        row["same_size"] = row["reference"].size == [entry[k] for k in ("states", "choices", "transitions")]
        row["same_values"] = None
        if "values" in entry:
            pairs = zip(row["reference"].along, entry["values"])
            row["same_values"] = max(abs(ours - theirs) for ours, theirs in pairs) < 1e-9
        rows.append(row)
    return rows
