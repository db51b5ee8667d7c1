"""What was reproduced, as Markdown and as one HTML page."""

import html

from integrator import AT, position

# What the published numbers rest on, where the text says otherwise or leaves it open.
DISAGREEMENTS = (
    ("LQR weights of the spacecraft", "R = 20·I gives the published gain and sizes; R = I does not"),
    ("Abstract input of the spacecraft", "U′ = [−0.08, 0.075] per input; the text says ±0.08"),
    ("Noise", "the samples are of the noise of two grouped steps, covariance [[6, 1], [1, 2]] for the integrator"),
    ("Horizon", "8 grouped steps, which are 16 of the original system"),
    ("Value of the disaligned case with two layers", "0.00072; the text has 0.0072"),
    ("Goal of the spacecraft", "the cells that touch the goal; here a cell counts if the goal contains it, so the models "
     "have the goal that these cells make up"),
    ("Threshold", "ρ = 0.5; sizes and values do not depend on it"),
    ("Transitions of the spacecraft with two layers", "an exact test of enabled actions gives more than the published tool's "
     "enumeration of vertices, which misses valid pairs"),
)
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00")


def yes(same):
    return {True: "equal", False: "DIFFERENT", None: "not published"}[same]


def number(value):
    return f"{value:,}" if isinstance(value, int) else f"{value:.5f}"


def tables(integrator, spacecraft):
    """Titles, headers and rows."""
    sizes, values, four = [], [], []
    for row in integrator:
        entry, ours = row["published"], row["reference"]
        sizes.append([row["name"], *map(number, ours.size), number(entry["transitions"]), yes(row["same_size"]),
                      number(row["pac"].size[2]), f"{ours.bytes / 1e6:,.0f} MB", f"{ours.seconds:.1f} s"])
        for mode in ("reference", "pac"):
            at = [number(row[mode].along[(x + 40) // 2]) for x in AT]
            values.append([row["name"], mode, *at, yes(row["same_values"]) if mode == "reference" else "guaranteed"])
    for row in spacecraft:
        entry, ours = row["published"], row["reference"]
        four.append([row["name"], number(ours.size[2]), number(entry["transitions_reference"]),
                     number(entry["transitions_exact"]), yes(row["same_size"]), number(ours.lower),
                     number(entry["value_at_initial_state"]), str(entry["paper_value"]), yes(row["same_values"]),
                     number(row["pac"].lower)])
    return [
        ("Table I: the double integrator, reference mode",
         ["row", "states", "choices", "transitions", "published", "all three", "in pac mode", "written", "in"], sizes),
        ("Values on x₂ = 0", ["row", "mode", *[f"x₁ = {x}" for x in AT], "all 41 published values"], values),
        ("The spacecraft", ["case", "transitions", "published tool", "exact", "transitions are", "value",
                            "published tool", "in the text", "values are", "pac mode, guaranteed"], four),
        ("Where the text and the published numbers disagree", ["what", "what the numbers rest on"],
         [list(entry) for entry in DISAGREEMENTS]),
    ]


def markdown(tables):
    parts = ["# The experiments of the paper, again\n"]
    for title, header, rows in tables:
        parts.append(f"\n## {title}\n")
        parts.append("| " + " | ".join(header) + " |")
        parts.append("|" + "---|" * len(header))
        parts += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(parts) + "\n"


def panel(rows, title):
    """Values on x2 = 0: reference mode thin, pac mode thick, published ones as circles."""
    width, height, left, bottom = 640, 360, 52, 40
    x = lambda i: left + (width - left - 12) * i / 40
    y = lambda v: 12 + (height - bottom - 12) * (1 - v)
    line = lambda run: " ".join(f"{x(i):.1f},{y(v):.1f}" for i, v in enumerate(run.along))
    svg = [f'<svg viewBox="0 0 {width} {height + 24 * len(rows)}" role="img" aria-label="{html.escape(title)}">']
    for v in (0, 0.25, 0.5, 0.75, 1):
        svg.append(f'<path class="grid" d="M{left} {y(v):.1f}H{width - 12}"/>'
                   f'<text x="{left - 6}" y="{y(v) + 4:.1f}" text-anchor="end">{v:g}</text>')
    for i in range(0, 41, 5):
        svg.append(f'<text x="{x(i):.1f}" y="{height - bottom + 18}" text-anchor="middle">{position(i)}</text>')
    svg.append(f'<text x="{(left + width) / 2}" y="{height - 4}" text-anchor="middle">x₁, with x₂ = 0</text>')
    for k, row in enumerate(rows):
        colour = COLOURS[k % len(COLOURS)]
        svg.append(f'<polyline points="{line(row["reference"])}" fill="none" stroke="{colour}" stroke-width="1.2" '
                   f'stroke-dasharray="4 3"/><polyline points="{line(row["pac"])}" fill="none" stroke="{colour}" '
                   'stroke-width="2.4"/>')
        for i, v in enumerate(row["published"].get("values", [])):
            svg.append(f'<circle cx="{x(i):.1f}" cy="{y(v):.1f}" r="3" fill="none" stroke="{colour}"/>')
        legend = height + 18 + 24 * k
        svg.append(f'<path d="M{left} {legend - 4}h30" stroke="{colour}" stroke-width="2.4"/>'
                   f'<text x="{left + 38}" y="{legend}">{html.escape(row["name"])}</text>')
    return "".join(svg) + "</svg>"


def page(tables, integrator, spacecraft):
    body = ["<h1>The experiments of the paper, again</h1>",
            "<p>Badings, Romao, Abate, Jansen: <cite>A Stability-Based Abstraction Framework for Reach-Avoid Control of "
            "Stochastic Dynamical Systems with Unknown Noise Distributions</cite>, ECC 2024. <em>Reference</em> mode repeats "
            "the published tool's intervals, which are no guarantee; in <em>pac</em> mode all intervals hold together "
            "with confidence 99 %.</p>"]
    for title, header, rows in tables:
        head = "".join(f"<th>{html.escape(name)}</th>" for name in header)
        lines = ["<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in row) + "</tr>" for row in rows]
        body.append(f"<h2>{html.escape(title)}</h2><div class=wide><table><thead><tr>{head}</tr></thead>"
                    f"<tbody>{''.join(lines)}</tbody></table></div>")
        if title.startswith("Values"):
            body.append("<p>Dashed: reference mode; solid: pac mode; circles: published.</p>")
            for layers, name in ((1, "One layer"), (2, "Two layers")):
                chosen = [row for row in integrator if row["layers"] == layers]
                body.append(f"<h3>{name}</h3>" + panel(chosen, name))
        if title.startswith("The spacecraft"):
            for row in spacecraft:
                body.append(f'<h3>{html.escape(row["name"])}</h3><p>In pac mode; <a href="{row["page"]}">the whole '
                            "report</a>.</p>")
                body += [f"<figure>{picture.read_text()}</figure>" for picture in row["pictures"]]
    return TEMPLATE.replace("BODY", "\n".join(body))


TEMPLATE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>The experiments of the paper, again</title>
<meta name="viewport" content="width=device-width">
<style>
:root { color-scheme: light; }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em; color: #222; background: #fff; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .25em .7em; border-bottom: 1px solid #ccc; text-align: right; }
th:first-child, td:first-child { text-align: left; }
.wide { overflow-x: auto; }
svg { max-width: 100%; height: auto; font: 12px system-ui, sans-serif; }
.grid { stroke: #ddd; }
figure { margin: 1em 0; max-width: 44em; }
</style></head><body>
BODY
</body></html>
"""
