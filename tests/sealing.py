"""Stored JSON files as earlier versions wrote them, without a digest, so that a test can change an entry."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from holdfast.core.sweeps import Study


def read_unsealed(file: Path) -> dict[str, Any]:
    """Return the content of a file without its digest and the statement that it has one."""
    return {key: value for key, value in json.loads(file.read_text()).items() if key not in ("digest", "sealed")}


def read_unsealed_study(file: Path) -> dict[str, Any]:
    """Return the content of a study's file as earlier versions wrote it: without a seal, with the digest of its cells."""
    return {**read_unsealed(file), "digest": Study.open(file.parent).digest}
