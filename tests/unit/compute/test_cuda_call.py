"""Calls of kernels as a card's driver takes them, without a card."""

import importlib.util
import re

import numpy as np
import pytest

from lasersph.compute import cuda_device

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("numba_cuda") is None or cuda_device.IS_SIMULATED,
    reason="needs numba-cuda (extra gpu), not simulated",
)
FIRST = 4096
"""Address of the first element of a piece that no card has."""


@pytest.fixture
def card(monkeypatch):
    """The module of the card, whose kernels are not loaded."""
    from lasersph.compute import cuda_card

    monkeypatch.setattr(cuda_card, "_function", lambda kernel, kinds: kinds)
    return cuda_card


def piece(card, shape, dtype):
    return card.Piece(None, FIRST, shape, np.dtype(dtype))


def mixed(count, values, table, scale, flag):
    if flag and count:
        values[0] = scale * table[1, 0]


def test_words_are_what_a_kernel_takes(card):
    """A word for each parameter in the assembly that Numba writes for the same arguments."""
    from machine_code import newest_card
    from numba import cuda

    from lasersph.compute.cuda_assembly import assembly

    arguments = [np.uint64(3), piece(card, (5,), "f4"), piece(card, (2, 3), "f8"),
                 np.float32(0.5), np.True_]  # fmt: skip
    call = card.Call(None, arguments)
    kinds = call._function
    with newest_card():
        name, text = assembly(cuda.jit(mixed), kinds, (9, 0))
    head = text[text.index(f".entry {name}(") :].partition(")")[0]
    assert len(re.findall(r"\.param", head)) == call._words.size == 1 + 7 + 9 + 1 + 1
    assert "NumbaEnv" not in text


def test_words_by_hand(card):
    """No owner, number and size of the elements, address, lengths, strides; bits of numbers."""
    whole = piece(card, (6,), "f4")
    call = card.Call(None, [np.uint64(3), whole.cut(2, 5), np.float64(1.0), np.int64(-1)])
    part = [0, 0, 3, 4, FIRST + 8, 3, 4]
    assert call._words.tolist() == [3, *part, 0x3FF0000000000000, 2**64 - 1]
    assert piece(card, (2, 3), "f8").words == (0, 0, 6, 8, FIRST, 2, 3, 24, 8)
    # the driver finds each by its address
    assert np.diff(call._pointers).tolist() == [8] * 9
    assert call._pointers[0] == call._words.ctypes.data


@pytest.mark.parametrize("precision", ["float64", "float32"])
def test_numbers_and_pieces_change(card, precision):
    """Later starts take other numbers and pieces."""
    real = np.dtype(precision)
    given = [np.uint64(3), piece(card, (6,), "u4"), *[real.type(0)] * 2, np.int64(0)]
    call = card.Call(None, given)
    reals, whole = call.numbers(2, 2, real), call.numbers(4, 1, np.dtype(np.int64))
    reals[1], whole[0] = 2.5, -7
    assert call._words[9:10].view(real)[0] == 2.5
    assert call._words[10:].view(np.int64)[0] == -7
    assert call.numbers(5, 0, real).size == 0
    call.replace(1, piece(card, (2,), "u4"))
    assert call._words[1:8].tolist() == [0, 0, 2, 4, FIRST, 2, 4]


def test_error_of_the_driver(card):
    """It is named."""
    from cuda.bindings import driver

    assert card._done((driver.CUresult.CUDA_SUCCESS, 5)) == (5,)
    with pytest.raises(RuntimeError, match="CUDA_ERROR_OUT_OF_MEMORY"):
        card._done((driver.CUresult.CUDA_ERROR_OUT_OF_MEMORY,))
