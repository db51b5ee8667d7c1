"""The four cases of the spacecraft, with reports."""

import json

from runs import ROOT

CASES = {
    "aligned_base": "spacecraft_aligned",
    "aligned_stab": "spacecraft_aligned_two_layer",
    "disaligned_base": "spacecraft_disaligned",
    "disaligned_stab": "spacecraft_disaligned_two_layer",
}


def reproduce(dynabs, directory):
    published = json.loads((ROOT / "tests/data/spacecraft.json").read_text())["cases"]
    rows = []
    for entry in published:
        model = CASES[entry["case"]]
        row = {"name": model, "published": entry}
        for mode in ("reference", "pac"):
            place = directory / f"{model}.{mode}"
            print(f"{model}, {mode}", flush=True)
            row[mode] = dynabs.compile(model, mode, place)
            if mode == "pac":
                page, pictures = directory / f"{model}.html", directory / f"{model}.pictures"
                dynabs.run("dynabs-check", "report", place, "-o", page, "--svg", pictures, "--quiet")
                row["page"] = page.name
                row["pictures"] = sorted(pictures.glob("*.svg"))
            dynabs.clean(place)
        run = row["reference"]
        row["same_size"] = run.size[2] == entry["transitions_exact"]
        row["same_values"] = abs(run.lower - entry["value_at_initial_state"]) < 1e-9
        rows.append(row)
    return rows
