"""Strict TOML: lines of keys, encodings, syntax errors in our words."""

import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lasersph.input import CaseError, parse_toml, read_toml
from lasersph.input.key_lines import key_lines

TEXT = (
    r'''# comment
title = "a # b"
"qu\"o.ted".x = 1
[laser]
beam = { kind = 'g', r.s = "5 um" }
long = """
a = 3
[x]
\""" " """
raw = '''.lstrip()
    + "'''\n[y]\n'''\n"
    + """arr = [ # comment ]
  "a", { z = [1,
  2] },
]
[[probes]]
name = "a"
[[probes]]
name = 1979-05-27 07:32:00
[probes.sub]
k = 1
[a.b.c]
d.e = 3
"""
)

EXPECTED = {
    ("title",): 2,
    ('qu"o.ted', "x"): 3,
    ("laser",): 4,
    ("laser", "beam", "kind"): 5,
    ("laser", "beam", "r", "s"): 5,
    ("laser", "long"): 6,
    ("laser", "raw"): 10,
    ("laser", "arr"): 13,
    ("laser", "arr", 0): 14,
    ("laser", "arr", 1, "z"): 14,
    ("laser", "arr", 1, "z", 1): 15,
    ("probes", 0): 17,
    ("probes", 0, "name"): 18,
    ("probes", 1, "name"): 20,
    ("probes", 1, "sub", "k"): 22,
    ("a", "b"): 23,
    ("a", "b", "c", "d", "e"): 24,
}


@pytest.mark.parametrize("newline", ["\n", "\r\n"], ids=["LF", "CRLF"])
def test_keys_map_to_their_lines(newline):
    """Dotted keys, inline tables, arrays of tables, long strings: every key has its line."""
    document = parse_toml(TEXT.replace("\n", newline), "a.toml")
    for path, line in EXPECTED.items():
        assert document.lines[path] == line, path
    assert ("x",) not in document.lines


def _paths(value, path=()):
    items = value.items() if isinstance(value, dict) else enumerate(value)
    for key, inner in items:
        yield (*path, key)
        if isinstance(inner, dict | list):
            yield from _paths(inner, (*path, key))


def test_every_key_of_the_data_has_a_line():
    """The scanner and tomllib agree on the set of paths."""
    document = parse_toml(TEXT)
    assert set(_paths(document.data)) <= set(document.lines)


KEYS = st.text(alphabet="ab-_1", min_size=1, max_size=3)
VALUES = st.recursive(
    st.sampled_from(["1", "'x = ['", '"a\\"]"', "true", "-1.5e3", "'''\n[t]\n'''"]),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3).map(lambda items: "[" + ",\n ".join(items) + "]"),
        st.dictionaries(KEYS, inner, max_size=2).map(
            lambda table: "{" + ", ".join(f"{k} = {v}" for k, v in table.items()) + "}"
        ),
    ),
    max_leaves=5,
)


@given(st.dictionaries(KEYS, VALUES, max_size=5))
def test_generated_documents_have_a_line_for_every_key(table):
    """Nested values of any shape: each path of the data is found, in its own or an earlier line."""
    text = "\n".join(f"{key} = {value} # [c]" for key, value in table.items())
    document = parse_toml(text)
    assert set(_paths(document.data)) <= set(document.lines)


@given(st.binary(max_size=60))
def test_any_bytes_are_read_or_refused(raw):
    """No bytes raise anything but CaseError."""
    try:
        parse_toml(raw, "x.toml")
    except CaseError as error:
        assert str(error).startswith("x.toml")


@given(st.text(max_size=60))
def test_scanner_ends_on_any_text(text):
    """The scanner terminates on text that is no TOML at all."""
    key_lines(text)


BAD = [
    (b"a = 1\n\xff\xfe", "x.toml:2: byte 0xff is not UTF-8 text; save the file as UTF-8"),
    (b"a = 1\na = 2", "x.toml:2: a: given twice; remove one"),
    (b"[a]\nb=1\n[a]\n", "x.toml:3: [a]: given twice; remove one"),
    (b"s = 8 nm", 'x.toml:1: s: a number with a unit is text in TOML; write s = "8 nm"'),
    (b"s = 5%", 'x.toml:1: s: a number with a unit is text in TOML; write s = "5%"'),
    (b'a = "b', 'x.toml:1: a: text without its closing quotation mark; write a = "b"'),
    (b"a = ", "x.toml:1: not valid TOML: invalid value"),
    (b"a = " + b"[" * 5000, "x.toml: brackets nested too deeply"),
    (b"a = " + b"9" * 5000, "x.toml: not valid TOML: an integer of thousands of digits"),
]


@pytest.mark.parametrize(("raw", "message"), BAD, ids=[message[:30] for _, message in BAD])
def test_syntax_errors_in_one_line(raw, message):
    """Text that is not TOML is refused with its line."""
    with pytest.raises(CaseError) as error:
        parse_toml(raw, "x.toml")
    assert str(error.value) == message


def test_byte_order_mark_is_dropped():
    """A UTF-8 mark at the start, as Windows editors write it, is no error."""
    assert parse_toml(b"\xef\xbb\xbfa = 1").data == {"a": 1}


def test_files_that_cannot_be_read(tmp_path):
    """Missing file, folder and oversized file are refused before they are read."""
    with pytest.raises(CaseError, match="no such file"):
        read_toml(tmp_path / "none.toml")
    (tmp_path / "brass.toml").write_text("")
    with pytest.raises(
        CaseError, match=r'bras\.toml: no such file \(do you mean "brass.toml"\?\)$'
    ):
        read_toml(tmp_path / "bras.toml")
    with pytest.raises(CaseError, match="is a folder"):
        read_toml(tmp_path)
    big = tmp_path / "big.toml"
    with big.open("wb") as stream:
        stream.truncate(17 * 2**20)
    with pytest.raises(CaseError, match="larger than 16 MiB"):
        read_toml(big)
    with pytest.raises(CaseError):
        read_toml("a\0b")
    with pytest.raises(CaseError, match="no such file"):
        read_toml(os.devnull)


def test_mistakes_of_syntax_are_said_together():
    """Quantities and words without quotes, a key twice: the text is read on past them."""
    text = "a = 3 nm\nb = { kind = flat, size = 4 um } # c\na = 2\nc = true\nd = 1e-3"
    with pytest.raises(CaseError) as error:
        parse_toml(text, "x.toml")
    said = str(error.value).splitlines()
    assert said[0] == 'x.toml:1: a: a number with a unit is text in TOML; write a = "3 nm"'
    assert said[1].endswith('write b = { kind = "flat", size = "4 um" }')
    assert said[2] == "x.toml:3: a: given twice; remove one"
    document = parse_toml(text, "x.toml", tolerant=True)
    assert document.data["b"] == {"kind": "flat", "size": "4 um"}
    assert [problem.line for problem in document.problems] == [1, 2, 3]
    assert (document.data["c"], document.data["d"]) == (True, 1e-3)
