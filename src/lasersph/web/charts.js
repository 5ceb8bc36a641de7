/** Curves of history.csv, drawn by uPlot, and the reading of what grows in that file. */

import { fittingUnit, h, number } from "./dom.js";
import { ask } from "./net.js";

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
    for (const line of lines) {
      const cells = line.split(",");
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
 * A chart of one or more histories over the same time.
 *
 * runs: [{history, name}]; with two runs the colors tell the runs and the dashes the curves.
 * Returns {element, update(), destroy()}.
 */
export function chart(title, unit, curves, runs, end) {
  const figure = h("figure", { class: "chart" });
  const caption = h("figcaption", {});
  const body = h("div", { class: "plot", role: "img" });
  figure.append(caption, body);
  let plot = null;

  const data = () => {
    const parts = runs.map(({ history }) => [history.columns.time_s ?? [], ...curves.map(([column]) => history.columns[column] ?? [])]);
    return parts.length === 1 ? parts[0] : uPlot.join(parts.map((part) => (part[0].length ? part : [[0], ...curves.map(() => [null])])));
  };
  const largest = () => {
    let most = 0;
    for (const { history } of runs) for (const [column] of curves) for (const value of history.columns[column] ?? []) most = Math.max(most, Math.abs(value));
    return most;
  };
  let drawnSize = 0;

  const draw = () => {
    plot?.destroy();
    const { quiet, line, curves: inks } = colors();
    const [timeUnit, timeSize] = fittingUnit(end, "s");
    const [name, size] = fittingUnit(largest(), unit);
    drawnSize = size;
    const keys = runs.flatMap((run, r) => curves.map(([, words], k) =>
      h("span", { class: `key ink-${(runs.length > 1 ? r : k) + 1} dash-${runs.length > 1 ? k : 0}` },
        runs.length > 1 ? `${run.name}${curves.length > 1 ? `, ${words}` : ""}` : words)));
    caption.replaceChildren(h("b", {}, title), h("span", {}, name), ...keys);
    const axis = { stroke: quiet, grid: { stroke: line, width: 1 }, ticks: { show: false }, font: "12px system-ui, sans-serif" };
    plot = new uPlot({
      width: Math.max(body.clientWidth, 200),
      height: 190,
      padding: [8, 22, 0, 0],
      legend: { show: false },
      cursor: { y: false, drag: { x: true, y: false }, sync: { key: "time" } },
      scales: { x: { time: false, range: (u, low, high) => (u.zoomed ? [low, high] : [0, end]) } },
      axes: [
        { ...axis, size: 34, values: (u, ticks) => ticks.map((tick) => `${number(tick / timeSize)}${tick === ticks.at(-1) ? ` ${timeUnit}` : ""}`) },
        { ...axis, size: 54, values: (u, ticks) => ticks.map((tick) => number(tick / size)) },
      ],
      series: [{}, ...runs.flatMap((run, r) => curves.map((_, k) => ({
        stroke: inks[runs.length > 1 ? r : k], width: 1.75, dash: runs.length > 1 ? DASHES[k] : [], points: { show: false }, spanGaps: true,
      })))],
    }, data(), body);
    describe(name, size);
  };
  const describe = (name, size) => {
    const lasts = runs.flatMap(({ history }) => curves.map(([column, words]) => {
      const value = history.columns[column]?.at(-1);
      return value === undefined ? null : `${words} ${number(value / size)} ${name}`;
    })).filter(Boolean);
    body.setAttribute("aria-label", `${title} over time; at the end ${lasts.join(", ")}`);
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
        plot.setData(data());
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
