"""PySPH: right-hand sides on the displaced block, in the interpreter that PySPH is installed for.

Prints one line of JSON. Arguments: positions (.npy), "wcsph" or "heat-sum", segments, support,
speed of sound, viscosity, conductivity; threads by OMP_NUM_THREADS.
"""

import json
import sys
from statistics import median
from time import perf_counter, process_time

import numpy as np
from compyle.config import get_config

get_config().use_openmp = True

from pysph.base.kernels import CubicSpline  # noqa: E402
from pysph.base.nnps import LinkedListNNPS  # noqa: E402
from pysph.base.utils import get_particle_array  # noqa: E402
from pysph.sph.acceleration_eval import AccelerationEval  # noqa: E402
from pysph.sph.basic_equations import ContinuityEquation  # noqa: E402
from pysph.sph.equation import Equation, Group  # noqa: E402
from pysph.sph.sph_compiler import SPHCompiler  # noqa: E402
from pysph.sph.wc.basic import MomentumEquation, TaitEOS  # noqa: E402

NAME = "fluid"


class Conduction(Equation):
    """dT/dt = 2 D sum_j V_j (T_i - T_j) x_ij . grad W_ij / r_ij^2, D constant."""

    def __init__(self, dest, sources, D):
        self.D = D
        super().__init__(dest, sources)

    def initialize(self, d_idx, d_aT):
        d_aT[d_idx] = 0.0

    def loop(self, d_idx, s_idx, d_T, s_T, d_aT, s_m, s_rho, XIJ, DWIJ, R2IJ, EPS):
        F = (XIJ[0] * DWIJ[0] + XIJ[1] * DWIJ[1] + XIJ[2] * DWIJ[2]) / (R2IJ + EPS)
        d_aT[d_idx] += 2.0 * self.D * s_m[s_idx] / s_rho[s_idx] * (d_T[d_idx] - s_T[s_idx]) * F


def equations(case, sound_speed, viscosity, conductivity):
    """Groups of a right-hand side."""
    heat = Conduction(NAME, [NAME], D=conductivity)
    if case == "heat-sum":
        return [Group([heat])]
    state = TaitEOS(NAME, None, rho0=1.0, c0=sound_speed, gamma=7.0)
    momentum = MomentumEquation(NAME, [NAME], c0=sound_speed, alpha=viscosity, beta=0.0)
    return [Group([state], real=False), Group([ContinuityEquation(NAME, [NAME]), momentum, heat])]


def main():
    """Time the right-hand side; that of heat at rest keeps its neighbors."""
    path, case, segments = sys.argv[1], sys.argv[2], int(sys.argv[3])
    support, sound_speed, viscosity, conductivity = map(float, sys.argv[4:8])
    x, y, z = np.load(path)
    properties = ("au", "av", "aw", "arho", "dt_cfl", "dt_force", "T", "aT", "cs")
    particles = get_particle_array(
        name=NAME, x=x, y=y, z=z, m=1.0, rho=1.0, h=0.5 * support, p=0.0, cs=sound_speed,
        additional_props=list(properties),
    )  # fmt: skip
    particles.T[:] = 1.0 + 0.5 * np.cos(2.0 * np.pi * z / z.max())
    shape = CubicSpline(dim=3)
    groups = equations(case, sound_speed, viscosity, conductivity)
    evaluation = AccelerationEval([particles], groups, shape)
    SPHCompiler(evaluation, None).compile()
    keeps = case == "heat-sum"
    search = LinkedListNNPS(
        dim=3, particles=[particles], radius_scale=shape.radius_scale, cache=keeps
    )
    evaluation.set_nnps(search)
    times = []
    for _ in range(segments + 1):
        wall, processor = perf_counter(), process_time()
        if not (keeps and times):
            search.update_domain()
            search.update()
        evaluation.compute(0.0, 0.01)
        times.append((perf_counter() - wall, process_time() - processor))
    wall, processor = (median(column) for column in zip(*times[1:], strict=True))
    print(json.dumps({"wall": wall, "processor": processor}))


main()
