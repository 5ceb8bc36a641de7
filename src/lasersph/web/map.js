/** The map of a sweep: the field between its runs, where metal melts, boils or is ablated, and points that open the runs. */

import { h, number, quantity, svg, ticksOf, unitOf } from "./dom.js";

const LEFT = 78, RIGHT = 106, TOP = 14, BOTTOM = 56;
const COLORS = ["#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725"];
const LEVELS = 9; // about as many steps of color as a reader can tell apart
const LINES = { melts: ["melting", "#56b4e9", ""], boils: ["boiling", "#ff8a3d", "9 6"], ablates: ["ablation", "#e58fc0", "10 4 2 4"] };

export function colorAt(share, stops = COLORS) {
  const place = Math.max(0, Math.min(1, share)) * (stops.length - 1), k = Math.min(Math.floor(place), stops.length - 2);
  const part = (stop, at) => parseInt(stop.slice(at, at + 2), 16);
  return [1, 3, 5].map((at) => Math.round(part(stops[k], at) + (place - k) * (part(stops[k + 1], at) - part(stops[k], at))));
}

/** Round levels that cover a range in about `LEVELS` steps. */
function levelsOf(low, high) {
  const rough = (high - low) / LEVELS || 1, ten = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].find((one) => one * ten >= rough * 0.999) * ten;
  const first = Math.floor(low / step + 1e-9), count = Math.max(1, Math.ceil(high / step - 1e-9) - first);
  return Array.from({ length: count + 1 }, (_, k) => (first + k) * step);
}

/**
 * A picture of a field (rows from low to high, null where it is not known), linear in between.
 * colorOf: gives red, green, blue of a value, or null where nothing is drawn.
 */
export function fieldPicture(field, colorOf, width = 560, height = 360) {
  const canvas = h("canvas", { width, height }), pen = canvas.getContext("2d"), picture = pen.createImageData(width, height);
  const rows = field.length, columns = field[0].length;
  for (let j = 0; j < height; j += 1) {
    const v = (1 - (j + 0.5) / height) * (rows - 1), row = Math.min(Math.floor(v), rows - 2), up = v - row;
    for (let i = 0; i < width; i += 1) {
      const u = ((i + 0.5) / width) * (columns - 1), column = Math.min(Math.floor(u), columns - 2), on = u - column;
      const [a, b] = [field[row][column], field[row][column + 1]], [c, d] = [field[row + 1][column], field[row + 1][column + 1]];
      if (a === null || b === null || c === null || d === null) continue;
      const color = colorOf((1 - up) * ((1 - on) * a + on * b) + up * ((1 - on) * c + on * d));
      if (color) picture.data.set([...color, 255], 4 * (j * width + i));
    }
  }
  pen.putImageData(picture, 0, 0);
  return canvas.toDataURL();
}

/** An axis between two values: its place in the figure [pixels] of a value, linear or of the logarithm. */
function scale(low, high, isLogarithmic, from, to) {
  const [f, g] = isLogarithmic ? [Math.log, Math.exp] : [(one) => one, (one) => one];
  const room = 0.04 * (f(high) - f(low) || Math.abs(f(high)) || 1), a = f(low) - room, b = f(high) + room;
  return { at: (value) => from + ((to - from) * (f(value) - a)) / (b - a), low: g(a), high: g(b), isLogarithmic };
}

/**
 * The figure of a sweep over one or two keys.
 *
 * chosen: {x, y, column}, y empty for the number itself. map: what the server says of these, null
 * where it says nothing: the points are then drawn alone.
 */
