"""The surface as a body in color in a real browser: 3-D beside the particles, a turned section."""

import numpy as np
import pytest
import synthetic_flow
from playwright.sync_api import expect
from synthetic_dot import make_dot_run
from synthetic_run import NM, PERIOD
from test_viewer import Server, open_viewer, picture, wait_for_frame

from lasersph.output import open_run
from lasersph.output.particle_file import ParticleFile

pytestmark = pytest.mark.web


class Whole(Server):
    """Serves the index as it is, mirror images included."""

    def __init__(self, folder, **changes):
        self.changes = changes
        super().__init__(folder)

    def index(self):
        """The index with changes of its own."""
        return super().index() | {"mirrored": True} | self.changes


@pytest.fixture
def dot(tmp_path):
    """A quarter of a dot."""
    server = Whole(make_dot_run(tmp_path / "dot", columns=60))
    yield server
    server.shutdown()
    server.server_close()


def body(page, words):
    """Choose what is shown, and the picture of it."""
    page.get_by_label("Body", exact=True).select_option(words)
    return picture(page)


def test_surface_of_a_dot(page, dot, tmp_path):
    """It covers the particles, has fields of its own, grows with its heights, and turns."""
    open_viewer(page, dot)
    both = picture(page, tmp_path / "both.png")
    particles = body(page, "particles")
    assert np.mean(np.abs(both - particles) > 12) > 0.02
    surface = body(page, "surface")
    covered = [np.mean(one.max(axis=2) > 100) for one in (both, surface)]
    assert covered[1] > 0.5 * covered[0]
    page.get_by_label("Color", exact=True).select_option("height")
    wait_for_frame(page, dot.index()["start"], "height")
    expect(page.locator(".legend b")).to_have_text("height [nm]")
    page.get_by_label("Time").fill("6")
    wait_for_frame(page, 6, "height")
    tall = body(page, "surface, heights × 20")
    picture(page, tmp_path / "tall.png")
    assert np.mean(np.abs(tall - surface) > 20) > 0.05
    box = page.locator("canvas").bounding_box()
    page.mouse.move(box["x"] + 400, box["y"] + 200)
    page.mouse.down()
    page.mouse.move(box["x"] + 500, box["y"] + 200)
    page.mouse.up()
    assert np.mean(np.abs(picture(page) - tall) > 20) > 0.02


def test_section_is_turned_about_its_axis(page, tmp_path):
    """Cells of a section as ever; its surface as a round body that the mouse turns."""
    run = open_run(synthetic_flow.make_pool_run(tmp_path / "run"))
    r = (np.arange(60) + 0.5) * 0.5 * PERIOD / 60
    file = ParticleFile(run.path / "surface.vtkhdf", "Lines")
    for time in run.snapshots.times:
        z = -50 * NM * np.cos(2 * np.pi * r / PERIOD)
        fields = {"temperature": (300.0 + 2000.0 * np.exp(-r / 1e-6)).astype(np.float32)}
        file.append(float(time), np.array([r, z]), fields, units={"temperature": "K"})
    server = Whole(run.path, revolved=True)
    open_viewer(page, server)
    flat = picture(page)
    turned = body(page, "surface, heights × 20")
    picture(page, tmp_path / "turned.png")
    assert np.mean(np.abs(turned - flat) > 20) > 0.1
    assert page.locator(".cuts").is_visible()
    assert np.array_equal(body(page, "particles"), flat)
    server.shutdown()
    server.server_close()
