/** The start page: runs and sweeps as cards, sorted and filtered. */

import { ago, chip, h, quantity, sparkline, svg } from "./dom.js";
import { colorAt } from "./map.js";
import { moment, partDone } from "./moments.js";
import { getJson, pause } from "./net.js";
import { prepareScene } from "./scene.js";

const EVERY = 2000;
const ORDERS = {
  newest: ["newest first", (run) => -(run.modified ?? 0)],
  name: ["name", (run) => run.name],
  temperature: ["highest temperature", (run) => -(run.values?.temperature_max_K ?? 0)],
  depth: ["deepest melt", (run) => -(run.values?.["melt.depth_max_m"] ?? 0)],
};
const STATES = ["all states", "running", "complete", "stopped", "damaged"];
const chosen = { text: "", state: STATES[0], order: "newest", compared: new Set() };
/** The reader's choice, which stays when a run was opened in between. */

export async function showList(place, signal, head) {
  const cards = new Map();
  const grid = h("div", { class: "cards" });
  const count = h("p", { class: "quiet", role: "status" });
  const compare = h("a", { class: "button primary" }, "Compare");
  const picks = h("span", { role: "status" });
  const bar = h("div", { class: "bar", hidden: true }, picks, compare,
    h("button", { type: "button", onclick: () => {
      chosen.compared.clear();
      for (const box of grid.querySelectorAll(".pick input")) box.checked = false;
      draw();
    } }, "Clear"));
  let content = { runs: [], sweeps: [] };

  // The cards that the reader's words, state and order choose; a card is replaced where it changed.
  const draw = () => {
    const words = chosen.text.toLowerCase().split(/\s+/).filter(Boolean);
    const key = ORDERS[chosen.order][1];
    const all = [...content.sweeps, ...content.runs];
    const shown = all
      .filter((run) => chosen.state === STATES[0] || run.state === chosen.state)
      .filter((run) => words.every((word) => wordsOf(run).includes(word)))
      .sort((a, b) => (key(a) < key(b) ? -1 : key(a) > key(b) ? 1 : a.name < b.name ? -1 : 1));
    const wanted = shown.map((run) => cardOf(run));
    if (wanted.some((card, k) => grid.children[k] !== card) || grid.children.length !== wanted.length) {
      const focused = document.activeElement;
      grid.replaceChildren(...wanted);
      if (grid.contains(focused)) focused.focus();
    }
    // How many there are, or how to begin.
    const running = content.runs.filter((run) => run.state === "running").length;
    count.textContent = all.length
      ? [`${shown.length} of ${all.length}`, running ? `${running} running` : ""].filter(Boolean).join(", ")
      : "";
    if (!all.length) {
      grid.replaceChildren(h("p", { class: "empty" }, "No run lies in this folder yet. Start one: ",
        h("code", {}, `lasersph run dlip-steel --out ${content.folder}/steel`)));
    }
    // Two ticked runs can be compared.
    const picked = content.runs.filter((run) => chosen.compared.has(run.id));
    bar.hidden = !picked.length;
    compare.hidden = picked.length !== 2;
    compare.setAttribute("href", `#/compare/${[...chosen.compared].filter((id) => picked.some((run) => run.id === id)).join("/")}`);
    const names = picked.map((run) => run.name).join(" and ");
    const told = picked.length > 2 ? `${picked.length} runs are ticked: two can be compared` : picked.length === 2 ? names : `${names}: tick another run to compare with it`;
    if (picks.textContent !== told) picks.textContent = told;
  };

  // A card is made anew only where its content has changed, so that pictures do not flicker.
  const cardOf = (run) => {
    const text = JSON.stringify(run);
    const known = cards.get(run.id);
    if (known?.text === text) return known.card;
    const card = run.kind === "sweep" ? sweepCard(run) : runCard(run, draw);
    cards.set(run.id, { text, card });
    return card;
  };

  place.replaceChildren(
    h("h1", {}, "Runs"),
    h("form", { class: "tools", role: "search", onsubmit: (event) => event.preventDefault() },
      labeled("Find", h("input", { type: "search", value: chosen.text, placeholder: "case, metal, key, folder",
        oninput: (event) => { chosen.text = event.target.value; draw(); } })),
      labeled("State", options(STATES.map((state) => [state, state]), chosen.state,
        (value) => { chosen.state = value; draw(); })),
      labeled("Order", options(Object.entries(ORDERS).map(([name, [words]]) => [name, words]), chosen.order,
        (value) => { chosen.order = value; draw(); })),
      count),
    grid, bar);

  // Ask again as long as the page is seen.
  for (let isFirst = true; ; isFirst = false) {
    content = await getJson("api/runs", { signal });
    head(content);
    draw();
    // whoever reads the list looks at particles next
    if (isFirst) requestAnimationFrame(() => setTimeout(prepareScene));
    do await pause(EVERY, signal); while (document.hidden);
  }
}

/** Words of a run among which the reader searches. */
function wordsOf(run) {
  const changes = (run.changes ?? []).map((one) => `${one.key} ${one.now}`).join(" ");
  const spans = (run.spans ?? []).map((one) => one.key).join(" ");
  return [run.name, run.title, run.case, run.material, run.solver, run.state, changes, spans].join(" ").toLowerCase();
}

