"use strict";
(() => {
const data = JSON.parse(document.getElementById("data").textContent);
if (!data) return;
const $ = (id) => document.getElementById(id);

// Numbers: the same texts as in the page as it was written.
const short = (x) => String(Number(x.toPrecision(6)) + 0).replaceAll("-", "−").replace("e+", "e");
const at2 = (x) => String(Number(x.toFixed(2)) + 0);
const tuple = (x) => "(" + x.map(short).join(", ") + ")";
const ticks = (from, to, count) => {
  const rough = (to - from) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough) ?? rough;
  const list = [];
  for (let i = Math.ceil(from / step - 1e-9); i <= Math.floor(to / step + 1e-9); i++) list.push(i * step);
  return list;
};

const unpack = ({type, data}) => {
  const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
  const view = {u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, f32: Float32Array}[type];
  return new view(bytes.buffer);
};
const values = unpack(data.values), kinds = unpack(data.kinds);
const policy = Object.fromEntries(Object.entries(data.policy).map(([k, v]) => [k, unpack(v)]));
const ranges = data.ranges && Object.fromEntries(Object.entries(data.ranges).map(([k, v]) => [k, unpack(v)]));
const n = data.cells.length, TIME = -1;
const numCells = data.cells.reduce((a, b) => a * b, 1);
// One map of values, kinds and actions at the start, and one for each memory that runs may come with.
const maps = 1 + (data.memories ?? 0);
const keptSteps = values.length / numCells / maps - 1;

const face = (j, i) => data.lower[j] + i * (data.upper[j] - data.lower[j]) / data.cells[j];
const center = (j, i) => (face(j, i) + face(j, i + 1)) / 2;
const cellOf = (coordinates) => coordinates.reduce((sum, i, j) => sum + i * data.strides[j], 0);
const valueAt = (cell, step) => values[(view.map * (keptSteps + 1) + Math.min(step, keptSteps)) * numCells + cell];
const kindOf = (cell) => kinds[view.map * numCells + cell];
const level = (value) => Math.min(Math.floor(value * data.colours.length), data.colours.length - 1);
const point = (target) => {
  if (data.targets.points) return data.targets.points[target];
  const x = new Array(n);
  for (let j = n - 1; j >= 0; j--) {
    const axis = data.targets.axes[j];
    x[j] = axis[target % axis.length];
    target = Math.floor(target / axis.length);
  }
  return x;
};
const best = (cell, step) => {
  const left = data.horizon === null ? 1 : data.horizon - step;
  if (kindOf(cell) !== 0 || left <= 0) return null;
  let found = null;
  const at = view.map * numCells + cell;
  for (let e = policy.starts[at]; e < policy.starts[at + 1] && policy.left[e] <= left; e++) found = e;
  return found;
};
// Where the action of an entry of the policy leads, and what it is.
const successors = data.successors && unpack(data.successors);
const next = (entry) => successors ? Array.from(successors.subarray(entry * n, entry * n + n))
  : point(policy.target[entry]).map((d, j) => d + data.mean[j]);
const action = (entry) => data.inputs ? data.inputs[policy.target[entry]] : `steer to d = ${tuple(point(policy.target[entry]))}`;
const enabled = (cell) => {
  const list = [];
  for (let r = ranges.starts[cell]; r < ranges.starts[cell + 1]; r++)
    for (let i = 0; i < ranges.length[r]; i++) list.push(ranges.first[r] + i);
  return list;
};

// What is shown: a plane through the picked cell.
const view = {across: data.view.across, up: data.view.up, cell: [...data.view.slice], step: data.view.step, along: null, map: 0};
const show = {arrows: true, runs: true, between: false, enabled: true};
let touched = false;

const frameOf = (left, top, width, height, x, y) => ({
  left, top, width, height, x, y,
  px: (v) => left + (v - x[0]) / (x[1] - x[0]) * width,
  py: (v) => top + height - (v - y[0]) / (y[1] - y[0]) * height,
});
const range = (j) => [data.lower[j], data.upper[j]];
const acrossRange = () => view.across === TIME ? [-0.5, data.lastStep + 0.5] : range(view.across);
const mapFrame = () => frameOf(64, 16, 560, 420, acrossRange(), range(view.up));
const columns = () => view.across === TIME ? data.lastStep + 1 : data.cells[view.across];
const faceAcross = (i) => view.across === TIME ? i - 0.5 : face(view.across, i);
const placeOf = (i, j) => {
  const coordinates = [...view.cell];
  coordinates[view.up] = j;
  if (view.across === TIME) return [cellOf(coordinates), i];
  coordinates[view.across] = i;
  return [cellOf(coordinates), view.step];
};
const along = () => view.along ?? (view.across === TIME ? view.up : view.across);
const isFixed = (j) => j !== view.up && j !== view.across;
const box = (x0, y0, x1, y1) => `M${at2(x0)} ${at2(y0)}H${at2(x1)}V${at2(y1)}H${at2(x0)}Z`;

const axes = (f, across, up) => {
  const bottom = f.top + f.height;
  let text = `<rect class="border" x="${f.left}" y="${f.top}" width="${f.width}" height="${f.height}"/>`;
  for (const t of ticks(f.x[0], f.x[1], 7)) {
    const x = at2(f.px(t));
    text += `<path class="tick" d="M${x} ${bottom}v5"/><text class="number" x="${x}" y="${bottom + 18}" text-anchor="middle">${short(t)}</text>`;
  }
  for (const t of ticks(f.y[0], f.y[1], 6)) {
    const y = f.py(t);
    text += `<path class="tick" d="M${f.left} ${at2(y)}h-5"/><text class="number" x="${f.left - 8}" y="${at2(y + 4)}" text-anchor="end">${short(t)}</text>`;
  }
  return text + `<text class="name" x="${f.left + f.width / 2}" y="${bottom + 38}" text-anchor="middle">${across}</text>` +
    `<text class="name" transform="translate(16 ${f.top + f.height / 2}) rotate(-90)" text-anchor="middle">${up}</text>`;
};

const heat = (f) => {
  const nx = columns(), ny = data.cells[view.up], bx = Math.ceil(nx / 256), by = Math.ceil(ny / 256);
  const paths = data.colours.map(() => "");
  for (let j = 0; j < ny; j += by) {
    const top = Math.min(j + by, ny), y0 = f.py(face(view.up, j)), y1 = f.py(face(view.up, top));
    let from = 0, open = null;
    for (let i = 0; i < nx; i += bx) {
      let least = 1;
      for (let a = i; a < Math.min(i + bx, nx); a++)
        for (let b = j; b < top; b++) least = Math.min(least, valueAt(...placeOf(a, b)));
      const here = level(least);
      if (here === open) continue;
      if (open !== null) paths[open] += box(f.px(faceAcross(from)), y0, f.px(faceAcross(i)), y1);
      [from, open] = [i, here];
    }
    paths[open] += box(f.px(faceAcross(from)), y0, f.px(faceAcross(nx)), y1);
  }
  return paths.map((d, i) => d && `<path fill="${data.colours[i]}" d="${d}"/>`).join("");
};

const side = ([lower, upper]) => [lower ?? -Infinity, upper ?? Infinity];
const clipped = (sides, [from, to]) => [Math.max(side(sides)[0], from), Math.min(side(sides)[1], to)];
const meets = (region, j) => {
  const [lower, upper] = side(region[j]);
  return lower < face(j, view.cell[j] + 1) && face(j, view.cell[j]) < upper;
};
const regions = (f) => {
  const paths = (list) => list.map((region) => {
    if (region.some((_, j) => isFixed(j) && !meets(region, j))) return "";
    const [x0, x1] = view.across === TIME ? f.x : clipped(region[view.across], f.x);
    const [y0, y1] = clipped(region[view.up], f.y);
    return x0 < x1 && y0 < y1 ? box(f.px(x0), f.py(y0), f.px(x1), f.py(y1)) : "";
  }).join("");
  const avoid = paths(data.unsafe), goal = paths(data.goal);
  return (avoid && `<path class="unsafe outline" d="${avoid}"/><path class="unsafe cover" d="${avoid}"/><path fill="url(#map-hatch)" d="${avoid}"/>`) +
    (goal && `<path class="goal outline" d="${goal}"/>`) + outlines(f);
};

// What the half-spaces of a shape leave of the frame, by cutting off one after the other.
const cut = (f, shape) => {
  let polygon = [[f.x[0], f.y[0]], [f.x[1], f.y[0]], [f.x[1], f.y[1]], [f.x[0], f.y[1]]];
  for (const [normal, bound] of shape) {
    let offset = bound;
    view.cell.forEach((i, j) => { if (isFixed(j)) offset -= normal[j] * center(j, i); });
    const a = view.across === TIME ? 0 : normal[view.across], room = ([x, y]) => offset - a * x - normal[view.up] * y;
    polygon = polygon.flatMap((from, i) => {
      const to = polygon[(i + 1) % polygon.length], before = room(from), after = room(to), share = before / (before - after);
      const kept = before >= 0 ? [from] : [];
      if ((before >= 0) !== (after >= 0)) kept.push([0, 1].map((k) => from[k] + share * (to[k] - from[k])));
      return kept;
    });
  }
  return polygon;
};
const outlines = (f) => data.named.map(({name, shapes}) => {
  const polygons = shapes.map((shape) => cut(f, shape)).filter((polygon) => polygon.length > 2);
  if (!polygons.length) return "";
  const d = polygons.map((polygon) => `M${polygon.map(([x, y]) => `${at2(f.px(x))} ${at2(f.py(y))}`).join("L")}Z`).join("");
  const mean = (k) => polygons[0].reduce((sum, corner) => sum + corner[k], 0) / polygons[0].length;
  const text = (what) => `<text class="${what}" x="${at2(f.px(mean(0)))}" y="${at2(f.py(mean(1)))}" text-anchor="middle">${name}</text>`;
  return `<path class="casing" d="${d}"/><path class="named outline" d="${d}"/>` + text("halo") + text("named");
}).join("");

const arrow = (x, y, dx, dy, most) => {
  const length = Math.hypot(dx, dy);
  if (length < 0.5) return "";
  const shown = Math.min(length, most) / length;
  [dx, dy] = [dx * shown, dy * shown];
  const size = Math.hypot(dx, dy), head = Math.min(0.35 * size, 6) / size, hx = dx * head, hy = dy * head;
  const tip = `${at2(x + dx)} ${at2(y + dy)}`;
  const wing = (s) => `${at2(x + dx - hx - s * 0.5 * hy)} ${at2(y + dy - hy + s * 0.5 * hx)}`;
  return `M${at2(x)} ${at2(y)}L${tip}M${wing(1)}L${tip}L${wing(-1)}`;
};
const step = (f, i, j, entry) => {
  const to = next(entry), across = view.across === TIME ? i + 1 : to[view.across];
  const x = f.px(view.across === TIME ? i : center(view.across, i)), y = f.py(center(view.up, j));
  return [x, y, f.px(across) - x, f.py(to[view.up]) - y];
};
const arrows = (f) => {
  const nx = columns(), ny = data.cells[view.up], sx = Math.ceil(nx / 20), sy = Math.ceil(ny / 20);
  const place = Math.min(f.width / nx * sx, f.height / ny * sy), paths = ["", ""];
  for (let i = Math.floor(sx / 2); i < nx; i += sx) for (let j = Math.floor(sy / 2); j < ny; j += sy) {
    const [cell, k] = placeOf(i, j), entry = best(cell, k);
    if (entry === null) continue;
    paths[Number(level(valueAt(cell, k)) >= data.firstLight)] += arrow(...step(f, i, j, entry), 0.85 * place);
  }
  return `<path class="arrow on-dark" d="${paths[0]}"/><path class="arrow on-light" d="${paths[1]}"/>`;
};

const project = (f, time, x) => [f.px(view.across === TIME ? time : x[view.across]), f.py(x[view.up])];
const runs = (f) => {
  const drawn = ["", ""];
  for (const run of data.runs) {
    const pairs = run.points.map(([time, ...x]) => project(f, time, x).map(at2).join(" "));
    const asked = run.asked.map((i) => pairs[i]), dots = asked.map((pair) => `M${pair}h0`).join("");
    const line = "M" + (show.between ? pairs : asked).join("L");
    drawn[Number(!run.satisfied)] += `<path class="casing" d="${line}"/><path class="${run.class}" d="${line}"/><path class="dots ${run.class}" d="${dots}"/>`;
  }
  const [x, y] = project(f, 0, data.start);
  return drawn.join("") + `<circle class="start" cx="${at2(x)}" cy="${at2(y)}" r="4.5"/>`;
};

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

const facts = () => {
  const cell = cellOf(view.cell), entry = best(cell, view.step), kind = (maps > 1 ? ["open", "done", "failed"] : ["ordinary", "goal", "unsafe"])[kindOf(cell)];
  const sides = view.cell.map((i, j) => `${data.names[j]} ∈ [${short(face(j, i))}, ${short(face(j, i + 1))})`);
  const value = (Math.floor(valueAt(cell, view.step) * 1e6) / 1e6).toFixed(6);
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

const draw = () => {
  const f = mapFrame(), plot = $("map");
  const put = (name, text) => { plot.querySelector("g." + name).innerHTML = text; };
  put("heat", heat(f));
  put("regions", regions(f));
  put("arrows", show.arrows ? arrows(f) : "");
  put("runs", show.runs ? runs(f) : "");
  put("axes", axes(f, view.across === TIME ? data.time : data.titles[view.across], data.titles[view.up]));
  $("map-title").textContent = `${data.valueName} over ${view.across === TIME ? data.time : data.names[view.across]} and ${data.names[view.up]}`;
  redraw();
};
// What changes when another cell of the same plane is picked.
const redraw = () => {
  $("map").querySelector("g.pick").innerHTML = pick(mapFrame());
  facts();
  section();
};

// Controls.
const hasTime = data.lastStep > 0;
const option = (value, text, chosen) => `<option value="${value}"${value === chosen ? " selected" : ""}>${text}</option>`;
const controls = () => {
  const names = data.names.map((name, j) => [j, name]);
  const time = hasTime ? [[TIME, data.time]] : [];
  const options = (list, chosen) => list.map(([value, text]) => option(value, text, chosen)).join("");
  let html = "";
  if (maps > 1) {
    const memories = Array.from({length: maps - 1}, (_, m) => [m + 1, `with memory ${m}`]);
    html += `<label>on arrival <select id="memory">${options([[0, "at the start"], ...memories], view.map)}</select></label>`;
  }
  if (n > 1) {
    html += `<label>across <select id="across">${options([...names, ...time], view.across)}</select></label>`;
    html += `<label>up <select id="up">${options(names, view.up)}</select></label>`;
  }
  for (let j = 0; j < n; j++) if (isFixed(j))
    html += `<label>${data.names[j]} <input type="range" data-slice="${j}" min="0" max="${data.cells[j] - 1}" value="${view.cell[j]}"> <output></output></label>`;
  if (hasTime && keptSteps > 0 && view.across !== TIME)
    html += `<label>steps elapsed <input type="range" id="step" min="0" max="${data.lastStep}" value="${view.step}"> <output></output></label>`;
  const layers = [["arrows", "vector field"], ["runs", "simulated runs"]];
  if (data.group > 1) layers.push(["between", "steps in between"]);
  if (ranges) layers.push(["enabled", "enabled actions"]);
  for (const [name, text] of layers)
    html += `<label><input type="checkbox" data-show="${name}"${show[name] ? " checked" : ""}> ${text}</label>`;
  $("controls").innerHTML = html;
  $("controls").hidden = false;
  outputs();
};
const outputs = () => {
  for (const input of $("controls").querySelectorAll("input[type=range]")) {
    const j = input.dataset.slice, i = Number(input.value);
    const text = j === undefined ? `${i} of ${data.horizon}` : `[${short(face(j, i))}, ${short(face(j, i + 1))})`;
    input.nextElementSibling.textContent = text;
    input.setAttribute("aria-valuetext", text);
  }
};
$("controls").addEventListener("submit", (event) => event.preventDefault());
$("controls").addEventListener("input", ({target}) => {
  if (target.id === "across" || target.id === "up") {
    const before = view[target.id], other = target.id === "up" ? "across" : "up";
    view[target.id] = Number(target.value);
    // Both axes the same makes no plane: they swap, or time gives way.
    if (view.across === view.up) view[other] = before === TIME ? (view.up + 1) % n : before;
    const id = target.id;
    controls();
    $(id).focus();
  } else if (target.id === "memory") {
    view.map = Number(target.value);
  } else if (target.id === "step") {
    view.step = Number(target.value);
  } else if (target.dataset.slice !== undefined) {
    view.cell[Number(target.dataset.slice)] = Number(target.value);
  } else {
    show[target.dataset.show] = target.checked;
  }
  outputs();
  draw();
});
if (n > 1) {
  const options = data.names.map((name, j) => option(j, name, along())).join("");
  $("section-controls").innerHTML = `<label>along <select id="along">${options}</select></label>`;
  $("section-controls").hidden = false;
  $("along").addEventListener("input", ({target}) => { view.along = Number(target.value); section(); });
  $("section-controls").addEventListener("submit", (event) => event.preventDefault());
}

// Picking a cell, with a pointer or the arrow keys.
const map = $("map");
map.classList.add("live");
map.setAttribute("tabindex", "0");
map.setAttribute("role", "application");
map.setAttribute("aria-describedby", "picked-help");
$("picked-help").textContent = "Click on the map, or focus it and use the arrow keys (Home: back to the start).";
const clamp = (i, count) => Math.max(0, Math.min(count - 1, i));
const move = (i, j) => {
  touched = true;
  view.cell[view.up] = clamp(j, data.cells[view.up]);
  if (view.across === TIME) view.step = clamp(i, data.lastStep + 1);
  else view.cell[view.across] = clamp(i, data.cells[view.across]);
  redraw();
};
map.addEventListener("click", (event) => {
  const place = map.getBoundingClientRect(), f = mapFrame(), scale = 720 / place.width;
  const x = (event.clientX - place.left) * scale, y = (event.clientY - place.top) * scale;
  const i = Math.floor((x - f.left) / f.width * columns());
  const j = Math.floor((f.top + f.height - y) / f.height * data.cells[view.up]);
  if (i >= 0 && i < columns() && j >= 0 && j < data.cells[view.up]) move(i, j);
});
map.addEventListener("keydown", (event) => {
  const by = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
  if (!by && event.key !== "Home") return;
  event.preventDefault();
  if (by) {
    const i = view.across === TIME ? view.step : view.cell[view.across];
    return move(i + by[0], view.cell[view.up] + by[1]);
  }
  view.cell = [...data.view.slice];
  view.step = data.view.step;
  view.map = 0;
  touched = true;
  controls();
  draw();
});
controls();
})();
