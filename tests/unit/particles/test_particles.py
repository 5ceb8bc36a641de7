"""`Particles`: arrays by name that keep their identity, symbols, and what a checkpoint holds."""

import numpy as np
import pytest

from lasersph.particles.fields import FIELDS, Field
from lasersph.particles.particles import Particles


def body(backend, *fields, **settings):
    """Three particles in a plane."""
    return Particles(backend, 3, 2, fields, **settings)


def test_arrays_by_name(backend):
    """Shapes follow the table; with room, arrays are as long as the capacity."""
    particles = body(backend, "temperature", "velocity", capacity=5)
    assert particles["temperature"].shape == (5,)
    assert particles["velocity"].shape == (2, 5)
    assert list(particles) == ["temperature", "velocity"]
    assert "enthalpy" not in particles


def test_identity_is_kept(backend):
    """Setting, restoring and going back copy values into the same arrays."""
    particles = body(backend, "enthalpy")
    array = particles["enthalpy"]
    particles.set("enthalpy", np.array([1.0, 2.0, 3.0]))
    particles.save()
    particles.restore({"enthalpy": np.array([4.0, 5.0, 6.0])})
    assert particles["enthalpy"] is array
    assert backend.to_host(array).tolist() == [4.0, 5.0, 6.0]
    particles.go_back()
    assert particles["enthalpy"] is array
    assert backend.to_host(array).tolist() == [1.0, 2.0, 3.0]


def test_symbols(backend):
    """Loops get the arrays themselves by the symbols of the table."""
    particles = body(backend, "enthalpy", "temperature")
    assert particles.by_symbol("temperature") == {"T": particles["temperature"]}
    assert set(particles.by_symbol()) == {"h", "T"}


def test_kept_and_derived(backend):
    """A checkpoint holds the enthalpy and not the temperature that follows from it."""
    particles = body(backend, "enthalpy", "temperature")
    assert set(particles.kept) == {"enthalpy"}
    with pytest.raises(ValueError, match="lacks enthalpy"):
        particles.restore({"temperature": np.zeros(3)})


def test_nothing_grows_silently(backend):
    """No field twice, no array of another length, no unknown name, no room below the count."""
    particles = body(backend, "enthalpy")
    with pytest.raises(ValueError, match="already have"):
        particles.add("enthalpy")
    with pytest.raises(ValueError, match="shape"):
        particles.set("enthalpy", np.zeros(4))
    with pytest.raises(KeyError):
        particles.add("entalpy")
    with pytest.raises(ValueError, match="3 particles"):
        body(backend, capacity=2)


def test_a_field_of_ones_own(backend):
    """A field beside the table, of flags."""
    particles = body(backend, Field("mark", "s", "1", "1 where chosen", storage="flag"))
    assert particles["mark"].dtype == np.uint8


def test_symbols_of_a_table_are_unique():
    """One symbol, one field; every unit is said."""
    symbols = [field.symbol for field in FIELDS.values()]
    assert len(symbols) == len(set(symbols))
    assert all(field.unit and field.words for field in FIELDS.values())
