"""Arguments and results of functions of native code: their types, and how LLVM takes them."""

from __future__ import annotations

from typing import Any

from lasersph.compute.native_values import INT64, LLVM, Item, Number, Pointer, View


def result_text(result: Any) -> str:
    """LLVM's type of a result of no, one or several types."""
    if result is None:
        return "void"
    if isinstance(result, list):
        return "{ " + ", ".join(LLVM[one.name] for one in result) + " }"
    return LLVM[result.name]


def kinds_of(item: Item) -> Any:
    """Types of an argument, by which functions of other arguments are told apart."""
    if isinstance(item, Number):
        return item.dtype
    if isinstance(item, Pointer):
        return ("address", item.dtype)
    if isinstance(item, View):
        return ("array", item.dtype, len(item.shape))
    return tuple(map(kinds_of, item))


def flat_texts(item: Item) -> list[str]:
    """Numbers and addresses of an argument, with their types."""
    if isinstance(item, Number):
        return [item.typed]
    if isinstance(item, Pointer):
        return [f"ptr {item.text}"]
    if isinstance(item, View):
        return [f"ptr {item.text}", *(length.typed for length in item.shape)]
    return [text for one in item for text in flat_texts(one)]


def parameters(given: list[Item]) -> tuple[list[Item], list[str]]:
    """Parameters for arguments of some types, and the text of each of their parts."""
    texts: list[str] = []

    def part(kind: str) -> str:
        register = f"%a{len(texts)}"
        texts.append(f"{kind} {register}")
        return register

    def renamed(item: Item) -> Item:
        if isinstance(item, Number):
            return Number(item.dtype, part(LLVM[item.dtype.name]))
        if isinstance(item, Pointer):
            return Pointer(item.dtype, part("ptr"))
        if isinstance(item, View):
            return View(
                item.dtype, part("ptr"), tuple(Number(INT64, part("i64")) for _ in item.shape)
            )
        return list(map(renamed, item))

    return [renamed(item) for item in given], texts
