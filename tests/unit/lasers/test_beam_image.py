"""Measured beams: ISO 11146 widths, energy, cell means, formats, what is refused."""

import numpy as np
import pytest
from PIL import Image

from lasersph.lasers import Laser, UniformBeam
from lasersph.lasers.beam_image import digest_of, measured_envelope
from lasersph.lasers.beam_widths import beam_widths

SIDE, PIXEL = 256, 1e-6


def camera(first=64.0, second=None, *, azimuth=0.0, noise=0.0, offset=0.05, power=1.0, seed=0):
    """Image of a beam with diameters at 1/e^2 in pixels; a higher power makes the top flat."""
    y, x = np.mgrid[:SIDE, :SIDE]
    dx, dy = x - 120.0, y - 131.5
    along = np.cos(azimuth) * dx + np.sin(azimuth) * dy
    across = np.cos(azimuth) * dy - np.sin(azimuth) * dx
    square = (2.0 * along / first) ** 2 + (2.0 * across / (second or first)) ** 2
    grain = noise * np.random.default_rng(seed).normal(size=(SIDE, SIDE))
    return np.exp(-2.0 * square**power) + offset + grain


@pytest.mark.parametrize("seed", range(20))
def test_widths_of_a_gaussian_with_noise(seed):
    """256 x 256 pixels with 2 % of noise: within 1 %, whatever its size."""
    diameter = (40.0, 64.0, 85.0, 110.0)[seed % 4]
    found = beam_widths(camera(diameter, noise=0.02, seed=seed))
    assert found.widths == pytest.approx((diameter, diameter), rel=0.01)
    assert found.center == pytest.approx((120.0, 131.5), abs=0.5)
    assert found.background == pytest.approx(0.05, abs=2e-3)
    assert found.noise == pytest.approx(0.02, rel=0.1)


def test_widths_and_azimuth_of_an_ellipse():
    """Along the principal axes, the first nearer to the columns' direction."""
    found = beam_widths(camera(80.0, 50.0, azimuth=0.4))
    assert found.widths == pytest.approx((80.0, 50.0), rel=1e-4)
    assert found.azimuth == pytest.approx(0.4, abs=1e-4)
    assert found.diameter == pytest.approx(np.hypot(80.0, 50.0) / np.sqrt(2.0), rel=1e-4)
    turned = beam_widths(camera(50.0, 80.0, azimuth=0.4))
    assert turned.widths == pytest.approx((50.0, 80.0), rel=1e-4)


@pytest.mark.parametrize(("power", "noise", "error"), [(2.0, 0.0, 1e-4), (4.0, 0.02, 0.02)])
def test_flat_tops_have_their_second_moments(power, noise, error):
    """Four times the standard deviation of all pixels, not what a Gaussian would have."""
    ideal = camera(60.0, offset=0.0, power=power)
    x = np.arange(SIDE) - 120.0
    expected = 4.0 * np.sqrt((ideal * x**2).sum() / ideal.sum())
    found = beam_widths(camera(60.0, noise=noise, power=power)).widths
    assert found == pytest.approx((expected, expected), rel=error)


def saved(image, folder, name="beam.png"):
    """An image file of 12 bits in 16."""
    grains = np.clip(np.round(image / image.max() * 4095.0), 0, 65535).astype(np.uint16)
    if name.endswith(".csv"):
        np.savetxt(folder / name, grains, fmt="%d", delimiter=";")
    else:
        Image.fromarray(grains).save(folder / name)
    return folder / name


def laser(file, **spot):
    """10 uJ under stripes of 5 um on a measured spot."""
    return Laser.model_validate(
        {
            "pulse_energy": 1e-5,
            "beam": {"kind": "interference", "period": 5e-6},
            "spot": {"image": str(file), "pixel_size": PIXEL} | spot,
            "pulse": {"kind": "square", "duration": 1e-8},
            "absorption": {"kind": "surface"},
        }
    )


def plane(cells, half=1.5e-4):
    """Corners of cells x cells over the image, and the area of one."""
    edges = np.linspace(-half, half, cells + 1)
    low, high = (np.stack([a.ravel() for a in np.meshgrid(e, e)]) for e in (edges[:-1], edges[1:]))
    return low, high, (2.0 * half / cells) ** 2


@pytest.mark.parametrize("cells", [7, 100, 613])
def test_energy_of_a_measured_beam_closes(cells, tmp_path):
    """Cells of any size that hold the beam receive the pulse energy to 1e-6."""
    file = saved(camera(64.0, 50.0, azimuth=0.3, noise=0.02), tmp_path)
    light = laser(file, extent="whole").model_copy(update={"beam": UniformBeam()})
    low, high, area = plane(cells)
    total = light.energy_density(low, high, 0.0, 1.0).sum() * area
    assert total == pytest.approx(1e-5, rel=1e-6)


