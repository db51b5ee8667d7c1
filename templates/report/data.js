// What the page was written with: numbers, values, actions.
const data = JSON.parse(document.getElementById("data").textContent);
if (!data) return;
const $ = (id) => document.getElementById(id);

// A text of the model as it may stand in markup.
const safe = (text) => text.replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
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
// Where those of every cell begin, from how many there are.
const starts = (counts) => {
  const list = new Uint32Array(counts.length + 1);
  counts.forEach((count, i) => { list[i + 1] = list[i] + count; });
  return list;
};
const policy = Object.fromEntries(Object.entries(data.policy).map(([k, v]) => [k, unpack(v)]));
const ranges = data.ranges && Object.fromEntries(Object.entries(data.ranges).map(([k, v]) => [k, unpack(v)]));
policy.starts = starts(policy.counts);
if (ranges) ranges.starts = starts(ranges.counts);
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
const level = (value) => {
  const share = (value - data.scale[0]) / (data.scale[1] - data.scale[0]);
  return Math.min(Math.floor(Math.max(share * data.colours.length, 0)), data.colours.length - 1);
};
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
