"""NTMpy: a pulse on electrons and lattice, in the interpreter that NTMpy is installed for.

Prints one line of JSON. Argument: problem and sizes in JSON, as `pulse_problem.answers_of` gives.
"""

import contextlib
import io
import json
import sys
from time import perf_counter, process_time

import numpy as np
from NTMpy import NTMpy

WAVELENGTH = 800.0
"""[nm]; with the extinction coefficient it gives the depth of the light, and nothing else."""
LEAST = 1e-6
"""Conductivity of the lattice [W/(m K)]. The program divides by it."""


def source_of(pulse):
    """The light. Its "FWHM" is half the full width: exp(-(t - t0)^2 ln 2/FWHM^2)."""
    light = NTMpy.source()
    light.spaceprofile, light.timeprofile = "LB", "Gaussian"
    light.fluence, light.t0, light.FWHM = pulse["fluence"], pulse["center"], 0.5 * pulse["fwhm"]
    light.lambda_vac = WAVELENGTH
    return light


def run(pulse, cold, size):
    """Points, times and temperatures of one run."""
    hot = (lambda T: T / cold) if pulse["is_linear"] else (lambda T: 1.0 + 0.0 * T)
    extinction = pulse["alpha"] * 1e-9 * WAVELENGTH / (4.0 * np.pi)
    begin = perf_counter(), process_time()
    one = NTMpy.simulation(2, source_of(pulse))
    for thickness in layers(pulse["thickness"], size["layers"]):
        # heat capacities are per mass, of a density of one
        one.addLayer(
            thickness,
            1.0 + 1j * extinction,
            [lambda T: pulse["conductivity"] * hot(T), lambda T: LEAST + 0.0 * T],
            [lambda T: pulse["capacity"] * hot(T), lambda T: pulse["lattice"] + 0.0 * T],
            1.0,
            pulse["coupling"],
        )
    one.changeInit("electron", cold)
    one.changeInit("lattice", cold)
    one.stability_lim = [cold, 5.0 * cold]
    one.final_time, one.time_step = pulse["times"][-1] + 2.0 * size["step"], size["step"]
    for data in (one.temp_data, one.temp_data_Lat):
        data.collocpts, data.plt_points = size["points"], size["points"]
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        depth, time, both = one.run()
    end = perf_counter(), process_time()
    T = [[at(depth, time, part, pulse, when) for when in pulse["times"]] for part in both]
    return {
        "points": len(depth), "wall": end[0] - begin[0], "processor": end[1] - begin[1],
        "temperature": T,
    }  # fmt: skip


def layers(thickness, count):
    """Layers of one metal [m], each three times as thick as that above: points lie closer there."""
    share = 3.0 ** np.arange(count)
    return thickness * share / share.sum()


def at(depth, time, T, pulse, when):
    """Temperatures at the depths [K], straight between times and points."""
    after = int(np.searchsorted(time, when))
    share = (when - time[after - 1]) / (time[after] - time[after - 1])
    row = (1.0 - share) * T[after - 1] + share * T[after]
    return [float(np.interp(z, depth, row)) for z in pulse["depths"]]


def main():
    """All sizes, the first of them once more before."""
    given = json.loads(sys.argv[1])
    pulse, cold, sizes = given["pulse"], given["cold"], given["sizes"]
    run(pulse, cold, sizes[0])
    print("\n" + json.dumps({"runs": [run(pulse, cold, size) for size in sizes]}))


main()
