/** A new run: the keys of a shipped case, checked while they are typed, and its start. */

import { h, table } from "./dom.js";
import { inUnit, listEditor } from "./list_editor.js";
import { ask, getJson, pause } from "./net.js";

const STILL = 350; // without a key for so long, what was typed is checked

export async function showForm(place, signal, head, name = "dlip-steel") {
  let form = await getJson(`api/form/${name}`, { signal });
  document.title = "New run – lasersph";
  const rows = new Map(), shipped = new Map(); // what is typed, and what the case file says, by key
  const result = h("div", { class: "result", "aria-live": "polite" });
  const folder = h("input", { name: "folder", required: true, pattern: "[A-Za-z0-9][A-Za-z0-9._\\-]*", value: `${name}-1` });
  const start = h("button", { class: "primary", type: "submit", disabled: true }, "Start the run");
  const settings = () => [...rows].filter(([, { text, before }]) => text() !== before).map(([key, { text }]) => `${key}=${text()}`);
  const send = (path, content) => ask(path, { signal, method: "POST", body: JSON.stringify(content), headers: { "content-type": "application/json" } });

  let last = 0;
  const check = async () => {
    const mine = ++last;
    start.disabled = true;
    await pause(STILL, signal);
    if (mine !== last) return;
    const found = await (await send("api/check", { case: name, settings: settings() })).json();
    if (mine !== last) return;
    for (const { fields, said } of rows.values()) {
      for (const field of fields()) field.removeAttribute("aria-invalid");
      said.textContent = "";
    }
    const others = [];
    for (const { key, text } of found.problems) {
      // of a list: probes[2].depth
      const [, inside, place, column] = key.match(/^(.*?)(?:\[(\d+)\](?:\.(\w+)|\[\d+\])?)?$/), row = rows.get(key) ?? rows.get(inside);
      if (!row) others.push(h("p", { class: "error" }, `${key ? `${key}: ` : ""}${text}`));
      else {
        const wrong = row.fields(place, column);
        for (const field of wrong) field.setAttribute("aria-invalid", "true");
        others.push(h("p", {}, h("button", { type: "button", onclick: () => wrong[0]?.focus() }, key)));
        row.said.textContent = [row.said.textContent, key === inside ? text : `${key}: ${text}`].filter(Boolean).join("; ");
      }
    }
    start.disabled = found.problems.length > 0;
    result.replaceChildren(h("h2", {}, found.problems.length ? "Not yet right" : "Forecast"), ...others,
      found.forecast.length ? table(found.forecast) : "", ...found.warnings.map((text) => h("p", { class: "warning" }, text)));
  };
  const checkLater = () => check().catch((error) => {
    if (!signal.aborted) throw error;
  });

  /** Another kind of a table has other keys: the form is asked for anew, with all that was typed. */
  const chooseKind = async (event) => {
    const asked = new URLSearchParams(settings().map((one) => ["set", one])), { id } = event.target;
    form = { ...await getJson(`api/form/${name}?${asked}`, { signal }), isAnother: true };
    keys.replaceChildren(...sectionsOf());
    document.getElementById(id).focus();
    checkLater();
  };

  const rowOf = ({ key, value, help, unit, choices, list }) => {
    const id = `key-${key.replaceAll(/[^a-z0-9]/gi, "-")}`;
    const said = h("p", { class: "error", id: `${id}-said` });
    if (list) {
      const editor = listEditor(key, list, checkLater);
      if (!shipped.has(key)) shipped.set(key, form.isAnother ? (list.shape === "row" ? "" : "[]") : editor.text());
      rows.set(key, { ...editor, before: shipped.get(key), said });
      return h("div", { class: "key", role: "group", "aria-labelledby": id, "aria-describedby": `${id}-said` }, h("span", { class: "label", id }, key), editor.element,
        h("p", { class: "quiet" }, help, editor.help), said);
    }
    const change = key.endsWith(".kind") && choices.length ? chooseKind : checkLater;
    const attributes = { id, "aria-describedby": `${id}-help ${id}-said`, oninput: change };
    const field = choices.length
      ? h("select", attributes, [...(value ? [] : [""]), ...choices].map((one) => h("option", { value: one, selected: one === value }, one || "default")))
      : h("input", { ...attributes, value, placeholder: "default", autocomplete: "off", spellcheck: "false" });
    if (!shipped.has(key)) shipped.set(key, form.isAnother ? "" : value);
    rows.set(key, { fields: () => [field], text: () => field.value.trim(), before: shipped.get(key), said });
    return h("div", { class: "key" }, h("label", { for: id }, key, unit && h("small", {}, inUnit(unit))), field,
      h("p", { class: "quiet", id: `${id}-help` }, help.replaceAll("`", "")), said);
  };
  const sectionsOf = () => {
    rows.clear();
    const groups = new Map();
    for (const one of form.fields) {
      const group = one.key.includes(".") ? one.key.split(".")[0] : "case";
      // a key of another kind is taken out of the case
      if (!one.is_known) rows.set(one.key, { fields: () => [], text: () => "", before: shipped.get(one.key) ?? "", said: h("p", {}) });
      else groups.set(group, [...(groups.get(group) ?? []), one]);
    }
    return [...groups].map(([group, fields]) => {
      const isGiven = ({ value, list }) => value !== "" || list?.rows.flat().some((cell) => cell !== "");
      const rest = fields.filter((one) => !isGiven(one));
      return h("fieldset", {}, h("legend", {}, group), fields.filter(isGiven).map(rowOf),
        rest.length > 0 && h("details", {}, h("summary", {}, `${rest.length} more key${rest.length > 1 ? "s" : ""} of ${group}`), rest.map(rowOf)));
    });
  };
  const keys = h("div", {}, sectionsOf());
  const failed = h("p", { class: "error", role: "alert" });
  place.replaceChildren(
    h("p", { class: "path" }, h("a", { href: "#/" }, "Runs"), " / new run"), h("h1", {}, "New run"),
    h("form", { class: "case", onsubmit: async (event) => {
      event.preventDefault();
      start.disabled = true;
      failed.textContent = "";
      try {
        const { id } = await (await send("api/start", { case: name, settings: settings(), name: folder.value.trim() })).json();
        location.hash = `#/run/${id}`;
      } catch (error) {
        if (signal.aborted) return;
        failed.textContent = error.message;
        start.disabled = false;
      }
    } },
    h("div", { class: "keys" },
      h("div", { class: "key" }, h("label", { for: "case" }, "shipped case"), h("select", { id: "case", onchange: (event) => { location.hash = `#/new/${event.target.value}`; } },
        form.cases.map((one) => h("option", { value: one, selected: one === name }, one)))), keys),
    h("aside", {}, h("label", { for: "folder" }, "name of its folder"), folder, start, failed, result)));
  folder.id = "folder-name";
  place.querySelector("aside label").setAttribute("for", folder.id);
  checkLater();
}
