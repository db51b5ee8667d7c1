// Controls.
const hasTime = data.lastStep > 0;
const option = (value, text, chosen) => `<option value="${value}"${value === chosen ? " selected" : ""}>${safe(text)}</option>`;
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
    html += `<label>${safe(data.names[j])} <input type="range" data-slice="${j}" min="0" max="${data.cells[j] - 1}" value="${view.cell[j]}"> <output></output></label>`;
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
  linked = true;
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
  touched = linked = true;
  view.cell[view.up] = clamp(j, data.cells[view.up]);
  if (view.across === TIME) view.step = clamp(i, data.lastStep + 1);
  else view.cell[view.across] = clamp(i, data.cells[view.across]);
  redraw();
};
// The column, the row and the numbers under a pointer; null outside of the frame.
const under = (event) => {
  const place = map.getBoundingClientRect(), f = mapFrame(), scale = 720 / place.width;
  const x = ((event.clientX - place.left) * scale - f.left) / f.width;
  const y = (f.top + f.height - (event.clientY - place.top) * scale) / f.height;
  const i = Math.floor(x * columns()), j = Math.floor(y * data.cells[view.up]);
  if (i < 0 || i >= columns() || j < 0 || j >= data.cells[view.up]) return null;
  return {i, j, x: f.x[0] + x * (f.x[1] - f.x[0]), y: f.y[0] + y * (f.y[1] - f.y[0])};
};
map.addEventListener("click", (event) => {
  const place = under(event);
  if (place) move(place.i, place.j);
});
$("hover").hidden = false;
map.addEventListener("pointermove", (event) => {
  const place = under(event);
  if (!place) return void ($("hover").textContent = "");
  const [cell, step] = placeOf(place.i, place.j);
  const across = view.across === TIME ? `${data.time} = ${place.i}` : `${data.names[view.across]} = ${Number(place.x.toPrecision(3))}`;
  const kind = kindNames[kindOf(cell)];
  $("hover").textContent = `${across}, ${data.names[view.up]} = ${Number(place.y.toPrecision(3))}: ${at6(valueAt(cell, step))}, ${kind}`.replaceAll("-", "−");
});
map.addEventListener("pointerleave", () => { $("hover").textContent = ""; });
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
  touched = linked = true;
  controls();
  draw();
});

// Links to what is shown: #across=x1&up=x2&step=3&cell=1,2,3.
const remember = () => {
  if (!linked) return;
  const at = {across: view.across === TIME ? "time" : data.plain[view.across], up: data.plain[view.up], step: view.step, cell: view.cell};
  if (maps > 1) at.map = view.map;
  const link = "#" + Object.entries(at).map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll("%2C", ",")}`).join("&");
  if (link !== location.hash) history.replaceState(null, "", link);
};
// What of a link makes sense is shown.
const follow = () => {
  const link = new URLSearchParams(location.hash.slice(1)), whole = (text, count) => /^\d+$/.test(text) && Number(text) < count;
  const named = (key) => data.plain.includes(link.get(key)) ? data.plain.indexOf(link.get(key)) : view[key];
  const up = named("up"), across = hasTime && link.get("across") === "time" ? TIME : named("across");
  if (across !== up) Object.assign(view, {across, up});
  const cell = (link.get("cell") ?? "").split(",");
  if (cell.length === n && cell.every((i, j) => whole(i, data.cells[j]))) view.cell = cell.map(Number);
  if (whole(link.get("step"), data.lastStep + 1)) view.step = Number(link.get("step"));
  if (whole(link.get("map"), maps)) view.map = Number(link.get("map"));
  touched = linked = true;
  controls();
  draw();
};
addEventListener("hashchange", follow);
controls();
if (location.hash) follow();
