/** The page of one run: state, numbers, particles, curves, figures, case, log. */

import { chart, History, reliefChart } from "./charts.js";
import { chip, h, quantity, table, warningsBox } from "./dom.js";
import { moment, partDone } from "./moments.js";
import { ask, getJson, listen } from "./net.js";
import { http } from "./sources.js";
import { mount } from "./viewer.js";

const BESIDE = 2; // charts beside the particles; the others stand below

export async function showRun(place, signal, head, id) {
  const base = `api/run/${id}/`;
  const asked = getJson(`api/run/${id}`, { signal }); // while the particles are on their way
  const history = new History(id);
  const beside = h("div", { class: "charts" }), charts = h("div", { class: "charts row" });
  const drawn = new Map();
  const top = h("div", { class: "top" });
  const note = h("p", { class: "error", role: "alert", hidden: true });
  const numbers = h("dl", { class: "large" });
  const log = h("pre", { tabindex: "0", "aria-label": "run.log" });
  const below = h("div", { class: "below" });
  const scene = h("div", { class: "scene" });
  const path = h("p", { class: "path" }, h("a", { href: "#/" }, "Runs"));
  let viewer = null, sizes = null, run = null, relief = null;

  place.replaceChildren(path, top, note, numbers, h("div", { class: "wide" }, scene, beside), charts, below,
    h("section", {}, h("h2", {}, "Log"), log));

  // Stop or resume, by the server; its refusal is shown.
  const change = async (event) => {
    event.target.disabled = true;
    try {
      await ask(`${base}${run.state === "running" ? "stop" : "resume"}`, { signal, method: "POST" });
    } catch (error) {
      if (signal.aborted) return;
      event.target.disabled = false;
      note.textContent = error.message;
      note.hidden = false;
    }
  };

  // Title, state and numbers, which change with every step.
  const drawTop = () => {
    const done = partDone(run);
    const end = run.pulses.length ? `${run.pulses.length} pulses` : quantity(run.end_s, "s");
    const state = h("p", { class: "state", "aria-live": "polite" }, chip(run.state), " ",
      run.state === "complete"
        ? `${quantity(run.time_s, "s")} computed in ${run.took}`
        : `${moment(run.time_s, run.pulses, quantity)} of ${end}, ${Math.floor(100 * done)} %, step ${run.step}`);
    top.replaceChildren(h("h1", {}, run.title || run.name), state,
      run.state !== "complete" ? h("progress", { value: done, max: 1, "aria-label": "time reached" }) : "",
      run.may_run ? h("p", { class: "actions" }, ["running", "stopped"].includes(run.state) && h("button", { onclick: change }, run.state === "running" ? "Stop" : "Resume"),
        h("a", { class: "button", href: `#/again/${id}` }, "Run again with changes")) : "",
      h("p", { class: "verdict" }, run.verdict ?? [run.solver, run.material].filter(Boolean).join(", ")),
      warningsBox(run.warnings));
    numbers.replaceChildren(...run.numbers.map((one) => h("div", {},
      h("dt", {}, one.words), h("dd", {}, one.text, one.error && h("small", {}, ` ± ${one.error}`)), one.at && h("dd", { class: "at" }, `at ${one.at}`))));
  };

  // Figures, notes, case and tables, which change with the state.
  const drawBelow = () => below.replaceChildren(...[
    run.figures.length > 0 && h("section", {}, h("h2", {}, "Figures"), h("div", { class: "figures" }, run.figures.map((one) =>
      h("figure", {}, h("a", { href: `${base}figure/${one.name}` },
        h("img", { src: `${base}figure/${one.name}?${sizes?.figures ?? ""}`, loading: "lazy", alt: one.name.replaceAll("-", " ") })),
      h("figcaption", {}, one.caption))))),
    run.notes?.length > 0 && h("section", {}, h("h2", {}, "Notes"), ...run.notes.map((text) => h("p", { class: "note" }, text))),
    h("section", {}, h("h2", {}, "Case"), caseOf(run)),
    ...run.tables.map((one) => h("details", {}, h("summary", {}, one.title), table(one.rows, one.head)))].filter(Boolean));

  /** The relief stands first below the particles: it is what stays of a texture. */
  const drawRelief = async () => {
    if (relief || !run.has_relief) return;
    relief = await reliefChart([run], signal);
    charts.prepend(relief.element);
  };

  // A chart is kept as long as it shows the same curves.
  const drawCharts = () => {
    for (const [title, unit, curves] of history.charts()) {
      const name = `${title} ${curves.length}`;
      const old = drawn.get(title);
      if (old?.name === name) {
        old.chart.update();
        continue;
      }
      const found = chart(title, unit, curves, [{ history, name: run.name, pulses: run.pulses }], run.end_s);
      if (old) {
        old.chart.element.replaceWith(found.element);
        old.chart.destroy();
      } else (beside.children.length < BESIDE ? beside : charts).append(found.element);
      drawn.set(title, { name, chart: found });
    }
  };

  // A viewer of its own for each start of the run: earlier frames are of another one.
  const start = () => {
    viewer?.destroy();
    const host = h("div", {});
    scene.replaceChildren(host);
    viewer = mount(host, http(base), { live: run?.state === "running" });
  };

  /** Fetch what an event says to have changed; a later event waits for an earlier one. */
  let waiting = null, busy = false;
  const follow = async (found) => {
    waiting = found;
    if (busy) return;
    busy = true;
    try {
      while (waiting && !signal.aborted) {
        const now = waiting, before = sizes;
        waiting = null;
        sizes = now;
        note.textContent = now.note ?? "";
        note.hidden = !now.note;
        // The folder was removed.
        if (now.state === "gone") {
          run.state = "gone";
          drawTop();
          return;
        }
        // The run was started anew: its history and frames begin again.
        if (before && now.started !== before.started) {
          history.clear();
          start();
        }
        // Rows, log and state, each where the event says that it grew.
        const grew = await history.pull(signal);
        if (grew) drawCharts();
        if (!before || now.log !== before.log) log.textContent = await (await ask(`${base}log`, { signal })).text();
        if (!before || grew || now.state !== before.state || now.figures !== before.figures || now.report !== before.report) {
          const figures = run.figures.length, state = run.state;
          run = await getJson(`api/run/${id}`, { signal });
          drawTop();
          await drawRelief();
          if (!before || run.figures.length !== figures || run.state !== state) drawBelow();
          if (run.state !== state && run.state === "running") viewer.setLive(true); // it ends that itself, with the last frame
        }
      }
    } finally {
      busy = false;
    }
  };

  // Whoever leaves the page takes its pictures along.
  signal.addEventListener("abort", () => {
    viewer?.destroy();
    relief?.destroy();
    for (const { chart } of drawn.values()) chart.destroy();
  }, { once: true });
  // Particles first: they take longest.
  start();
  try {
    run = await asked;
  } catch (error) {
    viewer.destroy();
    throw error;
  }
  document.title = `${run.name} – lasersph`;
  path.append(...(run.sweep ? [" / ", h("a", { href: `#/sweep/${run.sweep}` }, "sweep")] : []), ` / ${run.name}`);
  viewer.setLive(run.state === "running");
  drawTop();
  drawBelow();
  listen(id, (found) => follow(found).catch((error) => {
    if (!signal.aborted) throw error;
  }), signal);
}

/** Changes of the case file, the file, and every value. */
function caseOf(run) {
  const changed = run.changes.length
    ? table(run.changes.map((one) => [one.key, one.was || "–", one.now]), ["changed", "in the case file", "computed with"])
    : h("p", { class: "quiet" }, "Nothing was changed of the case file.");
  const values = Object.entries(run.resolved).map(([key, value]) => [key, typeof value === "string" ? value : JSON.stringify(value)]);
  return [changed,
    h("details", {}, h("summary", {}, "The case file"), h("pre", { tabindex: "0" }, run.case_text)),
    h("details", {}, h("summary", {}, "Every value, SI"), table(values)),
    h("p", { class: "quiet" }, `Case ${run.case_hash}; `, Object.entries(run.versions).map(([name, version]) => `${name} ${version}`).join(", "),
      run.has_report && [". ", h("a", { href: `api/run/${run.id}/report`, target: "_blank", rel: "noopener" }, "Report")])];
}
