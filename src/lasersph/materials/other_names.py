"""Other names of the shipped metals: chemical symbols, standards, trade names, both spellings."""

from __future__ import annotations

OTHER_NAMES = {
    "aluminium": ("Al", "aluminum"),
    "aluminium-aa6014": ("AA6014", "EN AW-6014"),
    "copper": ("Cu",),
    "gold": ("Au",),
    "inconel-718": ("IN718", "Inconel", "Alloy 718", "2.4668", "UNS N07718"),
    "iron": ("Fe",),
    "nickel": ("Ni",),
    "silver": ("Ag",),
    "steel-304": ("304", "AISI 304", "SS304", "stainless steel 304", "1.4301", "X5CrNi18-10"),
    "steel-316l": ("316L", "316", "AISI 316L", "SS316L", "stainless steel 316L", "1.4404"),
    "ti-6al-4v": ("Ti64", "TiAl6V4", "Ti6Al4V", "titanium grade 5", "TC4", "3.7165"),
    "titanium": ("Ti",),
    "tungsten": ("W", "wolfram"),
}
"""By shipped name what else the metal is called. Case, spaces and hyphens make no difference; 316
differs from 316L by its carbon only."""
FAMILIES = {
    "steel": ("steel-304", "steel-316l"),
    "stainless": ("steel-304", "steel-316l"),
    "stainless steel": ("steel-304", "steel-316l"),
    "titanium alloy": ("ti-6al-4v",),
    "aluminium alloy": ("aluminium-aa6014",),
}
"""Words that name no one metal, with those to choose from."""


def shipped_name(name: str, shipped: tuple[str, ...]) -> str:
    """The one of the shipped names that is meant; the name itself where none is."""
    plain = {_plain(one): one for one in shipped}
    plain |= {_plain(other): one for one, others in OTHER_NAMES.items() for other in others}
    found = plain.get(_plain(name))
    return found if found in shipped else name


def metals_of_family(word: str) -> tuple[str, ...]:
    """The shipped metals that a word such as "steel" may mean; none where it is no such word."""
    plain = {_plain(family): metals for family, metals in FAMILIES.items()}
    return plain.get(_plain(word), ())


def is_called(name: str, word: str) -> bool:
    """Whether a word is part of one of the other names of a shipped metal."""
    return any(_plain(word) in _plain(other) for other in OTHER_NAMES.get(name, ()))


def _plain(name: str) -> str:
    """Letters and digits alone, in small letters and one spelling of aluminum."""
    letters = "".join(letter for letter in name.lower() if letter.isalnum())
    return letters.replace("aluminum", "aluminium")
