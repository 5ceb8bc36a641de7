"""X3P, the format of ISO 25178-72: a ZIP file with main.xml, heights in binary, and checksums.

Axes x and y are incremental (a step each), heights are absolute; all are double precision in
meters. A height that is missing is NaN.

Reference: [ISO25178] ISO 25178-72:2017, XML file format x3p.
"""

from __future__ import annotations

import hashlib
import io
import xml.etree.ElementTree as xml
import zipfile
from datetime import UTC, datetime

import numpy as np

from lasersph.output.errors import OutputError

MAIN = "main.xml"
DATA = "bindata/data.bin"
SUMS = "md5checksum.hex"
SPACE = "http://www.opengps.eu/2008/ISO5436_2"
NUMBERS = {"I": "<i2", "L": "<i4", "F": "<f4", "D": "<f8"}
"""Types of numbers by their letter: 16 and 32 bits, single and double precision."""


def x3p_bytes(z: np.ndarray, dx: float, dy: float, note: str = "") -> bytes:
    """The file of heights z (ny, nx) [m] at steps dx, dy [m]; NaN where one is missing."""
    ny, nx = z.shape
    data = np.ascontiguousarray(z, "<f8").tobytes()

    # Record 1: axes, of which x and y have equal steps and z is absolute.
    root = xml.Element(f"{{{SPACE}}}ISO5436_2")
    one = _table(root, "Record1", Revision="ISO5436 - 2000", FeatureType="SUR" if ny > 1 else "PRF")
    axes = xml.SubElement(one, "Axes")
    for name, kind, step in (("CX", "I", dx), ("CY", "I", dy), ("CZ", "A", 1.0)):
        _table(axes, name, AxisType=kind, DataType="D", Increment=repr(float(step)), Offset="0.0")

    # Record 2: who made the map, and the note.
    made = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    two = _table(root, "Record2", Date=made)
    who = {"Manufacturer": "lasersph", "Model": "lasersph", "Serial": "-", "Version": "1"}
    _table(two, "Instrument", **who)
    xml.SubElement(two, "CalibrationDate").text = made
    _table(two, "ProbingSystem", Type="Software", Identification="computed")
    xml.SubElement(two, "Comment").text = note

    # Record 3: size of the matrix, and the binary file with its checksum.
    three = xml.SubElement(root, "Record3")
    _table(three, "MatrixDimension", SizeX=str(nx), SizeY=str(ny), SizeZ="1")
    checksum = hashlib.md5(data, usedforsecurity=False).hexdigest().upper()
    _table(three, "DataLink", PointDataLink=DATA, MD5ChecksumPointData=checksum)

    # Record 4: the checksum of this XML stands in a file of its own.
    _table(root, "Record4", ChecksumFile=SUMS)
    xml.register_namespace("p", SPACE)
    text = xml.tostring(root, encoding="UTF-8", xml_declaration=True)

    # The three files of the archive.
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr(MAIN, text)
        file.writestr(DATA, data)
        sums = hashlib.md5(text, usedforsecurity=False).hexdigest()
        file.writestr(SUMS, f"{sums} *{MAIN}\n")
    return target.getvalue()


def _table(parent: xml.Element, name: str, **entries: str) -> xml.Element:
    """An element with one child an entry."""
    element = xml.SubElement(parent, name)
    for key, value in entries.items():
        xml.SubElement(element, key).text = value
    return element


def read_x3p(content: bytes) -> tuple[np.ndarray, float, float]:
    """Heights (ny, nx) [m], NaN where missing, and both steps [m].

    Raises:
        OutputError: no file of this format, axes that are not incremental, heights in the XML, or
            a checksum that is not that of the data.
    """
    # Size, axes and type of the numbers from the XML, heights from the binary file that it names.
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as file:
            root = xml.fromstring(file.read(MAIN))
            link = _text(root, "Record3/DataLink/PointDataLink")
            data = file.read(link)
        nx, ny = (int(_text(root, f"Record3/MatrixDimension/Size{axis}")) for axis in "XY")
        kinds = {axis: _text(root, f"Record1/Axes/{axis}/AxisType") for axis in ("CX", "CY")}
        steps = [float(_text(root, f"Record1/Axes/C{axis}/Increment", "1")) for axis in "XYZ"]
        dtype = np.dtype(NUMBERS[_text(root, "Record1/Axes/CZ/DataType")])
    except (zipfile.BadZipFile, KeyError, ValueError, xml.ParseError) as error:
        raise OutputError(f"it is no X3P file: {error}") from None
    # Axes with listed places, sums that differ and torn data are refused.
    if any(kind != "I" for kind in kinds.values()):
        raise OutputError("its x and y are no steps of equal length; only such maps are read")
    wanted = _text(root, "Record3/DataLink/MD5ChecksumPointData", "").lower()
    if wanted and wanted != hashlib.md5(data, usedforsecurity=False).hexdigest():
        raise OutputError("its heights are damaged: the checksum is another")
    if len(data) != nx * ny * dtype.itemsize:
        raise OutputError(f"it holds {len(data)} bytes of heights, not {nx} times {ny} numbers")
    z = np.frombuffer(data, dtype).reshape(ny, nx).astype(float)
    # The increment of z scales stored numbers to meters.
    return steps[2] * z, steps[0], steps[1]


def _text(root: xml.Element, path: str, default: str | None = None) -> str:
    """Text of an element. Raises KeyError where there is none and no default."""
    found = root.findtext(path)
    if found is None:
        if default is None:
            raise KeyError(path)
        return default
    return found.strip()
