"""Comparing two records of ``tools/record.py``."""

from __future__ import annotations

import base64
import difflib
import hashlib
import html
import io
import json
import re
import sys
from collections.abc import Iterator
from itertools import islice, zip_longest
from pathlib import Path

NUMBER = r"\d+(?:\.\d+)?(?:e-?\d+)?"
LASTS = rf"{NUMBER} (?:ms|s|min|h)\b *"
# What may differ between two runs of the same code, and what counts in its place.
VARIES = tuple(
    (re.compile(pattern, re.MULTILINE), constant)
    for pattern, constant in (
        (r"\b\d{4}-\d\d-\d\d([T ]\d\d:\d\d(:\d\d(\.\d+)?)?(Z|\+\d\d:?\d\d| UTC)?)?\b", "<time>"),
        (rf"(seconds\"?)(=|: ){NUMBER}", r"\g<1>\g<2>0"),
        (rf"(completed runs took |chunks in |>Time</th><td class=\"\">){LASTS}", r"\1<time>"),
        (rf"{LASTS}(of one thread|with the \d+ threads of this machine)", r"<time> \1"),
        (r"(of one thread  a chunk) +", r"\1  "),  # as wide as the times below
        (rf"(  \d+|\d+ of \d+)  +{LASTS}(?:{LASTS})?($|\d)", r"\1 <time> \2"),  # tables of studies
        (rf"(Size on disk</th><td class=\"\">){NUMBER}", r"\1<size>"),  # times are in it
        (
            r"\b(holdfast|[Pp]ython|numpy|scipy|casadi|llvmlite|xarray|zarr|mujoco)( |\": \"|: )\d+(\.\d+)+[\w.]*",
            r"\1\2<version>",
        ),
        (r'"(processor|machine)": "[^"]*"', r'"\1": "<machine>"'),
        (r"(>Computed on</th><td class=\"\">)[^;<]*", r"\1<machine>"),
        (r"(127\.0\.0\.1|localhost):\d+", r"\1:<port>"),
        (r"\bkey=[\w-]+", "key=<key>"),
        # What holdfast.core.progress says, of a record that was made with it.
        (r"^holdfast: (?!nothing|missing)[a-z]+ing\b(.*, (about \d+ (s|min)|so far \d).*|[^,;:]*)\n", ""),
        (r"^\d+ of \d+ chunks, about .*\n", ""),  # only of what takes half a minute
        (r" at 0x[0-9a-f]+", ""),
        (r"(\"|#)([pmh])[0-9a-f]{10}\b", r"\1\2<digest>"),  # names in a drawing, of all digits of its places
        (r"^exit code 0\n", ""),
        (r"^(\d+ [0-9a-f]{32} \d+) [\d.e-]+ (\d+) [0-9a-f]{8}$", r"\1 <seconds> \2 <digest>"),  # chunks of studies
        (r"(digests; all together) [0-9a-f]{64}", r"\1 <digest>"),
        (r"X'[0-9A-F]{64}',X'[0-9A-F]{64}'\);$", "<digests>);"),  # of records with their times
    )
)


def compare(old: Path, new: Path, keys: list[str], page: Path | None) -> int:
    """Print what differs, file by file, in all cases or those with the keys given; exit code 1 if anything does."""
    a, b = (read(folder, keys) for folder in (old, new))
    if not a or not b:
        sys.exit(f"there is no record in '{new if a else old}'" + (f" of {', '.join(keys)}" if keys else ""))
    different = [
        name for name in sorted(a.keys() | b.keys()) if name not in a or name not in b or not same(name, a[name], b[name])
    ]
    for name in different:
        if name in a and name in b:
            print(name, *list(differences(name, a[name], b[name])), sep="\n    ")
        else:
            print(f"{name}: only in {old if name in a else new}")
    print(f"{len(different)} of {len(a.keys() | b.keys())} files differ")
    if page is not None:
        shown = [n for n in different if n.endswith((".png", ".svg"))]
        rows = [f"<h2>{html.escape(n)}</h2>{image(n, a.get(n))}{image(n, b.get(n))}\n" for n in shown]
        page.write_text(
            f"<!doctype html><meta charset=utf-8><style>img {{width: 48%}}</style>{''.join(rows)}", encoding="utf-8"
        )
        print(f"{len(shown)} pictures side by side: {page}")
    return int(bool(different))


