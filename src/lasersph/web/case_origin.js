/** Source of a new run: a shipped case, a case file below the folder, a text, an earlier run. */

import { h } from "./dom.js";

const MOST = 60000; // letters of a case that a request carries

/**
 * The choice of a case.
 *
 * choose(origin, name): called with what the server is to read, {case}, {file}, {text} or {run}, and a
 * name for it; with null while nothing is chosen. Returns {element, show(origin, form), say(text)}.
 */
export function caseOrigin(choose) {
  const cases = h("select", { id: "case" });
  const path = h("input", { id: "own-path", placeholder: "my-case.toml", autocomplete: "off", spellcheck: "false" });
  const upload = h("input", { id: "own-upload", type: "file", accept: ".toml" });
  const text = h("textarea", { id: "own-text", rows: 12, spellcheck: "false", placeholder: 'title = "my case"' });
  const said = h("p", { class: "error", role: "alert" });
  const read = (action) => h("button", { type: "button", onclick: action }, "Read the case");
  const byPath = h("div", { class: "own", hidden: true }, h("label", { for: "own-path" }, "path below the folder of runs"), path,
    read(() => choose({ file: path.value.trim() }, path.value.trim())));
  const byText = h("div", { class: "own", hidden: true }, h("label", { for: "own-upload" }, "a file of this computer"), upload,
    h("label", { for: "own-text" }, "or its text"), text, read(() => sendText("own case")));

  const sendText = (name) => {
    if (text.value.length > MOST) return say(`A case of at most ${MOST} letters is wanted; lay larger ones below the folder of runs.`);
    return choose({ text: text.value }, name);
  };
  const say = (words) => { said.textContent = words; };
  upload.addEventListener("change", async () => {
    const [file] = upload.files;
    if (!file) return;
    if (file.size > 4 * MOST) return say(`${file.name} is too large for a case.`);
    text.value = await file.text();
    sendText(file.name);
  });
  cases.addEventListener("change", () => {
    byPath.hidden = cases.value !== ":file";
    byText.hidden = cases.value !== ":text";
    if (!cases.value.startsWith(":")) location.hash = `#/new/${cases.value}`;
    else if (cases.value !== ":run") choose(null);
  });

  /** Show which case was read. */
  const show = (origin, form) => {
    const option = (value, words) => h("option", { value, selected: origin.case ? value === origin.case : value in ofKind && ofKind[value] in origin }, words);
    const ofKind = { ":file": "file", ":text": "text", ":run": "run" };
    cases.replaceChildren(...(origin.run ? [option(":run", `the run ${form.name}, again with changes`)] : []),
      h("optgroup", { label: "own" }, option(":file", "a case file below the folder of runs"), option(":text", "a case file of this computer, or its text")),
      h("optgroup", { label: "shipped" }, form.cases.map((one) => option(one, one))));
    say("");
  };
  const element = h("fieldset", { class: "origin" }, h("legend", {}, "begin with"),
    h("div", { class: "key" }, h("label", { for: "case" }, "case"), cases), byPath, byText, said);
  return { element, show, say };
}
