"""laserttm: a pulse on electrons and lattice, in the interpreter that laserttm is installed for.

Prints one line of JSON. Argument: problem and sizes in JSON, as `pulse_problem.answers_of` gives.
"""

import json
import sys
from math import pi
from time import perf_counter, process_time

import laserttm.depth_profile as profile
import numpy as np

LEAST = 0.01
"""Conductivity of the lattice [W/(m K)], the least that the program takes."""
SPOT = 1e-4
"""Radius of the beam [m]; the fluence at its center is given by power and rate."""
KELVIN = 273.15


def settings(pulse, cold, size):
    """Of one pulse whose run ends at the last time: at 0.9 of a period after its center."""
    rate = 0.9 / (pulse["times"][-1] - pulse["center"])
    return {
        "material": "custom", "gamma_manual": pulse["capacity"] / cold,
        "Cl_manual": pulse["lattice"], "G_manual": pulse["coupling"],
        "ke0_manual": pulse["conductivity"], "kl_manual": LEAST,
        "alpha_opt_manual": pulse["alpha"], "T0_C": cold - KELVIN,
        "Lz": pulse["thickness"], "Nz": size["points"], "relTol": size["tolerance"],
        "absTol": size["tolerance"], "tau_FWHM": pulse["fwhm"], "f_rep": rate, "nPulses": 1,
        "simDuration": pulse["times"][-1], "absorbance": 1.0, "spotRadius": SPOT,
        "Pavg": 0.5 * rate * pulse["fluence"] * pi * SPOT**2,
        "snapshotDelays": [time - pulse["center"] for time in pulse["times"]],
        "storeHistory": False, "makePlots": False, "writeReport": False, "verbose": False,
        "showProgress": False, "Ndiff": 1, "dzTarget_diff": 1e-6,
    }  # fmt: skip


def grow_with_lattice(pulse, cold):
    """k of the program is k T_e/T_l; with k that grows as T_l it is that of the others, k T_e/T_0.

    Its settings offer no table of k; the run reads it by this function.
    """
    slope = pulse["conductivity"] / cold
    T = np.array([1.0, 1e5])
    profile.k_table = lambda _metal: (T, LEAST + slope * T)


def run(pulse, cold, size):
    """Points, times and temperatures of one run."""
    begin = perf_counter(), process_time()
    found = profile.depth_profile_solver(settings(pulse, cold, size))
    end = perf_counter(), process_time()
    depth, T = found["zGrid_m"], []
    for name in ("TeSnapshots_C", "TlSnapshots_C"):
        rows = KELVIN + np.array(found[name])
        T.append([[float(np.interp(z, depth, row)) for z in pulse["depths"]] for row in rows])
    return {
        "points": size["points"], "wall": end[0] - begin[0], "processor": end[1] - begin[1],
        "temperature": T,
    }  # fmt: skip


def main():
    """All sizes, the first of them once more before, while the program compiles."""
    given = json.loads(sys.argv[1])
    pulse, cold, sizes = given["pulse"], given["cold"], given["sizes"]
    grow_with_lattice(pulse, cold)
    run(pulse, cold, sizes[0])
    print("\n" + json.dumps({"runs": [run(pulse, cold, size) for size in sizes]}))


main()
