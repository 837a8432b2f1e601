"""Consistent copy of an experiment, even while it is served."""

from __future__ import annotations

import secrets
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

from holdfast.core.errors import StoreError
from holdfast.teleop.records.file import RECORDS_FILE, list_protocol_files
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.verification import VerificationReport, verify_records


def copy_experiment(folder: str | Path, out: str | Path) -> VerificationReport:
    """Copy the records as they are at one moment, with SQLite's backup, and the files that belong to them.

    The copy appears under its name when it is complete and was verified.

    Args:
        folder: Folder of the experiment, which may be served at the same time.
        out: New folder for the copy.

    Returns:
        Report of the verification of the copy, which is sound.

    Raises:
        StoreError: There is no experiment, ``out`` exists or cannot be written, or the copy is not sound.
    """
    source, target = Path(folder), Path(out)
    if target.exists():
        raise StoreError(f"'{target}' exists already; give a new folder for the copy")
    temporary = target.with_name(f".{target.name}-{secrets.token_hex(4)}.tmp")
    with Records.open(source) as records:
        try:
            temporary.mkdir(parents=True)
            with closing(sqlite3.connect(temporary / RECORDS_FILE)) as database:
                records.copy_to(database)
            for name in list_protocol_files(records.protocol):
                shutil.copyfile(source / name, temporary / name)
            report = verify_records(temporary)
            if report.damages:
                raise StoreError(f"the copy of '{source}' is not sound: {report.damages[0]}; verify '{source}'")
            temporary.rename(target)
        except (OSError, sqlite3.Error) as error:
            raise StoreError(f"cannot copy '{source}' to '{target}': {error}; choose another folder") from error
        finally:
            shutil.rmtree(temporary, ignore_errors=True)
    return report
