// Drives a report like a reader would, and leaves the outcome in the data-selftest of its root element.
// scripts/check-report.sh puts it at the end of a page and opens that in a browser.
"use strict";
(() => {
const failures = [];
const check = (holds, what) => { if (!holds) failures.push(what); };
const get = (selector) => document.querySelector(selector);
const input = (element, value) => {
  if (element.type === "checkbox") element.checked = value; else element.value = value;
  element.dispatchEvent(new Event("input", {bubbles: true}));
};
const drawing = (selector) => get(selector).innerHTML;
const layers = ["#map .heat", "#map .regions", "#map .arrows", "#map .runs", "#map .axes", "#map .scale",
  "#section .regions", "#section .curve", "#section .axes"];
const facts = () => [...document.querySelectorAll("#facts dd")].map((fact) => fact.textContent);

// Two drawings are the same if their numbers are, up to the last digit.
const number = /-?\d+(?:\.\d+)?/g;
const same = (a, b) => {
  const [x, y] = [a, b].map((text) => (text.match(number) ?? []).map(Number));
  return a.replace(number, "#") === b.replace(number, "#") && x.every((v, i) => Math.abs(v - y[i]) < 0.021);
};

try {
  const map = get("#map"), n = document.querySelectorAll("#up option").length || 1;
  const before = layers.map(drawing), told = facts();
  const legend = () => [...document.querySelectorAll(".entry")].filter((entry) => !entry.hidden).map((entry) => entry.textContent.trim());
  const explained = legend(), box = map.getAttribute("viewBox");
  check(!get("#controls").hidden, "no controls");
  const arrows = get("[data-show=arrows]");
  input(arrows, true);
  layers.forEach((layer, i) => check(same(before[i], drawing(layer)), `${layer} is redrawn differently`));
  check(told.join() === facts().join(), `facts are told differently: ${told.join("; ")} | ${facts().join("; ")}`);
  check(explained.join() === legend().join(), `the legend changes: ${explained.join("; ")} | ${legend().join("; ")}`);
  check(map.getAttribute("viewBox") === box, "the map changes its size");
  input(arrows, false);
  check(drawing("#map .arrows") === "", "arrows stay");
  check(!legend().some((text) => text.includes("best action")), "the legend has arrows that are not drawn");
  input(arrows, true);

  // A click on the middle of the map.
  const place = map.getBoundingClientRect(), at = (x, y) => ({
    bubbles: true,
    clientX: place.left + x / 720 * place.width,
    clientY: place.top + y / 720 * place.width,
  });
  const border = get("#map .axes .border"), side = (name) => Number(border.getAttribute(name));
  const clicks = [[0.5, 0.5], [0.25, 0.77], [0.42, 0.25], [0.65, 0.68], [0.52, 0.87]]
    .map(([x, y]) => [side("x") + x * side("width"), side("y") + y * side("height")]);
  const seen = new Set();
  let steered = 0;
  for (const [x, y] of clicks) {
    map.dispatchEvent(new MouseEvent("click", at(x, y)));
    seen.add(get("#fact-cell").textContent + get("#fact-value").textContent);
    check(get("#map .picked") !== null, "the picked cell is not shown");
    const leads = get("#map .leads") !== null, best = get("#fact-best").textContent;
    check(leads === (best !== "none"), `best action "${best}" but leads drawn: ${leads}`);
    if (leads) {
      steered++;
      check(Number(get("#fact-enabled").textContent) > 0, "steering without an enabled action");
      check(get("#map .enabled") !== null || get("[data-show=enabled]") === null, "enabled actions are not shown");
    }
    check(get("#picked-spoken").textContent.startsWith(get("#fact-cell").textContent), "nothing is spoken");
  }
  check(seen.size === clicks.length, "clicks on different places pick the same cell");
  check(steered > 0, "no click found a cell with an action");
  map.dispatchEvent(new MouseEvent("click", at(10, 10)));
  check(seen.has(get("#fact-cell").textContent + get("#fact-value").textContent), "a click outside picks a cell");

  // What is under the pointer is told, and only there.
  const hover = get("#hover");
  map.dispatchEvent(new PointerEvent("pointermove", at(...clicks[0])));
  check(/: [01]\.\d{6}, \w+$/.test(hover.textContent), `under the pointer: "${hover.textContent}"`);
  map.dispatchEvent(new PointerEvent("pointermove", at(10, 10)));
  check(hover.textContent === "", "something is told outside of the map");

  // The keyboard.
  const press = (key) => map.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true}));
  check(map.tabIndex === 0, "the map cannot be focused");
  const here = facts().join();
  press("ArrowUp");
  check(facts().join() !== here, "arrow keys do nothing");
  press("ArrowDown");
  check(facts().join() === here, "arrow keys do not go back");
  press("ArrowRight");
  check(facts().join() !== here, "arrow keys do nothing sideways");
  press("Home");
  check(facts()[0] === told[0], "Home does not go back to the start");

  // Other planes.
  const step = get("#step");
  if (step) {
    const first = drawing("#map .heat");
    input(step, step.max);
    check(drawing("#map .heat") !== first, "the step changes nothing");
    check(step.nextElementSibling.textContent !== "", "the step is not told");
    input(step, 0);
    check(drawing("#map .heat") === first, "the step does not go back");
  }
  const slice = get("[data-slice]");
  if (slice) {
    const first = drawing("#map .heat"), value = slice.value;
    input(slice, value === "0" ? slice.max : 0);
    check(drawing("#map .heat") !== first, "the slice changes nothing");
    input(slice, value);
    check(drawing("#map .heat") === first, "the slice does not go back");
  }
  if (n > 1) {
    const first = drawing("#map .heat"), [across, up] = [get("#across").value, get("#up").value];
    input(get("#up"), across);
    check(get("#across").value === up && get("#up").value === across, "the axes do not swap");
    check(drawing("#map .heat") !== first, "other axes, same map");
    const names = [...document.querySelectorAll("#up option")].map((option) => option.textContent);
    const [one, two] = [names[across], names[up]];
    const named = (axes, ...names) => names.every((name) => get(axes).textContent.includes(name));
    check(named("#map .axes", one, two), "axes are not named");
    for (const option of get("#across").options) {
      input(get("#across"), option.value);
      check(!/NaN|Infinity|undefined/.test(map.outerHTML), `the map across ${option.text} has no numbers`);
      check(get("#across").value !== get("#up").value, "a plane with one axis only");
    }
    input(get("#across"), across);
    input(get("#up"), up);
    check(drawing("#map .heat") === first, "the axes do not go back");
    const curve = drawing("#section .curve");
    input(get("#along"), up);
    check(drawing("#section .curve") !== curve && named("#section .axes", two), "one cross-section only");
  }
  // Links lead back to what was shown.
  const link = location.hash, shown = drawing("#map .heat") + facts().join();
  check(/^#across=[^&]+&up=[^&]+&step=\d+&cell=[\d,]+/.test(link), `no link to what is shown: ${link}`);
  input(arrows, true);
  press("ArrowUp");
  press("ArrowLeft");
  check(location.hash !== link, "the link stays");
  history.replaceState(null, "", link);
  dispatchEvent(new HashChangeEvent("hashchange"));
  check(drawing("#map .heat") + facts().join() === shown, "the link leads elsewhere");
  history.replaceState(null, "", "#across=nowhere&up=<b>&step=-1&cell=1e9,x");
  dispatchEvent(new HashChangeEvent("hashchange"));
  check(drawing("#map .heat") + facts().join() === shown, "a link that makes no sense leads somewhere");
  const between = get("[data-show=between]");
  if (between) {
    const first = drawing("#map .runs");
    input(between, true);
    check(drawing("#map .runs").length > first.length, "no steps in between");
  }
  check(!/NaN|Infinity|undefined/.test(document.body.innerHTML.replace(/<script[\s\S]*?<\/script>/g, "")), "NaN is shown");
  check(!document.querySelector("main img, main b, main script"), "a name became markup");
  const wide = document.documentElement;
  check(wide.scrollWidth <= wide.clientWidth, `the page is ${wide.scrollWidth} wide, the window ${wide.clientWidth}`);
} catch (error) {
  failures.push(String(error.stack ?? error));
}
document.documentElement.dataset.selftest = failures.length ? `failed: ${failures.join(" | ")}` : "passed";
})();
