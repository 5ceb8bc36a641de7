"""Texts of loops are written once in a process, as long as nothing that entered them changes."""

import pytest

from lasersph import compute
from lasersph.compute import generate

SHIFT = 1.0


def shifted(T):
    """A field and a constant of the module."""
    return T + SHIFT


def doubled(T):
    """What an editor may put in the place of the first function."""
    return 2.0 * T


def result():
    """What a new backend computes."""
    backend = compute.cpu(threads=1)
    out = backend.zeros(1)
    backend.pointwise(shifted, {"T": backend.asarray([4.0])}, out)
    return out[0]


@pytest.fixture
def texts(monkeypatch):
    """Loops that were written since."""
    found = []
    write = generate.LoopText.written

    def written(self):
        found.append(self.loop.function.__name__)
        return write(self)

    monkeypatch.setattr(generate.LoopText, "written", written)
    return found


def test_next_backend_writes_nothing(texts):
    """Another solver of a process finds the texts of the one before."""
    assert result() == 5.0
    texts.clear()
    assert result() == 5.0 and texts == []


def test_changed_constant_is_seen(texts, monkeypatch):
    """A global name that means something else gives another text, and the old one again."""
    assert result() == 5.0
    texts.clear()
    monkeypatch.setitem(globals(), "SHIFT", 3.0)
    assert result() == 7.0 and texts == ["shifted"]
    monkeypatch.undo()
    assert result() == 5.0


def test_replaced_code_is_seen(texts, monkeypatch):
    """A function that an editor has given other code, in the same object, is written anew."""
    assert result() == 5.0
    texts.clear()
    monkeypatch.setattr(shifted, "__code__", doubled.__code__)
    assert result() == 8.0 and texts == ["shifted"]
