// The viewer of particles: 2-D cells as rectangles, 3-D particles as shaded spheres, with WebGL 2.
//
//   const viewer = mount(element, source, options)   ->   { works, setFrame, setField, setLive, destroy }
//
// `works` is false where there is no WebGL 2, which the viewer then says itself.
// A source has `index()`, which resolves to what `lasersph.output.frame_blocks.particle_index`
// gives, and `block(name)`, which resolves to an ArrayBuffer of little-endian float32. Three are
// here: http(base), inline(json) of a report, kernel(model) of a notebook.
// Options: frame (number), field (name), live (true), ranges ({field: [low, high]}, so that two
// viewers have the same scale), onFrame(number, time) after a frame was drawn.
import { Scene } from "./scene.js";

const CSS = `
:host { display: block; font: 13px/1.4 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
* { box-sizing: border-box; }
.viewer { background: #161d29; color: #e8ecf2; border-radius: 10px; overflow: hidden; }
.stage { position: relative; aspect-ratio: 16 / 9; min-height: 220px; max-height: 72vh; width: 100%;
  background: radial-gradient(ellipse at 50% 35%, #2b3648 0%, #161d29 75%); }
canvas { position: absolute; inset: 0; width: 100%; height: 100%; display: block;
  touch-action: none; cursor: grab; }
canvas:active { cursor: grabbing; }
.title { position: absolute; left: 14px; top: 10px; font-size: 14px; font-weight: 600;
  max-width: calc(100% - 28px); white-space: nowrap; overflow: hidden; text-overflow: ellipsis;
  pointer-events: none; text-shadow: 0 1px 3px #000a; }
.legend { position: absolute; right: 12px; top: 10px; bottom: 44px; max-height: 310px; width: 136px;
  display: flex; flex-direction: column; align-items: flex-end; pointer-events: none;
  padding: 4px 6px 10px; border-radius: 6px; background: #161d2970; text-shadow: 0 1px 3px #000a; }
.legend b { font-weight: 600; text-align: right; margin-bottom: 10px; }
.bar { position: relative; flex: 1; width: 14px; border-radius: 3px; border: 1px solid #ffffff40; }
.bar span { position: absolute; right: 20px; transform: translateY(50%); white-space: nowrap;
  font-variant-numeric: tabular-nums; }
.bar span.level { color: #ffd08a; }
.bar span::after { content: ""; position: absolute; right: -7px; top: 50%; width: 5px;
  border-top: 1px solid currentColor; }
.scale { position: absolute; left: 16px; bottom: 12px; border: 2px solid #fff; border-top: 0;
  height: 7px; pointer-events: none; }
.scale span { position: absolute; left: 50%; bottom: 6px; transform: translateX(-50%);
  white-space: nowrap; text-shadow: 0 1px 3px #000; }
.message { position: absolute; left: 50%; bottom: 16px; transform: translateX(-50%);
  background: #0b0f16e0; padding: 4px 14px; border-radius: 14px; max-width: 70%; }
.message:empty { display: none; }
.controls { display: flex; flex-wrap: wrap; gap: 8px 12px; align-items: center;
  padding: 9px 14px; background: #1d2635; }
.time { flex: 1 1 240px; display: flex; gap: 10px; align-items: center; }
.time input { flex: 1; min-width: 90px; }
output { min-width: 5.6em; text-align: right; font-variant-numeric: tabular-nums; }
label { display: inline-flex; gap: 6px; align-items: center; white-space: nowrap; color: #c3ccd9; }
input[type=range] { accent-color: #ff9d3c; }
button, select { font: inherit; color: #f2f5f9; background: #30405a; border: 1px solid #4a5c78;
  border-radius: 6px; padding: 4px 10px; cursor: pointer; min-height: 28px; }
button:hover, select:hover { background: #3d5070; }
button[aria-pressed=true] { background: #b3261e; border-color: #e5574f; }
button:disabled { opacity: .55; cursor: default; }
:focus-visible { outline: 2px solid #ffc46b; outline-offset: 1px; }
[hidden] { display: none !important; }
@media (max-width: 520px) { .stage { aspect-ratio: 4 / 3; } .title { font-size: 12px; }
  .legend { font-size: 11px; right: 4px; top: 30px; width: 104px; } }
`;
const HTML = `
<section class="viewer" aria-label="Particle viewer">
  <div class="stage">
    <canvas tabindex="0" role="img" aria-label="Particles"></canvas>
    <div class="title"></div>
    <div class="legend" hidden><b></b><div class="bar"></div></div>
    <div class="scale" hidden><span></span></div>
    <div class="message" role="status"></div>
  </div>
  <div class="controls">
    <button class="play" type="button" title="Play all frames (space)">▶ Play</button>
    <button class="live" type="button" aria-pressed="false" title="Follow the newest frame"
      hidden>● Live</button>
    <span class="time"><input type="range" min="0" value="0" step="1" aria-label="Time">
      <output></output></span>
    <label>Color <select class="field" aria-label="Color"></select></label>
    <label class="phases">Show <select class="phase" aria-label="Show">
      <option value="-1,2">all</option><option value="0.001,2">any melt</option>
      <option value="0.5,2">half molten and more</option><option value="0.999,2">fluid only</option>
      <option value="-1,0.999">solid and mushy</option></select></label>
    <label class="cuts">Cut <select class="axis" aria-label="Cut"><option value="-1">none</option>
      <option value="0">x</option><option value="1">y</option><option value="2">z</option></select>
      <input class="cut" type="range" min="0" max="1" step="0.005" value="0.5"
        aria-label="Place of the cut" hidden></label>
    <button class="home" type="button" title="Show all again (h)">Whole view</button>
  </div>
</section>`;
// Steps of play [ms], pauses between tries [ms], between two looks at a growing run, memory [bytes]
const STEP = 120, PAUSE = 300, LONGEST_PAUSE = 8000, LOOK = 1000, KEPT = 3e8;
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
  const canvas = part("canvas"), slider = part(".time input"), message = part(".message");
  const say = (text) => { if (message.textContent !== text) message.textContent = text; };
  let scene;
  try {
    scene = new Scene(canvas);
  } catch (error) {
    part(".controls").hidden = true;
    say("Particles cannot be drawn: this browser offers no WebGL 2.");
    const nothing = () => {};
    return { works: false, setFrame: nothing, setField: nothing, setLive: nothing, destroy: nothing };
  }

  let index = null, frame = 0, field = options.field, loaded = null;
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
    const names = ["position", "width", name, ...("melt_fraction" in index.blocks ? ["melt_fraction"] : [])];
    const [position, width, value, melt] = await Promise.all(
      names.map((one) => fetchBlock("particles", one, number)));
    const line = index.surface ? await fetchBlock("surface", "position", number) : null;
    return { position, width, value, melt: melt ?? null, line };
  }

  // Draw a frame; errors are tried again with growing pauses until something else is wanted.
  async function show(number, name = field) {
    const mine = ++generation;
    for (let pause = PAUSE; !gone; pause = Math.min(2 * pause, LONGEST_PAUSE)) {
      try {
        if (!index) takeIndex(await source.index());
        if (mine !== generation) return;
        if (!index.times.length) {
          say("Waiting for the first snapshot");
          return;
        }
        frame = Math.max(0, Math.min(number ?? index.start, index.times.length - 1));
        const known = (one) => index.fields.some((info) => info.name === one);
        field = known(name) ? name : index.fields.find((info) => !isFlat(info.range))?.name
          ?? index.fields[0].name;
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
        say("The frame did not come; trying again");
        await sleep(pause);
        if (mine !== generation || gone) return;
        index = (await source.index().catch(() => null)) ?? index;  // the run may be a new one
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
        const grown = found.times.length > (index?.times.length ?? 0) || found.stamp !== index?.stamp;
        const following = live;  // the last index of a run ends the live state
        takeIndex(found);
        if (message.textContent === SILENT) say("");
        if (grown && following) show(index.times.length - 1);
        else if (grown && !loaded) show(options.frame);
        pause = LOOK;
      } catch (error) {
        if (live) say(SILENT);
        pause = Math.min(2 * pause, LONGEST_PAUSE);
      }
    }
  }

  function takeIndex(found) {
    const first = !index || !index.fields.length;
    index = found;
    slider.max = Math.max(0, index.times.length - 1);
    part(".live").hidden = index.is_complete;
    if (index.is_complete) setLive(false);
    if (!first || !index.fields.length) return;
    part(".title").textContent = index.case;
    part(".cuts").hidden = index.dimensions < 3;
    const melts = index.fields.some((one) => one.name === "melt_fraction" && one.range[1] > 0);
    part(".phases").hidden = !melts;
    const choice = part(".field");
    choice.replaceChildren(...index.fields.map((one) => new Option(one.label, one.name)));
  }

  // ----- drawing

  function draw() {
    const info = index.fields.find((one) => one.name === field);
    let [low, high] = options.ranges?.[field] ?? info.range;
    const signed = low < 0 && high > 0;
    if (signed) [low, high] = [-Math.max(-low, high), Math.max(-low, high)];
    if (isFlat([low, high])) [low, high] = [low - 1, low + 1];
    const colors = signed ? "signed" : field.includes("temperature") ? "heat"
      : field.endsWith("fraction") ? "share" : "amount";
    scene.load(loaded, index, { low, high, colors });
    if (home) scene.goHome();
    home = false;
    applyFilters();
    drawLegend(info, low, high, colors);
  }

  function applyFilters() {
    const axis = Number(part(".axis").value);
    part(".cut").hidden = axis < 0;
    scene.filter(part(".phase").value.split(",").map(Number), axis, Number(part(".cut").value));
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
    const far = (value) => marks.every(([mark]) => Math.abs(mark - value) > 0.055 * (high - low));
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
    const text = quantity(index.times[frame], "s");
    slider.value = frame;
    slider.setAttribute("aria-valuetext", text);
    part("output").textContent = text;
    part(".field").value = field;
  }

  scene.onView = () => {
    const aim = scene.metersPerPixel * 130, ten = 10 ** Math.floor(Math.log10(aim));
    const length = ten * (aim / ten >= 5 ? 5 : aim / ten >= 2 ? 2 : 1);
    part(".scale").hidden = false;
    part(".scale").style.width = `${length / scene.metersPerPixel}px`;
    part(".scale span").textContent = quantity(length, "m");
  };

  // ----- what the user does

  function setFrame(number) {
    setLive(false);
    return show(number);
  }

  function setField(name) {
    return show(frame, name);
  }

  function setLive(wanted) {
    const newly = wanted && !live;
    live = Boolean(wanted) && !index?.is_complete;
    part(".live").setAttribute("aria-pressed", String(live));
    if (!newly || !live) return;
    play(false);
    if (index?.times.length) show(index.times.length - 1);
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
  for (const name of [".phase", ".axis", ".cut"])
    part(name).addEventListener("input", () => loaded && applyFilters());
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
  return { works: true, setFrame, setField, setLive, destroy };
}

