"""Frames per second of the viewer: `python benchmarks/viewer.py [PARTICLES ...]`.

A cube of spheres is turned and drawn in headless Chromium, each frame waited for until the card has
drawn it: all particles, and the part that is drawn while a large cloud moves. The first line names
what draws; "SwiftShader" is the processor, without any graphics card.
"""

from __future__ import annotations

import sys

from browser_page import chromium

from lasersph.output.viewer import viewer_module

FRAMES = 5
PAGE = "<!doctype html><canvas style='width:1000px;height:560px'></canvas>"
MEASURE = """
window.measure = async (side, frames) => {
  const count = side ** 3, position = new Float32Array(3 * count);
  for (let k = 0; k < count; k++)
    position.set([k % side, Math.floor(k / side) % side, Math.floor(k / side ** 2)], 3 * k);
  const value = Float32Array.from({ length: count }, (_, k) => k % side);
  const bounds = Array(3).fill([0, side - 1]);
  const scene = new Scene(document.querySelector("canvas"));
  const began = performance.now();
  const frame = { position, width: new Float32Array(3 * count).fill(1), value };
  scene.kept = [-3e38, 3e38];
  scene.cut = [0, 0, 0, 3e38];
  scene.load(frame, { bounds, dimensions: 3 }, { low: 0, high: side, colors: "heat" });
  scene.goHome();
  scene.draw();
  const first = performance.now() - began;
  const mean = (drawn) => {
    let total = 0;
    for (let k = 0; k < frames; k++) { scene.yaw += 0.1; total += scene.draw(drawn); }
    return total / frames;
  };
  const result = { first, all: mean(count), part: mean(Math.min(count, MOVING)) };
  const info = scene.gl.getExtension("WEBGL_debug_renderer_info");
  result.card = scene.gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : scene.gl.RENDERER);
  scene.destroy();
  return result;
};
"""


def main() -> None:
    """Print a line for each number of particles."""
    counts = [int(text) for text in sys.argv[1:]] or [100_000, 1_000_000]
    with chromium() as browser:
        for number, count in enumerate(counts):
            page = browser.new_page(viewport={"width": 1100, "height": 700})
            page.set_content(PAGE)
            page.add_script_tag(content=viewer_module() + MEASURE, type="module")
            page.wait_for_function("typeof window.measure === 'function'")
            side = round(count ** (1 / 3))
            found = page.evaluate(
                "([side, frames]) => window.measure(side, frames)", [side, FRAMES]
            )
            if number == 0:
                print(found["card"])
                print("particles   first picture [ms]   frames/s, all   frames/s while it moves")
            fast, slow = 1000.0 / found["part"], 1000.0 / found["all"]
            print(f"{side**3:9,}   {found['first']:18.0f}   {slow:13.1f}   {fast:23.1f}")
            page.close()


if __name__ == "__main__":
    main()
