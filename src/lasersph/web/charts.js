/** Curves of history.csv and reliefs, drawn by uPlot, and the reading of what grows in that file. */

import { fittingUnit, h, number } from "./dom.js";
import { ask, getJson } from "./net.js";
import { TimeAxis } from "./time_axis.js";

/** Charts in the order shown: title, unit, curves as [column, words]. Those without data are left out. */
export const CHARTS = [
  ["Temperature", "K", [["temperature_max_K", "highest"], ["temperature_at_maximum_K", "at the brightest place"],
    ["temperature_surface_min_K", "coldest of the surface"]]],
  ["Melt depth", "m", [["melt_depth_any_m", "any melt"], ["melt_depth_half_m", "half molten"], ["melt_depth_m", "fluid"]]],
  ["Melt width", "m", [["melt_width_any_m", "any melt"], ["melt_width_half_m", "half molten"], ["melt_width_m", "fluid"]]],
  ["Flow", "m/s", [["flow_speed_max_m_s", "fastest particle"], ["flow_surface_speed_max_m_s", "surface"]]],
  ["Crater", "m", [["crater_depth_m", "depth on the axis"], ["crater_depth_max_m", "deepest"]]],
];
const DASHES = [[], [6, 4], [2, 3]];
const OPEN = 2; // of uPlot: a row without a value leaves a line open to the next row that has one
const PAUSE = "pause"; // what limits the step that jumps over one

/** The rows of a run, which grow. */
export class History {
  constructor(id) {
    this.id = id;
    this.clear();
  }

  clear() {
    this.next = 0;
    this.names = null;
    this.columns = {};
    this.pauses = []; // rows at the end of a pause between pulses that was jumped over
  }

  /** First and last time of what was computed between two pauses [s]. */
  spans() {
    const times = this.columns.time_s ?? [], firsts = [0, ...this.pauses];
    return times.length ? firsts.map((row, k) => [times[row], times[(firsts[k + 1] ?? times.length) - 1]]) : [];
  }

  /** Fetch what is new; whether there was anything. */
  async pull(signal) {
    let grew = false;
    for (;;) {
      let answer;
      try {
        answer = await ask(`api/run/${this.id}/history?from=${this.next}`, { signal });
      } catch (error) {
        if (error.status !== 400 || this.next === 0) throw error;
        this.clear(); // another run lies in the folder now
        continue;
      }
      const text = await answer.text();
      const next = Number(answer.headers.get("X-Next"));
      if (next <= this.next) return grew;
      this.next = next;
      grew = true;
      this.add(text);
    }
  }

  add(text) {
    const lines = text.split("\n");
    lines.pop();
    if (!this.names) {
      this.names = lines.shift().split(",");
      const wanted = new Set(["time_s", ...CHARTS.flatMap(([, , curves]) => curves.map(([column]) => column))]);
      for (const name of this.names) if (wanted.has(name)) this.columns[name] = [];
    }
    const places = this.names.map((name, k) => [this.columns[name], k]).filter(([column]) => column);
    const limit = this.names.indexOf("limit");
    for (const line of lines) {
      const cells = line.split(",");
      if (cells[limit] === PAUSE) this.pauses.push(this.columns.time_s.length);
      for (const [column, k] of places) column.push(Number(cells[k]));
    }
  }

  /** Charts that have anything to show. */
  charts() {
    return CHARTS
      .map(([title, unit, curves]) => [title, unit, curves.filter(([column]) => this.columns[column]?.some((value) => value !== 0))])
      .filter(([, , curves]) => curves.length);
  }
}

function colors() {
  const style = getComputedStyle(document.documentElement);
  const read = (name) => style.getPropertyValue(name).trim();
  return { ink: read("--ink"), quiet: read("--quiet"), line: read("--line"), curves: [read("--curve-1"), read("--curve-2"), read("--curve-3")] };
}

/**
 * A chart of columns over time or place.
 *
 * over: {unit, words, ends(), marks(low, high)}: what lies below, its first and last place, and marks as [place, words] where
 * these are no round numbers. lines: {words, ink, dash} for each column. tables():
 * lists of columns, the first of each what lies below. With `sync` the cursors of charts go together.
 * Returns {element, update(), destroy()}.
 */
