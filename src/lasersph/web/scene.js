// Draws particles with WebGL 2: cells of a plane as rectangles, particles of space as spheres.
//
// The camera is orthographic, so that a scale bar is true everywhere: a point p [m] is drawn at
// turn (p - center) / metersPerPixel. In the plane x points right and z up; in space the mouse
// turns the view about the body. While a large cloud moves, a random part of it is drawn.

import { COLORS, ramp, CELL, FLAT, LIT, PLAIN, ROUND, SEGMENT, SPHERE, SURFACE, VIEW } from "./shaders.js";
import { boxOf, drawSurface } from "./surface_body.js";

const MOVING = 100000;  // particles drawn while a cloud moves that takes longer than SLOW to draw
const SLOW = 60;        // [ms]
const TURN = 0.008;     // radians per pixel of the mouse
const EDGE = 16;        // pixels left free beside the body
const NARROW = 520;     // pixels of a window whose color bar is small, as in viewer_look.js

const PROGRAMS = { cells: [CELL, FLAT], spheres: [SPHERE, ROUND], segments: [SEGMENT, PLAIN],
  surfaces: [SURFACE, LIT] };

let spare = null; // a scene that waits for its first particles

// Make a scene before one is needed: without a graphics card that takes half a second.
export function prepareScene() {
  try {
    spare ??= new Scene(document.createElement("canvas"));
    spare.drawNothing();
  } catch {
    spare = null; // the viewer says that there is no WebGL 2
  }
}

// The scene that was prepared, or a new one. Throws where there is no WebGL 2.
export function readyScene() {
  const found = spare?.gl.isContextLost() ? null : spare;
  spare = null;
  return found ?? new Scene(document.createElement("canvas"));
}

export class Scene {
  constructor(canvas) {
    this.canvas = canvas;
    this.gl = canvas.getContext("webgl2", { antialias: true, powerPreference: "high-performance" });
    if (!this.gl) throw new Error("no WebGL 2");
    this.center = [0, 0, 0];
    this.yaw = 0.55;
    this.pitch = 0.5;
    this.metersPerPixel = 1e-9;
    this.lastDrawn = 0;
    this.onView = () => {};
    this.build();
    this.watchMouse();
    this.resized = new ResizeObserver(() => (this.box && !this.isTurned ? this.goHome() : this.request()));
    this.resized.observe(canvas);
  }

