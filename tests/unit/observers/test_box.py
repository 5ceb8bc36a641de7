"""A closed box of liquid: center lines and stream function of known fields."""

import json
from dataclasses import replace

import numpy as np
import pytest
from synthetic_flow import box_view

from lasersph.observers import flow_observers
from lasersph.observers.box_flow import EVERY, BoxFlow
from lasersph.observers.box_sections import Box, center_lines, extremum

SIZE, SPEED = 1e-3, 1.0


def displace(view, share=0.15):
    """The same fields with particles moved by up to a share of the spacing."""
    exact = box_view()
    shift = np.random.default_rng(2).uniform(-share, share, view.position.shape) * view.width
    x, z = view.position + shift
    a, b = np.pi * x / SIZE, np.pi * (z + SIZE) / SIZE
    velocity = np.array(
        [
            -np.pi * SPEED * np.sin(a) ** 2 * np.sin(2 * b),
            np.pi * SPEED * np.sin(2 * a) * np.sin(b) ** 2,
        ]
    )
    temperature = exact.temperature + (-20.0 / SIZE) * shift[0]
    flow = replace(view.flow, velocity=velocity)
    return replace(view, position=np.array([x, z]), temperature=temperature, flow=flow)


def test_eddy_on_its_center_lines():
    """u of psi = -V L sin^2 sin^2: extrema pi V at a quarter and three quarters of the height."""
    observer = BoxFlow()
    observer.observe(box_view())
    observer.observe(displace(replace(box_view(), step=EVERY)))
    box = observer.summary()["box"]
    assert (box["width_m"], box["height_m"]) == pytest.approx((SIZE, SIZE))
    center = box["center"]
    for name in ("u_max", "w_max"):
        assert center[f"{name}_m_s"] == pytest.approx(np.pi * SPEED, rel=5e-3)
    for name in ("u_min", "w_min"):
        assert center[f"{name}_m_s"] == pytest.approx(-np.pi * SPEED, rel=5e-3)
    assert center["u_max_at_z_m"] == pytest.approx(-0.25 * SIZE, abs=0.01 * SIZE)
    assert center["w_max_at_x_m"] == pytest.approx(0.25 * SIZE, abs=0.01 * SIZE)
    assert len(box["lines"]["z_m"]) == len(box["lines"]["u_m_s"]) == 33
    assert box["lines"]["z_m"][0] == pytest.approx(-SIZE)


def test_stream_function_of_a_clockwise_eddy():
    """Its extremum is -V L in the middle; the walls have 0."""
    observer = BoxFlow()
    observer.observe(box_view())
    psi = observer.summary()["box"]["stream_function"]
    assert psi["min_m2_s"] == pytest.approx(-SPEED * SIZE, rel=5e-3)
    assert (psi["min_x_m"], psi["min_z_m"]) == pytest.approx((0.5 * SIZE, -0.5 * SIZE))
    assert psi["max_m2_s"] == pytest.approx(0.0, abs=5e-3 * SPEED * SIZE)


def test_lines_at_given_shares():
    """Both lines run through the middle."""
    view = box_view()
    box = Box.around(view.position, view.width)
    lines = center_lines(view.position, view.flow.velocity, box, np.array([0.25, 0.5]))
    assert lines.x == pytest.approx([0.25 * SIZE, 0.5 * SIZE])
    assert lines.w == pytest.approx([np.pi * SPEED, 0.0], abs=0.01)


@pytest.mark.parametrize("mirror", ["front", "back"])
def test_lines_of_half_a_block_lie_in_its_mirror(mirror):
    """u = z^2 (1 - y^2) with y from the mirror: even, so that a parabola finds it at y = 0 among
    particles and images."""
    ticks = (np.arange(8) + 0.5) / 16.0
    sign = 1.0 if mirror == "front" else -1.0
    x, y, z = (one.ravel() for one in np.meshgrid(2 * ticks, sign * ticks, 2 * ticks))
    position, width = np.array([x, y, z]), np.array([[0.125], [0.0625], [0.125]])
    velocity = np.array([z**2 * (1.0 - y**2), y, 0.0 * z])
    box = Box.around(position, width * np.ones_like(position), mirror)
    lines = center_lines(position, velocity, box, np.array([0.25, 0.5]))
    assert lines.u == pytest.approx([0.25**2, 0.5**2], abs=1e-3)
    # v is odd: its images have the other sign, and lines see none of it
    found, turned = box.with_images(position, velocity)
    assert found.shape == (3, 1024)
    assert np.all(turned[1] == found[1])


def test_extremum_of_a_parabola():
    """Exact between the samples; at an end the end."""
    places = np.linspace(0.0, 1.0, 11)
    place, value = extremum(places, 2.0 - (places - 0.43) ** 2, 1.0)
    assert (place, value) == pytest.approx((0.43, 2.0))
    assert extremum(places, places, -1.0) == (0.0, 0.0)


def test_history_between_and_state():
    """Evaluated in every 50th step and at the end, also of a run resumed at its end."""
    observers = flow_observers(2, box=True, iterations=("pressure",))
    first = observers.observe(box_view(step=0))
    later = observers.observe(box_view(time=1e-5, step=1, speed=2.0))
    assert later["box_u_max_m_s"] == first["box_u_max_m_s"]
    assert later["flow_speed_max_m_s"] == pytest.approx(2 * first["flow_speed_max_m_s"])
    resumed = flow_observers(2, box=True, iterations=("pressure",))
    resumed.restore(json.loads(json.dumps(observers.state())))
    summary = observers.summary()
    assert summary["box"]["center"]["u_max_m_s"] == pytest.approx(2 * np.pi, rel=5e-3)
    assert resumed.summary() == summary
    assert "melt" not in summary
    assert "surface_speed_max_m_s" not in summary["flow"]
