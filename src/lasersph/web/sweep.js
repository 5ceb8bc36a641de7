/** A sweep: its map, whose points open their runs, its table, and the answer of a calibration. */

import { chip, h, quantity, table, unitOf } from "./dom.js";
import { drawMap } from "./map.js";
import { getJson, pause } from "./net.js";
import { calibrationOf } from "./posterior.js";

const EVERY = 3000;

export async function showSweep(place, signal, head, id) {
  let sweep = await getJson(`api/sweep/${id}`, { signal });
  document.title = `${sweep.name} – lasersph`;
  const keys = Object.keys(sweep.units);
  const chosen = { x: keys[0], y: keys[1] ?? "", column: sweep.main[0] ?? "" };
  const map = h("div", { class: "map" });
  const rows = h("div", {}), warnings = h("div", {});
  const state = h("p", { class: "state", "aria-live": "polite" });

  // State, table and warnings at once; the field comes when the server has it.
  const draw = () => {
    const counts = Object.entries(sweep.counts).filter(([, count]) => count).map(([name, count]) => `${count} ${name}`);
    state.replaceChildren(`${sweep.rows.length} runs: ${counts.join(", ")}`);
    rows.replaceChildren(drawTable(sweep));
    warnings.replaceChildren(...sweep.warnings.map((one) => h("p", { class: "warning" }, `${one.runs} run${one.runs > 1 ? "s" : ""}: ${one.text}`)));
    drawField().catch((error) => {
      if (!signal.aborted) throw error;
    });
  };

  /** The points at once, and what the server says of the field between them when it comes. */
  let drawn = "", last = 0;
  const drawField = async () => {
    const { x, y, column } = chosen, asked = new URLSearchParams({ x, y, show: column });
    const wanted = `${asked} ${JSON.stringify(sweep.counts)}`, mine = ++last;
    if (drawn === wanted) return;
    if (!drawn.startsWith(`${asked} `)) map.replaceChildren(drawMap(sweep, chosen, null));
    if (!column || sweep.study) return;
    const found = await getJson(`api/sweep/${id}/map?${asked}`, { signal });
    if (mine !== last) return;
    drawn = wanted;
    map.replaceChildren(found.refused ? h("p", { class: "quiet" }, `Points alone: ${found.refused}`) : "", drawMap(sweep, chosen, found.refused ? null : found));
  };
  const select = (words, entries, name) => h("label", {}, h("span", {}, words), h("select", {
    onchange: (event) => { chosen[name] = event.target.value; draw(); } },
  entries.map(([value, text]) => h("option", { value, selected: value === chosen[name] }, text))));

  place.replaceChildren(
    h("p", { class: "path" }, h("a", { href: "#/" }, "Runs"), ` / ${sweep.name}`),
    h("h1", {}, sweep.title), state, warnings,
    ...(sweep.calibration ? calibrationOf(sweep.calibration) : []),
    h("h2", {}, sweep.study ? "Numbers" : "Map"),
    h("form", { class: "tools", onsubmit: (event) => event.preventDefault() },
      select("Across", keys.map((key) => [key, key]), "x"),
      select("Up", [["", "the number itself"], ...keys.map((key) => [key, key])], "y"),
      select("Number", sweep.columns.map((one) => [one, sweep.words[one] ? `${sweep.words[one]} (${one})` : one]), "column")),
    map, h("h2", {}, "Runs"), rows);
  // Ask again until no run can change any more.
  for (;;) {
    draw();
    if (sweep.rows.every((row) => ["complete", "failed", "wrong"].includes(row.status))) return;
    await pause(EVERY, signal);
    sweep = await getJson(`api/sweep/${id}`, { signal });
  }
}

/** The runs with their keys, main numbers and state. */
function drawTable(sweep) {
  const keys = Object.keys(sweep.units);
  const columns = sweep.main;
  const rows = sweep.rows.map((row) => [
    row.id ? h("a", { href: `#/run/${row.id}` }, row.run) : row.run,
    ...keys.map((key) => (typeof row.settings[key] === "number" ? quantity(row.settings[key], sweep.units[key]) : String(row.settings[key]))),
    ...columns.map((one) => quantity(row.numbers[one], unitOf(one))),
    h("span", {}, chip(row.status), row.reason && h("span", { class: "error" }, ` ${row.reason}`))]);
  return table(rows, ["run", ...keys, ...columns.map((one) => sweep.words[one] ?? one), "state"]);
}
