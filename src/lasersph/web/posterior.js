/** The answer of a calibration: unknowns with their bands, the posterior of each and of each pair, and how well the data fit. */

import { h, number, quantity, svg, table, warningsBox } from "./dom.js";
import { fieldPicture } from "./map.js";

const INKS = [[253, 205, 160], [214, 84, 18]]; // where 95 % and 68 % of the posterior lie
const SHARES = [0.95, 0.68];

/** Sentence, warnings, corner of posteriors, data with their deviations, and chi squared. */
export function calibrationOf(found) {
  const names = Object.keys(found.unknowns);
  return [h("h2", {}, "Calibration"),
    found.sentence ? h("p", { class: "verdict" }, found.sentence) : "",
    warningsBox(found.warnings),
    h("div", { class: "corner" }, names.map((below, row) => h("div", { class: "charts row" },
      names.slice(0, row).map((across, column) => pairOf(found, across, below, column, row)),
      posteriorOf(below, found.unknowns[below], found.posterior[below])))),
    table(found.data.map((one) => [`${one.measurement}: ${one.number}`,
      `${quantity(one.measured, one.unit)} ± ${quantity(one.standard_error, one.unit, 2)}`, quantity(one.computed, one.unit), number(one.pull, 2)]),
    ["measured number", "measured", "computed", "standard deviations off"]),
    h("p", { class: "quiet" }, `χ² = ${number(found.chi_squared.value, 3)} with ${found.chi_squared.degrees_of_freedom} degrees of freedom, p = ${number(found.chi_squared.probability, 2)}`)];
}

/** The histogram of one unknown, with the band of 95 %. */
function posteriorOf(name, one, { edges, density }) {
  const low = edges[0], high = edges.at(-1), most = Math.max(...density);
  const toX = (value) => (100 * (Math.max(low, Math.min(high, value)) - low)) / (high - low || 1);
  const text = `${quantity(one.mean, one.unit)} ± ${quantity(one.sd, one.unit, 2)}`;
  return h("figure", { class: "chart posterior" },
    h("figcaption", {}, h("b", {}, name), h("span", {}, text)),
    svg("svg", { viewBox: "0 0 100 46", preserveAspectRatio: "none", role: "img", "aria-label": `posterior of ${name}: ${text}` },
      svg("rect", { x: toX(one.low_95), width: toX(one.high_95) - toX(one.low_95), y: 0, height: 46, class: "band" }),
      density.map((value, k) => svg("rect", { x: toX(edges[k]), width: toX(edges[k + 1]) - toX(edges[k]) + 0.1, y: 46 - (42 * value) / most, height: (42 * value) / most, class: "bin" }))),
    h("p", { class: "ends" }, h("span", {}, quantity(low, one.unit)), h("span", {}, `95 %: ${quantity(one.low_95, one.unit)} to ${quantity(one.high_95, one.unit)}`), h("span", {}, quantity(high, one.unit))));
}

/** Density above which a share of a posterior on cells of one size lies. */
function levelOf(cells, share) {
  const sorted = cells.flat().sort((a, b) => b - a), total = sorted.reduce((sum, one) => sum + one, 0);
  let sum = 0;
  return sorted.find((one) => (sum += one) >= share * total) ?? 0;
}

/** Where a pair of unknowns lies, with the correlation of both. */
function pairOf(found, across, below, column, row) {
  // Cells above the densities that enclose 95 % and 68 %.
  const cells = found.pairs[`${across} ${below}`], [outer, inner] = SHARES.map((share) => levelOf(cells, share));
  const [x, y] = [across, below].map((name) => found.posterior[name].edges);
  const [xs, ys] = [x, y].map((edges) => [0.5 * (edges[0] + edges[1]), 0.5 * (edges.at(-2) + edges.at(-1))]); // middles of the outer cells
  const [u, v] = [across, below].map((name) => found.unknowns[name]);
  const toX = (value) => (100 * (value - x[0])) / (x.at(-1) - x[0] || 1), toY = (value) => 100 - (100 * (value - y[0])) / (y.at(-1) - y[0] || 1);
  // Covariance over both standard deviations.
  const together = found.covariance[row][column] / Math.sqrt(found.covariance[row][row] * found.covariance[column][column]);
  const text = `correlation ${number(together, 2)}`;
  const picture = fieldPicture(cells, (value) => (value >= inner ? INKS[1] : value >= outer ? INKS[0] : null), 360, 360);
  return h("figure", { class: "chart posterior both" },
    h("figcaption", {}, h("b", {}, `${across} and ${below}`), h("span", {}, text)),
    svg("svg", { viewBox: "0 0 100 100", preserveAspectRatio: "none", role: "img", "aria-label": `posterior of ${across} and ${below}: ${text}` },
      svg("image", { x: toX(xs[0]), y: toY(ys[1]), width: toX(xs[1]) - toX(xs[0]), height: toY(ys[0]) - toY(ys[1]), preserveAspectRatio: "none", href: picture }),
      svg("path", { d: `M${toX(u.mean)},0V100M0,${toY(v.mean)}H100`, class: "mean" })),
    h("p", { class: "ends" }, h("span", {}, `${across} ${quantity(x[0], u.unit)} to ${quantity(x.at(-1), u.unit)}`), h("span", {}, `up: ${below} ${quantity(y[0], v.unit)} to ${quantity(y.at(-1), v.unit)}`),
      h("span", {}, "dark 68 %, light 95 %")));
}
