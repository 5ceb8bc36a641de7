// The fields of a run: which colors it, between which ends, and by which limits it is shown.

export const BEYOND = 3e38;   // of every number of a field
export const FREE = "limits"; // the choice for which limits are typed
const TELLING = ["temperature", "speed"]; // fields that color a run for which none was chosen

// Whether a range is that of one value and its rounding.
export function isFlat([low, high]) {
  return !(high - low > 1e-5 * Math.max(Math.abs(low), Math.abs(high)));
}

// The color of a run for which none was chosen: what tells most and varies. Before anything varies
// it is the temperature, of which a run at its begin has one value.
export function tellingField({ fields, is_complete: isComplete }) {
  const names = fields.map((info) => info.name), known = TELLING.filter((name) => names.includes(name));
  const varying = fields.filter((info) => !isFlat(info.range)).map((info) => info.name);
  return known.find((name) => varying.includes(name)) ?? (isComplete ? varying[0] : null) ?? known[0] ?? names[0];
}

// The ends of the colors of a field. The temperature of a run that computes reaches to where the
// metal melts from the first frame on, so that cold metal is not drawn in the colors of hot metal.
export function rangeOf({ name, range: [low, high] }, { is_complete: isComplete, levels }) {
  const melts = name === "temperature" && !isComplete ? levels?.melts : null;
  return [low, Math.max(high, melts ?? high)];
}

// What can be shown of a run, as [words, value]: all, phases where it melts, what is hotter than its
// levels, any limits.
export function gatesOf({ fields, levels }) {
  const gates = [["all", "null"]];
  const add = (words, field, low, high) => gates.push([words, JSON.stringify({ field, low, high })]);
  const range = (name) => fields.find((one) => one.name === name)?.range ?? [0, 0];
  if (range("melt_fraction")[1] > 0) {
    add("any melt", "melt_fraction", 0.001, BEYOND);
    add("half molten and more", "melt_fraction", 0.5, BEYOND);
    add("fluid only", "melt_fraction", 0.999, BEYOND);
    add("solid and mushy", "melt_fraction", -BEYOND, 0.999);
  }
  for (const [word, value] of Object.entries(levels ?? {}))
    if (range("temperature")[1] >= value) add(`hotter than where it ${word}`, "temperature", value, BEYOND);
  return [...gates, ["limits …", FREE]];
}

export function gateWords(index) {
  return gatesOf(index).map(([words]) => words).join();
}