function labeled(words, field) {
  return h("label", {}, h("span", {}, words), field);
}

function options(entries, value, change) {
  return h("select", { onchange: (event) => change(event.target.value) },
    entries.map(([name, words]) => h("option", { value: name, selected: name === value }, words)));
}

/** The card of a run: picture, state, numbers; of a damaged one the reason. */
function runCard(run, changed) {
  if (run.state === "damaged") {
    return h("article", { class: "card damaged" },
      h("div", { class: "words" }, h("h2", {}, run.name), chip(run.state), h("p", { class: "error" }, run.error)));
  }
  const name = run.title || run.name;
  const pick = h("input", { type: "checkbox", "aria-label": `Compare ${run.name}`,
    checked: chosen.compared.has(run.id),
    onchange: (event) => {
      if (event.target.checked) chosen.compared.add(run.id);
      else chosen.compared.delete(run.id);
      changed();
    } });
  return h("article", { class: "card" },
    h("div", { class: "picture" }, pictureOf(run)),
    h("div", { class: "words" },
      h("h2", {}, h("a", { href: `#/run/${run.id}` }, run.name)),
      chip(run.state),
      name !== run.name && h("p", { class: "title" }, name),
      run.state !== "complete" && h("progress", { value: partDone(run), max: 1, "aria-label": "time reached" }),
      h("ul", { class: "tags", "aria-label": "what was changed" }, run.changes.filter((one) => !/^[[{]/.test(one.now)).slice(0, 4).map((one) =>
        h("li", { title: one.was ? `${one.key}: ${one.was} in the case file` : one.key }, `${one.key.split(".").pop()} ${one.now}`))),
      h("dl", { class: "numbers" }, run.numbers.slice(0, 4).map((one) => [h("dt", {}, one.words), h("dd", {}, one.text)])),
      h("footer", {}, h("span", {}, run.state === "complete"
        ? `${quantity(run.time_s, "s")} in ${run.took}` : `${moment(run.time_s, run.pulses, quantity)} of ${run.pulses.length ? `${run.pulses.length} pulses` : quantity(run.end_s, "s")}`),
        h("span", {}, ago(run.modified)),
        run.warnings.length > 0 && h("span", { class: "chip warned", title: run.warnings.join("\n") }, `${run.warnings.length} warning${run.warnings.length > 1 ? "s" : ""}`), h("label", { class: "pick" }, pick, "compare"))));
}

/** The picture of a run, else a small curve of its temperature. */
function pictureOf(run) {
  if (run.picture) {
    return h("img", { src: `api/run/${run.id}/figure/${run.picture}`, loading: "lazy", decoding: "async",
      alt: `${run.picture.replaceAll("-", " ")} of ${run.name}` });
  }
  if (run.curve?.length > 1) return [sparkline(run.curve), h("span", { class: "what" }, "highest temperature")];
  return h("span", { class: "what" }, "no picture yet");
}

/** The runs of a sweep over its keys, colored by their main number. */
function pointsOf(points) {
  if (!points.length) return null;
  return svg("svg", { viewBox: "0 0 160 90", class: "points", "aria-hidden": "true" }, points.filter(([, y]) => y !== null).map(([x, y, share]) =>
    svg("circle", { cx: 12 + 136 * x, cy: 80 - 54 * y, r: points.length > 60 ? 2.2 : 3.4, fill: share === null ? "none" : `rgb(${colorAt(share).join()})`, class: "point" })));
}

/** A key that varies and its values: "fluence 0.15 J/cm² to 0.6 J/cm²". */
function spanOf({ key, unit, ends }) {
  const words = ends.map((one) => (typeof one === "number" ? quantity(one, unit) : String(one)));
  const isRange = ends.every((one) => typeof one === "number");
  return `${key.split(".").pop()} ${[...new Set(words)].join(isRange ? " to " : ", ")}`;
}

/** The card of a sweep: its runs over two keys, its state, what varies. */
function sweepCard(sweep) {
  if (sweep.state === "damaged") return runCard(sweep);
  const counts = Object.entries(sweep.counts);
  const total = counts.reduce((sum, [, count]) => sum + count, 0);
  return h("article", { class: "card sweep" },
    h("div", { class: "picture" }, pointsOf(sweep.points), h("span", { class: sweep.points.length ? "what" : "count" }, String(total), h("small", {}, " runs"))),
    h("div", { class: "words" },
      h("h2", {}, h("a", { href: `#/sweep/${sweep.id}` }, sweep.name)), chip(sweep.state),
      h("p", { class: "title" }, sweep.title),
      h("ul", { class: "tags", "aria-label": "what varies" }, sweep.spans.map((span) => h("li", { title: span.key }, spanOf(span)))),
      h("dl", { class: "numbers" }, counts.map(([name, count]) => [h("dt", {}, name), h("dd", {}, String(count))])),
      h("footer", {}, h("span", {}, sweep.study || (sweep.is_calibration ? "calibration" : "sweep")), h("span", {}, ago(sweep.modified)))));
}
