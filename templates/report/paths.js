// The vector field and the runs.
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
  return ["on-dark", "on-light"].map((name, k) => paths[k] && `<path class="arrow ${name}" d="${paths[k]}"/>`).join("");
};

const project = (f, time, x) => [f.px(view.across === TIME ? time : x[view.across]), f.py(x[view.up])];
// What to add to the end of a line over a periodic axis so that it is no longer than half of the axis.
const shift = (from, to, wrap) => wrap === null ? 0 : to - from > wrap / 2 ? -wrap : from - to > wrap / 2 ? wrap : 0;
const isInSlice = (x) => x.every((v, j) => !isFixed(j) || face(j, view.cell[j]) <= v && v < face(j, view.cell[j] + 1));
// Lines between points that are both in the slice, that are not, or all: out at one end of a periodic axis, in at the other.
const runLine = (points, only, wraps) => {
  const pair = (x, y) => `${at2(x)} ${at2(y)}`;
  let d = "", pen = false;
  for (let i = 1; i < points.length; i++) {
    const from = points[i - 1], to = points[i];
    if (only !== null && only !== (from.inside && to.inside)) { pen = false; continue; }
    if (!pen) d += "M" + pair(from.x, from.y);
    const dx = shift(from.x, to.x, wraps[0]), dy = shift(from.y, to.y, wraps[1]);
    if (dx || dy) d += `L${pair(to.x + dx, to.y + dy)}M${pair(from.x - dx, from.y - dy)}`;
    d += "L" + pair(to.x, to.y);
    pen = true;
  }
  return d;
};
const runs = (f) => {
  const drawn = ["", ""], isProjected = data.names.some((_, j) => isFixed(j));
  const wraps = [view.across !== TIME && data.periods[view.across] !== null ? f.width : null, data.periods[view.up] !== null ? f.height : null];
  for (const run of data.runs) {
    const points = run.points.map(([time, ...x]) => {
      const [px, py] = project(f, time, x);
      return {x: px, y: py, inside: isInSlice(x)};
    });
    const asked = run.asked.map((i) => points[i]);
    const paths = (only, faded) => {
      const path = (name, d) => d && `<path class="${name}${faded}" d="${d}"/>`, line = runLine(show.between ? points : asked, only, wraps);
      const dots = asked.filter((point) => only === null || point.inside === only).map(({x, y}) => `M${at2(x)} ${at2(y)}h0`).join("");
      return path("casing", line) + path(run.class, line) + path("dots " + run.class, dots);
    };
    drawn[Number(!run.satisfied)] += isProjected ? paths(false, " faded") + paths(true, "") : paths(null, "");
  }
  const [x, y] = project(f, 0, data.start);
  return drawn.join("") + `<circle class="start" cx="${at2(x)}" cy="${at2(y)}" r="4.5"/>`;
};
