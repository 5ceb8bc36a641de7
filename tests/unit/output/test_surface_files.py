"""Height maps as X3P, SDF and text: written, read back, refused in one line."""

import zipfile

import numpy as np
import pytest

from lasersph.output import OutputError
from lasersph.output.height_map import HeightMap
from lasersph.output.surface_files.read import read_surface


@pytest.fixture
def relief():
    """Five rows of seven columns of 100 and 200 nm, one height missing."""
    y, x = np.mgrid[0:5, 0:7]
    z = 1e-9 * (3.0 * x - 7.0 * y)
    z[2, 3] = np.nan
    return HeightMap(1e-7 * np.arange(7), 2e-7 * np.arange(5), z)


@pytest.mark.parametrize("kind", ["x3p", "sdf", "csv"])
def test_written_and_read(relief, tmp_path, kind):
    """Heights, steps and the missing height come back."""
    found = read_surface(relief.write(tmp_path / f"relief.{kind}"))
    np.testing.assert_allclose(found.z, relief.z, rtol=1e-8)
    np.testing.assert_allclose(found.x, relief.x, atol=1e-15)
    np.testing.assert_allclose(found.y, relief.y, atol=1e-15)


@pytest.mark.parametrize("kind", ["x3p", "sdf"])
def test_profile(tmp_path, kind):
    """A profile is a file of one row."""
    line = HeightMap(1e-7 * np.arange(9), np.zeros(1), 1e-9 * np.arange(9.0)[None, :])
    found = read_surface(line.write(tmp_path / f"line.{kind}"))
    assert found.z.shape == (1, 9)
    np.testing.assert_allclose(found.z, line.z)


TEXTS = {
    "columns": "x [um],z [nm]\n0,1\n0.5,2\n1.0,-3\n",
    "spaces": "x_um z_nm\n0 1\n0.5 2\n1.0 -3\n",
    "gwyddion": "# Width: 1.5 µm\n# Height: 0.5 µm\n# Value units: nm\n1\t2\t-3\n",
    "keyence": '"Model","VK"\n"XY calibration","500","nm"\n"Unit","nm"\n"Height"\n"1","2","-3"\n',
}


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS.keys())
def test_exports_of_microscopes(tmp_path, text):
    """A profile of three heights, half a micrometer apart."""
    path = tmp_path / "profile.csv"
    path.write_text(text, encoding="utf-8")
    found = read_surface(path)
    np.testing.assert_allclose(found.z, [[1e-9, 2e-9, -3e-9]])
    np.testing.assert_allclose(np.diff(found.x), 5e-7)


def test_rounded_places(tmp_path):
    """Places 88.18 nm apart, written to 0.1 nm, are even; ones half a step off are not."""
    x = np.arange(50) * 0.08818
    for drift, is_even in ((0.0, True), (0.02, False)):
        lines = [f"{a + drift * a * (4.4 - a):.4f},{k}" for k, a in enumerate(x)]
        (tmp_path / "a.csv").write_text("\n".join(["x [um],z [nm]", *lines]))
        if is_even:
            assert read_surface(tmp_path / "a.csv").steps[0] == pytest.approx(88.18e-9, rel=1e-4)
        else:
            with pytest.raises(OutputError, match="the steps of x differ"):
                read_surface(tmp_path / "a.csv")


BAD = {
    "empty": ("a.csv", "", "it is empty"),
    "no unit": ("a.csv", "x,z\n0,1\n1,2\n2,3\n", "name columns with their units"),
    "other unit": ("a.csv", "x [ns],z [nm]\n0,1\n1,2\n2,3\n", "name columns with their units"),
    "word": ("a.csv", "x [um],z [nm]\n0,1\n1,two\n2,3\n", 'row 2: "two" is no number'),
    "short row": ("a.csv", "x [um],z [nm]\n0,1\n1\n2,3\n", "row 2 holds 1 numbers, not 2"),
    "uneven": ("a.csv", "x [um],z [nm]\n0,1\n1,2\n5,3\n", "the steps of x differ"),
    "no grid": ("a.csv", "x_m,y_m,z_m\n0,0,1\n1,0,2\n0,1,3\n", "no rectangular grid"),
    "binary sdf": ("a.sdf", "bISO-1.0\n", "only ASCII files"),
    "sdf without points": ("a.sdf", "aISO-1.0\nNumProfiles = 1\n*\n1\n*\n", "misses numpoints"),
    "sdf of few heights": (
        "a.sdf",
        "aISO-1.0\nNumPoints=2\nNumProfiles=2\nXscale=1\nYscale=1\nZscale=1\n*\n1 2 3\n*\n",
        "it holds 3 heights, its header says 2 times 2",
    ),
    "sdf without steps": (
        "a.sdf",
        "aISO-1.0\nNumPoints=2\nNumProfiles=1\nXscale=0\nYscale=1\nZscale=1\n*\n1 2\n*\n",
        "not above zero",
    ),
    "no x3p": ("a.x3p", "hello", "it is no X3P file"),
    "picture": ("a.png", "", 'no format ".png" of a surface'),
}


@pytest.mark.parametrize(("name", "text", "message"), BAD.values(), ids=BAD.keys())
def test_refused_in_one_line(tmp_path, name, text, message):
    """The line names the file and what is wrong."""
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(OutputError) as caught:
        read_surface(tmp_path / name)
    assert message in str(caught.value)
    assert name in str(caught.value)
    assert "\n" not in str(caught.value)


def test_damaged_x3p(relief, tmp_path):
    """A height that changed on the way is found by the checksum."""
    path = relief.write(tmp_path / "relief.x3p")
    with zipfile.ZipFile(path) as file:
        parts = {name: file.read(name) for name in file.namelist()}
    parts["bindata/data.bin"] = bytes(8) + parts["bindata/data.bin"][8:]
    parts["bindata/data.bin"] = parts["bindata/data.bin"][:8] + bytes(8) + bytes(8 * 33)
    with zipfile.ZipFile(path, "w") as file:
        for name, content in parts.items():
            file.writestr(name, content)
    with pytest.raises(OutputError, match="the checksum is another"):
        read_surface(path)


@pytest.mark.parametrize(
    ("head", "scales"),
    [
        ("x_m,height_m", (1.0, 1.0)),
        ("x_m,fluence_J_m2,height_m,melt_depth_m", (1.0, 1.0)),
        ("x [um],Height [nm]", (1e-6, 1e-9)),
        ("Distance (µm);Depth [um]", (1e-6, -1e-6)),
        ("height_nm\tposition_mm", (1e-3, 1e-9)),
    ],
)
def test_names_of_columns(tmp_path, head, scales):
    """Our own profiles and what microscopes call their columns; a depth counts downward."""
    separator = next(one for one in ",;\t" if one in head)
    names = head.split(separator)
    places = [names.index(n) for n in names if n[0].lower() in "xdp" and "epth" not in n]
    rows = [
        [str(0.25 * k + (10 * k if n in places else 0)) for n in range(len(names))]
        for k in range(5)
    ]
    file = tmp_path / "line.csv"
    file.write_text("\n".join([head, *(separator.join(row) for row in rows)]), encoding="utf-8")
    found = read_surface(file)
    np.testing.assert_allclose(found.x, scales[0] * 10.25 * np.arange(5), rtol=1e-12)
    np.testing.assert_allclose(found.z[0], scales[1] * 0.25 * np.arange(5), rtol=1e-12)
