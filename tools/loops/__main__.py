"""``python -m tools.loops``: all loops; ``python -m tools.loops NAME ...``: some of them."""

from __future__ import annotations

import sys
from importlib import import_module

from tools.loops import LOOPS
from tools.loops.film import write

for name in sys.argv[1:] or LOOPS:
    file = write(name, import_module(f"tools.loops.{name.replace('-', '_')}").shots(), LOOPS[name])
    print(file, f"{file.stat().st_size / 1000:.0f} kB")
