/** The head of the page, and what is shown for which address after the #. */

import { h } from "./dom.js";
import { showList } from "./list.js";
import { Refused } from "./net.js";

/** Views by address; the list does not wait for the modules of the others. */
const ADDRESSES = [
  [/^#\/run\/([0-9a-f]+)$/, async () => (await import("./run.js")).showRun],
  [/^#\/compare\/([0-9a-f]+)\/([0-9a-f]+)$/, async () => (await import("./compare.js")).showComparison],
  [/^#\/sweep\/([0-9a-f]+)$/, async () => (await import("./sweep.js")).showSweep],
  [/^#\/new(?:\/([a-z0-9-]+))?$/, async () => (await import("./form.js")).showForm],
  [/^#\/again\/([0-9a-f]+)$/, async () => (await import("./form.js")).showAgain],
  [/^(#\/)?$/, () => showList],
];
let shown = null;

/** Name the folder, and offer a new run where the server may start one. */
function head(content) {
  document.getElementById("folder").textContent = content.folder;
  const actions = document.getElementById("actions");
  if (content.may_run && !actions.children.length) actions.append(h("a", { class: "button", href: "#/new" }, "New run"));
}

/** Show what belongs to the address; what was shown before is ended. */
async function show() {
  const address = location.hash;
  const [match, view] = ADDRESSES.map(([pattern, view]) => [address.match(pattern), view]).find(([match]) => match) ?? [];
  if (!match && !address.startsWith("#/")) return; // a place in the page
  const wasShown = shown !== null;
  shown?.abort();
  shown = new AbortController();
  const { signal } = shown;
  // a part of its own: what comes late for an address that was left draws into what nobody sees
  const place = h("div", { class: "view" });
  document.getElementById("content").replaceChildren(place);
  document.title = "lasersph";
  window.scrollTo(0, 0);
  if (wasShown) document.getElementById("content").focus({ preventScroll: true });
  try {
    if (!match) throw new Refused(404, "There is nothing at this address.");
    await (await view())(place, signal, head, ...match.slice(1).filter(Boolean));
  } catch (error) {
    if (signal.aborted) return;
    place.replaceChildren(h("h1", {}, error instanceof Refused ? "Nothing to show" : "The page failed"),
      h("p", { class: "error" }, error.message), h("p", {}, h("a", { href: "#/" }, "All runs")));
    if (!(error instanceof Refused)) throw error;
  }
}

window.addEventListener("hashchange", show);
show();
