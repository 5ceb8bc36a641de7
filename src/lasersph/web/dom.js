/** Elements, and numbers in words. */

/**
 * An element: h("p", {class: "quiet", onclick: f}, "text", child). Attributes that are null or
 * false are left out; children that are null or false as well.
 */
export function h(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  fill(element, attributes, children);
  return element;
}

const SVG = "http://www.w3.org/2000/svg";

/** The same for SVG. */
export function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS(SVG, tag);
  fill(element, attributes, children);
  return element;
}

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
}

/** A table of rows of words; the first column names, the others are numbers. */
export function table(rows, head = []) {
  const top = head.length ? h("thead", {}, h("tr", {}, head.map((cell) => h("th", { scope: "col" }, cell)))) : null;
  const body = rows.map(([name, ...cells]) =>
    h("tr", {}, h("th", { scope: "row" }, name), cells.map((cell) => h("td", {}, cell))));
  return h("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": head[0] || "table" },
    h("table", {}, top, h("tbody", {}, body)));
}

/** One box of all warnings, "" without any; of several each has a line, whole on a click. */
export function warningsBox(texts) {
  if (!texts.length) return "";
  return h("div", { class: "warnings" }, texts.length < 2
    ? h("p", {}, texts)
    : texts.map((text) => h("details", {}, h("summary", {}, text))));
}

const PREFIXED = { m: 1, "m^2": 2, "m^3": 3, s: 1, J: 1, W: 1, Pa: 1, Hz: 1 };
const PREFIXES = ["f", "p", "n", "µ", "m", "", "k", "M", "G", "T"];
const NO_KILO = ["m", "m^2", "m^3", "s"];

/** Name and size of the unit with the prefix that fits a value in SI: [ "nm", 1e-9 ]. */
export function fittingUnit(value, unit) {
  if (unit === "J/m^2" || unit === "W/m^2") return [`${unit[0]}/cm²`, 1e4]; // as light is told everywhere
  const shown = unit.replace("^2", "²").replace("^3", "³");
  if (!(unit in PREFIXED) || !value) return [shown, 1];
  const step = 1000 ** PREFIXED[unit];
  let power = Math.floor(Math.log10(Math.abs(value)) / Math.log10(step) + 1e-9);
  power = Math.max(-5, Math.min(power, NO_KILO.includes(unit) ? 0 : 4));
  return [PREFIXES[power + 5] + shown, step ** power];
}

/** A number with `digits` significant digits, without superfluous zeros. */
export function number(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${Number(mantissa)}·10${[...String(Number(exponent))].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("")}`;
  }
  return String(Number(value.toPrecision(digits)));
}

/** A value in SI units as people read it: (8e-9, "m") gives "8 nm". */
export function quantity(value, unit = "", digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const [name, size] = fittingUnit(value, unit);
  return `${number(value / size, digits)} ${name}`.trim();
}

const DECADES = [[1, 2, 5], [1, 2, 3, 4, 5, 7]]; // numbers of a decade on a logarithmic axis
const LEAST_TICKS = 4;

/** Ticks of an axis {low, high, isLogarithmic} at round numbers, as [value, words], and the name of their unit. */
export function ticksOf({ low, high, isLogarithmic }, unit) {
  const most = Math.max(Math.abs(low), Math.abs(high));
  const [name, size] = fittingUnit(most, unit);
  for (const steps of isLogarithmic ? DECADES : []) {
    const found = [];
    for (let ten = 10 ** Math.floor(Math.log10(low / size)); ten * size <= high; ten *= 10) {
      for (const one of steps) if (one * ten * size >= low && one * ten * size <= high) found.push([one * ten * size, number(one * ten)]);
    }
    if (found.length >= LEAST_TICKS) return [found, name];
  }
  const found = []; // also of a logarithmic axis that covers too little of a decade
  const rough = (high - low) / size / 6 || 1, ten = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].find((one) => one * ten >= rough) * ten;
  for (let k = Math.ceil(low / size / step - 1e-9); k * step <= (high / size) * (1 + 1e-9); k += 1) found.push([k * step * size, number(k * step)]);
  return [found, name];
}

/** Unit that a key of a result ends in: depth_max_m, temperature_max_K. */
export function unitOf(key) {
  const ends = [["_K_s", "K/s"], ["_K_m", "K/m"], ["_m_s", "m/s"], ["_m3", "m^3"], ["_m2", "m^2"],
    ["_W_m2", "W/m^2"], ["_Pa", "Pa"], ["_m", "m"], ["_s", "s"], ["_K", "K"], ["_J", "J"], ["_kg", "kg"]];
  return (ends.find(([end]) => key.endsWith(end)) || ["", ""])[1];
}

/** How long ago a moment was, in words. */
export function ago(seconds) {
  const passed = Math.max(0, Date.now() / 1000 - seconds);
  for (const [size, word] of [[86400, "d"], [3600, "h"], [60, "min"]]) {
    const count = Math.floor(passed / size);
    if (count) return `${count} ${word} ago`;
  }
  return "just now";
}

const STATES = {
  complete: "complete", running: "running", stopped: "stopped", damaged: "damaged", failed: "failed",
  wrong: "refused", missing: "not begun", gone: "removed", starting: "starting",
};

/** The state of a run as a chip. */
export function chip(state) {
  return h("span", { class: `chip ${state}` }, STATES[state] ?? state);
}

/** A curve without axes, for a card; above it is room for a word. */
export function sparkline(values) {
  const low = Math.min(...values), high = Math.max(...values), count = Math.max(values.length - 1, 1);
  const points = values.map((value, k) =>
    `${((100 * k) / count).toFixed(2)},${(46 - (32 * (value - low)) / (high - low || 1)).toFixed(2)}`);
  return svg("svg", { viewBox: "0 0 100 50", preserveAspectRatio: "none", class: "curve", "aria-hidden": "true" },
    svg("polygon", { points: `0,50 ${points.join(" ")} 100,50` }),
    svg("polyline", { points: points.join(" ") }));
}
