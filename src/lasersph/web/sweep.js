/** A sweep: its map, whose points open their runs, its table, and the answer of a calibration. */

import { chip, fittingUnit, h, number, quantity, svg, table, unitOf } from "./dom.js";
import { getJson, pause } from "./net.js";

const EVERY = 3000;
const WIDTH = 720, HEIGHT = 400, LEFT = 78, RIGHT = 96, TOP = 14, BOTTOM = 56;
const HEAT = [[48, 18, 59], [122, 27, 109], [187, 55, 84], [237, 105, 37], [252, 190, 60], [255, 244, 190]];
const PREFERRED = ["melt.depth_half_max_m", "melt.depth_max_m", "crater.depth_m", "temperature_max_K"];

export async function showSweep(place, signal, head, id) {
  let sweep = await getJson(`api/sweep/${id}`, { signal });
  document.title = `${sweep.name} – lasersph`;
  const keys = Object.keys(sweep.units);
  const chosen = { x: keys[0], y: keys[1] ?? "", column: PREFERRED.find((one) => sweep.columns.includes(one)) ?? sweep.columns[0] ?? "" };
  const map = h("div", { class: "map" });
  const rows = h("div", {});
  const state = h("p", { class: "state", "aria-live": "polite" });

  const draw = () => {
    const counts = Object.entries(sweep.counts).filter(([, count]) => count).map(([name, count]) => `${count} ${name}`);
    state.replaceChildren(`${sweep.rows.length} runs: ${counts.join(", ")}`);
    map.replaceChildren(drawMap(sweep, chosen));
    rows.replaceChildren(drawTable(sweep));
  };
  const select = (words, entries, name) => h("label", {}, h("span", {}, words), h("select", {
    onchange: (event) => { chosen[name] = event.target.value; draw(); } },
  entries.map(([value, text]) => h("option", { value, selected: value === chosen[name] }, text))));

  place.replaceChildren(
    h("p", { class: "path" }, h("a", { href: "#/" }, "Runs"), ` / ${sweep.name}`),
    h("h1", {}, sweep.title), state,
    ...(sweep.calibration ? calibrationOf(sweep.calibration) : []),
    h("h2", {}, "Map"),
    h("form", { class: "tools", onsubmit: (event) => event.preventDefault() },
      select("Across", keys.map((key) => [key, key]), "x"),
      select("Up", [["", "the number itself"], ...keys.map((key) => [key, key])], "y"),
      select("Number", sweep.columns.map((one) => [one, one]), "column")),
    map, h("h2", {}, "Runs"), rows);
  for (;;) {
    draw();
    if (sweep.rows.every((row) => ["complete", "failed", "wrong"].includes(row.status))) return;
    await pause(EVERY, signal);
    sweep = await getJson(`api/sweep/${id}`, { signal });
  }
}

function colorAt(share) {
  const place = Math.max(0, Math.min(1, share)) * (HEAT.length - 1), k = Math.min(Math.floor(place), HEAT.length - 2);
  return `rgb(${HEAT[k].map((part, c) => Math.round(part + (place - k) * (HEAT[k + 1][c] - part))).join()})`;
}

/** Ticks at round numbers, with the words for each. */
function ticksOf(low, high, unit) {
  const [name, size] = unit === "J/m^2" ? ["J/cm²", 1e4] : fittingUnit(Math.max(Math.abs(low), Math.abs(high)), unit);
  const rough = (high - low) / size / 5, ten = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].find((one) => one * ten >= rough) * ten;
  const found = [];
  for (let k = Math.ceil(low / size / step - 1e-9); k * step <= (high / size) * (1 + 1e-9); k += 1) found.push([k * step * size, number(k * step)]);
  return [found, name];
}