export function drawMap(sweep, { x, y, column }, map) {
  const rows = sweep.rows.filter((row) => typeof row.settings[x] === "number" && (!y || typeof row.settings[y] === "number"));
  const valueOf = (row) => map?.values[row.run] ?? row.numbers[column]; // a run that does not melt has a pool of size 0
  const values = rows.map(valueOf).filter(Number.isFinite);
  if (!rows.length || !values.length) return h("p", { class: "quiet" }, "No complete run has this number yet.");
  const [wide, tall] = window.innerWidth > 640 ? [720, 420] : [460, 400]; // letters keep their size on a small screen
  const unit = unitOf(column), words = sweep.words[column] ?? column;
  const plane = map && y ? map.field : null, curve = map && !y ? map.field : null;
  const known = plane ? plane.flat().filter((one) => one !== null) : values;
  const [low, high] = known.length ? [Math.min(...known), Math.max(...known)] : [0, 1];
  const levels = plane && high > low ? levelsOf(low, high) : null;
  const bottom = levels ? levels[0] : low, top = levels ? levels.at(-1) : high;
  const color = (value) => {
    if (!levels) return colorAt((value - low) / (high - low || 1));
    const step = Math.max(0, Math.min(levels.length - 2, levels.findLastIndex((one) => one <= value)));
    return colorAt(levels.length > 2 ? step / (levels.length - 2) : 0.5);
  };
  const paint = (value) => `rgb(${color(value).join()})`;
  const [first, second] = map?.axes ?? [];
  const ups = rows.map((row) => (y ? row.settings[y] : valueOf(row))).filter(Number.isFinite);
  const acrosses = rows.map((row) => row.settings[x]);
  const across = scale(Math.min(...acrosses), Math.max(...acrosses), first?.is_logarithmic, LEFT, wide - RIGHT);
  const up = scale(Math.min(...ups), Math.max(...ups), Boolean(y && second?.is_logarithmic), tall - BOTTOM, TOP);
  const [xTicks, xUnit] = ticksOf(across, sweep.units[x]), [yTicks, yUnit] = ticksOf(up, y ? sweep.units[y] : unit);

  const area = [];
  if (plane) {
    const [[x0, x1], [y0, y1]] = map.axes.map(({ grid }) => [grid[0], grid.at(-1)]);
    area.push(svg("image", { x: across.at(x0), width: across.at(x1) - across.at(x0), y: up.at(y1), height: up.at(y0) - up.at(y1),
      preserveAspectRatio: "none", href: fieldPicture(plane, color) }));
  }
  if (curve) area.push(svg("polyline", { class: "between", points: first.grid.map((at, k) => curve[k] !== null && `${across.at(at)},${up.at(curve[k])}`).filter(Boolean).join(" ") }));
  const bands = Object.entries(map?.bands ?? {}), events = bands.map(([name]) => name);
  for (const [name, parts] of bands) {
    const rings = parts.map((part) => (y ? part.map((at) => [across.at(at[0]), up.at(at[1])])
      : [[0, TOP], [1, TOP], [1, tall - BOTTOM], [0, tall - BOTTOM]].map(([k, v]) => [across.at(part[k][0]), v])));
    area.push(svg("path", { d: rings.map((ring) => `M${ring.map((at) => at.map((one) => one.toFixed(1)).join(",")).join("L")}Z`).join(""),
      "fill-rule": "evenodd", "fill-opacity": y ? 0.2 : 0.35, fill: LINES[name][1], stroke: LINES[name][1] }));
  }
  const lines = Object.entries(map?.lines ?? {}).filter(([name]) => name in LINES);
  for (const [name, parts] of lines) for (const part of parts) {
    const [, ink, dash] = LINES[name];
    const points = y ? part.map((at) => `${across.at(at[0])},${up.at(at[1])}`)
      : part.flatMap(([at]) => [`${across.at(at)},${TOP}`, `${across.at(at)},${tall - BOTTOM}`]);
    area.push(svg("polyline", { points: points.join(" "), class: "event edge" }), svg("polyline", { points: points.join(" "), class: "event", stroke: ink, "stroke-dasharray": dash }));
  }
  const points = rows.map((row) => pointOf(row, plane)).filter(Boolean);

  function pointOf(row, isOnField) {
    const value = valueOf(row), isKnown = Number.isFinite(value);
    if (!isKnown && !y) return null;
    const text = `${row.run}: ${x} ${quantity(row.settings[x], sweep.units[x])}${y ? `, ${y} ${quantity(row.settings[y], sweep.units[y])}` : ""}, ${isKnown ? quantity(value, unit) : row.status}`;
    const [cx, cy] = [across.at(row.settings[x]), up.at(y ? row.settings[y] : value)];
    const mark = isKnown ? svg("circle", { cx, cy, r: isOnField ? 5.5 : 8, fill: isOnField ? "#fff" : paint(value), class: "point" }, svg("title", {}, text))
      : svg("path", { d: `M${cx - 6},${cy - 6}l12,12m0,-12l-12,12`, class: "point lost" }, svg("title", {}, text));
    // a wide ring that is not seen lets a finger find the point
    return row.id ? svg("a", { href: `#/run/${row.id}`, "aria-label": text }, svg("circle", { cx, cy, r: 12, fill: "transparent" }), mark) : mark;
  }

  const steps = levels ? levels.slice(0, -1).map((one, k) => [one, levels[k + 1]]) : Array.from({ length: 40 }, (_, k) => [low + (k * (high - low)) / 40, low + ((k + 1) * (high - low)) / 40]);
  const barAt = (value) => tall - BOTTOM - ((tall - TOP - BOTTOM) * (value - bottom)) / (top - bottom || 1);
  const bar = top > bottom && y ? [steps.map(([from, to]) => svg("rect", { x: wide - RIGHT + 18, width: 14, y: barAt(to), height: barAt(from) - barAt(to) + 0.3, fill: paint(0.5 * (from + to)) })),
    ticksOf({ low: bottom, high: top }, unit)[0].map(([at, text]) => svg("text", { x: wide - RIGHT + 37, y: barAt(at) + 4 }, text)),
    svg("text", { x: wide - RIGHT + 18, y: tall - BOTTOM + 20 }, `[${ticksOf({ low: bottom, high: top }, unit)[1] || "1"}]`)] : [];
  return h("figure", { class: "chart" },
    h("figcaption", {}, h("b", {}, words), h("span", {}, "each point opens its run"),
      events.map((name) => h("span", {}, svg("svg", { width: 30, height: 8, class: "sample", "aria-hidden": "true" },
        !(name in (map.lines ?? {})) ? svg("rect", { width: 30, height: 8, "fill-opacity": 0.35, fill: LINES[name][1], stroke: LINES[name][1] }) : [svg("line", { x1: 0, x2: 30, y1: 4, y2: 4, class: "event edge" }), svg("line", { x1: 0, x2: 30, y1: 4, y2: 4, class: "event", stroke: LINES[name][1], "stroke-dasharray": LINES[name][2] })]), LINES[name][0], !(name in (map.lines ?? {})) && ", between runs")),
      rows.some((row) => !Number.isFinite(valueOf(row))) && y && h("span", { class: "lost" }, "× no result")),
    svg("svg", { viewBox: `0 0 ${wide} ${tall}`, class: "axes", role: "group", "aria-label": `${words} over ${x}${y ? ` and ${y}` : ""}` },
      xTicks.map(([at, text]) => [svg("line", { x1: across.at(at), x2: across.at(at), y1: TOP, y2: tall - BOTTOM }), svg("text", { x: across.at(at), y: tall - BOTTOM + 20, "text-anchor": "middle" }, text)]),
      yTicks.map(([at, text]) => [svg("line", { x1: LEFT, x2: wide - RIGHT, y1: up.at(at), y2: up.at(at) }), svg("text", { x: LEFT - 8, y: up.at(at) + 4, "text-anchor": "end" }, text)]),
      svg("text", { x: (LEFT + wide - RIGHT) / 2, y: tall - 12, "text-anchor": "middle" }, `${x} [${xUnit || "1"}]`),
      svg("text", { x: 16, y: (TOP + tall - BOTTOM) / 2, "text-anchor": "middle", transform: `rotate(-90 16 ${(TOP + tall - BOTTOM) / 2})` }, `${y || words} [${yUnit || "1"}]`),
      area, bar, points),
    map?.onsets?.length > 0 && h("details", { class: "quiet" }, h("summary", {}, `Where it begins, over ${x}`), h("ul", {}, map.onsets.map((text) => h("li", {}, text)))),
    (map?.notes ?? []).map((text) => h("p", { class: "quiet" }, text)));
}
