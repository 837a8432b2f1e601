"""What made a result: versions and the kind of processor."""

from __future__ import annotations

import platform
from functools import lru_cache
from pathlib import Path
from typing import Any

from holdfast.provenance import versions

_PACKAGES = ("holdfast", "numpy", "scipy", "casadi", "llvmlite", "zarr", "mujoco")


@lru_cache(maxsize=1)
def machine() -> dict[str, Any]:
    """Versions and processor of this process; equal ones give equal bits."""
    return {"processor": _processor(), "python": platform.python_version(), "versions": versions(*_PACKAGES)}


def _processor() -> str:
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("model name"):
                return " ".join(line.partition(":")[2].split())
    except OSError:
        pass
    return platform.processor() or platform.machine()
