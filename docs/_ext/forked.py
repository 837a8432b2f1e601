"""Command lines of the program, from one process that has imported it and forks for each of them.

Importing is most of what a short command takes. What it prints and its exit code are those of a process of its own.
"""

from __future__ import annotations

import atexit
import gc
import json
import os
import subprocess
import sys
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages
from tempfile import TemporaryDirectory

# What commands import when they need it, beside all of the program.
MODULES = ("jinja2", "matplotlib.backends.backend_svg", "scipy.optimize", "scipy.spatial", "scipy.stats", "typer.rich_utils")
MODULES += ("llvmlite.binding", "pandas", "xarray")


class Program:
    """``holdfast``, as :func:`subprocess.run` would run it.

    Args:
        environment: Of every command.
    """

    def __init__(self, environment: Mapping[str, str]) -> None:
        pipe = subprocess.PIPE
        self._server = subprocess.Popen([sys.executable, __file__], env=environment, stdin=pipe, stdout=pipe, text=True)
        atexit.register(self._server.communicate)  # it ends when nothing more can come

    def __call__(self, arguments: list[str], folder: Path) -> subprocess.CompletedProcess[str]:
        """Run it in the folder."""
        assert self._server.stdin is not None
        assert self._server.stdout is not None
        with TemporaryDirectory(prefix="holdfast-docs-") as kept:
            files = [Path(kept, name) for name in ("out", "err")]
            self._server.stdin.write(json.dumps([arguments, str(folder), *map(str, files)]) + "\n")
            self._server.stdin.flush()
            code = int(self._server.stdout.readline())
            return subprocess.CompletedProcess(arguments, code, *(file.read_text(encoding="utf-8") for file in files))


def serve() -> None:
    """Run what comes on stdin, one line a command, and answer with exit codes."""
    import holdfast

    for found in walk_packages(holdfast.__path__, "holdfast."):
        if not found.name.endswith(("__main__", "jax_rows", "torch_rows")):
            import_module(found.name)
    for name in MODULES:
        import_module(name)
    gc.freeze()
    for line in sys.stdin:
        arguments, folder, *files = json.loads(line)
        if (child := os.fork()) == 0:
            os.chdir(folder)
            for number, name in enumerate([os.devnull, *files]):
                os.dup2(os.open(name, os.O_RDWR | os.O_CREAT), number)
            sys.argv = ["holdfast", *arguments]
            holdfast.interface.cli.main()
            return
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)


if __name__ == "__main__":
    serve()
