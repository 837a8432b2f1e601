"""Limits for MJCF files: MuJoCo expands counts and opens the named files without looking at either."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

from holdfast.errors import ArmError
from holdfast.files import reading

_LARGEST = 64 << 20  # bytes of a model
_LARGEST_FILE = 256 << 20  # of a mesh or picture
_MOST_ELEMENTS = 20_000  # with replicas
_MOST_COPIES = 1000  # of one element; MuJoCo takes their square
# The product of the numbers in these attributes becomes memory.
_MOST = {
    "hfield": (("nrow", "ncol"), 1 << 22),
    "texture": (("width", "height"), 1 << 24),
    "composite": (("count",), 10_000),
    "flexcomp": (("count",), 10_000),
    "numeric": (("size",), 1_000_000),
    "user": (("dim",), 10_000),
    "general": (("actdim", "nsample"), 10_000),
}
_SIZES_OF_STACK = {"memory", "njmax", "nconmax", "nstack"}  # taken only when a model moves, and then as it is used
_MOST_SIZE = 10_000
_PNG = b"\x89PNG\r\n\x1a\n"


def check(path: Path) -> str:
    """The text of a model, if it is safe for MuJoCo.

    Raises:
        ArmError: It cannot be read, or it or a file that it names would make far more of itself than an arm needs.
    """
    text = _text(path)
    _check(text, path, path.parent, {path.resolve()})
    return text


def _text(path: Path) -> str:
    try:
        with reading.guarded(advice="give the path of an MJCF file", kind=ArmError):
            return reading.text(path, _LARGEST)
    except UnicodeDecodeError as error:
        raise ArmError(f"this is not valid XML ({error}); give an MJCF file") from error


def _check(text: str, path: Path, folder: Path, seen: set[Path]) -> None:
    try:
        root = ElementTree.fromstring(text)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise ArmError(f"this is not valid XML ({error}); give an MJCF file") from error
    elements = 0
    for element, copies in _copies(root, 1):
        elements += copies
        if elements > _MOST_ELEMENTS or copies > _MOST_COPIES:
            raise ArmError(
                f"with its <replicate> written out, the model has more than {_MOST_COPIES} copies of one element or more than "
                f"{_MOST_ELEMENTS} elements; leave out what is not the arm"
            )
        _check_sizes(element)
    dirs = {Path(c.get(k, "")) for c in root.iter("compiler") for k in ("meshdir", "texturedir", "assetdir")} | {Path()}
    for element in root.iter():
        for key, name in element.attrib.items():
            if not key.startswith("file"):
                continue
            for place in {folder / d / name for d in dirs} | {path.parent / d / name for d in dirs}:
                _check_file(place, element.tag, folder, seen)


def _copies(element: ElementTree.Element, copies: int) -> Iterator[tuple[ElementTree.Element, int]]:
    """Every element with how often it is there once replicas are made."""
    stack = [(element, copies)]
    while stack:
        e, count = stack.pop()
        yield e, count
        if e.tag == "replicate":
            count = min(count * max(_whole(e.get("count", "1")), 1), 1 << 60)
        stack.extend((inner, count) for inner in e)


def _check_sizes(element: ElementTree.Element) -> None:
    keys, most = _MOST.get(element.tag, ((), 0))
    total = 1
    for key in keys:
        for word in element.get(key, "1").split():
            total *= max(_whole(word), 1)
    if total > most and keys:
        raise ArmError(f"<{element.tag}> asks for {total} entries ({', '.join(keys)}); at most {most} are read")
    if element.tag == "size":
        for key, word in element.attrib.items():
            if key not in _SIZES_OF_STACK and _whole(word) > _MOST_SIZE:
                raise ArmError(f"<size> has {key} {word[:40]}; at most {_MOST_SIZE} is read")


def _whole(text: str) -> int:
    """The number that MuJoCo may read; MuJoCo refuses other text itself."""
    try:
        return int(min(max(float(text), -1.0), 1e18))
    except ValueError:
        return 0


def _check_file(place: Path, tag: str, folder: Path, seen: set[Path]) -> None:
    if not reading.exists(place) or place.is_dir():
        return  # for MuJoCo to refuse
    named = f"'{place.name}', which it names"
    if tag in ("include", "model"):
        where = place.resolve()
        if where not in seen:
            seen.add(where)
            try:
                _check(_text(place), place, folder, seen)
            except ArmError as error:
                raise ArmError(f"{named}: {error}") from error
        return
    with reading.guarded(f"{named},", kind=ArmError):
        head = reading.raw(place, _LARGEST_FILE)[:24]
    if head.startswith(_PNG):
        width, height = int.from_bytes(head[16:20]), int.from_bytes(head[20:24])
        if width * height > _MOST["texture"][1]:
            raise ArmError(f"{named}, has {width} x {height} pixels; at most {_MOST['texture'][1]} are read")
