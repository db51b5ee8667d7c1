// The picked cell, what is enabled there, and where its best action leads.
const pick = (f) => {
  if (!touched) return "";
  const i = view.across === TIME ? view.step : view.cell[view.across], j = view.cell[view.up];
  const cell = cellOf(view.cell), entry = best(cell, view.step);
  let text = "";
  if (show.enabled && ranges && kindOf(cell) === 0) {
    const places = enabled(cell).map((a) => project(f, i + 1, point(a)).map(at2).join(" "));
    text += `<path class="enabled" d="${[...new Set(places)].map((p) => `M${p}h0`).join("")}"/>`;
  }
  const square = box(f.px(faceAcross(i)), f.py(face(view.up, j)), f.px(faceAcross(i + 1)), f.py(face(view.up, j + 1)));
  text += `<path class="picked" d="${square}"/><path class="picked inner" d="${square}"/>`;
  if (entry !== null) {
    const d = arrow(...step(f, i, j, entry), Infinity);
    text += `<path class="casing" style="stroke-width:5" d="${d}"/><path class="leads" d="${d}"/>`;
  }
  return text;
};

const section = () => {
  const j = along(), f = frameOf(64, 16, 632, 220, range(j), [0, 1.05]), bottom = f.top + f.height;
  const coordinates = [...view.cell];
  let d = "", before = null;
  for (let i = 0; i < data.cells[j]; i++) {
    coordinates[j] = i;
    const y = at2(f.py(valueAt(cellOf(coordinates), view.step)));
    if (before === null) d += `M${f.left} ${y}`;
    else if (y !== before) d += `H${at2(f.px(face(j, i)))}V${y}`;
    before = y;
  }
  d += `H${at2(f.px(data.upper[j]))}`;
  const band = (list) => list.map((region) => {
    if (region.some((_, l) => l !== j && !meets(region, l))) return "";
    const [x0, x1] = clipped(region[j], f.x);
    return x0 < x1 ? box(f.px(x0), f.top, f.px(x1), bottom) : "";
  }).join("");
  const avoid = band(data.unsafe), goal = band(data.goal);
  const plot = $("section"), put = (name, text) => { plot.querySelector("." + name).innerHTML = text; };
  put("regions", (avoid && `<path fill="url(#section-hatch)" d="${avoid}"/>`) + (goal && `<path class="goal band" d="${goal}"/>`));
  const wanted = data.threshold === null ? "" : `<path class="threshold" d="M${f.left} ${at2(f.py(data.threshold))}h${f.width}"/>`;
  put("curve", wanted + `<path class="value" d="${d}"/>`);
  put("axes", axes(f, data.titles[j], data.valueName));
  const at = data.names.map((name, l) => l === j ? "" : `${name} = ${short(center(l, view.cell[l]))}`).filter(Boolean);
  $("section-title").textContent = `${data.valueName} along ${data.names[j]}` + (at.length ? " at " + at.join(", ") : "");
};

const kindNames = maps > 1 ? ["open", "done", "failed"] : ["ordinary", "goal", "unsafe"];
// A lower bound stays one.
const at6 = (value) => (Math.floor(value * 1e6) / 1e6).toFixed(6);
const facts = () => {
  const cell = cellOf(view.cell), entry = best(cell, view.step), kind = kindNames[kindOf(cell)];
  const sides = view.cell.map((i, j) => `${data.names[j]} ∈ [${short(face(j, i))}, ${short(face(j, i + 1))})`);
  const value = at6(valueAt(cell, view.step));
  const late = view.step > 0 ? ` at step ${view.step}${data.horizon === null ? "" : ` of ${data.horizon}`}` : "";
  const facts = {
    cell: sides.join(", "), kind, value: value + late,
    enabled: kindOf(cell) !== 0 ? "none needed" : ranges ? String(enabled(cell).length)
      : data.inputs ? String(data.inputs.length) : "left out of this page",
    best: entry === null ? "none" : action(entry),
    leads: entry === null ? "–" : tuple(next(entry)),
  };
  for (const [id, text] of Object.entries(facts)) $("fact-" + id).textContent = text;
  if (touched) $("picked-spoken").textContent = `${facts.cell}: ${kind}, value ${facts.value}, ${facts.best}`;
};

// The legend has what is drawn.
const legend = (plot) => {
  for (const entry of document.querySelectorAll("[data-drawn]")) entry.hidden = !plot.querySelector(`[class*="${entry.dataset.drawn}"]`);
};

const draw = () => {
  const f = mapFrame(), plot = $("map");
  plot.setAttribute("viewBox", `0 0 720 ${f.height + 64}`);
  for (const side of ["width", "height"]) plot.querySelector("clipPath rect").setAttribute(side, f[side]);
  plot.querySelector("clipPath rect").setAttribute("x", f.left);
  const put = (name, text) => { plot.querySelector("g." + name).innerHTML = text; };
  put("heat", heat(f));
  put("regions", regions(f));
  put("arrows", show.arrows ? arrows(f) : "");
  put("runs", show.runs ? runs(f) : "");
  put("axes", axes(f, view.across === TIME ? data.time : data.titles[view.across], data.titles[view.up]));
  put("scale", colourBar(f));
  legend(plot);
  $("map-title").textContent = `${data.valueName} over ${view.across === TIME ? data.time : data.names[view.across]} and ${data.names[view.up]}`;
  redraw();
};
// What changes when another cell of the same plane is picked.
const redraw = () => {
  $("map").querySelector("g.pick").innerHTML = pick(mapFrame());
  facts();
  section();
  remember();
};
