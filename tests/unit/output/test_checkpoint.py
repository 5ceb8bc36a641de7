"""Checkpoints: exact state, checksum, the one before as a reserve."""

import numpy as np
import pytest

from lasersph.output import checkpoint
from lasersph.output.checkpoint import Checkpoint
from lasersph.output.errors import OutputError


def state(step):
    rng = np.random.default_rng(step)
    arrays = {
        "enthalpy": rng.standard_normal(30),
        "position": rng.random((2, 30)),
        "order": np.arange(30, dtype=np.uint32),
        "empty": np.zeros(0),
    }
    scalars = {"time_step": 0.1 + 0.2, "limit": "pulse", "list": [1, 2.5], "nan": float("nan")}
    return Checkpoint(step, step * 1e-12, "abc", arrays, scalars, {"history_rows": step})


def test_state_reads_back_bit_for_bit(tmp_path):
    """Arrays, numbers and types are exactly those that were saved."""
    saved = state(7)
    found = checkpoint.load(checkpoint.save(tmp_path / "checkpoint", saved))
    assert (found.step, found.time, found.case_hash) == (7, 7e-12, "abc")
    for name, array in saved.arrays.items():
        assert found.arrays[name].dtype == array.dtype
        assert found.arrays[name].shape == array.shape
        assert found.arrays[name].tobytes() == array.tobytes()
        assert found.arrays[name].flags.writeable
    assert found.scalars["time_step"] == 0.1 + 0.2
    assert np.isnan(found.scalars["nan"])
    assert found.meta == {"history_rows": 7}


def test_the_last_two_are_kept(tmp_path):
    """Older ones and unfinished ones are removed after a good one is in place."""
    (tmp_path / "step-0000000009.checkpoint.writing").write_bytes(b"torn")
    for step in (1, 2, 30):
        checkpoint.save(tmp_path, state(step))
    names = [path.name for path in checkpoint.candidates(tmp_path)]
    assert names == ["step-0000000030.checkpoint", "step-0000000002.checkpoint"]
    assert not list(tmp_path.glob("*.writing"))


@pytest.mark.parametrize("damage", ["cut", "flip", "empty"])
def test_damage_is_detected(tmp_path, damage):
    """A cut, altered or empty file is never taken for a checkpoint."""
    path = checkpoint.save(tmp_path, state(1))
    data = bytearray(path.read_bytes())
    for position in np.random.default_rng(0).integers(0, len(data), 40):
        altered = bytearray(data)
        altered[position] ^= 4
        path.write_bytes({"cut": data[:position], "flip": altered, "empty": b""}[damage])
        with pytest.raises(OutputError, match="it is damaged"):
            checkpoint.load(path)


def test_full_disk_keeps_the_last_good_one(tmp_path, monkeypatch):
    """A write that fails leaves the checkpoint before and no torn file."""
    good = checkpoint.save(tmp_path, state(1))

    def full(_):
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr("os.fsync", full)
        with pytest.raises(OutputError, match="the disk is full"):
            checkpoint.save(tmp_path, state(2))
    assert [path.name for path in tmp_path.iterdir()] == [good.name]
    assert checkpoint.load(good).step == 1


def test_another_format_is_refused(tmp_path, monkeypatch):
    """A checkpoint of another program version is named as such."""
    with monkeypatch.context() as patch:
        patch.setattr(checkpoint, "CHECKPOINT_SCHEMA", 99)
        path = checkpoint.save(tmp_path, state(1))
    ours = checkpoint.CHECKPOINT_SCHEMA
    with pytest.raises(OutputError, match=f"its format is 99, this version reads {ours}"):
        checkpoint.load(path)
