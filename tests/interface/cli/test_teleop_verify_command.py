"""``holdfast teleop verify`` and ``backup``: what they say, and that no damage makes a command stumble."""

import itertools
import os
import sqlite3
from contextlib import closing

import pytest

import flips
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.verification import verify_records

BITS = int(os.environ.get("HOLDFAST_FLIPS", "240"))


@pytest.fixture(scope="module")
def experiment(tmp_path_factory):
    folder = tmp_path_factory.mktemp("verified") / "experiment"
    flips.experiment(folder)
    return folder


def test_a_changed_bit_of_data_is_found(experiment, tmp_path, rng, cli):
    """Where another program reads something else than before, verify says so; and nothing stumbles."""

    rounds = itertools.count()

    def read():
        if next(rounds) % 40 == 0:  # each takes a quarter of a second
            assert cli("teleop", "verify", tmp_path / "copy")[0] == 3
            code, _, err = cli("teleop", "subjects", tmp_path / "copy")
            assert code == 0 or err.startswith("holdfast: ")

    seen = flips.flipped(experiment, tmp_path / "copy", BITS, rng, read)
    print(f"{BITS} bits, {seen.touched} of them touch data, {len(seen.missed)} missed")
    assert seen.touched > BITS / 4
    assert seen.missed == []


def test_sound_records(cli, experiment):
    code, out, err = cli("teleop", "verify", experiment)
    assert (code, err) == (0, "")
    assert (
        out == f"sound: 6 trials, {verify_records(experiment).links} digests; all together "
        f"{verify_records(experiment).overall_digest}\n"
    )


def test_the_first_damaged_trial_is_named_first(cli, experiment, tmp_path):
    flips.copied(experiment, tmp_path / "copy")
    with closing(sqlite3.connect(tmp_path / "copy" / "records.sqlite")) as db, db:
        db.execute("UPDATE cycles SET time = 9 WHERE trial IN (3, 5) AND k = 1")
    code, out, _ = cli("teleop", "verify", tmp_path / "copy")
    assert code == 3
    assert out.splitlines()[0] == "damaged: trial 3 of S01 is not as it was written"


def test_a_backup_is_sound_and_whole(cli, refused, experiment, tmp_path):
    code, out, _ = cli("teleop", "backup", experiment, tmp_path / "safe" / "copy")
    assert code == 0
    assert "sound: 6 trials" in out
    assert verify_records(tmp_path / "safe" / "copy").overall_digest == verify_records(experiment).overall_digest
    assert sorted(f.name for f in (tmp_path / "safe").iterdir()) == ["copy"]
    assert sorted(f.name for f in (tmp_path / "safe" / "copy").iterdir()) == ["protocol.yaml", "records.sqlite"]
    assert "exists already" in refused("teleop", "backup", experiment, tmp_path / "safe")
    (tmp_path / "file").touch()
    assert "choose another folder" in refused("teleop", "backup", experiment, tmp_path / "file" / "copy")


def test_a_backup_of_a_damaged_folder_is_refused(refused, experiment, tmp_path):
    flips.copied(experiment, tmp_path / "copy")
    with closing(sqlite3.connect(tmp_path / "copy" / "records.sqlite")) as db, db:
        db.execute("UPDATE trials SET rating = 0 WHERE id = 4")
    assert "is not sound" in refused("teleop", "backup", tmp_path / "copy", tmp_path / "safe")
    assert not (tmp_path / "safe").exists()


def test_a_backup_while_somebody_writes(experiment, tmp_path, rng):
    from holdfast.teleop.records.copies import copy_experiment

    flips.copied(experiment, tmp_path / "live")
    with Records.open(tmp_path / "live") as records, records.transaction():
        before = verify_records(tmp_path / "live").overall_digest
        records.set_note("S01", "not yet")
        assert verify_records(tmp_path / "live").overall_digest == before
        copy_experiment(tmp_path / "live", tmp_path / "copy")
        flips.trial(records, "S02", rng)
    assert verify_records(tmp_path / "copy").overall_digest == before
    assert verify_records(tmp_path / "live").overall_digest != before
