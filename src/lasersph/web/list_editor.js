/** A list of a case as rows of cells: probes, times, tables of a pulse. */

import { h } from "./dom.js";

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/** The unit beside a name. */
export function inUnit(unit) {
  return unit && unit !== "1" ? ` [${unit.replace("^2", "²").replace("^3", "³")}]` : "";
}

function valueOf(text, { is_text: isText, is_number: isNumber }) {
  const isPlain = ["true", "false"].includes(text) || (isNumber && NUMBER.test(text)) || (!isText && !isNumber);
  return isPlain ? text : JSON.stringify(text);
}

function rowText(shape, columns, texts) {
  const values = texts.map((text, k) => valueOf(text, columns[k]));
  if (shape === "values") return values[0];
  if (shape !== "tables") return `[${values.join(", ")}]`;
  return `{ ${columns.map(({ name }, k) => texts[k] && `${name} = ${values[k]}`).filter(Boolean).join(", ")} }`;
}

/** A list with rows of texts as TOML in one line; empty for one of a length of which nothing is given. */
export function listText({ shape, columns }, rows) {
  if (shape !== "row") return `[${rows.map((texts) => rowText(shape, columns, texts)).join(", ")}]`;
  const texts = rows[0] ?? [];
  return texts.every((text) => text === "") ? "" : rowText(shape, columns, texts);
}

/**
 * The editor of one list, see `form_of`.
 *
 * Returns {element, help, text, fields}: text() gives the list as TOML in one line, see `listText`;
 * fields(n, name) the inputs of its n-th row, from 1, and of a column, all without these.
 */
export function listEditor(key, list, change) {
  const { shape, columns, rows } = list;
  const body = h("div", {}), isFixed = shape === "row";
  const lines = () => [...body.children];
  const cells = (line) => [...line.querySelectorAll("input, select")];

  const add = (texts) => {
    const line = h("div", { class: "line" }, columns.map(({ name, unit, choices }, k) => {
      const head = `${name}${inUnit(unit)}`, words = [key, shape === "row" ? k + 1 : "", name].filter(Boolean).join(" ");
      const attributes = { "aria-label": words, "data-name": name, oninput: change };
      const field = choices.length
        ? h("select", attributes, ["", ...choices].map((one) => h("option", { value: one, selected: one === texts[k] }, one || "default")))
        : h("input", { ...attributes, value: texts[k] ?? "", placeholder: head ? "" : "value", autocomplete: "off", spellcheck: "false", size: 8 });
      return h("span", {}, head && h("small", { "aria-hidden": "true" }, head), field);
    }), !isFixed && h("button", { type: "button", "aria-label": `Remove this row of ${key}`, title: "Remove", onclick: () => { line.remove(); change(); } }, "×"));
    body.append(line);
    return line;
  };
  for (const texts of rows) add(texts);

  const text = () => listText(list, lines().map((line) => cells(line).map((cell) => cell.value.trim())));
  const fields = (place, name) => {
    const chosen = place && lines()[place - 1] ? [lines()[place - 1]] : lines();
    const found = chosen.flatMap(cells), named = found.filter((cell) => name && cell.dataset.name === name);
    return named.length ? named : found;
  };
  const more = h("button", { type: "button", onclick: () => { cells(add([]))[0].focus(); change(); } }, `Add to ${key}`);
  const told = columns.filter((one) => one.name && one.help).map(({ name, help }) => `${name}: ${help}`);
  return { element: h("div", { class: "rows" }, body, !isFixed && more), help: told.length ? ` (${told.join("; ")})` : "", text, fields };
}
