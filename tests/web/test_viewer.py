"""The viewer in a real browser: frames, fields, colors, play, live, errors."""

import http.server
import io
import json
import re
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic_run
from browser_window import LOST, wait_until_drawn
from PIL import Image
from playwright.sync_api import expect

import lasersph
from lasersph.output.frame_blocks import particle_block, particle_index

pytestmark = pytest.mark.web
WEB = Path(lasersph.__file__).parent / "web"
POLICY = "default-src 'none'; script-src 'self' 'nonce-test'; connect-src 'self'; img-src data:"
PAGE = """<!doctype html><html lang="en"><title>viewer</title><link rel="icon" href="data:,">
<div id="here"></div><script type="module" nonce="test">
import { http } from "./sources.js";
import { mount } from "./viewer.js";
window.viewer = mount(document.getElementById("here"), http("api/"));
</script></html>"""


class Server(http.server.ThreadingHTTPServer):
    """Serves the viewer and one run folder; the first `failures` blocks are refused."""

    daemon_threads = True

    def __init__(self, folder):
        self.folder, self.failures, self.asked, self.frames = folder, 0, [], None
        self.held, self.release = "", threading.Event()
        super().__init__(("127.0.0.1", 0), Answer)
        threading.Thread(target=self.serve_forever, daemon=True).start()
        self.address = f"http://127.0.0.1:{self.server_address[1]}/"

    def index(self):
        """The index, cut to `frames` as of a run that computes; without the mirror image, so that
        the hot corner is a corner."""
        found: dict[str, Any] = particle_index(self.folder) | {"mirrored": False}
        if self.frames is not None:
            cut = slice(self.frames)
            found |= {"times": found["times"][cut], "counts": found["counts"][cut]}
            found |= {"is_complete": False, "levels": {"melts": synthetic_run.LIQUIDUS}}
            if self.frames:
                for one in found["fields"]:
                    one["range"] = self.range_so_far(one["name"], found)
        return found

    def range_so_far(self, field, index):
        """Smallest and largest value of a field in the frames that there are."""
        places = zip(index["blocks"][field], index["counts"], strict=False)
        names = [f"particles.{field}.{at}.{count}.{index['stamp']}" for at, count in places]
        blocks = [np.frombuffer(particle_block(self.folder, name), "<f4") for name in names]
        return [float(min(map(np.min, blocks))), float(max(map(np.max, blocks)))]


