"""Versions and kind of processor that produced a result."""

from __future__ import annotations

import platform
from functools import lru_cache
from pathlib import Path
from typing import Any

from holdfast.core.provenance import versions

_RECORDED_PACKAGES = ("holdfast", "numpy", "scipy", "casadi", "llvmlite", "zarr", "mujoco")


@lru_cache(maxsize=1)
def describe_machine() -> dict[str, Any]:
    """Return versions and processor of this process; equal ones give equal bits."""
    return {"processor": _processor_name(), "python": platform.python_version(), "versions": versions(*_RECORDED_PACKAGES)}


def _processor_name() -> str:
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("model name"):
                return " ".join(line.partition(":")[2].split())
    except OSError:
        pass
    return platform.processor() or platform.machine()
