"""Records of an experiment in which one bit or one digit was changed are refused: no table is made of them.

``HOLDFAST_CHANGES`` is the number of changes of each kind; ``make soak`` asks for 2,000.
"""

import os

import pytest

import flips
import holdfast as hf
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.tables import cycle_table, export_tables, trial_table

CHANGES = int(os.environ.get("HOLDFAST_CHANGES", "40"))


@pytest.fixture(scope="module")
def experiment(tmp_path_factory):
    folder = tmp_path_factory.mktemp("records") / "experiment"
    flips.experiment(folder)
    return folder


def is_refused(folder, table=trial_table):
    """Return whether reading a table is refused with one sentence."""
    try:
        with Records.open(folder) as records:
            table(records)
    except hf.HoldfastError as error:
        return "\n" not in str(error)
    return False


@pytest.mark.parametrize("change", [flips.change_bits, flips.change_digits])
def test_changed_records_are_refused(experiment, tmp_path, rng, change):
    seen = flips.changed(experiment, tmp_path / "copy", change, CHANGES, rng, is_seen=is_refused)
    print(f"{CHANGES} changes, {seen.touched} of them touch data, {len(seen.missed)} are silent")
    assert seen.touched > CHANGES / 4
    assert seen.missed == []


def test_every_table_refuses_a_changed_rating(experiment, tmp_path):
    """Only its digest shows that another rating is not the one that was given."""
    flips.copied(experiment, tmp_path / "copy")
    with Records.open(tmp_path / "copy") as records:
        records._db.execute("UPDATE trials SET rating = 0 WHERE id = 4")
    for table in (trial_table, cycle_table, lambda records: export_tables(records, tmp_path / "tables")):
        assert not is_refused(experiment, table)
        assert is_refused(tmp_path / "copy", table)
