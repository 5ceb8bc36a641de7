// The viewer of particles: 2-D cells as rectangles, 3-D particles as shaded spheres, with WebGL 2.
//
//   const viewer = mount(element, source, options)   ->
//     { works, setFrame, setField, setLive, box, setBox, destroy }
//
// `works` is false where there is no WebGL 2, which the viewer then says itself. `box` gives what
// the whole view shows, [low, high] of x, y and z [m], once a frame was drawn.
// A source has `index()`, which resolves to what `lasersph.output.frame_blocks.particle_index`
// gives, and `block(name)`, which resolves to an ArrayBuffer of little-endian float32: sources.js.
// Options: frame (number), field (name), live (true), ranges ({field: [low, high]}, so that two
// viewers have the same scale), onFrame(number, time) after a frame was drawn.
import { readyScene } from "./scene.js";
import { moment } from "./moments.js";
import { kernel } from "./sources.js";
import { BEYOND, FREE, gatesOf, gateWords, isFlat, rangeOf, tellingField } from "./viewer_fields.js";
import { BODIES, hasBody, loadBody, surfaceGrid } from "./surface_body.js";
import { CSS, HTML } from "./viewer_look.js";

// Steps of play [ms], pauses between tries [ms], between two looks at a growing run, memory [bytes]
const STEP = 120, PAUSE = 300, LONGEST_PAUSE = 8000, LOOK = 1000, KEPT = 3e8;
const LETTERS = 17; // from a mark of the color bar to the next, at least [pixels]
const SILENT = "The run does not answer; trying again";
const PREFIXES = [[1e-12, "p"], [1e-9, "n"], [1e-6, "µ"], [1e-3, "m"], [1, ""], [1e3, "k"],
  [1e6, "M"], [1e9, "G"]];

