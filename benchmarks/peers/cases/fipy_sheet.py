"""FiPy: one implicit step of heat on a grid, in the interpreter that FiPy is installed for.

Prints one line of JSON. Arguments: cells along an edge, segments, D dt / dx^2, tolerance.
"""

import json
import os
import sys
from statistics import median
from time import perf_counter, process_time

os.environ["FIPY_SOLVERS"] = "scipy"

from fipy import CellVariable, DiffusionTerm, Grid2D, TransientTerm
from fipy.solvers.scipy import LinearCGSolver


def main():
    """Time steps of one square, hot on the left and cold on the right."""
    edge, segments = int(sys.argv[1]), int(sys.argv[2])
    step, tolerance = float(sys.argv[3]), float(sys.argv[4])
    mesh = Grid2D(nx=edge, ny=edge, dx=1.0, dy=1.0)
    temperature = CellVariable(mesh=mesh, value=300.0, hasOld=True)
    temperature.constrain(1000.0, mesh.facesLeft)
    temperature.constrain(300.0, mesh.facesRight)
    equation = TransientTerm() == DiffusionTerm(coeff=1.0)
    solver = LinearCGSolver(tolerance=tolerance, iterations=2000)
    times = []
    for _ in range(segments + 1):
        wall, processor = perf_counter(), process_time()
        temperature.updateOld()
        equation.solve(temperature, dt=step, solver=solver)
        times.append((perf_counter() - wall, process_time() - processor))
    wall, processor = (median(column) for column in zip(*times[1:], strict=True))
    print(json.dumps({"wall": wall, "processor": processor}))


main()
