"""See a failure before it happens: an interactive page for any arm (needs ``holdfast[view]``).

:func:`serve` opens it on this machine; ``holdfast studio ARM`` does the same from the command line.
"""

from __future__ import annotations

from holdfast.studio.server import Studio, serve
from holdfast.studio.state import State

__all__ = ["State", "Studio", "serve"]
