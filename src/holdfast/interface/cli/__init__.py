"""Command line of holdfast, a thin layer over the library."""

from __future__ import annotations

import gc
import sys
from contextlib import suppress

from holdfast.interface.cli.interrupt import STOPPED_EXIT_CODE, InterruptHandler

__all__ = ["main"]


def main() -> None:
    """Run the program; Ctrl-C ends it within a second, with exit code 130 and one line on stderr."""
    gc.set_threshold(50_000)  # the default of 700 collects many times while modules are imported
    interrupt = InterruptHandler()
    try:
        from holdfast.interface.cli.program import main as run

        run()
    except SystemExit as end:
        if end.code != STOPPED_EXIT_CODE:
            raise
    except BaseException:  # a third-party module that is interrupted during its import may raise any exception
        if not interrupt.was_requested:
            raise
        print("holdfast: stopped", file=sys.stderr, flush=True)
    with suppress(OSError):
        sys.stdout.flush()
    interrupt.end_process()
