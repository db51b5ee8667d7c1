// What is shown: a plane through the picked cell.
const view = {across: data.view.across, up: data.view.up, cell: [...data.view.slice], step: data.view.step, along: null, map: 0};
const show = {arrows: true, runs: true, between: false, enabled: true};
// Whether a cell was picked, and whether what is shown is another than at first.
let touched = false, linked = false;

const frameOf = (left, top, width, height, x, y) => ({
  left, top, width, height, x, y,
  px: (v) => left + (v - x[0]) / (x[1] - x[0]) * width,
  py: (v) => top + height - (v - y[0]) / (y[1] - y[0]) * height,
});
const range = (j) => [data.lower[j], data.upper[j]];
const lengthOf = (j) => data.upper[j] - data.lower[j];
const acrossRange = () => view.across === TIME ? [-0.5, data.lastStep + 0.5] : range(view.across);
// Both axes have the same scale if they have the same unit, or none and square cells, and no side is much longer.
const isEqual = () => {
  if (view.across === TIME) return false;
  const [a, b] = [view.across, view.up], width = (j) => lengthOf(j) / data.cells[j], ratio = lengthOf(a) / lengthOf(b);
  const alike = data.units[a] === null && data.units[b] === null ? Math.abs(width(a) / width(b) - 1) < 1e-9 : data.units[a] === data.units[b];
  return alike && ratio >= 0.25 && ratio <= 4;
};
const mapFrame = () => {
  const x = acrossRange(), y = range(view.up), size = [548, 420];
  if (!isEqual()) return frameOf(64, 16, ...size, x, y);
  const scale = Math.min(size[0] / (x[1] - x[0]), size[1] / (y[1] - y[0]));
  const width = Math.round((x[1] - x[0]) * scale), height = Math.round((y[1] - y[0]) * scale);
  return frameOf(64 + Math.floor((size[0] - width) / 2), 16, width, height, x, y);
};
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
  return text + `<text class="name" x="${f.left + f.width / 2}" y="${bottom + 38}" text-anchor="middle">${safe(across)}</text>` +
    `<text class="name" transform="translate(${f.left - 48} ${f.top + f.height / 2}) rotate(-90)" text-anchor="middle">${safe(up)}</text>`;
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


const colourBar = (f) => {
  const left = f.left + f.width + 20;
  let text = `<rect class="border" fill="url(#map-colours)" x="${left}" y="${f.top}" width="16" height="${f.height}" style="fill:url(#map-colours)"/>`;
  for (const [place, label] of data.scaleLabels) {
    const y = f.top + f.height * (1 - place);
    text += `<path class="tick" d="M${left + 16} ${at2(y)}h5"/><text class="number" x="${left + 25}" y="${at2(y + 4)}">${label}</text>`;
  }
  return text + `<text class="name" transform="translate(${left + 84} ${f.top + f.height / 2}) rotate(-90)" text-anchor="middle">${data.valueName}</text>`;
};