  // Programs and buffers; again after the graphics card was lost.
  build() {
    const gl = this.gl;
    this.programs = {};
    this.arrays = new Map();
    this.buffers = {};
    for (const name of ["position", "width", "value", "gate", "line", "corner", "order",
      "point", "normal", "level", "triangles"])
      this.buffers[name] = gl.createBuffer();
    this.fill("corner", new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
    this.texture = gl.createTexture();
  }

  // A program, built when it is first drawn with: that takes a tenth of a second without a card.
  program(name) {
    return (this.programs[name] ??= this.linked(...PROGRAMS[name]));
  }

  linked(vertex, fragment) {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VIEW + vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error(gl.getProgramInfoLog(program));
    return program;
  }

  // Bring an array to the card, unless it is there.
  fill(name, array) {
    const gl = this.gl;
    if (this.arrays.get(name) === array) return;
    this.arrays.set(name, array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
    gl.bufferData(gl.ARRAY_BUFFER, array, gl.STATIC_DRAW);
  }

  // Take a frame: arrays of `frame_blocks`, with the ends and the name of the colors.
  load(frame, index, { low, high, colors }) {
    const gl = this.gl;
    this.frame = frame;
    this.index = index;
    this.range = [low, high];
    this.count = frame.value.length;
    if (this.arrays.get("width") !== frame.width)
      this.smallest = frame.width.reduce((low, one) => (one > 0 && one < low ? one : low), Infinity);
    for (const name of ["position", "width", "value"]) this.fill(name, frame[name]);
    if (frame.gate) this.fill("gate", frame.gate);
    if (frame.line) this.fill("line", frame.line);
    if (index.dimensions === 3 && this.arrays.get("order")?.length !== this.count) {
      const order = shuffled(this.count);
      this.arrays.set("order", order);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers.order);
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, order, gl.STATIC_DRAW);
    }
    if (this.colors !== colors) {
      this.colors = colors;
      gl.bindTexture(gl.TEXTURE_2D, this.texture);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, ramp(colors));
      for (const end of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T])
        gl.texParameteri(gl.TEXTURE_2D, end, gl.CLAMP_TO_EDGE);
      for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
        gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR);
    }
    this.request();
  }

  gradient(colors) {
    return COLORS[colors];
  }

  // Show what lies between two ends of the gate, a field of its own; cut away what lies before a
  // plane, at a part of the body.
  filter(kept, axis, part) {
    this.kept = kept;
    this.cut = [0, 0, 0, 3e38];
    if (axis >= 0) {
      const [least, high] = this.index.bounds[axis], { mirrored, mirrored_y: mirroredY } = this.index;
      const low = [mirrored, mirroredY, false][axis] ? -high : least;
      const toward = axis === 1 ? -1 : 1;  // y is cut in front of the plane, x and z behind it
      this.cut[axis] = toward;
      this.cut[3] = toward * (low + part * (high - low));
    }
    this.request();
  }

  // Look at the box that the first frame shown asked for.
  goHome() {
    const [x, y, z] = (this.box ??= this.homeBox());
    const space = this.space;
    this.center = [x, y, z].map(([low, high]) => 0.5 * (low + high));
    [this.yaw, this.pitch] = space ? [0.55, 0.5] : [0, 0];
    const { clientWidth: wide, clientHeight: high } = this.canvas;
    const across = space ? 1.4 * Math.max(x[1] - x[0], y[1] - y[0]) : x[1] - x[0];
    const up = space ? 0.88 * (z[1] - z[0]) + 0.66 * (y[1] - y[0]) : z[1] - z[0];
    const bar = wide > NARROW ? 160 : 112;  // pixels of the color bar, at the right
    this.metersPerPixel = Math.max(across / (wide - bar - 2 * EDGE), up / (high - 70), 1e-15);
    this.shift(0.5 * bar, 0);
    this.isTurned = false;  // by the user: until then it fits whatever the size of the window
    this.request();
  }

  // The body as it lay at first and what is close above it; of a deep plane what became warm.
  homeBox() {
    const { bounds, mirrored, mirrored_y: mirroredY, dimensions } = this.index;
    const [x, y, z] = bounds.map(([low, high]) => [low, high]);
    if (mirrored) x[0] = -x[1];
    if (mirroredY) y[0] = -y[1];
    if (this.frame.grid && !this.frame.hasParticles) {
      this.column = 0;
      return boxOf(this.frame.grid);
    }
    const tall = z[1] - z[0];
    this.column = 0.25 * tall;
    if (dimensions === 1) [x[0], x[1]] = [-0.5 * this.column, 0.5 * this.column];
    if (dimensions < 3)
      z[0] = Math.max(z[0], z[1] - Math.max(this.warmDepth(), 0.3 * (x[1] - x[0])));
    z[1] += Math.max(0, Math.min(this.highest() - z[1], 0.4 * tall));
    return [x, y, z];
  }

  // Whether what is shown is turned, not only moved.
  get space() {
    return this.index.dimensions === 3 || Boolean(this.frame?.grid);
  }

  highest() {
    const { position, width } = this.frame;
    let top = -Infinity;
    for (let k = 2; k < position.length; k += 3) top = Math.max(top, position[k] + 0.5 * width[k]);
    return top;
  }

  // How deep below the top the colored field reaches [m], and half as much again.
  warmDepth() {
    const { position, value } = this.frame;
    const top = this.index.bounds[2][1];
    let low = Infinity, high = -Infinity;
    for (const one of value) { low = Math.min(low, one); high = Math.max(high, one); }
    let depth = 0;
    for (let k = 0; k < value.length; k++)
      if (value[k] > low + 0.05 * (high - low)) depth = Math.max(depth, top - position[3 * k + 2]);
    return 1.5 * depth;
  }

  // ----- drawing

  request(moving = false) {
    this.moving = moving;
    this.isTurned ||= moving;
    if (this.pending) return;
    this.pending = requestAnimationFrame(() => {
      this.pending = 0;
      if (!this.frame || this.gl.isContextLost()) return;
      const partly = this.moving && this.lastDrawn > SLOW && this.count > MOVING;
      this.draw(partly ? MOVING : this.count);
      clearTimeout(this.rest);
      if (partly) this.rest = setTimeout(() => this.request(), 200);
      this.onView();
    });
  }

  // Draw a cell that nobody sees: what the card prepares for a first picture is then there.
  drawNothing() {
    const none = new Float32Array(3);
    this.load({ position: none, width: none, value: new Float32Array(1) },
      { dimensions: 2, bounds: Array(3).fill([0, 1]) }, { low: 0, high: 1, colors: "heat" });
    this.filter([-3e38, 3e38], -1, 0);
    this.column = 0;
    this.draw();
    this.frame = null;
  }

  // Draw `count` particles of the frame; returns the time that it took [ms].
  draw(count = this.count) {
    const gl = this.gl, canvas = this.canvas, { grid } = this.frame;
    const dense = Math.min(devicePixelRatio || 1, 2), began = performance.now();
    for (const [side, size] of [["width", canvas.clientWidth], ["height", canvas.clientHeight]]) {
      const pixels = Math.max(1, Math.round(size * dense));
      if (canvas[side] !== pixels) canvas[side] = pixels; // which takes new memory of the card
    }
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (!grid || this.frame.hasParticles) this.drawParticles(count, dense);
    if (grid) drawSurface(this, dense);
    else if (this.frame.line && this.index.dimensions === 2) this.drawLine(dense);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // wait for the card
    this.lastDrawn = performance.now() - began;
    return this.lastDrawn;
  }

  // The mirror images that belong to the body, as signs of x and y.
  sides() {
    const { mirrored, mirrored_y: mirroredY } = this.index;
    return (mirrored ? [-1, 1] : [1]).flatMap((x) => (mirroredY ? [-1, 1] : [1]).map((y) => [x, y]));
  }

  drawParticles(count, dense) {
    const gl = this.gl, { dimensions } = this.index;
    const program = this.program(dimensions === 3 ? "spheres" : "cells");
    this.use(program, dense);
    gl.uniform2fv(gl.getUniformLocation(program, "kept"), this.kept);
    gl.uniform4fv(gl.getUniformLocation(program, "cut"), this.cut);
    gl.uniform1f(gl.getUniformLocation(program, "column"), this.column);
    const step = dimensions === 3 ? 0 : 1;
    this.attach(program, "position", "position", 3, step);
    this.attach(program, "width", "width", 3, step);
    this.attach(program, "value", "value", 1, step);
    this.attach(program, "gate", this.frame.gate ? "gate" : "value", 1, step);
    if (!this.frame.gate) gl.uniform2f(gl.getUniformLocation(program, "kept"), -3e38, 3e38);
    this.attach(program, "corner", "corner", 2, 0);
    (dimensions === 3 ? gl.enable : gl.disable).call(gl, gl.DEPTH_TEST);
    for (const side of this.sides()) {
      gl.uniform2f(gl.getUniformLocation(program, "side"), ...side);
      if (dimensions === 3) {
        // a little larger than their cell they close the body; where only a part is drawn, too
        gl.uniform1f(gl.getUniformLocation(program, "swell"), 0.6 * Math.cbrt(this.count / count));
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers.order);
        gl.drawElements(gl.POINTS, count, gl.UNSIGNED_INT, 0);
        continue;
      }
      for (const more of [0.4, 0]) {  // larger ones below fill the gaps between cells that moved
        gl.uniform1f(gl.getUniformLocation(program, "grow"), more * this.smallest);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
      }
    }
  }

  // The surface that moves: a white line with a dark edge.
  drawLine(dense) {
    const gl = this.gl, program = this.program("segments");
    this.use(program, dense);
    this.attach(program, "corner", "corner", 2, 0);
    this.attach(program, "from", "line", 3, 1);
    this.attach(program, "to", "line", 3, 1, 12);
    for (const [thickness, ink] of [[4.5, [0.05, 0.07, 0.1, 1]], [2, [1, 1, 1, 1]]])
      for (const side of this.sides()) {
        gl.uniform2f(gl.getUniformLocation(program, "side"), ...side);
        gl.uniform1f(gl.getUniformLocation(program, "thickness"), thickness * dense);
        gl.uniform4fv(gl.getUniformLocation(program, "ink"), ink);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.frame.line.length / 3 - 1);
      }
  }

  // Begin to draw with a program: camera and colors.
  use(program, dense) {
    const gl = this.gl, at = (name) => gl.getUniformLocation(program, name);
    gl.useProgram(program);
    for (let k = 0; k < gl.getParameter(gl.MAX_VERTEX_ATTRIBS); k++) gl.disableVertexAttribArray(k);
    const rows = this.axes();
    gl.uniformMatrix3fv(at("turn"), true, rows.flat());
    gl.uniform3fv(at("center"), this.center);
    gl.uniform2f(at("halfWindow"), 0.5 * this.canvas.width, 0.5 * this.canvas.height);
    gl.uniform1f(at("metersPerPixel"), this.metersPerPixel / dense);
    const spans = this.index.bounds.map(([low, high]) => high - low);
    gl.uniform1f(at("reach"), 4 * Math.hypot(...spans) + 1e-30);
    gl.uniform2fv(at("range"), this.range);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
  }

  attach(program, name, buffer, size, step, offset = 0) {
    const gl = this.gl, place = gl.getAttribLocation(program, name);
    if (place < 0) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[buffer]);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, offset);
    gl.vertexAttribDivisor(place, step);
  }

  // Right, up and away from the viewer, as rows.
  axes() {
    const [c, s, u, v] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    return [[c, s, 0], [-s * v, c * v, u], [-s * u, c * u, -v]];
  }

  // ----- mouse and fingers

  watchMouse() {
    const canvas = this.canvas, fingers = new Map();
    canvas.addEventListener("pointerdown", (event) => {
      fingers.set(event.pointerId, event);
      canvas.setPointerCapture(event.pointerId);
    });
    for (const end of ["pointerup", "pointercancel"])
      canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      const before = fingers.get(event.pointerId);
      if (!before || !this.index) return;
      const [x, y] = [event.clientX - before.clientX, event.clientY - before.clientY];
      if (fingers.size > 1) {
        const other = [...fingers.values()].find((one) => one.pointerId !== event.pointerId);
        const far = (one) => Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
        this.zoom(far(before) / Math.max(far(event), 1), event);
      } else if (this.space && !event.shiftKey && !(event.buttons & 2)) {
        this.yaw -= TURN * x;
        this.pitch = Math.max(-1.57, Math.min(1.57, this.pitch + TURN * y));
      } else this.shift(-x, y);
      fingers.set(event.pointerId, event);
      this.request(true);
    });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(0.0015 * event.deltaY), event);
      this.request(true);
    }, { passive: false });
  }

  // Move the center by pixels to the right and up.
  shift(x, y) {
    const [right, up] = this.axes();
    this.center = this.center.map((one, k) => one + this.metersPerPixel * (x * right[k] + y * up[k]));
  }

  // Make everything smaller by a factor, about the place of an event.
  zoom(factor, event) {
    const box = this.canvas.getBoundingClientRect();
    const x = event.clientX - box.left - 0.5 * box.width, y = 0.5 * box.height + box.top - event.clientY;
    this.shift(x * (1 - factor), y * (1 - factor));
    this.metersPerPixel *= factor;
  }

  destroy() {
    this.resized.disconnect();
    cancelAnimationFrame(this.pending);
    clearTimeout(this.rest);
    this.frame = null;
    this.gl.getExtension("WEBGL_lose_context")?.loseContext();
  }
}

// Numbers below `count` in an order that looks random, the same each time (Fisher and Yates).
function shuffled(count) {
  const order = Uint32Array.from({ length: count }, (_, k) => k);
  for (let k = count - 1, state = 1; k > 0; k--) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;  // Numerical Recipes' generator
    const other = state % (k + 1);
    [order[k], order[other]] = [order[other], order[k]];
  }
  return order;
}