function drawMap(sweep, { x, y, column }) {
  const rows = sweep.rows.filter((row) => typeof row.settings[x] === "number" && (!y || typeof row.settings[y] === "number"));
  const values = rows.map((row) => row.numbers[column]).filter(Number.isFinite);
  if (!rows.length || !values.length) return h("p", { class: "quiet" }, "No complete run has this number yet.");
  const low = Math.min(...values), high = Math.max(...values), unit = unitOf(column);
  const across = rows.map((row) => row.settings[x]);
  const up = rows.map((row) => (y ? row.settings[y] : row.numbers[column])).filter(Number.isFinite);
  const padded = (all) => {
    const least = Math.min(...all), most = Math.max(...all), room = 0.06 * (most - least || Math.abs(most) || 1);
    return [least - room, most + room];
  };
  const [x0, x1] = padded(across), [y0, y1] = padded(up);
  const toX = (value) => LEFT + ((WIDTH - LEFT - RIGHT) * (value - x0)) / (x1 - x0);
  const toY = (value) => HEIGHT - BOTTOM - ((HEIGHT - TOP - BOTTOM) * (value - y0)) / (y1 - y0);
  const [xTicks, xUnit] = ticksOf(x0, x1, sweep.units[x]), [yTicks, yUnit] = ticksOf(y0, y1, y ? sweep.units[y] : unit);
  const points = rows.map((row) => {
    const value = row.numbers[column], known = Number.isFinite(value);
    if (!known && !y) return null;
    const words = `${row.run}: ${x} ${quantity(row.settings[x], sweep.units[x])}${y ? `, ${y} ${quantity(row.settings[y], sweep.units[y])}` : ""}, ${known ? quantity(value, unit) : row.status}`;
    const dot = svg("circle", { cx: toX(row.settings[x]), cy: toY(y ? row.settings[y] : value), r: 8,
      fill: known ? colorAt((value - low) / (high - low || 1)) : "none", class: known ? "point" : "point unknown" }, svg("title", {}, words));
    return row.id ? svg("a", { href: `#/run/${row.id}`, "aria-label": words }, dot) : dot;
  });
  const bar = Array.from({ length: 40 }, (_, k) => svg("rect", { x: WIDTH - RIGHT + 26, width: 14, height: (HEIGHT - TOP - BOTTOM) / 40 + 0.5,
    y: TOP + ((HEIGHT - TOP - BOTTOM) * (39 - k)) / 40, fill: colorAt(k / 39) }));
  return h("figure", { class: "chart" },
    h("figcaption", {}, h("b", {}, column), " each point opens its run"),
    svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "axes", role: "group", "aria-label": `${column} over ${x}${y ? ` and ${y}` : ""}` },
      xTicks.map(([at, words]) => [svg("line", { x1: toX(at), x2: toX(at), y1: TOP, y2: HEIGHT - BOTTOM }), svg("text", { x: toX(at), y: HEIGHT - BOTTOM + 20, "text-anchor": "middle" }, words)]),
      yTicks.map(([at, words]) => [svg("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: toY(at), y2: toY(at) }), svg("text", { x: LEFT - 8, y: toY(at) + 4, "text-anchor": "end" }, words)]),
      svg("text", { x: (LEFT + WIDTH - RIGHT) / 2, y: HEIGHT - 12, "text-anchor": "middle" }, `${x} [${xUnit || "1"}]`),
      svg("text", { x: 16, y: (TOP + HEIGHT - BOTTOM) / 2, "text-anchor": "middle", transform: `rotate(-90 16 ${(TOP + HEIGHT - BOTTOM) / 2})` }, `${y || column} [${yUnit || "1"}]`),
      bar, svg("text", { x: WIDTH - RIGHT + 46, y: TOP + 10 }, quantity(high, unit, 3)), svg("text", { x: WIDTH - RIGHT + 46, y: HEIGHT - BOTTOM }, quantity(low, unit, 3)),
      points.filter(Boolean)));
}

function drawTable(sweep) {
  const keys = Object.keys(sweep.units);
  const columns = PREFERRED.filter((one) => sweep.columns.includes(one));
  const rows = sweep.rows.map((row) => [
    row.id ? h("a", { href: `#/run/${row.id}` }, row.run) : row.run,
    ...keys.map((key) => (typeof row.settings[key] === "number" ? quantity(row.settings[key], sweep.units[key]) : String(row.settings[key]))),
    ...columns.map((one) => quantity(row.numbers[one], unitOf(one))),
    h("span", {}, chip(row.status), row.reason && h("span", { class: "error" }, ` ${row.reason}`))]);
  return table(rows, ["run", ...keys, ...columns, "state"]);
}

/** The unknowns with their bands, the posterior of each, and how well the data fit. */
function calibrationOf(found) {
  const unknowns = Object.entries(found.unknowns);
  return [h("h2", {}, "Calibration"),
    ...found.warnings.map((text) => h("p", { class: "warning" }, text)),
    h("div", { class: "charts row" }, unknowns.map(([name, one]) => posteriorOf(name, one, found.posterior[name]))),
    table(found.data.map((one) => [`${one.measurement}: ${one.number}`,
      `${quantity(one.measured, one.unit)} ± ${quantity(one.standard_error, one.unit, 2)}`, quantity(one.computed, one.unit), number(one.pull, 2)]),
    ["measured number", "measured", "computed", "standard deviations off"]),
    h("p", { class: "quiet" }, `χ² = ${number(found.chi_squared.value, 3)} with ${found.chi_squared.degrees_of_freedom} degrees of freedom, p = ${number(found.chi_squared.probability, 2)}`)];
}

function posteriorOf(name, one, { edges, density }) {
  const low = edges[0], high = edges.at(-1), most = Math.max(...density);
  const toX = (value) => (100 * (value - low)) / (high - low || 1);
  const text = `${number(one.mean)} ± ${number(one.sd, 2)} ${one.unit}`;
  return h("figure", { class: "chart posterior" },
    h("figcaption", {}, h("b", {}, name), h("span", {}, text)),
    svg("svg", { viewBox: "0 0 100 46", preserveAspectRatio: "none", role: "img", "aria-label": `posterior of ${name}: ${text}` },
      svg("rect", { x: toX(one.low_95), width: toX(one.high_95) - toX(one.low_95), y: 0, height: 46, class: "band" }),
      density.map((value, k) => svg("rect", { x: toX(edges[k]), width: toX(edges[k + 1]) - toX(edges[k]) + 0.1, y: 46 - (42 * value) / most, height: (42 * value) / most, class: "bin" }))),
    h("p", { class: "ends" }, h("span", {}, number(low)), h("span", {}, `95 %: ${number(one.low_95)} to ${number(one.high_95)} ${one.unit}`), h("span", {}, number(high))));
}
