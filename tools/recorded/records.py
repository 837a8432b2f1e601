"""Comparing two records of ``tools/record.py``."""

from __future__ import annotations

import base64
import difflib
import hashlib
import html
import io
import json
import sys
from collections.abc import Iterator
from pathlib import Path


def compare(old: Path, new: Path, page: Path | None) -> int:
    """Print what differs, file by file; exit code 1 if anything does."""
    a, b = ({str(f.relative_to(x)): f.read_bytes() for f in sorted(x.rglob("*")) if f.is_file()} for x in (old, new))
    if not a or not b:
        sys.exit(f"there is no record in '{new if a else old}'")
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


def same(name: str, a: bytes, b: bytes) -> bool:
    """Whether two files say the same."""
    return a == b or (name.endswith(".png") and pixels(a) == pixels(b))


def differences(name: str, a: bytes, b: bytes, most: int = 6) -> Iterator[str]:
    """The first differences of two files, a line each."""
    try:
        lines, others = ([line.decode() for line in x.splitlines()] for x in (a, b))
        if name.endswith(".json"):
            lines, others = (list(entries(json.loads(x))) for x in (a, b))
    except (UnicodeDecodeError, json.JSONDecodeError):
        yield f"{hashlib.sha256(a).hexdigest()[:16]}, {len(a)} bytes; {hashlib.sha256(b).hexdigest()[:16]}, {len(b)} bytes"
        return
    found = [
        line for line in difflib.unified_diff(lines, others, n=0, lineterm="") if not line.startswith(("---", "+++", "@@"))
    ]
    at = 0
    if len(found) == 2:  # a long line: where it differs
        at = max(0, next((k for k, (x, y) in enumerate(zip(found[0][1:], found[1][1:], strict=False)) if x != y), 0) - 40)
    yield from (line[0] + ("…" if at else "") + line[1 + at :][:150] for line in found[:most])
    if len(found) > most:
        yield f"… {len(found)} lines"


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
