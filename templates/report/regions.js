// Goal, unsafe region, and the regions that a task names.
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
  const text = (what) => `<text class="${what}" x="${at2(f.px(mean(0)))}" y="${at2(f.py(mean(1)))}" text-anchor="middle">${safe(name)}</text>`;
  return `<path class="casing" d="${d}"/><path class="named outline" d="${d}"/>` + text("halo") + text("named");
}).join("");
