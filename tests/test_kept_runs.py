"""Made-up runs are written once, and nothing that a test does to its own reaches another's."""

from kept_runs import written_once


def test_written_once_and_copied(tmp_path):
    """The same arguments give copies, others and functions another run."""
    written = []

    @written_once
    def write(folder, number, *, look=None):
        written.append(number)
        folder.mkdir(parents=True)
        (folder / "number").write_text(str(number))
        return folder

    first = write(tmp_path / "a", 1)
    (first / "number").write_text("changed")
    assert write(tmp_path / "b", 1) == tmp_path / "b"
    assert (tmp_path / "b" / "number").read_text() == "1"
    write(tmp_path / "c", 2)
    for name in "de":
        write(tmp_path / name, 1, look=print)
    assert written == [1, 2, 1, 1]
