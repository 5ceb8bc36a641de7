"""The command that sets the hot loops beside what the machine can do."""

import json

import pytest
import roofline

from lasersph.compute import cuda_device


def test_table_and_json(tmp_path, capsys):
    """Ceilings, the loops with their ratios, all of it as JSON."""
    file = tmp_path / "speed.json"
    assert roofline.main(["--sizes", "400,900", "--threads", "1", "--json", str(file)]) == 0
    text = capsys.readouterr().out
    assert "1 thread: " in text and "GB/s" in text and "pair sum 3-D" in text
    numbers = json.loads(file.read_text())
    assert numbers["schema_version"] == 1
    assert numbers["ceilings"][0]["bandwidth_B_s"] > 0.0
    assert {one["particles"] for one in numbers["loops"]} == {400, 343, 900, 1000}


@pytest.mark.parametrize(
    ("sizes", "text"),
    [("many", "give whole numbers"), ("5", "from 100 on"), ("400,1000000000000", "need up to")],
)
def test_wrong_sizes(sizes, text, capsys):
    """What is no size, or more than the machine has, is refused in one line."""
    assert roofline.main(["--sizes", sizes]) == 2
    error = capsys.readouterr().err
    assert text in error and error.count("\n") == 1


def test_no_graphics_card(monkeypatch, capsys):
    """`--backend cuda` without a card ends with one line."""

    def no_card():
        raise cuda_device.NoDevice("--backend cuda: no CUDA device found")

    monkeypatch.setattr(cuda_device, "checked", no_card)
    assert roofline.main(["--backend", "cuda"]) == 2
    assert (
        capsys.readouterr().err
        == "lasersph: --backend cuda: no CUDA device found; see docs/gpu.md\n"
    )