def read(folder: Path, keys: list[str]) -> dict[str, bytes]:
    """The files of a record by name."""
    files = {file.relative_to(folder): file for file in sorted(folder.rglob("*")) if file.is_file()}
    found = {
        str(name): settled(str(name), file.read_bytes()) for name, file in files.items() if not keys or name.parts[0] in keys
    }
    return {name: data for name, data in found.items() if data}


def settled(name: str, data: bytes) -> bytes:
    """A text without what varies; anything else as it is."""
    try:
        text = data.decode()
    except UnicodeDecodeError:
        return data
    for pattern, constant in VARIES:
        text = pattern.sub(constant, text)
    return ("".join(sorted(text.splitlines(True))) if name.endswith(".journal") else text).encode()  # as chunks are done


def same(name: str, a: bytes, b: bytes) -> bool:
    """Whether two files say the same."""
    return a == b or (name.endswith(".png") and pixels(a) == pixels(b))


def differences(name: str, a: bytes, b: bytes, most: int = 4) -> Iterator[str]:
    """The first differences of two files, a line each."""
    try:
        lines, others = ([line.decode() for line in x.splitlines()] for x in (a, b))
        if name.endswith(".json"):
            lines, others = (list(entries(json.loads(x))) for x in (a, b))
    except (UnicodeDecodeError, json.JSONDecodeError):
        yield f"{hashlib.sha256(a).hexdigest()[:16]}, {len(a)} bytes; {hashlib.sha256(b).hexdigest()[:16]}, {len(b)} bytes"
        return
    found = [line for line in difflib.unified_diff(lines, others, n=0, lineterm="") if line[:3] not in ("---", "+++", "@@ ")]
    gone, come = ([line[1:] for line in found if line[0] == sign] for sign in "-+")
    for x, y in islice(zip_longest(gone, come), most):
        at = max(
            0, next((k for k, (c, d) in enumerate(zip(x or "", y or "", strict=False)) if c != d), 0) - 40
        )  # of a long line, where it differs
        yield from (
            f"{sign}{'…' if at else ''}{text[at : at + 150]}" for sign, text in (("-", x), ("+", y)) if text is not None
        )
    if not found:
        yield "the same, written otherwise"
    elif max(len(gone), len(come)) > most:
        yield f"… {len(gone)} lines gone, {len(come)} come"


def entries(value: object, path: str = "") -> Iterator[str]:
    """The leaves of a JSON document, each with its keys."""
    if isinstance(value, dict | list) and value:
        for key, item in value.items() if isinstance(value, dict) else enumerate(value):
            yield from entries(item, f"{path}.{key}" if path else str(key))
    else:
        yield f"{path}: {json.dumps(value)}"


def image(name: str, data: bytes | None) -> str:
    """A picture for a page."""
    if data is None:
        return "<i>none</i>"
    if name.endswith(".svg") and b"xmlns=" not in data[:500]:
        data = data.replace(b"<svg ", b'<svg xmlns="http://www.w3.org/2000/svg" ', 1)
    kind = "svg+xml" if name.endswith(".svg") else "png"
    return f"<img src='data:image/{kind};base64,{base64.b64encode(data).decode()}'>"


def pixels(data: bytes) -> str:
    """Digest of the size and the pixels of a picture."""
    from PIL import Image

    picture = Image.open(io.BytesIO(data)).convert("RGBA")
    return hashlib.sha256(f"{picture.size}".encode() + picture.tobytes()).hexdigest()