def test_local_fluence_of_a_measured_beam(tmp_path):
    """That of the Gaussian it is, 8 E/(pi d^2) at its center, y upward; sections as cell means."""
    file = saved(camera(64.0, 40.0, azimuth=0.5), tmp_path)
    local = laser(file).spot_fluence
    d = 64e-6, 40e-6
    assert local.center == pytest.approx(8.0 * 1e-5 / (np.pi * d[0] * d[1]), rel=0.01)
    place = 2e-5 * np.array([np.cos(0.5), -np.sin(0.5)])  # rows run downward
    left = np.exp(-8.0 * (2e-5 / d[0]) ** 2)
    assert local.at(*place) == pytest.approx(left * local.center, rel=0.01)
    envelope = local.envelope
    low, high = np.array([[-3e-6, 1e-5]]), np.array([[4e-6, 1.02e-5]])
    x = np.linspace(low[0], high[0], 2001)
    mean = np.trapezoid(envelope.at(x, 0.0), x, axis=0) / (high - low)[0]
    assert envelope.cell_means(low, high, np.zeros(2)) == pytest.approx(mean, rel=1e-5)
    point = np.empty((0, 1))
    assert envelope.cell_means(point, point, np.zeros(2)) == pytest.approx(
        [float(envelope.at(0.0, 0.0))]
    )


@pytest.mark.parametrize("name", ["beam.png", "beam.tif", "beam.csv"])
def test_formats_hold_the_same_beam(name, tmp_path):
    """PNG and TIFF of 16 bits and tables."""
    file = saved(camera(), tmp_path, name)
    found = measured_envelope(str(file), digest_of(file), PIXEL)
    assert 2.0 * found.radius == pytest.approx(64e-6, rel=1e-3)
    assert found.saturated == 0
    assert found.shape.startswith("measured, ISO 11146 widths 64")


def test_a_saturated_camera_is_told(tmp_path):
    """Many whole numbers at the highest value."""
    file = saved(np.minimum(camera(), 0.8), tmp_path)
    assert "look saturated" in measured_envelope(str(file), digest_of(file), PIXEL).quality


def test_another_image_is_another_case(tmp_path):
    """The content is part of the laser; one that changed under its digest is refused."""
    file = saved(camera(), tmp_path)
    first = laser(file)
    again = Laser.model_validate(first.model_dump())
    assert again == first
    saved(camera(70.0), tmp_path)
    assert laser(file) != first
    with pytest.raises(ValueError, match="has changed since its digest was taken"):
        Laser.model_validate(first.model_dump())


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda f: f.with_name("none.png"), "cannot be read: No such file"),
        (lambda f: f.rename(f.with_suffix(".bmp")), "is no PNG, TIFF or CSV"),
        (lambda f: saved(camera()[:, :120], f.parent), "shows no whole beam"),
        (lambda f: saved(0.0 * camera() + 1.0, f.parent), "the same value in all pixels"),
        (lambda f: saved(camera(noise=0.1)[:90, :60], f.parent), "shows no whole beam"),
        (lambda f: saved(camera()[:4], f.parent), "has 256 x 4 pixels"),
        (lambda f: _written(f, b"x"), "cannot be read as an image"),
        (lambda f: _written(f.with_suffix(".csv"), b"1;2\n3"), "is no table of numbers"),
        (lambda f: _colored(f), "is in color"),
    ],
)  # fmt: skip
def test_refused_images(make, words, tmp_path):
    """One line that says what is wrong."""
    file = make(saved(camera(), tmp_path))
    with pytest.raises(ValueError, match=words):
        laser(file)


def _written(file, content):
    file.write_bytes(content)
    return file


def _colored(file):
    Image.fromarray(np.arange(300, dtype=np.uint8).reshape(10, 10, 3)).save(file)
    return file


def test_refused_keys(tmp_path):
    """An image without its pixel, pixels without an image, and a diameter beside it."""
    file = saved(camera(), tmp_path)
    with pytest.raises(ValueError, match=r'pixel_size: missing; write e.g. pixel_size = "1.2 um"'):
        laser(file, pixel_size=None)
    with pytest.raises(ValueError, match="diameter: is that of the image; leave it out"):
        laser(file, diameter=1e-4)
    with pytest.raises(ValueError, match="pixel_size: says nothing without an image"):
        laser(file, image=None)
