"""Jobs in a separate process, so that no station waits: ``python -m holdfast.teleop.serve.process JOB DIR OUT ...``.

The tables of an experiment, and its statistics, take seconds of processor time and hundreds of megabytes. Inside the server
they would block the event loop, which shares the interpreter's lock, and the server would keep the memory.
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

from holdfast.core.errors import HoldfastError, InputError
from holdfast.teleop.records.records import Records

_REFUSED_EXIT_CODE = 3  # the job printed an error message for the user

_log = logging.getLogger(__name__)


async def run_job(job: str, *arguments: str) -> None:
    """Run one of the jobs of this module in another process.

    Raises:
        InputError: The job rejected its input.
        HoldfastError: The job failed; the log has the reason.
    """
    command = [sys.executable, "-m", __name__, job, *arguments]
    finished = await asyncio.to_thread(subprocess.run, command, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    if finished.returncode == _REFUSED_EXIT_CODE:
        raise InputError(finished.stdout.decode().strip())
    if finished.returncode:
        _log.error("%s failed:\n%s", job, finished.stderr.decode(errors="replace"))
        raise HoldfastError(f"the {job} failed; the terminal in which the server was started shows why")


def _export_archive(folder: Path, out: Path) -> None:
    """Write ``OUT/export.zip`` with the output of :func:`holdfast.teleop.records.tables.export_tables`."""
    from holdfast.teleop.records.tables import export_tables

    with Records.open(folder) as records, records.read_snapshot():
        files = export_tables(records, out / "tables")
    with zipfile.ZipFile(out / "export.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        for file in files:
            archive.write(file, f"{folder.resolve().name or 'experiment'}/{file.name}")


def _write_report(folder: Path, out: Path, missing: str) -> None:
    """Write ``OUT/report.html``, with its tables."""
    from holdfast.teleop.analysis.eligibility import analyse_records
    from holdfast.teleop.records.tables import tool_paths

    with Records.open(folder) as records, records.read_snapshot():
        result = analyse_records(records, missing)  # type: ignore[arg-type]
        result.save(out, records.protocol, tool_paths(records))


_JOB_FUNCTIONS: dict[str, Callable[..., None]] = {"export": _export_archive, "report": _write_report}


def _run_job_function(job: str, folder: str, out: str, *arguments: str) -> int:
    if hasattr(os, "nice"):
        os.nice(10)  # lower priority than the stations
    try:
        _JOB_FUNCTIONS[job](Path(folder), Path(out), *arguments)
    except HoldfastError as error:
        sys.stdout.buffer.write(str(error).encode())
        return _REFUSED_EXIT_CODE
    return 0


if __name__ == "__main__":
    sys.exit(_run_job_function(*sys.argv[1:]))
