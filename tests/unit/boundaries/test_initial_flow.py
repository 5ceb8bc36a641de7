"""Velocities that a flow starts from."""

import numpy as np
import pytest
from pydantic import TypeAdapter, ValidationError

from lasersph.boundaries.initial_flow import InitialFlow, TabulatedFlow, TaylorGreenFlow
from lasersph.input import CaseError

BOX = ((-0.5, 0.5), (-1.0, 0.0))
PLACES = np.array([[0.25, 0.0, 0.1], [-0.5, -0.25, -0.3]])


def initial(**data):
    """The start that a case says."""
    return TypeAdapter(InitialFlow).validate_python(data)


def test_rest():
    """Zero everywhere."""
    assert not initial(kind="rest").velocity(PLACES, BOX).any()


def test_taylor_green_by_hand():
    """sin(kx) cos(kz), -cos(kx) sin(kz), k = 2 pi: u = -1 at (1/4, -1/2), w = 1 at (0, -1/4)."""
    flow = initial(kind="taylor-green", speed=1.0)
    assert isinstance(flow, TaylorGreenFlow)
    velocity = flow.velocity(PLACES, BOX)
    assert velocity[:, 0] == pytest.approx([-1.0, 0.0], abs=1e-15)
    assert velocity[:, 1] == pytest.approx([0.0, 1.0], abs=1e-15)
    halved = initial(kind="taylor-green", speed=1.0, period=0.5).velocity(PLACES, BOX)
    assert halved[:, 0] == pytest.approx([0.0, 0.0], abs=1e-12)


def test_table_is_linear_inside_and_nearest_outside(tmp_path):
    """A field u = x, w = 2 z on a lattice comes back exactly; beyond it the edge counts."""
    x, z = np.meshgrid([-0.5, 0.0, 0.5], [-1.0, -0.5, 0.0])
    rows = np.stack([x, z, x, 2 * z], axis=-1).reshape(-1, 4)
    file = tmp_path / "field.csv"
    np.savetxt(file, rows, delimiter=",", header="x,z,u,w", comments="")
    flow = TabulatedFlow(path=str(file))
    assert flow.velocity(PLACES, BOX) == pytest.approx(PLACES * [[1.0], [2.0]])
    assert flow.velocity(np.array([[0.9], [-0.5]]), BOX)[:, 0] == pytest.approx([0.5, -1.0])
    assert TabulatedFlow(rows=flow.rows).velocity(PLACES, BOX) == pytest.approx(
        flow.velocity(PLACES, BOX)
    )


def test_table_of_one_place():
    """A single row is a uniform velocity."""
    flow = TabulatedFlow(rows=((0.0, 0.0, 1.0, -2.0),))
    assert flow.velocity(PLACES, BOX).T.tolist() == [[1.0, -2.0]] * 3


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x,z,u\n1,2,3\n", "no column w"),
        ("x,z,u,w\n1,2,3,4\n1,2,3\n", ":3: needs 4 finite numbers"),
        ("x,z,u,w\n1,2,3,nan\n", ":2: needs 4 finite numbers"),
        ("x,z,u,w\n1,2,3,four\n", ":2: needs 4 finite numbers"),
    ],
)
def test_bad_tables(text, message, tmp_path):
    """The line of what cannot be read is said."""
    file = tmp_path / "field.csv"
    file.write_text(text, encoding="utf-8")
    with pytest.raises((CaseError, ValidationError), match=message):
        TabulatedFlow(path=str(file))


def test_an_empty_table_is_refused(tmp_path):
    """A headline alone is no field."""
    file = tmp_path / "field.csv"
    file.write_text("x,z,u,w\n", encoding="utf-8")
    with pytest.raises(ValidationError, match="missing"):
        TabulatedFlow(path=str(file))