class Answer(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server: Server

    def log_message(self, *_):
        """Say nothing."""

    def do_GET(self):
        path, status = self.path.removeprefix("/"), 200
        if path == "":
            kind, body = "text/html", PAGE.encode()
        elif path.endswith(".js"):
            kind, body = "text/javascript", (WEB / path).read_bytes()
        elif path == "api/particles":
            kind, body = "application/json", json.dumps(self.server.index()).encode()
        else:
            name = path.removeprefix("api/block/")
            self.server.asked.append(name)
            if name == self.server.held:
                self.server.release.wait()
            kind, body = "application/octet-stream", particle_block(self.server.folder, name)
            if self.server.failures:
                self.server.failures -= 1
                status, body = 503, b""
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.send_header("Content-Security-Policy", POLICY)
        kept = "immutable, max-age=31536000" if "block" in path and status == 200 else "no-store"
        self.send_header("Cache-Control", kept)
        self.end_headers()
        self.wfile.write(body)


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    path = tmp_path_factory.mktemp("viewer")
    return {d: synthetic_run.make_run(path / f"{d}d", dimension=d) for d in (2, 3)}


@pytest.fixture
def server(folders):
    found = Server(folders[2])
    yield found
    found.shutdown()
    found.server_close()


def open_viewer(page, server):
    """Open the page and wait for the first picture."""
    page.goto(server.address)
    expect(page.locator(".scale")).to_be_visible()
    expect(page.locator(".stage")).to_have_attribute("data-shown", re.compile("."))


def wait_for_frame(page, frame, field="temperature"):
    """Until a frame was loaded and drawn."""
    expect(page.locator(".stage")).to_have_attribute("data-shown", f"{frame} {field}")


def picture(page, keep_as=None):
    """The canvas as it is on the screen, (rows, columns, 3)."""
    wait_until_drawn(page)
    data = page.locator("canvas").screenshot()
    if keep_as is not None:
        keep_as.write_bytes(data)
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGB")).astype(int)


def body_of(image):
    """Rows and columns that the metal covers: what is not the dark ground, above the scale bar."""
    bright = image[30:-60, 4:-160].max(axis=2) > 100
    rows, columns = np.flatnonzero(bright.any(axis=1)), np.flatnonzero(bright.any(axis=0))
    return rows[0] + 30, rows[-1] + 30, columns[0] + 4, columns[-1] + 4


def assert_color(pixel, color, tolerance=14):
    wanted = [int(color[at : at + 2], 16) for at in (1, 3, 5)]
    assert np.all(np.abs(pixel - wanted) <= tolerance), (pixel, color)


def three_pixels(image):
    """The hot corner of the made-up metal (x = 0, at the surface), a cold one, and beside it."""
    top, bottom, left, right = body_of(image)
    return image[top + 4, left + 4], image[bottom - 4, right - 4], image[top + 4, left - 8]


def test_start_fields_and_scrubbing(page, server, tmp_path):
    """It begins with hot metal; three pixels have the colors of what they show."""
    open_viewer(page, server)
    index = server.index()
    assert page.get_by_label("Time").input_value() == str(index["start"])
    hot, cold, beside = three_pixels(picture(page, tmp_path / "temperature.png"))
    assert_color(hot, "#fdf6c5")
    assert_color(cold, "#d3d7dc")
    assert beside.max() < 90
    page.get_by_label("Color", exact=True).select_option("melt fraction")
    wait_for_frame(page, index["start"], "melt_fraction")
    expect(page.locator(".legend b")).to_have_text("melt fraction")
    hot, cold, _ = three_pixels(picture(page, tmp_path / "melt-fraction.png"))
    assert_color(hot, "#d94a1e")
    assert_color(cold, "#d3d7dc")
    page.get_by_label("Show").select_option("any melt")
    _, bottom, _, right = body_of(whole := picture(page))
    assert whole[bottom + 6, right - 4].max() < 90
    page.get_by_label("Show").select_option("limits …")
    wait_for_frame(page, index["start"], "melt_fraction")
    hottest = next(one["range"][1] for one in index["fields"] if one["name"] == "temperature")
    page.get_by_label("At least").fill(f"{0.9 * hottest:.0f}")
    page.get_by_label("At most").fill(f"{hottest + 1.0:.0f}")
    picture(page, tmp_path / "limits.png")
    _, low, _, far = body_of(picture(page))
    assert low < bottom and far < right  # only what is nearly as hot as it gets
    page.get_by_label("Show").select_option("all")
    page.get_by_label("Color", exact=True).select_option("temperature")
    page.get_by_label("Time").fill("0")
    expect(page.locator("output")).to_have_text("0 s")
    wait_for_frame(page, 0)
    hot, cold, _ = three_pixels(picture(page))
    assert_color(hot, "#d3d7dc")


def test_blocks_are_fetched_once(page, server):
    """Only what is looked at comes, and what did not change does not come again."""
    open_viewer(page, server)
    assert len(server.asked) == 3
    page.get_by_label("Time").fill("1")
    wait_for_frame(page, 1)
    page.get_by_label("Time").fill(str(server.index()["start"]))
    wait_for_frame(page, server.index()["start"])
    assert len(server.asked) == len(set(server.asked)) <= 5


def test_play_goes_on_from_frame_to_frame(page, server):
    """Play runs through the times until it is paused, and begins anew at the end."""
    open_viewer(page, server)
    last = len(server.index()["times"]) - 1
    page.get_by_label("Time").fill(str(last - 1))
    page.get_by_role("button", name="Play").click()
    expect(page.locator("output")).to_have_text("0 s")
    page.get_by_role("button", name="Pause").click()
    expect(page.get_by_role("button", name="Play")).to_be_visible()


def test_keys_turn_pages_and_the_camera_stays(page, server):
    """Arrow keys step; another frame does not move the view; Whole view brings it back."""
    open_viewer(page, server)
    page.locator("canvas").focus()
    before = page.locator(".scale span").inner_text(), body_of(picture(page))
    box = page.locator("canvas").bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.wheel(0, 400)
    zoomed = body_of(picture(page))
    assert zoomed[3] - zoomed[2] < before[1][3] - before[1][2]
    page.keyboard.press("ArrowRight")
    wait_for_frame(page, server.index()["start"] + 1)
    assert body_of(picture(page)) == zoomed
    page.get_by_role("button", name="Whole view").click()
    assert body_of(picture(page)) == before[1]


def test_a_lost_frame_is_tried_again(page, server):
    """Two blocks fail; the viewer says so and goes on by itself."""
    open_viewer(page, server)
    server.failures = 2
    page.get_by_label("Time").fill("3")
    expect(page.locator(".message")).to_have_text("The frame did not come; trying again")
    wait_for_frame(page, 3)
    expect(page.locator(".message")).to_have_text("")
    assert page.locator("output").inner_text() == "30 ns"
    lost = [text for text in page.complaints if "503" in text]
    assert page.complaints == lost
    page.complaints.clear()


def test_a_late_frame_is_dropped(page, server):
    """What was asked for before, and comes after, is not drawn over what is looked at now."""
    open_viewer(page, server)
    index = server.index()
    place = f"{index['blocks']['temperature'][0]}.{index['counts'][0]}.{index['stamp']}"
    server.held = f"particles.temperature.{place}"
    page.get_by_label("Time").fill("0")
    expect(page.locator("output")).to_have_text("0 s")
    page.get_by_label("Time").fill(str(index["start"]))
    wait_for_frame(page, index["start"])
    with page.expect_response(lambda answer: server.held in answer.url) as answer:
        server.release.set()
    answer.value.finished()
    hot, _, _ = three_pixels(picture(page))
    assert_color(hot, "#fdf6c5")


def test_live_is_a_state_of_its_own(page, server):
    """A growing run: live follows the newest frame, looking at an old one leaves that state."""
    server.frames = 2
    open_viewer(page, server)
    live = page.get_by_role("button", name="Live")
    live.click()
    expect(live).to_have_attribute("aria-pressed", "true")
    server.frames = 4
    expect(page.locator("output")).to_have_text("30 ns")
    page.get_by_label("Time").fill("1")
    expect(live).to_have_attribute("aria-pressed", "false")
    server.frames = 5
    expect(page.get_by_label("Time")).to_have_attribute("max", "4")
    expect(page.locator("output")).to_have_text("10 ns")
    live.click()
    expect(page.locator("output")).to_have_text("40 ns")
    server.frames = None
    expect(live).to_be_hidden()


def lose_a_block_at_the_end(page, server):
    """Let the run end as the next block is asked for, which is lost."""

    def lose(route):
        server.frames = None
        route.abort()

    page.route(re.compile("/api/block/"), lose, times=1)


def test_a_frame_is_lost_while_the_run_ends(page, server):
    """The index that is fetched again is the last one: all frames can be chosen."""
    server.frames = 6
    lose_a_block_at_the_end(page, server)
    open_viewer(page, server)
    expect(page.get_by_label("Time")).to_have_attribute("max", "20")
    expect(page.get_by_role("button", name="Live")).to_be_hidden()
    assert all(re.search(LOST, text) for text in page.complaints)
    page.complaints.clear()


def test_live_frame_is_lost_while_the_run_ends(page, server):
    """What comes instead of it is the last frame."""
    server.frames = 6
    open_viewer(page, server)
    page.get_by_role("button", name="Live").click()
    lose_a_block_at_the_end(page, server)
    server.frames = 7
    wait_for_frame(page, 20)
    expect(page.get_by_label("Time")).to_have_attribute("max", "20")
    assert all(re.search(LOST, text) for text in page.complaints)
    page.complaints.clear()


def test_live_run_shows_its_temperature_from_the_first_frame(page, server, tmp_path):
    """Of which the first frame has one value: cold metal is gray, on a scale up to melting; what
    can be shown grows with the run, and a color that the reader chose stays."""
    server.frames = 1
    open_viewer(page, server)
    wait_for_frame(page, 0)
    expect(page.locator(".legend b")).to_have_text("temperature [K]")
    expect(page.locator(".bar .level")).to_have_text(["melts 1727"])
    for pixel in three_pixels(picture(page, tmp_path / "first-frame.png"))[:2]:
        assert_color(pixel, "#d3d7dc")
    gates = page.locator(".gate option")
    expect(gates).to_have_count(2)
    page.get_by_role("button", name="Live").click()
    server.frames = 9
    wait_for_frame(page, 8)
    expect(page.locator(".bar .level")).to_have_text(["melts 1727"])
    hot, cold, _ = three_pixels(picture(page))
    assert np.ptp(hot) > 40 > np.ptp(cold)  # no longer gray
    expect(gates.nth(1)).to_have_text("any melt")
    page.get_by_label("Color", exact=True).select_option("melt fraction")
    wait_for_frame(page, 8, "melt_fraction")
    page.get_by_label("Show").select_option("any melt")
    server.frames = None
    wait_for_frame(page, 20, "melt_fraction")
    expect(page.get_by_label("Show").locator("option:checked")).to_have_text("any melt")


def test_before_the_first_frame(page, server):
    """It waits, and shows the first frame when it comes."""
    server.frames = 0
    page.goto(server.address)
    expect(page.locator(".message")).to_have_text("Waiting for the first snapshot")
    server.frames = 1
    expect(page.locator(".scale")).to_be_visible()


def test_space_turns_and_is_cut(page, folders, tmp_path):
    """Spheres: the mouse turns and, by its right button, moves them; a cut shows the inside."""
    server = Server(folders[3])
    open_viewer(page, server)
    first = picture(page, tmp_path / "spheres.png")
    box = page.locator("canvas").bounding_box()
    page.mouse.move(box["x"] + 400, box["y"] + 200)
    page.mouse.down()
    page.mouse.move(box["x"] + 480, box["y"] + 230)
    page.mouse.up()
    turned = picture(page)
    assert np.mean(np.abs(turned - first) > 20) > 0.02
    page.mouse.down(button="right")
    page.mouse.move(box["x"] + 450, box["y"] + 230, steps=3)
    page.mouse.up(button="right")
    moved = picture(page)
    assert np.mean(np.abs(moved[:, 100:400] - turned[:, 130:430]) > 20) < 0.02
    covered = np.mean(moved.max(axis=2) > 100)
    page.get_by_label("Cut", exact=True).select_option("x")
    assert np.mean(picture(page).max(axis=2) > 100) < 0.9 * covered
    server.shutdown()
    server.server_close()


def test_without_webgl_it_says_so(page_without_webgl, server):
    """A sentence instead of an empty box."""
    page_without_webgl.goto(server.address)
    expect(page_without_webgl.locator(".message")).to_have_text(
        "Particles cannot be drawn: this browser offers no WebGL 2."
    )