export function lineChart({ title, unit, over, lines, tables, sync = "" }) {
  const figure = h("figure", { class: "chart" });
  const caption = h("figcaption", {});
  const body = h("div", { class: "plot", role: "img", "aria-label": title });
  figure.append(caption, body);
  let plot = null, drawnSize = 0, isZoomed = false;

  const data = () => {
    const found = tables();
    if (found.length === 1) return found[0];
    const parts = found.map((part) => (part[0].length ? part : [[over.ends()[0]], ...part.slice(1).map(() => [null])]));
    return uPlot.join(parts, parts.map((part) => part.map(() => OPEN)));
  };
  const largest = () => {
    let most = 0;
    for (const [, ...columns] of tables()) for (const column of columns) for (const value of column) most = Math.max(most, Math.abs(value));
    return most;
  };

  const draw = () => {
    plot?.destroy();
    const { quiet, line, curves: inks } = colors();
    const [underUnit, underSize] = fittingUnit(Math.max(...over.ends().map(Math.abs)), over.unit);
    const [name, size] = fittingUnit(largest(), unit);
    drawnSize = size;
    caption.replaceChildren(h("b", {}, title), h("span", {}, name), ...lines.map(({ words, ink, dash }) =>
      h("span", { class: `key ink-${ink + 1} dash-${dash}` }, words)));
    const axis = { stroke: quiet, grid: { stroke: line, width: 1 }, ticks: { show: false }, font: "12px system-ui, sans-serif" };
    plot = new uPlot({
      width: Math.max(body.clientWidth, 200),
      height: 190,
      padding: [8, 28, 0, 0],
      legend: { show: false },
      cursor: { y: false, drag: { x: true, y: false }, ...(sync && { sync: { key: sync } }) },
      scales: { x: { time: false, range: (u, low, high) => {
        const [all] = u.data;
        isZoomed = all.length > 1 && (low > all[0] || high < all.at(-1)); // of one row uPlot asks for any range around it
        return isZoomed ? [low, high] : over.ends();
      } } },
      axes: [
        { ...axis, size: 34, ...(over.marks ? markedBy(over) : { values: (u, ticks) => ticks.map((tick) => `${number(tick / underSize)}${tick === ticks.at(-1) ? ` ${underUnit}` : ""}`) }) },
        { ...axis, size: 54, values: (u, ticks) => ticks.map((tick) => number(tick / size)) },
      ],
      series: [{}, ...lines.map(({ ink, dash }) => ({ stroke: inks[ink], width: 1.75, dash: DASHES[dash], points: { show: false }, spanGaps: false }))],
    }, data(), body);
    describe(name, size);
  };
  const describe = (name, size) => {
    const lasts = tables().flatMap(([, ...columns]) => columns).map((column, k) =>
      (column.length ? `${lines[k].words} ${number(column.at(-1) / size)} ${name}` : "")).filter(Boolean);
    body.setAttribute("aria-label", `${title} over ${over.words}; at the end ${lasts.join(", ")}`);
  };
  const observer = new ResizeObserver(() => plot?.setSize({ width: Math.max(body.clientWidth, 200), height: 190 }));
  observer.observe(body);
  const theme = matchMedia("(prefers-color-scheme: dark)");
  theme.addEventListener("change", draw);
  requestAnimationFrame(draw);
  return {
    element: figure,
    update() {
      if (!plot) return;
      const [name, size] = fittingUnit(largest(), unit);
      if (size !== drawnSize) draw();
      else {
        plot.setData(data(), !isZoomed);
        describe(name, size);
      }
    },
    destroy() {
      observer.disconnect();
      theme.removeEventListener("change", draw);
      plot?.destroy();
    },
  };
}

/** Marks below a chart where their places say more than round numbers, as options of uPlot. */
function markedBy(over) {
  return {
    splits: (u, axis, low, high) => over.marks(low, high).map(([place]) => place),
    values: (u) => over.marks(u.scales.x.min, u.scales.x.max).map(([, words]) => words),
  };
}

/**
 * A chart of one or more histories over the same time, see `lineChart`.
 *
 * runs: [{history, name, pulses}]; with two runs the colors tell the runs and the dashes the curves.
 */
export function chart(title, unit, curves, runs, end) {
  const isOne = runs.length === 1;
  const lines = runs.flatMap(({ name }, r) => curves.map(([, words], k) => ({
    words: isOne ? words : `${name}${curves.length > 1 ? `, ${words}` : ""}`, ink: isOne ? k : r, dash: isOne ? 0 : k,
  })));
  const over = new TimeAxis(runs, end);
  const tables = () => {
    over.update();
    return runs.map(({ history }) => over.cut(history, curves.map(([column]) => history.columns[column] ?? [])));
  };
  return lineChart({ title, unit, lines, tables, over, sync: "time" });
}

/**
 * The reliefs of runs over one another, or null where none has one.
 *
 * runs: as `api/run/ID` tells them. Throws what the signal says.
 */
export async function reliefChart(runs, signal) {
  const known = runs.filter((run) => run.has_relief);
  const reliefs = await Promise.all(known.map((run) => getJson(`api/run/${run.id}/relief`, { signal })));
  if (!known.length) return null;
  const ends = reliefs.flatMap(({ x }) => x);
  const lines = known.map((run) => ({ words: runs.length > 1 ? run.name : "height of the surface at the end", ink: runs.indexOf(run), dash: 0 }));
  return lineChart({ title: "Relief", unit: "m", lines, tables: () => reliefs.map(({ x, height }) => [x, height]),
    over: { unit: "m", words: "place", ends: () => [Math.min(...ends), Math.max(...ends)] } });
}
