// Where the viewer gets its frames from: a server, a report, the kernel of a notebook.

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
