// The surface that moves as a body in color: over x and y in 3-D, or a line of a section (r, z)
// turned about its axis. Its triangles join the middles of columns, half and quarter are mirrored.

const SECTORS = 96;  // around an axis: a circle looks round

// The ways to show a run that has such a body, as [words, value]: `parts` to draw and by what
// heights are drawn larger. Reliefs are some nanometers on micrometers.
export const BODIES = [["particles", "null"], ["particles and surface", '{"particles":true,"times":1}'],
  ["surface", '{"times":1}'], ["surface, heights × 5", '{"times":5}'], ["surface, heights × 20", '{"times":20}']];

// Whether an index has a surface that is a body.
export function hasBody(index) {
  return Boolean(index.surface && (index.surface.shape || index.revolved));
}

// What is loaded of the surface of a frame: positions, and the field where the surface has it.
export async function loadBody(index, fetchBlock, number, name) {
  if (!index.surface) return { line: null, level: null };
  const known = hasBody(index) && name in index.surface.blocks;
  const [line, level] = await Promise.all([fetchBlock("surface", "position", number),
    known ? fetchBlock("surface", name, number) : null]);
  return { line, level };
}

// The points of the whole surface row by row, (rows, columns), with normals and values.
export function surfaceGrid(index, line, level, times) {
  const { shape } = index.surface;
  const grid = shape ? overArea(index, line, level, shape) : aroundAxis(line, level);
  for (let k = 2; k < grid.point.length; k += 3) grid.point[k] *= times;
  grid.normal = normals(grid);
  grid.triangles = triangles(grid);
  return grid;
}

function empty(rows, columns) {
  const count = rows * columns;
  return { rows, columns, point: new Float32Array(3 * count), value: new Float32Array(count) };
}

// Rows along x, columns along y; mirror images come first, so that places grow.
function overArea({ mirrored, mirrored_y: mirroredY }, line, level, [nx, ny]) {
  const grid = empty(mirrored ? 2 * nx : nx, mirroredY ? 2 * ny : ny);
  const source = (k, n, isMirrored) => (!isMirrored ? [k, 1] : k < n ? [n - 1 - k, -1] : [k - n, 1]);
  for (let row = 0, to = 0; row < grid.rows; row++) {
    const [ix, signX] = source(row, nx, mirrored);
    for (let column = 0; column < grid.columns; column++, to++) {
      const [iy, signY] = source(column, ny, mirroredY), from = ix * ny + iy;
      grid.point.set([signX * line[3 * from], signY * line[3 * from + 1], line[3 * from + 2]], 3 * to);
      grid.value[to] = level ? level[from] : NaN;
    }
  }
  return grid;
}

// Rows outward from the axis, whose height is that of the parabola through its mirror image.
function aroundAxis(line, level) {
  const count = line.length / 3, grid = empty(count + 1, SECTORS + 1);
  const inner = (values, step, at) => (9 * values[at] - values[step + at]) / 8;
  for (let row = 0, to = 0; row <= count; row++) {
    const r = row ? line[3 * (row - 1)] : 0, z = row ? line[3 * (row - 1) + 2] : inner(line, 3, 2);
    const value = !level ? NaN : row ? level[row - 1] : inner(level, 1, 0);
    for (let sector = 0; sector <= SECTORS; sector++, to++) {
      const angle = (2 * Math.PI * sector) / SECTORS;
      grid.point.set([r * Math.cos(angle), r * Math.sin(angle), z], 3 * to);
      grid.value[to] = value;
    }
  }
  return grid;
}

// Normals from the differences of neighbors along rows and columns, upward.
function normals({ rows, columns, point }) {
  const found = new Float32Array(point.length);
  const between = (a, b) => [0, 1, 2].map((k) => point[3 * b + k] - point[3 * a + k]);
  for (let i = 0, to = 0; i < rows; i++)
    for (let j = 0; j < columns; j++, to++) {
      const u = between(to - (i > 0) * columns, to + (i < rows - 1) * columns);
      const v = between(to - (j > 0), to + (j < columns - 1));
      const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      const length = Math.hypot(...n);
      found.set(length > 0 ? n.map((one) => (one * Math.sign(n[2] || 1)) / length) : [0, 0, 1], 3 * to);
    }
  return found;
}

// Two triangles for each four points.
function triangles({ rows, columns }) {
  const found = new Uint32Array(6 * (rows - 1) * (columns - 1));
  for (let i = 0, to = 0; i < rows - 1; i++)
    for (let j = 0; j < columns - 1; j++, to += 6) {
      const a = i * columns + j;
      found.set([a, a + columns, a + columns + 1, a, a + columns + 1, a + 1], to);
    }
  return found;
}

// The box of its points, [low, high] of x, y and z [m].
export function boxOf({ point }) {
  const box = [0, 1, 2].map(() => [Infinity, -Infinity]);
  for (let k = 0; k < point.length; k++) {
    const side = box[k % 3];
    side[0] = Math.min(side[0], point[k]);
    side[1] = Math.max(side[1], point[k]);
  }
  return box;
}

// Bring a grid to the card of a scene, and draw it. It lies half a particle before those below it,
// so that their round tops do not show through.
export function drawSurface(scene, dense) {
  const { gl, frame: { grid } } = scene, program = scene.program("surfaces");
  if (scene.arrays.get("point") !== grid.point) {
    for (const name of ["point", "normal"]) scene.fill(name, grid[name]);
    scene.fill("level", grid.value.map((one) => (Number.isNaN(one) ? scene.range[0] : one)));
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, scene.buffers.triangles);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, grid.triangles, gl.STATIC_DRAW);
  }
  scene.use(program, dense);
  gl.enable(gl.DEPTH_TEST);
  gl.uniform2f(gl.getUniformLocation(program, "side"), 1, 1);
  gl.uniform4fv(gl.getUniformLocation(program, "cut"), scene.cut);
  gl.uniform1f(gl.getUniformLocation(program, "lift"), scene.smallest);
  scene.attach(program, "point", "point", 3, 0);
  scene.attach(program, "normal", "normal", 3, 0);
  scene.attach(program, "level", "level", 1, 0);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, scene.buffers.triangles);
  gl.drawElements(gl.TRIANGLES, grid.triangles.length, gl.UNSIGNED_INT, 0);
}
