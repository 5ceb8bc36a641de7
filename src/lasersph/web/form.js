/** A new run: the keys of a case, checked while they are typed, and its start. */

import { caseOrigin } from "./case_origin.js";
import { h, table, warningsBox } from "./dom.js";
import { formFields } from "./form_fields.js";
import { ask, pause, Refused } from "./net.js";

const STILL = 350; // without a key for so long, what was typed is checked

/** The form for a shipped case. */
export function showForm(place, signal, head, name = "dlip-steel") {
  return fillForm(place, signal, { case: name });
}

/** The form for a run again with changes. */
export function showAgain(place, signal, head, id) {
  return fillForm(place, signal, { run: id });
}

async function fillForm(place, signal, first) {
  document.title = "New run – lasersph";
  let origin = null, rows = new Map();
  const result = h("div", { class: "result", "aria-live": "polite" });
  const changed = h("ul", { class: "tags", "aria-label": "what is changed" });
  const folder = h("input", { id: "folder-name", name: "folder", required: true, pattern: "[A-Za-z0-9][A-Za-z0-9._\\-]*" });
  const start = h("button", { class: "primary", type: "submit", disabled: true }, "Start the run");
  const failed = h("p", { class: "error", role: "alert" });
  const keys = h("div", {});
  const settings = () => [...rows].filter(([, { text, given }]) => text() !== given).map(([key, { text }]) => `${key}=${text()}`);
  const send = (path, content) => ask(path, { signal, method: "POST", body: JSON.stringify(content), headers: { "content-type": "application/json" } });

  // Check once nothing was typed for a while; only the last answer counts.
  let last = 0;
  const check = async () => {
    const mine = ++last;
    start.disabled = true;
    drawChanges();
    await pause(STILL, signal);
    if (mine !== last) return;
    const found = await (await send("api/check", { ...origin, settings: settings() })).json();
    if (mine !== last) return;
    for (const { fields, said } of rows.values()) {
      for (const field of fields()) field.removeAttribute("aria-invalid");
      said.textContent = "";
    }
    start.disabled = found.problems.length > 0;
    result.replaceChildren(h("h2", {}, found.problems.length ? "Not yet right" : "Forecast"), ...found.problems.map(sayProblem),
      found.forecast.length ? table(found.forecast) : "", warningsBox(found.warnings));
  };
  const checkLater = () => check().catch((error) => {
    if (!signal.aborted) throw error;
  });

  /** A problem beside its key, with a button that leads there; in full where the form has no such key. */
  const sayProblem = ({ key, line, text }) => {
    // of a list: probes[2].depth
    const [, inside, number, column] = key.match(/^(.*?)(?:\[(\d+)\](?:\.(\w+)|\[\d+\])?)?$/), row = rows.get(key) ?? rows.get(inside);
    const at = line && !origin.case ? `line ${line}: ` : "";
    const wrong = row?.fields(number, column) ?? [];
    if (!wrong.length) return h("p", { class: "error" }, `${at}${key ? `${key}: ` : ""}${text}`);
    for (const field of wrong) field.setAttribute("aria-invalid", "true");
    row.said.textContent = [row.said.textContent, key === inside ? text : `${key}: ${text}`].filter(Boolean).join("; ");
    return h("p", {}, h("button", { type: "button", onclick: () => {
      wrong[0].closest("details")?.setAttribute("open", "");
      wrong[0].focus();
    } }, `${at}${key}`));
  };
  const drawChanges = () => changed.replaceChildren(...[...rows].filter(([, { text, given }]) => text() !== given).map(([key, { text, given }]) =>
    h("li", { title: `${key}: ${given || "not given"} in the case file` }, `${key} ${/^[[{]/.test(text()) ? "changed" : text() || "left out"}`)));

  // Fields of the case; parts that the reader opened stay open.
  const draw = (form) => {
    const groupOf = (details) => details.closest("fieldset").firstElementChild.textContent;
    const open = [...keys.querySelectorAll("details[open]")].map(groupOf);
    const found = formFields(form, checkLater, chooseKind);
    rows = found.rows;
    keys.replaceChildren(...found.elements);
    for (const details of keys.querySelectorAll("details")) details.open = open.includes(groupOf(details));
  };
  /** Another kind of a table has other keys: the form is asked for anew, with all that was typed. */
  const chooseKind = async (event) => {
    const { id } = event.target;
    let asked, form;
    do { // what is typed while the form is on its way is not lost
      asked = settings();
      form = await (await send("api/form", { ...origin, settings: asked })).json();
    } while (asked.join("\n") !== settings().join("\n"));
    draw(form);
    document.getElementById(id).focus();
    checkLater();
  };
  // Another case: everything typed belongs to the last one.
  const begin = async (wanted) => {
    last += 1;
    start.disabled = true;
    origin = wanted;
    rows = new Map();
    for (const one of [keys, result, changed]) one.replaceChildren();
    if (!wanted) return;
    const form = await (await send("api/form", wanted)).json();
    if (origin !== wanted) return;
    choice.show(wanted, form);
    folder.value = form.folder;
    draw(form);
    checkLater();
  };
  const choice = caseOrigin((wanted) => begin(wanted).catch((error) => {
    if (signal.aborted) return;
    if (!(error instanceof Refused)) throw error;
    choice.say(error.message);
  }));

  await begin(first);
  place.replaceChildren(
    h("p", { class: "path" }, h("a", { href: "#/" }, "Runs"), " / new run"), h("h1", {}, first.run ? "Run again with changes" : "New run"),
    h("form", { class: "case", onsubmit: async (event) => {
      event.preventDefault();
      start.disabled = true;
      failed.textContent = "";
      try {
        const { id } = await (await send("api/start", { ...origin, settings: settings(), name: folder.value.trim() })).json();
        location.hash = `#/run/${id}`;
      } catch (error) {
        if (signal.aborted) return;
        failed.textContent = error.message;
        start.disabled = false;
      }
    } },
    h("div", { class: "keys" }, choice.element, keys),
    h("aside", {}, h("label", { for: folder.id }, "name of its folder"), folder, start, failed, changed, result)));
}
