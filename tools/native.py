"""Compile ``route_search.cpp`` to the language of LLVM: ``python -m tools.native``, with clang 19.

The result is for no processor in particular. It is part of the package, so that users and the tests need no compiler.
"""

from __future__ import annotations

import hashlib
import re
import subprocess
from pathlib import Path

SOURCE = Path(__file__).parents[1] / "src/holdfast/model/collision/compiled/route_search.cpp"
COMMAND = (
    "clang++-19 -std=c++20 -O2 -ffreestanding -fno-exceptions -fno-rtti -fno-math-errno -ffp-contract=fast "
    "-fno-strict-aliasing -fno-vectorize -fno-slp-vectorize -fno-unroll-loops -fno-asynchronous-unwind-tables "
    "-Wall -Wextra -Wno-psabi -S -emit-llvm -o -"
)
# Lines and marks that name the compiler, the processor, or the places in the source.
_DROPPED_LINES = (";", "source_filename", "target ", "attributes ", "!")
_DROPPED_MARKS = r", !\w+(\.\w+)* !\d+| #\d+| local_unnamed_addr| dso_local| mustprogress|\s*; preds = .*"


def first_line() -> str:
    """Return the first line of the result, by which a test finds out whether the source has changed since."""
    source = b"".join(path.read_bytes() for path in sorted(SOURCE.parent.glob("*.[ch]pp")))
    return f"; From route_search.cpp, SHA-256 {hashlib.sha256(source).hexdigest()}, by tools/native.py. Do not edit."


def compile_source() -> str:
    """Return the text of the compiled source."""
    text = subprocess.run([*COMMAND.split(), str(SOURCE)], check=True, capture_output=True, text=True).stdout
    lines = [re.sub(_DROPPED_MARKS, "", line) for line in text.splitlines() if not line.startswith(_DROPPED_LINES)]
    return "\n".join([first_line(), *lines]) + "\n"


if __name__ == "__main__":
    SOURCE.with_suffix(".ll").write_text(compile_source())
