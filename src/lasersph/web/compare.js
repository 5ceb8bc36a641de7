/** Two runs side by side: what differs, numbers, particles and curves with the same scales and time. */

import { chart, History, reliefChart } from "./charts.js";
import { chip, h, number, quantity, table } from "./dom.js";
import { getJson, listen } from "./net.js";
import { http } from "./sources.js";
import { mount } from "./viewer.js";

export async function showComparison(place, signal, head, ...ids) {
  const runs = await Promise.all(ids.map((id) => getJson(`api/run/${id}`, { signal })));
  const histories = ids.map((id) => new History(id));
  const end = Math.max(...runs.map((run) => run.end_s));
  document.title = `${runs.map((run) => run.name).join(" and ")} – lasersph`;

  const hosts = runs.map(() => h("div", {}));
  const charts = h("div", { class: "charts row" });
  // Keys in which the cases differ, each in its unit.
  const keys = [...new Set(runs.flatMap((run) => Object.keys(run.resolved)))].sort();
  const textOf = (run, key) => {
    const value = run.resolved[key], unit = run.units[key];
    if (value === undefined || value === null) return "–";
    return unit && typeof value === "number" ? quantity(value, unit, 6) : JSON.stringify(value).replace(/^"|"$/g, "");
  };
  const texts = (key) => runs.map((run) => textOf(run, key));
  const differing = keys.map((key) => [key, ...texts(key)]).filter(([key, one, other]) => key !== "title" && one !== other);
  const names = runs.map((run) => run.name);

  place.replaceChildren(
    h("p", { class: "path" }, h("a", { href: "#/" }, "Runs"), " / comparison"),
    h("h1", {}, "Two runs, one scale"),
    h("div", { class: "pair" }, runs.map((run, k) => h("section", {},
      h("h2", { class: `key ink-${k + 1}` }, h("a", { href: `#/run/${run.id}` }, run.name), " ", chip(run.state)),
      h("p", { class: "quiet" }, run.title), hosts[k]))),
    charts,
    h("h2", {}, "Numbers"), numbersOf(runs),
    h("h2", {}, "What differs"),
    differing.length ? h("div", { class: "differing" }, table(differing, ["key", ...names])) : h("p", { class: "quiet" }, "The cases are the same."));

  // one scale for each field
  const sources = ids.map((id) => http(`api/run/${id}/`));
  const indices = await Promise.all(sources.map((source) => source.index()));
  if (signal.aborted) return;
  const ranges = {};
  for (const { name, range: [low, high] } of indices.flatMap((index) => index.fields)) {
    const known = ranges[name] ?? [low, high];
    ranges[name] = [Math.min(known[0], low), Math.max(known[1], high)];
  }
  let leading = 0; // the viewer that the reader moves; the other shows the frame of the closest time
  const shown = [null, null];
  let isAlike = indices[0].dimensions !== indices[1].dimensions; // else both show the same part of the metal
  const viewers = sources.map((source, k) => mount(hosts[k], source, {
    ranges,
    onFrame: async (frame, time) => {
      shown[k] = frame;
      const boxes = viewers.map((viewer) => viewer.box());
      if (!isAlike && boxes.every(Boolean)) {
        isAlike = true;
        const both = boxes[0].map(([low, high], axis) => [Math.min(low, boxes[1][axis][0]), Math.max(high, boxes[1][axis][1])]);
        for (const viewer of viewers) viewer.setBox(both);
      }
      if (leading !== k) return;
      const other = 1 - k;
      if (!indices[other].is_complete) indices[other] = await sources[other].index();
      const times = indices[other].times;
      if (signal.aborted || leading !== k || !times.length) return;
      const closest = times.reduce((best, one, n) => (Math.abs(one - time) < Math.abs(times[best] - time) ? n : best), 0);
      if (shown[other] !== closest) viewers[other].setFrame(closest);
    },
  }));
  // The viewer that is touched leads.
  for (const [k, host] of hosts.entries()) {
    for (const kind of ["pointerdown", "keydown", "focusin"]) host.addEventListener(kind, () => { leading = k; }, { capture: true });
  }

  // The same charts for both runs, with the columns that either has.
  const relief = await reliefChart(runs, signal);
  if (relief) charts.prepend(relief.element);
  const drawn = new Map();
  const draw = () => {
    const titles = new Map();
    for (const history of histories) for (const [title, unit, curves] of history.charts()) {
      const known = titles.get(title)?.[1] ?? [];
      titles.set(title, [unit, [...known, ...curves.filter(([column]) => !known.some(([other]) => other === column))].slice(0, 2)]);
    }
    for (const [title, [unit, curves]] of titles) {
      const name = curves.map(([column]) => column).join();
      const old = drawn.get(title);
      if (old?.name === name) {
        old.chart.update();
        continue;
      }
      const found = chart(title, unit, curves, histories.map((history, k) => ({ history, name: names[k], pulses: runs[k].pulses })), end);
      if (old) {
        old.chart.element.replaceWith(found.element);
        old.chart.destroy();
      } else charts.append(found.element);
      drawn.set(title, { name, chart: found });
    }
  };
  // Whoever leaves the page takes its pictures along.
  signal.addEventListener("abort", () => {
    for (const viewer of viewers) viewer.destroy();
    relief?.destroy();
    for (const { chart } of drawn.values()) chart.destroy();
  }, { once: true });
  // Events of each run one after the other, so that no row is taken twice.
  for (const [k, id] of ids.entries()) {
    let asked = Promise.resolve();
    listen(id, () => {
      asked = asked.then(() => histories[k].pull(signal)).then((grew) => grew && draw()).catch((error) => {
        if (!signal.aborted) throw error;
      });
    }, signal);
  }
}

/** The results of two runs, and by how much the second differs from the first. */
function numbersOf(runs) {
  if (!runs.every((run) => run.results.length)) return h("p", { class: "quiet" }, "They are compared when both runs are complete.");
  const [first, second] = runs.map((run) => new Map(run.results.map((one) => [one.key, one])));
  const rows = [...new Set([...first.keys(), ...second.keys()])].map((key) => {
    const [one, other] = [first.get(key), second.get(key)];
    return [(one ?? other).words, one?.text ?? "–", other?.text ?? "–", differenceOf(one, other)];
  });
  return table(rows, ["number", ...runs.map((run) => run.name), "difference"]);
}

/** The second number less the first, with its share of the first; a dash where one is missing. */
function differenceOf(one, other) {
  if (!Number.isFinite(one?.value) || !Number.isFinite(other?.value)) return "–";
  const more = other.value - one.value, sign = more > 0 ? "+" : "−";
  if (more === 0) return "none";
  const share = one.value ? `, ${sign}${number(Math.abs((100 * more) / one.value), 2)} %` : "";
  return `${sign}${quantity(Math.abs(more), one.unit, 3)}${share}`;
}
