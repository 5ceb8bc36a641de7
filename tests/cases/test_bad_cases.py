"""Every bad case file gives its message, exactly, with file, line and key."""

from pathlib import Path

import pytest
from bad_ablation_cases import BAD_ABLATION_CASES
from bad_cases import BAD_CASES
from bad_ejection_cases import BAD_EJECTION_CASES
from bad_electron_cases import BAD_ELECTRON_CASES
from bad_flow_cases import BAD_FLOW_CASES
from bad_geometry_cases import BAD_GEOMETRY_CASES

from lasersph.case import load_case
from lasersph.input import CaseError

FOLDER = Path(__file__).parent
GOOD = (FOLDER / "good.toml").read_text(encoding="utf-8")
GOOD_FLOW = (FOLDER / "good-flow.toml").read_text(encoding="utf-8")
GOOD_SPOT = (FOLDER / "good-spot.toml").read_text(encoding="utf-8")
GOOD_ABLATION = (FOLDER / "good-ablation.toml").read_text(encoding="utf-8")
MATTER = BAD_ABLATION_CASES | BAD_EJECTION_CASES
ALL = BAD_CASES | BAD_ELECTRON_CASES | BAD_FLOW_CASES | BAD_GEOMETRY_CASES | MATTER


def spoiled(name: str) -> bytes:
    """The bytes of a bad case file."""
    old, new, _ = ALL[name]
    good = GOOD_FLOW if name in BAD_FLOW_CASES else GOOD
    good = GOOD_ABLATION if name in MATTER else good
    good = GOOD_SPOT if name in BAD_GEOMETRY_CASES else good
    if isinstance(new, bytes):
        return new
    if not old:
        return (good + new).encode()
    assert good.count(old) >= 1, f"the good case no longer holds {old!r}"
    return good.replace(old, new, 1).encode()


def test_there_are_enough_and_the_good_one_is_good(tmp_path):
    """The table is as long as promised, and its starting point is accepted."""
    assert len(BAD_CASES) >= 40 and len(ALL) == sum(
        len(table)
        for table in (
            *(BAD_CASES, BAD_ELECTRON_CASES, BAD_FLOW_CASES, BAD_GEOMETRY_CASES),
            *(BAD_ABLATION_CASES, BAD_EJECTION_CASES),
        )
    )
    file = tmp_path / "case.toml"
    file.write_text(GOOD, encoding="utf-8")
    case = load_case(str(file))
    assert case.initial_temperature == 293.15
    assert case.name == "case"
    file.write_text(GOOD_FLOW, encoding="utf-8")
    flow = load_case(str(file))
    assert flow.flow is not None and flow.material.is_liquid
    file.write_text(GOOD_ABLATION, encoding="utf-8")
    assert load_case(str(file)).solver.kind == "ablation"


@pytest.mark.parametrize("name", ALL)
def test_message(name, tmp_path):
    """One line of the refusal is the one in the table."""
    file = tmp_path / "case.toml"
    file.write_bytes(spoiled(name))
    with pytest.raises(CaseError) as error:
        load_case(str(file))
    expected = ALL[name][2].replace("{folder}", str(tmp_path))
    expected = expected if expected.startswith("/") else f"{file}{expected}"
    assert expected in str(error.value).splitlines()


@pytest.mark.parametrize("newline", [b"\n", b"\r\n"], ids=["LF", "CRLF"])
@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"], ids=["plain", "BOM"])
def test_line_ends_and_byte_order_mark_are_no_errors(newline, mark, tmp_path):
    """Files as Windows editors write them are the same case."""
    file = tmp_path / "case.toml"
    file.write_bytes(GOOD.encode())
    usual = load_case(str(file)).hash()
    file.write_bytes(mark + GOOD.encode().replace(b"\n", newline))
    assert load_case(str(file)).hash() == usual
