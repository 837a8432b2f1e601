"""Stored JSON files without their digest, so that a test can change an entry and seal the file again."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any


def read_unsealed(file: Path) -> dict[str, Any]:
    """Return the content of a file without its digest."""
    return {key: value for key, value in json.loads(file.read_text()).items() if key != "digest"}


def seal(data: dict[str, Any]) -> str:
    """Return the text of a file with the digest that fits it; unlike holdfast, with NaN where the data contain it."""
    body = json.dumps(data, indent=2).removesuffix("\n}")
    return f'{body},\n  "digest": "{hashlib.sha256(body.encode()).hexdigest()}"\n}}\n'


def write_sealed(file: Path, data: dict[str, Any]) -> None:
    """Write content with the digest that fits it."""
    file.write_text(seal(data))