export function mount(element, source, options = {}) {
  const root = element.shadowRoot ?? element.attachShadow({ mode: "open" });
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(CSS);
  root.adoptedStyleSheets = [sheet];
  root.innerHTML = HTML;
  const part = (name) => root.querySelector(name);
  const slider = part(".time input"), message = part(".message");
  const say = (text) => { if (message.textContent !== text) message.textContent = text; };
  let begun = source.index();  // on its way while the card is made ready
  begun.catch(() => {});       // it is asked for again
  let scene;
  try {
    scene = readyScene();
  } catch (error) {
    part(".controls").hidden = true;
    part(".stage").classList.add("is-empty");
    say("Particles cannot be drawn: this browser offers no WebGL 2.");
    const nothing = () => {};
    return { works: false, setFrame: nothing, setField: nothing, setLive: nothing, box: nothing, destroy: nothing };
  }

  const canvas = scene.canvas;
  for (const [name, value] of [["tabindex", "0"], ["role", "img"], ["aria-label", "Particles"]])
    canvas.setAttribute(name, value);
  part(".stage").prepend(canvas);

  let index = null, frame = 0, loaded = null;
  let chosen = options.field, field = null;  // a color for which none was chosen follows the run
  let gate = null;  // what is shown: {field, low, high}; null shows all
  let live = Boolean(options.live), playing = null, generation = 0, gone = false, home = true;
  const kept = new Map();

  // ----- loading: whatever is late, or comes for what is no longer wanted, is dropped

  const sleep = (time) => new Promise((done) => setTimeout(done, time));

  async function fetchBlock(file, name, number) {
    const where = file === "surface" ? index.surface : index;
    const key = [file, name, where.blocks[name][number], where.counts[number], index.stamp].join(".");
    let block = kept.get(key);
    if (!block) {
      block = new Float32Array(await source.block(key));
      let bytes = block.byteLength;
      for (const [old, array] of [...kept].reverse()) {
        bytes += array.byteLength;
        if (bytes > KEPT) kept.delete(old);
      }
    }
    kept.delete(key);  // the last one used is the last one forgotten
    kept.set(key, block);
    return block;
  }

  async function loadFrame(number, name) {
    // a field of the surface alone colors no particles: they lie in the dark of its scale
    const own = name in index.blocks ? name : "temperature";
    const names = [...new Set(["position", "width", own, ...(gate ? [gate.field] : [])])];
    const blocks = await Promise.all(names.map((one) => fetchBlock("particles", one, number)));
    const block = Object.fromEntries(names.map((one, k) => [one, blocks[k]]));
    const { line, level } = await loadBody(index, fetchBlock, number, name);
    const value = own === name ? block[own] : new Float32Array(block[own].length).fill(-BEYOND);
    return { position: block.position, width: block.width, value, line, level,
      gate: gate && block[gate.field] };
  }

  // Draw a frame; errors are tried again with growing pauses until something else is wanted.
  async function show(number, name = chosen) {
    const mine = ++generation;
    for (let pause = PAUSE; !gone; pause = Math.min(2 * pause, LONGEST_PAUSE)) {
      try {
        if (!index) takeIndex(await (begun ?? source.index()));
        if (mine !== generation) return;
        if (!index.times.length) {
          say("Waiting for the first snapshot");
          return;
        }
        frame = Math.max(0, Math.min(number ?? index.start, index.times.length - 1));
        field = index.fields.some((info) => info.name === name) ? name : tellingField(index);
        tellFrame();
        const found = await loadFrame(frame, field);
        if (mine !== generation) return;
        loaded = found;
        draw();
        say("");
        part(".stage").dataset.shown = `${frame} ${field}`;
        options.onFrame?.(frame, index.times[frame]);
        return;
      } catch (error) {
        if (mine !== generation) return;
        begun = null;
        say("The frame did not come; trying again");
        await sleep(pause);
        if (mine !== generation || gone) return;
        const found = await source.index().catch(() => null);  // the run may be a new one, or at its end
        if (mine !== generation || gone) return;
        if (found && takeNewer(found).follows) number = index.times.length - 1;
      }
    }
  }

  // While a run computes, look for new frames; in the live state show the newest.
  async function watch() {
    for (let pause = LOOK; !gone; ) {
      await sleep(pause);
      if (gone || index?.is_complete) return;
      try {
        const found = await source.index();
        if (gone) return;
        const { grown, follows } = takeNewer(found);
        if (message.textContent === SILENT) say("");
        if (follows) show(index.times.length - 1);
        else if (grown && !loaded) show(options.frame);
        pause = LOOK;
      } catch (error) {
        if (live) say(SILENT);
        pause = Math.min(2 * pause, LONGEST_PAUSE);
      }
    }
  }

  // Whether there are more frames than before, and whether the newest of them is to be shown.
  function takeNewer(found) {
    const grown = found.times.length > (index?.times.length ?? 0) || found.stamp !== index?.stamp;
    const follows = grown && live;  // asked first: the last index of a run ends the live state
    takeIndex(found);
    return { grown, follows };
  }

  function takeIndex(found) {
    const first = !index || !index.fields.length;
    const before = first ? "" : gateWords(index);
    index = found;
    slider.max = Math.max(0, index.times.length - 1);
    part(".live").hidden = index.is_complete;
    if (index.is_complete) setLive(false);
    if (!index.fields.length) return;
    if (gateWords(index) !== before) offerGates();
    if (!first) return;
    part(".title").textContent = index.case;
    part(".bodies").hidden = !hasBody(index);
    part(".body").replaceChildren(...BODIES.map(([words, value]) => new Option(words, value)));
    part(".body").value = BODIES[index.dimensions === 3 && hasBody(index) ? 1 : 0][1];
    showCuts();
    const gated = index.fields.filter((one) => one.name in index.blocks);
    for (const [choice, fields] of [[".field", index.fields], [".measure", gated]])
      part(choice).replaceChildren(...fields.map((one) => new Option(one.label, one.name)));
  }

  // What can be shown grows with the run, which melts and boils while it is watched.
  function offerGates() {
    const was = part(".gate").value;
    part(".gate").replaceChildren(...gatesOf(index).map(([words, value]) => new Option(words, value)));
    if (gatesOf(index).some(([, value]) => value === was)) part(".gate").value = was;
  }

  // ----- drawing

  function draw() {
    const info = index.fields.find((one) => one.name === field);
    let [low, high] = options.ranges?.[field] ?? rangeOf(info, index);
    const signed = low < 0 && high > 0;
    if (signed) [low, high] = [-Math.max(-low, high), Math.max(-low, high)];
    if (isFlat([low, high])) [low, high] = [low - 1, low + 1];
    const colors = signed ? "signed" : field.includes("temperature") ? "heat"
      : field.endsWith("fraction") ? "share" : "amount";
    const shape = hasBody(index) && JSON.parse(part(".body").value);
    loaded.grid = shape ? surfaceGrid(index, loaded.line, loaded.level, shape.times) : null;
    loaded.hasParticles = !shape || Boolean(shape.particles && index.dimensions === 3);
    scene.load(loaded, index, { low, high, colors });
    if (home) scene.goHome();
    home = false;
    applyFilters();
    drawLegend(info, low, high, colors);
  }

  // Another body is looked at anew.
  function chooseBody() {
    showCuts();
    scene.box = null;
    home = true;
    if (loaded) draw();
  }

  function showCuts() {
    const isFlat = index.dimensions < 3 && part(".body").value === BODIES[0][1];
    part(".cuts").hidden = isFlat;
    if (isFlat) part(".axis").value = "-1";
  }

  function applyFilters() {
    const axis = Number(part(".axis").value);
    part(".cut").hidden = axis < 0;
    scene.filter(gate ? [gate.low, gate.high] : [-BEYOND, BEYOND], axis, Number(part(".cut").value));
  }

  function drawLegend(info, low, high, colors) {
    const { factor, unit } = scaled(info.unit, Math.max(Math.abs(low), Math.abs(high)));
    const bar = part(".bar");
    part(".legend").hidden = false;
    part(".legend b").textContent = unit ? `${info.label} [${unit}]` : info.label;
    bar.style.background = `linear-gradient(to top, ${scene.gradient(colors).join(", ")})`;
    const levels = field === "temperature" ? Object.entries(index.levels ?? {}) : [];
    const marks = levels.map(([word, value]) => [value, word])
      .filter(([value]) => value > low && value <= high);
    const step = niceStep((high - low) * factor / 5) / factor;
    const least = (LETTERS / (bar.clientHeight || 10 * LETTERS)) * (high - low);
    const far = (value) => marks.every(([mark]) => Math.abs(mark - value) > least);
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high * (1 + 1e-9); k++)
      if (far(k * step)) marks.push([k * step, null]);
    bar.replaceChildren(...marks.map(([value, word]) => {
      const mark = document.createElement("span");
      mark.className = word ? "level" : "";
      mark.textContent = (word ? `${word} ` : "") + number(value * factor);
      mark.style.bottom = `${100 * (value - low) / (high - low)}%`;
      return mark;
    }));
  }

  function tellFrame() {
    const text = moment(index.times[frame], index.pulses, quantity);
    slider.value = frame;
    slider.setAttribute("aria-valuetext", text);
    part("output").textContent = text;
    part(".field").value = field;
  }

  scene.onView = () => {
    const aim = scene.metersPerPixel * 130, ten = 10 ** Math.floor(Math.log10(aim));
    const length = ten * (aim / ten >= 5 ? 5 : aim / ten >= 2 ? 2 : 1);
    part(".scale").hidden = false;
    part(".scale i").style.width = `${length / scene.metersPerPixel}px`;
    part(".scale span").textContent = quantity(length, "m");
  };

  // ----- what the user does

  function setFrame(number) {
    setLive(false);
    return show(number);
  }

  function setField(name) {
    chosen = name;
    return show(frame);
  }

  function setLive(wanted) {
    const newly = wanted && !live;
    live = Boolean(wanted) && !index?.is_complete;
    part(".live").setAttribute("aria-pressed", String(live));
    if (!newly || !live) return;
    play(false);
    if (index?.times.length) show(index.times.length - 1);
  }

  // Limits of a field: those of a choice, or what was typed, in the unit that is shown.
  function chooseGate() {
    const choice = part(".gate").value, isFree = choice === FREE;
    part(".span").hidden = !isFree;
    if (!isFree) return setGate(JSON.parse(choice));
    const info = index.fields.find((one) => one.name === part(".measure").value);
    const { factor, unit } = unitOfLimits(info);
    part(".unit").textContent = unit;
    const limit = (name, none) => (part(name).value === "" ? none : Number(part(name).value) / factor);
    return setGate({ field: info.name, low: limit(".least", -BEYOND), high: limit(".most", BEYOND) });
  }

  function setGate(wanted) {
    gate = wanted;
    if (gate && loaded && index.blocks[gate.field]) return show(frame);
    return loaded && applyFilters();
  }

  // A field to be limited begins where the metal melts, or in the middle of its range.
  function beginLimits(name) {
    const info = index.fields.find((one) => one.name === name);
    const { factor } = unitOfLimits(info), { melts } = index.levels ?? {};
    const begin = name === "temperature" && melts ? melts : 0.5 * (info.range[0] + info.range[1]);
    part(".measure").value = name;
    part(".least").value = Number((begin * factor).toPrecision(4));
    part(".most").value = "";
  }

  function unitOfLimits({ unit, range }) {
    return scaled(unit, Math.max(...range.map(Math.abs)));
  }

  async function play(wanted) {
    if (Boolean(playing) === wanted) return;
    const mine = wanted ? {} : null;
    playing = mine;
    part(".play").textContent = wanted ? "❚❚ Pause" : "▶ Play";
    while (mine && playing === mine && !gone && index) {
      const due = sleep(STEP);
      await show((frame + 1) % index.times.length);
      await due;
    }
  }

  slider.addEventListener("input", () => { play(false); setFrame(Number(slider.value)); });
  part(".field").addEventListener("change", (event) => setField(event.target.value));
  part(".live").addEventListener("click", () => setLive(!live));
  part(".play").addEventListener("click", () => { setLive(false); play(!playing); });
  part(".home").addEventListener("click", () => loaded && scene.goHome());
  part(".body").addEventListener("change", chooseBody);
  for (const name of [".axis", ".cut"])
    part(name).addEventListener("input", () => loaded && applyFilters());
  part(".gate").addEventListener("input", () => {
    if (part(".gate").value === FREE && !part(".measure").dataset.begun) {
      part(".measure").dataset.begun = "yes";
      beginLimits(index.fields.some((one) => one.name === "temperature") ? "temperature" : field);
    }
    chooseGate();
  });
  part(".measure").addEventListener("input", (event) => { beginLimits(event.target.value); chooseGate(); });
  for (const name of [".least", ".most"]) part(name).addEventListener("input", chooseGate);
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step) { play(false); setFrame(frame + step); }
    else if (event.key === " ") part(".play").click();
    else if (event.key === "h") part(".home").click();
    else return;
    event.preventDefault();
  });
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => { scene.build(); if (loaded) draw(); });

  part(".live").setAttribute("aria-pressed", String(live));
  show(options.frame).then(watch);
  function destroy() {
    gone = true;
    generation++;
    scene.destroy();
    root.replaceChildren();
  }
  function setBox(box) {
    scene.box = box;
    scene.goHome();
  }
  return { works: true, setFrame, setField, setLive, box: () => scene.box, setBox, destroy };
}

// ----- numbers in words

function niceStep(rough) {
  const ten = 10 ** Math.floor(Math.log10(rough));
  return ten * [1, 2, 5, 10].find((one) => one * ten >= rough * 0.999);
}

function number(value) {
  const text = Number(value.toPrecision(4));
  if (text !== 0 && (Math.abs(text) >= 1e5 || Math.abs(text) < 1e-3)) return text.toExponential();
  return String(text).replace("-", "−");
}

// The factor and name of the unit in which a size shows as a number between 1 and 1000.
function scaled(unit, size) {
  if (!["s", "m", "m/s", "Pa", "J/kg", "K/m"].includes(unit)) return { factor: 1, unit: unit === "1" ? "" : unit };
  const [power, letter] = [...PREFIXES].reverse().find(([one]) => size >= one) ?? PREFIXES[4];
  return { factor: 1 / power, unit: letter + unit };
}

function quantity(value, unit) {
  const { factor, unit: name } = scaled(unit, Math.abs(value));
  return `${number(value * factor)} ${name}`;
}

export default {
  render({ model, el }) {
    const viewer = mount(el, kernel(model));
    return () => viewer.destroy();
  },
};