// ----- numbers in words

// Whether a range is that of one value and its rounding.
function isFlat([low, high]) {
  return !(high - low > 1e-5 * Math.max(Math.abs(low), Math.abs(high)));
}

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

// ----- sources

export function http(base) {
  const get = async (path, cache) => {
    const answer = await fetch(base + path, { cache });
    if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
    return answer;
  };
  return {
    index: async () => (await get("particles", "no-store")).json(),
    block: async (name) => (await get(`block/${name}`, "default")).arrayBuffer(),
  };
}

// Blocks of a report: 16-bit numbers between the ends of their range, the differences from the
// first block of their field, low bytes before high ones, compressed, in base64.
export function inline(json) {
  const decoded = new Map();
  async function steps(name) {
    const { data } = json.blocks[name];
    const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    const plain = new Uint8Array(await new Response(stream).arrayBuffer());
    const half = plain.length / 2, result = new Uint16Array(half);
    for (let k = 0; k < half; k++) result[k] = plain[k] | (plain[k + half] << 8);
    return result;
  }
  async function block(name) {
    const { range, first } = json.blocks[name];
    const counts = await steps(name), before = first ? await steps(first) : null;
    const parts = range.length, count = counts.length / parts;
    const values = new Float32Array(counts.length);
    for (let part = 0; part < parts; part++) {
      const [low, high] = range[part], unit = (high - low) / 65535;
      for (let k = 0, at = part * count; k < count; k++, at++)
        values[k * parts + part] = low + unit * (before ? (counts[at] + before[at]) & 65535 : counts[at]);
    }
    return values.buffer;
  }
  return {
    index: async () => json.index,
    block: (name) => decoded.get(name) ?? decoded.set(name, block(name)).get(name),
  };
}

// Messages to and from the Python side of an anywidget.
export function kernel(model) {
  const waiting = new Map();
  let last = 0;
  model.on("msg:custom", (answer, buffers) => {
    const one = waiting.get(answer.id);
    waiting.delete(answer.id);
    if (!one) return;
    if (answer.error) return one.fail(new Error(answer.error));
    const view = buffers?.[0];
    one.done(answer.index ?? view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength));
  });
  const ask = (what) => new Promise((done, fail) => {
    const id = ++last;
    waiting.set(id, { done, fail });
    setTimeout(() => waiting.delete(id) && fail(new Error("no answer")), 30000);
    model.send({ id, ...what });
  });
  return { index: () => ask({ ask: "index" }), block: (name) => ask({ ask: "block", name }) };
}

export default {
  render({ model, el }) {
    const viewer = mount(el, kernel(model));
    return () => viewer.destroy();
  },
};
