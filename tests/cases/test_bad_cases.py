"""Every bad case file gives its message, exactly, with file, line and key."""

from pathlib import Path

import pytest
from bad_cases import BAD_CASES

from lasersph.case import load_case
from lasersph.reading import CaseError

GOOD = (Path(__file__).parent / "good.toml").read_text(encoding="utf-8")


def spoiled(name: str) -> bytes:
    """The bytes of a bad case file."""
    old, new, _ = BAD_CASES[name]
    if isinstance(new, bytes):
        return new
    if not old:
        return (GOOD + new).encode()
    assert GOOD.count(old) >= 1, f"good.toml no longer holds {old!r}"
    return GOOD.replace(old, new, 1).encode()


def test_there_are_enough_and_the_good_one_is_good(tmp_path):
    """The table is as long as promised, and its starting point is accepted."""
    assert len(BAD_CASES) >= 40
    file = tmp_path / "case.toml"
    file.write_text(GOOD, encoding="utf-8")
    case = load_case(str(file))
    assert case.initial_temperature == 293.15
    assert case.name == "case"


@pytest.mark.parametrize("name", BAD_CASES)
def test_message(name, tmp_path):
    """One line of the refusal is the one in the table."""
    file = tmp_path / "case.toml"
    file.write_bytes(spoiled(name))
    with pytest.raises(CaseError) as error:
        load_case(str(file))
    expected = BAD_CASES[name][2].replace("{folder}", str(tmp_path))
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
