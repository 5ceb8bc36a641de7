/** The keys of a case as fields with help, in sections. */

import { h } from "./dom.js";
import { inUnit, listEditor, listText } from "./list_editor.js";

/**
 * The fields of a form, see `form_of`.
 *
 * change: called when anything is typed; chooseKind(event) when a table becomes one of another kind.
 * Returns {elements, rows}: rows has for each key fields(), the inputs, text(), what is typed, given,
 * what the case file says, and said, the place for what is wrong.
 */
export function formFields(form, change, chooseKind) {
  const rows = new Map(), groups = new Map();
  for (const one of form.fields) {
    const group = one.key.includes(".") ? one.key.split(".")[0] : "case";
    // a key that another kind of its table does not have is taken out of the case
    if (one.is_left) rows.set(one.key, { fields: () => [], text: () => "", given: givenText(one), said: h("p", {}) });
    else groups.set(group, [...(groups.get(group) ?? []), one]);
  }
  const rowOf = (one) => {
    const { row, element } = one.list ? listRow(one, change) : plainRow(one, one.key.endsWith(".kind") && one.choices.length ? chooseKind : change);
    rows.set(one.key, row);
    return element;
  };
  const elements = [...groups].map(([group, fields]) => {
    const rest = fields.filter((one) => !isGiven(one));
    return h("fieldset", {}, h("legend", {}, group), fields.filter(isGiven).map(rowOf),
      rest.length > 0 && h("details", {}, h("summary", {}, `${rest.length} more key${rest.length > 1 ? "s" : ""} of ${group}`), rest.map(rowOf)));
  });
  return { elements, rows };
}

function isGiven({ value, given, list }) {
  return value !== "" || given !== "" || [...(list?.rows ?? []), ...(list?.given ?? [])].flat().some((cell) => cell !== "");
}

function givenText({ given, list }) {
  return list ? listText(list, list.given) : given;
}

function idOf(key) {
  return `key-${key.replaceAll(/[^a-z0-9]/gi, "-")}`;
}

function listRow(one, change) {
  const { key, help, list } = one, id = idOf(key), said = h("p", { class: "error", id: `${id}-said` });
  const editor = listEditor(key, list, change);
  const element = h("div", { class: "key", role: "group", "aria-labelledby": id, "aria-describedby": `${id}-said` },
    h("span", { class: "label", id }, key), editor.element, h("p", { class: "quiet" }, help.replaceAll("`", ""), editor.help.replaceAll("`", "")), said);
  return { row: { ...editor, given: givenText(one), said }, element };
}

function plainRow(one, change) {
  const { key, value, help, unit, choices } = one, id = idOf(key), said = h("p", { class: "error", id: `${id}-said` });
  const attributes = { id, "aria-describedby": `${id}-help ${id}-said`, oninput: change };
  const options = choices.includes(value) || !value ? choices : [value, ...choices]; // a wrong one stays until another is chosen
  const field = choices.length
    ? h("select", attributes, [...(one.given ? [] : [""]), ...options].map((name) => h("option", { value: name, selected: name === value }, name || "default")))
    : h("input", { ...attributes, value, placeholder: "default", autocomplete: "off", spellcheck: "false" });
  const element = h("div", { class: "key" }, h("label", { for: id }, key, unit && h("small", {}, inUnit(unit))), field,
    h("p", { class: "quiet", id: `${id}-help` }, help.replaceAll("`", "")), said);
  return { row: { fields: () => [field], text: () => field.value.trim(), given: one.given, said }, element };
}
