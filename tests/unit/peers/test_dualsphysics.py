"""What DualSPHysics is given to read, and what is read from its output."""

import struct
from xml.etree import ElementTree

import numpy as np
import pytest
import same_particles as particles
from dualsphysics_files import write_particles
from dualsphysics_side import segment_times, steps_done, write_case
from workplace import PeerFailed

NUMBERS = {2: "<i", 8: "<I", 10: "<Q", 12: "<d", 23: "<3d"}
TYPES = {8: ("<u4", 1), 11: ("<f4", 1), 22: ("<f4", 3), 23: ("<f8", 3)}


class Reader:
    """Walks through a .bi4 file as its format says."""

    def __init__(self, data):
        self.data, self.at = data, 64

    def numbers(self, form):
        """The next numbers."""
        found = struct.unpack_from(form, self.data, self.at)
        self.at += struct.calcsize(form)
        return found

    def text(self):
        """The next text."""
        (length,) = self.numbers("<I")
        self.at += length
        return self.data[self.at - length : self.at].decode()

    def end(self):
        """Where the definition ends whose length is next."""
        (length,) = self.numbers("<I")
        return self.at + length

    def value(self):
        """Name and value."""
        name, (kind,) = self.text(), self.numbers("<i")
        found = self.text() if kind == 1 else self.numbers(NUMBERS[kind])
        return name, found if kind in (1, 23) else found[0]

    def array(self):
        """Name and array; its definition is as long as it says."""
        end = self.end()
        assert self.text() == "\nARRAY"
        name, (_, kind, count, size) = self.text(), self.numbers("<iiII")
        assert self.at == end
        type_, columns = TYPES[kind]
        found = np.frombuffer(self.data, type_, count * columns, self.at)
        assert found.nbytes == size
        self.at += size
        return name, found.reshape(-1, columns)

    def item(self):
        """Name, values, arrays, and items within."""
        end = self.end()
        assert self.text() == "\nITEM\n"
        name = self.text()
        assert self.numbers("<ii") == (0, 0)
        assert (self.text(), self.text()) == ("%.7E", "%.15E")
        arrays, items, size = self.numbers("<III")
        assert self.at == end
        end += size
        assert self.text() == "\nVALUES"
        values = dict(self.value() for _ in range(self.numbers("<I")[0]))
        assert self.at == end
        return (
            name, values, dict(self.array() for _ in range(arrays)),
            [self.item() for _ in range(items)],
        )  # fmt: skip


def test_file_of_particles(tmp_path):
    """The file can be walked through to its end, and has the particles."""
    position = particles.displaced_lattice(4, 3)
    velocity = particles.vortices(position, 4)
    path = tmp_path / "block.bi4"
    write_particles(path, position, velocity, (-2.0, 6.0))
    data = path.read_bytes()
    assert data[:60] == b"#FileJBD JPartDataBi4".ljust(58) + b"\n\0" and data[60:64] == bytes(4)
    reader = Reader(data)
    name, values, arrays, (part,) = reader.item()
    assert reader.at == len(data) and name == "JPartDataBi4" and not arrays
    assert values["CaseNp"] == values["CaseNfluid"] == 64 and values["CaseName"] == "block"
    assert values["MapPosMin"] == (-2.0, -2.0, -2.0) and values["MapPosMax"] == (6.0, 6.0, 6.0)
    assert part[0] == "PART_0000" and part[1]["Npok"] == 64
    np.testing.assert_array_equal(part[2]["Posd"].T, position)
    np.testing.assert_array_equal(part[2]["Vel"].T, velocity.astype("f4"))
    np.testing.assert_array_equal(part[2]["Idp"][:, 0], np.arange(64))
    np.testing.assert_array_equal(part[2]["Rhop"], 1.0)


def test_case(tmp_path):
    """The case has the same support and speed of sound as lasersph's."""
    case = write_case(tmp_path, 4, 3, 10)
    root = ElementTree.parse(case.with_suffix(".xml")).getroot()
    constants = {e.tag: e.get("value") for e in root.iterfind("execution/constants/*")}
    assert 2.0 * float(constants["h"]) == particles.SUPPORT
    speed = np.sqrt(float(constants["gamma"]) * float(constants["b"]) / float(constants["rhop0"]))
    assert speed == pytest.approx(particles.SOUND_SPEED)
    parameters = {e.get("key"): e.get("value") for e in root.iterfind("execution/parameters/*")}
    assert float(parameters["DtFixed"]) == particles.STEP
    assert float(parameters["TimeMax"]) == pytest.approx(31 * particles.STEP)
    assert float(parameters["TimeOut"]) == pytest.approx(10 * particles.STEP)
    assert root.find("execution/particles/fluid").get("count") == "64"
    assert case.with_suffix(".bi4").exists()


def test_times_of_segments():
    """Those of the first segment are left out, whatever number of steps the others took."""
    line = "00012   0.200000        1,010       10      195,112        9,261       9.81  21-11"
    assert steps_done(line) == 1010
    assert steps_done("Part_0000        195,112 particles successfully stored") is None
    segments = [(10, 50.0, 90.0), (20, 51.0, 92.0), (31, 53.2, 96.4), (41, 53.7, 97.4)]
    assert segment_times(segments) == pytest.approx((0.1, 0.2))
    with pytest.raises(PeerFailed, match="no times of segments"):
        segment_times(segments[:2])
