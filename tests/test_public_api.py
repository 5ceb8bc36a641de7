"""Names and signatures of the public API are those of tests/public_api.json.

Public is `lasersph.__all__` and what docs/api.md names. A change that is meant is written anew by
`python tests/test_public_api.py`.
"""

import importlib
import inspect
import json
import re
from dataclasses import fields, is_dataclass
from pathlib import Path

import lasersph

TESTS = Path(__file__).resolve().parent
STORED = TESTS / "public_api.json"
PAGE = TESTS.parent / "docs" / "api.md"
DIRECTIVE = re.compile(
    r"^\.\. auto(function|class|exception|module):: ([\w.]+)[^\n]*((?:\n {3}:[^\n]*)*)",
    re.MULTILINE,
)
WHAT_TO_DO = """
What scripts use has changed. Where that is not meant, take the change back. Where it is: let the
old name or argument go on working with a DeprecationWarning (docs/stability.md, How a change is
announced), write a line under Changed in CHANGELOG.md that says what to write instead, bring
docs/api.md up to date, and store the new list: python tests/test_public_api.py"""


def signature_of(value) -> str:
    """Names, kinds and defaults of arguments, without types: "(case, out, *, resume=False)"."""
    parameters = inspect.signature(value).parameters.values()
    return str(inspect.Signature([one.replace(annotation=one.empty) for one in parameters]))


def entries_of_class(name, kind, members) -> dict[str, str]:
    """Fields and documented members of a class."""
    found = {name: "class"}
    own = [one.name for one in fields(kind)] if is_dataclass(kind) else getattr(kind, "_fields", ())
    found |= {f"{name}.{one}": "field" for one in own if not one.startswith("_")}
    if members == "":  # all that are its own
        members = ",".join(one for one in vars(kind) if not one.startswith("_"))
    for member in filter(None, (one.strip() for one in (members or "").split(","))):
        value = inspect.getattr_static(kind, member, None)
        value = value.__func__ if isinstance(value, classmethod | staticmethod) else value
        is_method = inspect.isfunction(value)
        found[f"{name}.{member}"] = signature_of(value) if is_method else "field"
    return found


def resolved(name):
    """The object of a dotted name."""
    parts = name.split(".")
    for count in range(len(parts), 0, -1):
        try:
            value = importlib.import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for part in parts[count:]:
            value = getattr(value, part)
        return value
    raise AssertionError(f"docs/api.md names {name}, which is not there")


def public_api() -> dict[str, str]:
    """Every public name with its signature, or with what it is."""
    found = {f"lasersph.{one}": "name" for one in lasersph.__all__}
    wanted = [("any", name, None) for name in found]
    for kind, name, options in DIRECTIVE.findall(PAGE.read_text(encoding="utf-8")):
        members = re.search(r":members:(.*)", options)
        wanted.append((kind, name, members and members[1].strip()))
    for kind, name, members in wanted:
        value = resolved(name)
        if kind == "module":
            listed = members or ",".join(
                one
                for one, part in vars(value).items()
                if inspect.isfunction(part) and part.__module__ == name and one[0] != "_"
            )
            for member in filter(None, (one.strip() for one in listed.split(","))):
                part = getattr(value, member)
                dotted = f"{name}.{member}"
                is_class = inspect.isclass(part)
                found |= (
                    entries_of_class(dotted, part, None)
                    if is_class
                    else {dotted: signature_of(part)}
                )
        elif inspect.isclass(value):
            found |= entries_of_class(name, value, members)
        elif inspect.isfunction(value):
            found[name] = signature_of(value)
    plots = resolved("lasersph.plots")
    found |= {f"lasersph.plots.{one}": signature_of(getattr(plots, one)) for one in plots.__all__}
    return dict(sorted(found.items()))


def differences(stored, now) -> list[str]:
    """Lines of what is gone, changed or new."""
    lines = [f"- {name}{text} is gone" for name, text in stored.items() if name not in now]
    for name, text in now.items():
        if name not in stored:
            lines.append(f"+ {name}{text} is new")
        elif stored[name] != text:
            lines.append(f"! {name} was {stored[name]}, is {text}")
    return lines


def test_names_and_signatures():
    """The names, arguments, their order and their defaults have not changed unnoticed."""
    lines = differences(json.loads(STORED.read_text(encoding="utf-8")), public_api())
    assert not lines, "\n".join(["", *lines, WHAT_TO_DO])


def test_every_name_says_what_it_does():
    """`help` of a function of `lasersph` begins with a sentence and shows how it is called."""
    for name in lasersph.__all__:
        value = getattr(lasersph, name)
        if not inspect.isfunction(value):
            continue
        text = inspect.getdoc(value) or ""
        assert text.splitlines()[0].endswith((".", ":")), f"lasersph.{name}: {text[:80]}"
        assert f"lasersph.{name}(" in text, f"lasersph.{name} shows no call of it"


def test_no_signature_shows_a_place_in_memory():
    """`help` would print a default that is a function as <function name at 0x7f...>."""
    found = {name: text for name, text in public_api().items() if "<" in text}
    assert not found


def test_a_change_is_told():
    """An argument with another name, a name that is gone, and one that is new."""
    stored = {"lasersph.run": "(case, out)", "lasersph.gone": "()"}
    lines = differences(stored, {"lasersph.run": "(case, folder)", "lasersph.more": "()"})
    assert lines == [
        "- lasersph.gone() is gone",
        "! lasersph.run was (case, out), is (case, folder)",
        "+ lasersph.more() is new",
    ]


if __name__ == "__main__":
    STORED.write_text(json.dumps(public_api(), indent=1) + "\n", encoding="utf-8")
    print(f"wrote {STORED.name}")
