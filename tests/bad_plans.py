"""Plans with a mistake: one line says where it is and what, and nothing is written."""

import pytest

from lasersph.input import CaseError


def written(folder, text):
    """A plan file."""
    file = folder / "plan.toml"
    file.write_text(text)
    return file


def assert_mistake(read, folder, text, line, words):
    """Reading a plan of this text says these words of this line of the file."""
    file = written(folder, text)
    with pytest.raises(CaseError) as caught:
        read(file)
    lines = str(caught.value).splitlines()
    assert any(one.startswith(f"{file}:{line}: ") and words in one for one in lines), lines
    assert len(set(lines)) == len(lines) and list(folder.iterdir()) == [file]
