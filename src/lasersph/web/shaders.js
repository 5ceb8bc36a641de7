// Colors, and the programs of the graphics card.

// Colors from low to high. Cold metal is light gray: it reflects, it does not glow.
export const COLORS = {
  heat: ["#d3d7dc", "#b9aeb9", "#93678f", "#b03a63", "#dd4b3a", "#f5832a", "#fcbf38", "#fdf6c5"],
  share: ["#d3d7dc", "#f0d9a8", "#f7b955", "#ee7f2d", "#d94a1e"],
  amount: ["#d3d7dc", "#a9cbe0", "#63a6d0", "#2f7fbe", "#1c56a0", "#3f2f86", "#7c2a90"],
  signed: ["#2166ac", "#67a9cf", "#d3d7dc", "#ef8a62", "#b2182b"],
};

// 256 colors between the given ones, as bytes.
export function ramp(colors) {
  const stops = COLORS[colors].map((text) =>
    [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16)));
  const bytes = new Uint8Array(256 * 4).fill(255);
  // Each byte lies between the two given colors around its place.
  for (let k = 0; k < 256; k++) {
    const place = (k / 255) * (stops.length - 1), before = Math.min(Math.floor(place), stops.length - 2);
    for (let part = 0; part < 3; part++)
      bytes[4 * k + part] = stops[before][part] + (place - before) * (stops[before + 1][part] - stops[before][part]);
  }
  return bytes;
}

// Shared by all vertex programs: from meters to the window, and what is not shown.
export const VIEW = `#version 300 es
precision highp float;
uniform mat3 turn; uniform vec3 center; uniform vec2 halfWindow; uniform float metersPerPixel, reach;
uniform vec2 range, kept, side; uniform vec4 cut;
out float shade;
vec3 place(vec3 p) { return turn * (vec3(side * p.xy, p.z) - center) / metersPerPixel; }
vec4 onScreen(vec3 p) { return vec4(p.xy / halfWindow, p.z * metersPerPixel / reach, 1.0); }
bool isHidden(vec3 p, float gate) {
  return gate < kept.x || gate > kept.y || dot(cut.xyz, vec3(side * p.xy, p.z)) > cut.w;
}
`;
// A particle of a section: a rectangle of its width.
export const CELL = `
in vec2 corner; in vec3 position, width; in float value, gate; uniform float column, grow;
void main() {
  shade = clamp((value - range.x) / (range.y - range.x), 0.0, 1.0);
  vec3 size = width.x > 0.0 ? width : vec3(column, 0.0, width.z);
  vec3 p = place(position) + vec3(corner * (0.5 * (size.xz + grow) / metersPerPixel + 0.35), 0.0);
  gl_Position = isHidden(position, gate) ? vec4(2.0, 2.0, 2.0, 1.0) : onScreen(p);
}`;
// A particle in space: a point as large as a sphere of its volume.
export const SPHERE = `
in vec3 position, width; in float value, gate; uniform float swell; out float depth;
void main() {
  shade = clamp((value - range.x) / (range.y - range.x), 0.0, 1.0);
  float radius = swell * pow(width.x * width.y * width.z, 1.0 / 3.0) / metersPerPixel;
  gl_Position = isHidden(position, gate) ? vec4(2.0, 2.0, 2.0, 1.0) : onScreen(place(position));
  gl_PointSize = max(2.0 * radius, 1.5);
  depth = radius * metersPerPixel / reach;
}`;
// A piece of the line of a surface, as thick as wanted.
export const SEGMENT = `
in vec2 corner; in vec3 from, to; uniform float thickness;
void main() {
  vec3 a = place(from), b = place(to);
  vec2 along = normalize(b.xy - a.xy + vec2(1e-9, 0.0));
  vec3 p = corner.x < 0.0 ? a : b;
  p.xy += 0.5 * thickness * (corner.x * along + corner.y * vec2(-along.y, along.x));
  gl_Position = onScreen(p);
  shade = 0.0;
}`;
// A point of a surface that is a body, with its normal as the window sees it.
export const SURFACE = `
in vec3 point, normal; in float level; uniform float lift; out vec3 facing; out float beyond;
void main() {
  shade = clamp((level - range.x) / (range.y - range.x), 0.0, 1.0);
  facing = turn * normal;
  beyond = dot(cut.xyz, point) - cut.w;
  gl_Position = onScreen(place(point));
  gl_Position.z -= lift / reach;
}`;
export const LIT = `#version 300 es
precision highp float;
in float shade, beyond; in vec3 facing; uniform sampler2D colors; out vec4 color;
void main() {
  if (beyond > 0.0) discard;
  vec3 normal = normalize(facing) * (facing.z > 0.0 ? -1.0 : 1.0);
  float light = max(dot(normal, normalize(vec3(-0.45, 0.75, -0.65))), 0.0);
  vec3 own = texture(colors, vec2(shade, 0.5)).rgb;
  color = vec4(own * (0.45 + 0.15 * normal.y + 0.5 * light) + 0.08 * pow(light, 24.0), 1.0);
}`;
// Colors of the pieces: from the scale, a lit sphere, or one ink.
export const FLAT = `#version 300 es
precision highp float;
in float shade; uniform sampler2D colors; out vec4 color;
void main() { color = texture(colors, vec2(shade, 0.5)); }`;
export const ROUND = `#version 300 es
precision highp float;
in float shade, depth; uniform sampler2D colors; out vec4 color;
void main() {
  vec2 at = 2.0 * gl_PointCoord - 1.0;
  float inside = 1.0 - dot(at, at);
  if (inside < 0.0) discard;
  vec3 normal = vec3(at.x, -at.y, sqrt(inside));
  float light = max(dot(normal, normalize(vec3(-0.45, 0.75, 0.65))), 0.0);
  float sky = 0.5 + 0.5 * normal.y;
  vec3 own = texture(colors, vec2(shade, 0.5)).rgb;
  color = vec4(own * (0.34 + 0.16 * sky + 0.56 * light) + 0.10 * pow(light, 24.0), 1.0);
  gl_FragDepth = gl_FragCoord.z - 0.5 * depth * normal.z;
}`;
export const PLAIN = `#version 300 es
precision highp float;
in float shade; uniform vec4 ink; out vec4 color;
void main() { color = ink + 0.0 * shade; }`;
