"""A copy of an experiment that is consistent, also while it is served."""

from __future__ import annotations

import secrets
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

from holdfast.errors import StoreError
from holdfast.teleop.records.file import FILE, beside
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.verification import Verified, verify


def backup(folder: str | Path, out: str | Path) -> Verified:
    """Copy the records as they are at one moment, by SQLite's own means, with the files that belong to them.

    The copy appears under its name when it is whole and was verified.

    Args:
        folder: Of the experiment; it may be served at the same time.
        out: A folder that is not there yet.

    Returns:
        What verifying the copy showed: it is sound.

    Raises:
        StoreError: There is no experiment, ``out`` is there already or cannot be written, or the copy is not sound.
    """
    source, target = Path(folder), Path(out)
    if target.exists():
        raise StoreError(f"'{target}' exists already; give a new folder for the copy")
    made = target.with_name(f".{target.name}-{secrets.token_hex(4)}.tmp")
    with Records.open(source) as records:
        try:
            made.mkdir(parents=True)
            with closing(sqlite3.connect(made / FILE)) as db:
                records.copy_to(db)
            for name in beside(records.protocol):
                shutil.copyfile(source / name, made / name)
            found = verify(made)
            if found.damaged:
                raise StoreError(f"the copy of '{source}' is not sound: {found.damaged[0]}; verify '{source}'")
            made.rename(target)
        except (OSError, sqlite3.Error) as error:
            raise StoreError(f"cannot copy '{source}' to '{target}': {error}; choose another folder") from error
        finally:
            shutil.rmtree(made, ignore_errors=True)
    return found
