"""Conversion of folders of early versions to the present formats.

The formats of early versions were never released; folders of holdfast 0.1 are kept in ``tests/stored``. A results folder had a
list of finished chunks in ``run.json`` in place of the journal, a search had lines without checksums in ``search.jsonl``, and
files had no digest.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from holdfast.control.laws.law import Law
from holdfast.core.errors import StoreError
from holdfast.core.files import reading
from holdfast.core.files.digest import seal_document
from holdfast.core.files.output import replace_file
from holdfast.core.sweeps.folder import STUDY_FILE, digest_columns
from holdfast.core.sweeps.journal import ChecksumLines, Journal, JournalEntry
from holdfast.core.sweeps.memory import MEMORY_FILE
from holdfast.core.sweeps.samples import Column, SampleArrays
from holdfast.core.sweeps.store import FORMAT_VERSION, RUN_FILE, Store

_SEARCH_FILE = "search.jsonl"
_LAST_FORMAT_OF_OTHER_DIGITS = 2  # the last digits of rows in this format differ from those that are computed now


def convert_folder(path: str | Path, law: Law | None = None) -> Path:
    """Convert a folder of an early version in place; a folder in the present format is not changed.

    Early versions stored no checksums of values, so a lost file is not detected here.

    Args:
        path: Path of the folder of an assessment, a workspace, a study, or a search for designs.
        law: Control law of a workspace, of which early versions stored only a description.

    Returns:
        Path of the folder.

    Raises:
        StoreError: The folder contains none of these, is damaged, was stopped before it was complete, or is not writable.
    """
    folder = Path(path)
    try:
        if (folder / STUDY_FILE).exists():
            _convert_study(folder)
        elif (folder / RUN_FILE).exists():
            _convert_run(folder, law)
        elif (folder / _SEARCH_FILE).exists():
            _convert_search(folder)
        elif not (folder / MEMORY_FILE).exists():
            raise StoreError(f"'{folder}' contains no study, run, or search; give the folder that --out named")
    except (OSError, ValueError, LookupError, TypeError, AttributeError) as error:
        raise StoreError(f"'{folder}' cannot be converted ({error}); compute it again in a new folder") from error
    return folder


def _convert_study(folder: Path) -> None:
    for name in (STUDY_FILE, "made.json"):
        if (folder / name).exists():
            _seal(folder / name, _read_unsealed(folder / name))
    for cell in sorted((folder / "cells").glob("*")):
        _convert_run(cell, None)


def _convert_run(folder: Path, law: Law | None) -> None:
    run = _read_unsealed(folder / RUN_FILE)
    if run["version"] >= FORMAT_VERSION:
        return
    import zarr

    columns = [Column.from_stored(entry) for entry in run["columns"]]
    samples, journal = SampleArrays(folder, columns), Journal(folder / Store.JOURNAL)
    count = -(-run["rows"] // run["chunk"])
    if not run.pop("journal", False):
        for chunk in sorted(set(run["done"]) - journal.read_entries().keys()):
            start, stop = chunk * run["chunk"], min((chunk + 1) * run["chunk"], run["rows"])
            values = samples.read_rows(start, stop, [column.name for column in columns])
            journal.add(chunk, JournalEntry(digest_columns(values), samples.measure_chunk(chunk), 0.0, 0))
    if run["version"] <= _LAST_FORMAT_OF_OTHER_DIGITS and len(journal.read_entries()) < count:
        raise StoreError(
            f"'{folder}' was stopped before it was complete, and the last digits of its rows differ from those that are "
            "computed now; compute it again in a new folder"
        )
    if run["plan"].get("kind") == "workspace" and "gain" not in run["plan"]:
        run["plan"] = _replace_law(run["plan"], law, folder)
        zarr.open_group(samples.path, mode="r+").attrs["plan"] = json.dumps(run["plan"])
    del run["done"]
    _seal(folder / RUN_FILE, run | {"version": FORMAT_VERSION})


def _replace_law(plan: dict[str, Any], law: Law | None, folder: Path) -> dict[str, Any]:
    """Return a plan with the stored values of a law in place of its text."""
    if law is None or (law.describe(), law.arm.fingerprint) != (plan["law"], plan["arm"]):
        raise StoreError(f"'{folder}' contains the law '{plan['law']}'; give this law of the same arm")
    if float(f"{law.gain:g}") != law.gain:
        raise StoreError(f"gain is {law.gain}; it must have at most the six digits of the law's text in '{folder}'")
    names = list(plan)
    return {name: plan[name] for name in names[:2]} | law.to_stored() | {name: plan[name] for name in names[3:]}


def _convert_search(folder: Path) -> None:
    *lines, _ = reading.read_bytes(folder / _SEARCH_FILE).split(b"\n")  # the last line is empty or truncated
    ChecksumLines(folder / MEMORY_FILE).append(*lines)
    (folder / _SEARCH_FILE).unlink()


def _read_unsealed(file: Path) -> dict[str, Any]:
    data: dict[str, Any] = reading.read_json(file)
    return {name: value for name, value in data.items() if name not in ("digest", "sealed")}


def _seal(file: Path, data: dict[str, Any]) -> None:
    replace_file(file, seal_document(data))
