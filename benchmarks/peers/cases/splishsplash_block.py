"""SPlisHSPlasH: a block of fluid that falls in a closed box, weakly compressible SPH.

In the interpreter that it is installed for; prints one line of JSON. Arguments: folder to write
to, particles along an edge, steps; threads by OMP_NUM_THREADS.
"""

import json
import os
import sys
from itertools import pairwise, product
from statistics import median
from time import perf_counter, process_time

import pysplishsplash as sph

RADIUS = 0.005
"""Of a particle [m]; the support is four of it."""
WCSPH, ACROSS = 0, 97
"""Number of the method; every which particle's neighbors are counted."""
FACES = "1 2 4,1 4 3,5 7 8,5 8 6,1 5 6,1 6 2,3 4 8,3 8 7,1 3 7,1 7 5,2 6 8,2 8 4"


def write_scene(folder, edge):
    """Box and block; returns the path of the scene."""
    corners = "".join(f"v {x} {y} {z}\n" for x, y, z in product((-0.5, 0.5), repeat=3))
    with open(f"{folder}/box.obj", "w", encoding="utf-8") as file:
        file.write(corners + "".join(f"f {face}\n" for face in FACES.split(",")))
    length = 2.0 * RADIUS * edge
    box = 1.25 * length
    scene = {
        "Configuration": {
            "particleRadius": RADIUS, "simulationMethod": WCSPH, "boundaryHandlingMethod": 0,
            "density0": 1000, "timeStepSize": 1e-4, "numberOfStepsPerRenderUpdate": 1,
            "gravitation": [0, -9.81, 0], "cflMethod": 0, "stiffness": 50000, "exponent": 7,
            "enableZSort": True, "pause": False, "stopAt": 1000.0, "sim2D": False,
        },
        "Materials": [
            {"id": "Fluid", "viscosityMethod": 1, "viscosity": 0.01, "surfaceTensionMethod": 0}
        ],
        "RigidBodies": [
            {
                "geometryFile": "box.obj", "translation": [0, 0.5 * box, 0],
                "rotationAxis": [1, 0, 0], "rotationAngle": 0, "scale": [2 * box, box, box],
                "isDynamic": False, "isWall": True, "mapInvert": True, "mapThickness": 0.0,
                "mapResolution": [20, 20, 20],
            }
        ],
        "FluidBlocks": [
            {
                "denseMode": 0, "start": [-0.5 * length, 2 * RADIUS, -0.5 * length],
                "end": [0.5 * length, length + 2 * RADIUS, 0.5 * length],
                "translation": [0, 0, 0], "scale": [1, 1, 1], "id": "Fluid",
            }
        ],
    }  # fmt: skip
    path = f"{folder}/scene.json"
    with open(path, "w", encoding="utf-8") as file:
        json.dump(scene, file)
    return path


def neighbors(simulation, count):
    """Mean number of fluid and wall particles near a fluid particle."""
    some = range(0, count, ACROSS)
    found = sum(simulation.numberOfNeighbors(0, other, i) for i in some for other in (0, 1))
    return found / len(some)


def main():
    """Time steps, leave out the first three, and stop from within the last."""
    folder, edge, steps = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    simulator = sph.Exec.SimulatorBase()
    simulator.init(
        sceneFile=write_scene(folder, edge), useGui=False, initialPause=False,
        outputDir=f"{folder}/out",
    )  # fmt: skip
    simulator.initSimulation()
    stamps = []

    def after_step():
        stamps.append((perf_counter(), process_time()))
        if len(stamps) < steps + 3:
            return
        simulation = sph.Simulation.getCurrent()
        count = simulation.getFluidModel(0).numActiveParticles()
        times = [(after[0] - before[0], after[1] - before[1]) for before, after in pairwise(stamps)]
        wall, processor = (median(column) for column in zip(*times, strict=True))
        pairs = count * neighbors(simulation, count)
        print(json.dumps({"wall": wall, "processor": processor, "count": count, "pairs": pairs}))
        sys.stdout.flush()
        os._exit(0)

    simulator.setTimeStepCB(after_step)
    simulator.setValueFloat(simulator.STOP_AT, 1000.0)
    simulator.runSimulation()


main()
