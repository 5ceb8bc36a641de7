// Style and parts of the viewer.
export const CSS = `
:host { display: block; font: 13px/1.4 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
* { box-sizing: border-box; }
.viewer { container-type: inline-size; background: #161d29; color: #e8ecf2; border-radius: 10px; overflow: hidden; }
.stage { position: relative; aspect-ratio: 16 / 9; min-height: 220px; max-height: 72vh; width: 100%;
  background: radial-gradient(ellipse at 50% 35%, #2b3648 0%, #161d29 75%); }
.stage.is-empty { aspect-ratio: auto; min-height: 64px; }
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
.scale { position: absolute; left: 12px; bottom: 10px; padding: 3px 8px 7px; border-radius: 6px;
  background: #161d29c8; text-align: center; pointer-events: none; }
.scale i { display: block; height: 6px; margin: 0 auto; border: 2px solid #fff; border-top: 0; }
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
.span { display: inline-flex; gap: 6px; align-items: center; flex-wrap: wrap; color: #c3ccd9; }
input[type=number] { width: 6.2em; cursor: text; }
button, select, input[type=number] { font: inherit; color: #f2f5f9; background: #30405a; border: 1px solid #4a5c78;
  border-radius: 6px; padding: 4px 10px; cursor: pointer; min-height: 28px; }
button:hover, select:hover { background: #3d5070; }
button[aria-pressed=true] { background: #b3261e; border-color: #e5574f; }
button:disabled { opacity: .55; cursor: default; }
:focus-visible { outline: 2px solid #ffc46b; outline-offset: 1px; }
[hidden] { display: none !important; }
@container (max-width: 520px) { .stage { aspect-ratio: 4 / 3; } .title { font-size: 12px; }
  .legend { font-size: 11px; right: 4px; top: 30px; width: 104px; } }
`;
// Picture with its legends, then the controls below it.
export const HTML = `
<section class="viewer" aria-label="Particle viewer">
  <div class="stage">
    <div class="title"></div>
    <div class="legend" hidden><b></b><div class="bar"></div></div>
    <div class="scale" hidden><span></span><i></i></div>
    <div class="message" role="status"></div>
  </div>
  <div class="controls">
    <button class="play" type="button" title="Play all frames (space)">▶ Play</button>
    <button class="live" type="button" aria-pressed="false" title="Follow the newest frame"
      hidden>● Live</button>
    <span class="time"><input type="range" min="0" value="0" step="1" aria-label="Time">
      <output></output></span>
    <label>Color <select class="field" aria-label="Color"></select></label>
    <label>Show <select class="gate" aria-label="Show"></select></label>
    <span class="span" hidden><select class="measure" aria-label="Field with limits"></select>
      <input class="least" type="number" step="any" aria-label="At least" placeholder="any"> to
      <input class="most" type="number" step="any" aria-label="At most" placeholder="any">
      <span class="unit"></span></span>
    <label class="bodies" hidden>Body <select class="body" aria-label="Body"></select></label>
    <label class="cuts">Cut <select class="axis" aria-label="Cut"><option value="-1">none</option>
      <option value="0">x</option><option value="1">y</option><option value="2">z</option></select>
      <input class="cut" type="range" min="0" max="1" step="0.005" value="0.5"
        aria-label="Place of the cut" hidden></label>
    <button class="home" type="button" title="Show all again (h)">Whole view</button>
  </div>
</section>`;
