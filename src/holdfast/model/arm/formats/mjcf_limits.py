"""Size limits for MJCF files, because MuJoCo expands counts and opens the named files without a check."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

from holdfast.core.errors import ArmError
from holdfast.core.files import reading

_MAX_MODEL_BYTES = 64 << 20  # bytes of a model
_MAX_FILE_BYTES = 256 << 20  # of a mesh or image
_MAX_ELEMENTS = 20_000  # including replicas
_MAX_COPIES = 1000  # of one element; MuJoCo uses their square
# The product of the numbers in these attributes determines the memory.
_MAX_ENTRIES_BY_TAG = {
    "hfield": (("nrow", "ncol"), 1 << 22),
    "texture": (("width", "height"), 1 << 24),
    "composite": (("count",), 10_000),
    "flexcomp": (("count",), 10_000),
    "numeric": (("size",), 1_000_000),
    "user": (("dim",), 10_000),
    "general": (("actdim", "nsample"), 10_000),
}
_STACK_SIZE_KEYS = {"memory", "njmax", "nconmax", "nstack"}  # allocated only when a model moves, and as needed
_MAX_SIZE_VALUE = 10_000
_PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def read_checked_model(path: Path) -> str:
    """Return the text of a model if it is safe for MuJoCo.

    Raises:
        ArmError: The model cannot be read, or it or a file that it names is far larger than an arm needs.
    """
    text = _read_text(path)
    _check_model(text, path, path.parent, {path.resolve()})
    return text


def _read_text(path: Path) -> str:
    try:
        with reading.guard_reading(advice="give the path of an MJCF file", error_type=ArmError):
            return reading.read_text(path, _MAX_MODEL_BYTES)
    except UnicodeDecodeError as error:
        raise ArmError(f"this is not valid XML ({error}); correct it there, or give another MJCF file") from error


def _check_model(text: str, path: Path, folder: Path, seen: set[Path]) -> None:
    try:
        root = ElementTree.fromstring(text)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise ArmError(f"this is not valid XML ({error}); correct it there, or give another MJCF file") from error
    elements = 0
    for element, copies in _elements_with_copies(root, 1):
        elements += copies
        if elements > _MAX_ELEMENTS or copies > _MAX_COPIES:
            raise ArmError(
                f"with its <replicate> written out, the model has more than {_MAX_COPIES} copies of one element or more than "
                f"{_MAX_ELEMENTS} elements; leave out what is not the arm"
            )
        _reject_huge_sizes(element)
    asset_folders = {
        Path(compiler.get(key, "")) for compiler in root.iter("compiler") for key in ("meshdir", "texturedir", "assetdir")
    } | {Path()}
    for element in root.iter():
        for key, name in element.attrib.items():
            if not key.startswith("file"):
                continue
            for asset_path in {folder / asset_folder / name for asset_folder in asset_folders} | {
                path.parent / asset_folder / name for asset_folder in asset_folders
            }:
                _check_asset_file(asset_path, element.tag, folder, seen)


def _elements_with_copies(element: ElementTree.Element, copies: int) -> Iterator[tuple[ElementTree.Element, int]]:
    """Yield every element with its number of copies once replicas are expanded."""
    stack = [(element, copies)]
    while stack:
        current, count = stack.pop()
        yield current, count
        if current.tag == "replicate":
            count = min(count * max(_parse_integer(current.get("count", "1")), 1), 1 << 60)
        stack.extend((child, count) for child in current)


def _reject_huge_sizes(element: ElementTree.Element) -> None:
    keys, max_entries = _MAX_ENTRIES_BY_TAG.get(element.tag, ((), 0))
    total = 1
    for key in keys:
        for word in element.get(key, "1").split():
            total *= max(_parse_integer(word), 1)
    if total > max_entries and keys:
        raise ArmError(f"<{element.tag}> asks for {total} entries ({', '.join(keys)}); at most {max_entries} are read")
    if element.tag == "size":
        for key, word in element.attrib.items():
            if key not in _STACK_SIZE_KEYS and _parse_integer(word) > _MAX_SIZE_VALUE:
                raise ArmError(f"<size> has {key} {word[:40]}; at most {_MAX_SIZE_VALUE} is read")


def _parse_integer(text: str) -> int:
    """Return the number that MuJoCo may read, or 0 for text that MuJoCo rejects itself."""
    try:
        return int(min(max(float(text), -1.0), 1e18))
    except ValueError:
        return 0


def _check_asset_file(asset_path: Path, tag: str, folder: Path, seen: set[Path]) -> None:
    if not reading.path_exists(asset_path) or asset_path.is_dir():
        return  # MuJoCo itself rejects it
    description = f"'{asset_path.name}', which it names"
    if tag in ("include", "model"):
        resolved = asset_path.resolve()
        if resolved not in seen:
            seen.add(resolved)
            try:
                _check_model(_read_text(asset_path), asset_path, folder, seen)
            except ArmError as error:
                raise ArmError(f"{description}: {error}") from error
        return
    with reading.guard_reading(f"{description},", error_type=ArmError):
        header = reading.read_bytes(asset_path, _MAX_FILE_BYTES)[:24]
    if header.startswith(_PNG_SIGNATURE):
        width, height = int.from_bytes(header[16:20]), int.from_bytes(header[20:24])
        if width * height > _MAX_ENTRIES_BY_TAG["texture"][1]:
            raise ArmError(
                f"{description}, has {width} x {height} pixels; at most {_MAX_ENTRIES_BY_TAG['texture'][1]} are read"
            )
