"""Work in a process of its own, so that no station waits for it: ``python -m holdfast.teleop.serve.process JOB DIR OUT ...``.

The tables of an experiment, and its statistics, take seconds of a processor and hundreds of megabytes: in the server they would
hold up the event loop, which shares the interpreter's lock, and the memory would stay with it.
"""

from __future__ import annotations

import asyncio
import logging
import os
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

from holdfast.errors import HoldfastError, InputError
from holdfast.teleop.records.records import Records

_REFUSED = 3  # exit code: what was printed is a sentence for people

_log = logging.getLogger(__name__)


async def apart(job: str, *arguments: str) -> None:
    """Do one of the jobs here in another process.

    Raises:
        InputError: What the job was refused with.
        HoldfastError: It failed; the log has the reason.
    """
    command = [sys.executable, "-m", __name__, job, *arguments]
    done = await asyncio.to_thread(subprocess.run, command, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    if done.returncode == _REFUSED:
        raise InputError(done.stdout.decode().strip())
    if done.returncode:
        _log.error("%s failed:\n%s", job, done.stderr.decode(errors="replace"))
        raise HoldfastError(f"the {job} failed; the terminal in which the server was started shows why")


def _export(folder: Path, out: Path) -> None:
    """``OUT/export.zip``, with what :func:`holdfast.teleop.records.tables.export` writes."""
    from holdfast.teleop.records.tables import export

    with Records.open(folder) as records, records.reading():
        files = export(records, out / "tables")
    with zipfile.ZipFile(out / "export.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        for file in files:
            archive.write(file, f"{folder.resolve().name or 'experiment'}/{file.name}")


def _report(folder: Path, out: Path, missing: str) -> None:
    """``OUT/report.html``, with its tables."""
    from holdfast.teleop.analysis.eligibility import analyse_records
    from holdfast.teleop.records.tables import tool_paths

    with Records.open(folder) as records, records.reading():
        result = analyse_records(records, missing)  # type: ignore[arg-type]
        result.save(out, records.protocol, tool_paths(records))


_JOBS: dict[str, Callable[..., None]] = {"export": _export, "report": _report}


def _main(job: str, folder: str, out: str, *more: str) -> int:
    if hasattr(os, "nice"):
        os.nice(10)  # after the stations
    try:
        _JOBS[job](Path(folder), Path(out), *more)
    except HoldfastError as error:
        sys.stdout.buffer.write(str(error).encode())
        return _REFUSED
    return 0


if __name__ == "__main__":
    sys.exit(_main(*sys.argv[1:]))
