"""Studies: the same bits whoever computes, whatever is killed; damaged, foreign, full and shared folders."""

from __future__ import annotations

import errno
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from toy import Toy, cells

from cards import check_card
from holdfast.core.errors import StoreError
from holdfast.core.sweeps import Column, Store, Study, SweepCell, ThreadRunner, journal, merge_studies
from holdfast.core.sweeps.folder import digest_columns, lock_folder
from holdfast.core.sweeps.journal import ChecksumLines, Journal, JournalEntry
from sealing import read_unsealed, write_sealed

HERE = str(Path(__file__).parent)


def make(folder, some=None, seed=1) -> Study:
    return Study.create(folder, "toy", seed, cells=cells() if some is None else some)


def bits(study: Study) -> dict[tuple[int, int], str]:
    return {(k, n): e.digest for k in range(len(study.cells)) for n, e in study.cell_entries(k).items()}


@pytest.fixture(scope="module")
def straight(tmp_path_factory) -> Study:
    """Computed by one thread without a stop."""
    study = make(tmp_path_factory.mktemp("straight") / "s")
    assert study.run(cells(), ThreadRunner(1)) == {}
    assert study.is_complete
    return study


def test_a_notebook_says_how_far_it_is(straight):
    check_card(straight, False)


def test_the_rows_are_those_of_the_seeds_of_the_chunks(straight):
    for k in range(2):
        store = straight.cell_store(k)
        found = np.concatenate([store.read_chunk(n, ["x"])["x"] for n in store.committed_chunks])
        parts = [np.random.default_rng(np.random.SeedSequence(1, spawn_key=(n,))).random((s, 2)) for n, s in
                 enumerate([5, 5, 5, 5, 3])]  # fmt: skip
        np.testing.assert_array_equal(found, (k + 1) * np.concatenate(parts))
        np.testing.assert_array_equal(store.dataset()["x"].values, found)
    assert [(s.chunks_done, s.rows_done) for s in straight.status()] == [(5, 23)] * 2
    assert straight.makers[0]["versions"]["numpy"] == np.__version__
    assert straight.runs[0]["chunks"] == 10


def test_threads_and_interruptions_change_no_bit(tmp_path, straight):
    study = make(tmp_path / "s")
    seen = []
    study.run(cells(), ThreadRunner(2), lambda *x: seen.append(x), stop=lambda: len(seen) > 3)
    assert not study.is_complete
    again = Study.open(tmp_path / "s")
    assert again.status()[0].chunks_done >= 3
    make(tmp_path / "s").run(cells(), ThreadRunner(2), lambda *x: seen.append(x))
    assert bits(again) == bits(straight)
    assert seen[-1][:2] == (10, 10)
    assert max(x[0] for x in seen) == 10


def test_an_interrupt_keeps_what_was_committed(tmp_path, straight):
    study = make(tmp_path / "s")

    def impatient(done, *_):
        if done == 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        study.run(cells(), ThreadRunner(2), impatient)
    assert len(bits(study)) == 4
    study.run(cells(), ThreadRunner(1))
    assert bits(study) == bits(straight)


def test_shares_for_machines_that_never_meet_merge_to_the_whole(tmp_path, straight):
    parts = [make(tmp_path / f"p{k}") for k in range(3)]
    for k, p in enumerate(parts):
        p.run(cells(), ThreadRunner(1), part=(k + 1, 3))
    assert sum(len(bits(p)) for p in parts) == 10
    other = read_unsealed(parts[1].path / "made.json")
    other["makers"][0]["processor"] = "another kind"
    write_sealed(parts[1].path / "made.json", other)
    found = merge_studies(tmp_path / "whole", [p.path for p in parts])
    whole = Study.open(tmp_path / "whole")
    assert (found.added, found.both, found.apart) == (10, 0, ())
    assert bits(whole) == bits(straight)
    assert whole.is_complete
    assert {m["processor"] for m in whole.makers} == {"another kind", straight.makers[0]["processor"]}
    assert sorted(map(json.dumps, whole.runs)) == sorted(json.dumps(r) for p in parts for r in p.runs)
    assert merge_studies(whole.path, [parts[0].path]).both == len(bits(parts[0]))


def test_merging_says_what_agrees_and_what_does_not(tmp_path, straight):
    mine, near, far = (make(tmp_path / name) for name in ("mine", "near", "far"))
    mine.run(cells(), ThreadRunner(1))
    for study, error in ((near, 1e-15), (far, 1e-6)):
        study.run(cells(), ThreadRunner(1))
        rows = study.cell_store(0).read_chunk(1, ["x", "status"])
        store = study.cell_store(0)
        store.commit_chunk(1, {**rows, "x": rows["x"] + error})
    assert (merge_studies(mine.path, [near.path]).close, merge_studies(mine.path, [far.path]).apart) == (1, (("c0", 1),))
    with pytest.raises(StoreError, match=r"not parts of one study.*its seed is 1, but 2 was requested"):
        merge_studies(mine.path, [make(tmp_path / "other", seed=2).path])


# ---- the journal and damage ------------------------------------------------------------------------------------------


def test_a_journal_forgives_what_a_crash_leaves(tmp_path):
    j = Journal(tmp_path / "j")
    assert j.read_entries() == {}
    for k in range(3):
        j.add(k, JournalEntry(f"{k:032x}", 10, 0.5, 0))
    whole = j.path.read_bytes()
    for torn in (b"3 abc", b"3 abc 10 0.5 0 00000000\n", b"\xff\xfe\n", b"rubbish\n\n", whole[:20]):
        j.path.write_bytes(whole + torn)
        assert set(j.read_entries()) == {0, 1, 2}
        j.add(7, JournalEntry("d", 1, 0.0, 0))
        assert set(j.read_entries()) == {0, 1, 2, 7}
    j.drop([1, 7])
    assert set(j.read_entries()) == {0, 2}
    j.add(1, JournalEntry("e", 1, 0.0, 3))
    assert j.read_entries()[1] == JournalEntry("e", 1, 0.0, 3)


def test_a_full_disk_leaves_the_journal_as_it_was(tmp_path, monkeypatch):
    j = Journal(tmp_path / "j")
    j.add(0, JournalEntry("a", 1, 0.0, 0))
    before = j.path.read_bytes()
    write = os.write

    def full(handle, data):
        write(handle, bytes(data)[:5])
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(journal.os, "write", full)
    with pytest.raises(StoreError, match="No space"):
        j.add(1, JournalEntry("b", 1, 0.0, 0))
    assert j.path.read_bytes() == before


def test_a_full_disk_is_named_and_costs_the_chunk_in_hand(tmp_path, monkeypatch, straight):
    study = make(tmp_path / "s")
    study.run(cells(), ThreadRunner(1), stop=lambda: len(bits(study)) >= 3)
    done = bits(study)

    def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patch:
        patch.setattr(journal.os, "write", full)
        with pytest.raises(StoreError, match=r"No space left on device.*make room"):
            study.run(cells(), ThreadRunner(1))
    assert bits(study) == done
    study.run(cells(), ThreadRunner(1))
    assert bits(study) == bits(straight)


def file_of(study, chunk, cell=0):
    return study.cell_folder(cell) / "samples.zarr" / "x" / "c" / str(chunk) / "0"


@pytest.mark.parametrize("how", ["cut", "flipped", "lost", "other rows"])
def test_a_damaged_chunk_is_named_and_computed_again(how, tmp_path, straight):
    study = make(tmp_path / "s")
    study.run(cells(), ThreadRunner(1))
    file = file_of(study, 2)
    data = bytearray(file.read_bytes())
    if how == "cut":
        file.write_bytes(data[:-4])
    elif how == "flipped":
        data[len(data) // 2] ^= 1
        file.write_bytes(data)
    elif how == "lost":
        file.unlink()
    else:
        file.write_bytes(file_of(study, 3).read_bytes())
    found = study.verify()
    assert [(d.cell, d.chunk) for d in found] == [("c0", 2)]
    assert study.verify() == []
    assert study.status()[0].chunks_done == 4
    study.run(cells(), ThreadRunner(1))
    assert bits(study) == bits(straight)
    assert study.verify() == []


@pytest.mark.parametrize("how", ["folder", "journal", "all damaged"])
def test_a_cell_that_is_gone_is_named(how, tmp_path, straight):
    """Nothing of it is left to be compared: verify said that all was sound."""
    first, study = make(tmp_path / "first"), tmp_path / "merged"
    first.run(cells(), ThreadRunner(1), stop=lambda: len(bits(first)) >= 6)  # of the second cell only a part
    merge_studies(study, [tmp_path / "first"])
    for s in (first, Study.open(study)):
        assert s.verify() == []
        if how == "folder":
            shutil.rmtree(s.cell_folder(0))
        elif how == "journal":
            (s.cell_folder(0) / "done.journal").unlink()
        else:
            for n in range(5):
                file_of(s, n).write_bytes(b"")
        found = s.verify()
        assert {d.cell for d in found} == {"c0"}
        assert [d.chunk for d in found] == (list(range(5)) if how == "all damaged" else [None])
        assert s.verify() == []  # named once, missing from then on
        s.run(cells(), ThreadRunner(1))
        assert s.verify() == []
        assert bits(s) == bits(straight)


def test_a_cell_that_was_never_begun_is_no_damage(tmp_path):
    study = make(tmp_path / "s")
    assert study.verify() == []
    study.run(cells(), ThreadRunner(1), stop=lambda: len(bits(study)) >= 3)
    assert study.verify() == []
    (tmp_path / "s" / "begun.journal").unlink()  # a folder of holdfast 0.9 has none
    shutil.rmtree(study.cell_folder(0))
    assert study.verify() == []


DAMAGED = {
    "no name": lambda c: c.pop("name"),
    "a name that leads elsewhere": lambda c: c.update(name="../../elsewhere"),
    "a name of a folder below": lambda c: c.update(name="a/b"),
    "a name that is too long": lambda c: c.update(name="x" * 300),
    "no labels": lambda c: c.pop("labels"),
    "labels that are text": lambda c: c.update(labels="x"),
    "rows without end": lambda c: c.update(rows=2**62),
    "more chunks than can be counted": lambda c: c.update(rows=10**9, chunk=1),
    "chunks of nothing": lambda c: c.update(chunk=0),
    "no digest": lambda c: c.pop("digest"),
}


@pytest.mark.parametrize("what", DAMAGED)
def test_a_damaged_cell_of_a_study_file_is_a_sentence(what, tmp_path):
    make(tmp_path / "s")
    file = tmp_path / "s" / "study.json"
    data = read_unsealed(file)
    DAMAGED[what](data["cells"][1])
    write_sealed(file, data)
    with pytest.raises(StoreError, match=r"is damaged: its cell 2 is missing or wrong"):
        Study.open(tmp_path / "s")


@pytest.mark.parametrize(
    ("key", "value"),
    [("rows", 2**62), ("rows", -1), ("chunk", 0), ("columns", [["../x", "float64", [], "1", ""]]), ("columns", [["x"]]),
     ("columns", [["x", "no type", [], "1", ""]]), ("columns", [["x", "a", [], "1", ""]]),
     ("columns", [["x", "O", [], "1", ""]]), ("columns", [["x", "float64", [["a", -1]], "1", ""]])],
)  # fmt: skip
def test_a_damaged_run_file_is_a_sentence(key, value, tmp_path):
    store = Store.create(tmp_path / "s", {"kind": "x"}, [Column("x", "float64")], rows=10, chunk=5)
    assert store.missing_chunks == [0, 1]
    file = tmp_path / "s" / "run.json"
    write_sealed(file, read_unsealed(file) | {key: value})
    with pytest.raises(StoreError, match="is damaged: its"):
        Store.open(tmp_path / "s")


def test_chunks_of_one_row_of_a_large_run_are_no_hang(tmp_path):
    Store.create(tmp_path / "s", {"kind": "x"}, [Column("x", "float64")], rows=10**9, chunk=10**6)
    file = tmp_path / "s" / "run.json"
    write_sealed(file, read_unsealed(file) | {"chunk": 1})
    with pytest.raises(StoreError, match="its chunk is missing or wrong"):
        Store.open(tmp_path / "s")


def test_names_that_are_too_long_are_refused(tmp_path):
    long = tmp_path / ("x" * 300)
    for make_it in (
        lambda: make(long),
        lambda: Study.open(long),
        lambda: merge_studies(long, [make(tmp_path / "s").path]),
        lambda: Store.open(long),
        lambda: Store.create(long, {}, [Column("x", "float64")], rows=10, chunk=5),
    ):
        with pytest.raises(StoreError):
            make_it()


@pytest.mark.parametrize("how", ["cut", "lost"])
def test_a_run_alone_notices_files_that_are_not_whole(how, tmp_path, straight):
    study = make(tmp_path / "s")
    study.run(cells(), ThreadRunner(1))
    file = file_of(study, 2)
    if how == "cut":
        file.write_bytes(file.read_bytes()[:-4])
    else:
        file.unlink()
    study.run(cells(), ThreadRunner(1))
    assert study.verify() == []
    assert bits(study) == bits(straight)


# ---- folders -----------------------------------------------------------------------------------------------------------


def test_other_studies_and_foreign_folders_are_refused(tmp_path):
    make(tmp_path / "s")
    for some, seed, words in (
        (cells(3), 1, "cell 'c2' is not in it"),
        (cells(1), 1, "cell 'c1' is not requested"),
        (cells(rows=24), 1, "has rows 23, but 24 was requested"),
        (cells(), 2, "its seed is 1, but 2 was requested"),
        ([SweepCell("c0", Toy(), {"scale": 9}, rows=23, chunk=5), cells()[1]], 1, "cell 'c0' has other settings"),
    ):
        with pytest.raises(StoreError, match=words):
            make(tmp_path / "s", some, seed)
    with pytest.raises(StoreError, match="another study"):
        Study.open(tmp_path / "s").run(cells(3), ThreadRunner(1))
    foreign = tmp_path / "foreign"
    foreign.mkdir()
    (foreign / "thesis.tex").write_text("work")
    with pytest.raises(StoreError, match="not empty and is not a holdfast study"):
        make(foreign)
    for folder in (foreign, tmp_path / "nowhere"):
        with pytest.raises(StoreError, match=r"not a study: it has no study\.json"):
            Study.open(folder)
    with pytest.raises(StoreError, match="is a file"):
        make(foreign / "thesis.tex")
    with pytest.raises(StoreError, match="cannot write"):
        make("/proc/holdfast")


@pytest.mark.parametrize("change", [{"cells": None}, {"seed": "5"}, {"format": "x"}, {"version": 9}])
def test_a_damaged_study_file_is_a_sentence(change, tmp_path):
    study = make(tmp_path / "s")
    file = study.path / "study.json"
    write_sealed(file, {**read_unsealed(file), **change})
    with pytest.raises(StoreError):
        Study.open(study.path)
    file.write_text("{")
    with pytest.raises(StoreError, match="cannot be read"):
        Study.open(study.path)


@pytest.mark.parametrize("key", ["labels", "rows", "chunk", "name", "digest"])
def test_a_cell_that_lacks_something_is_named(key, tmp_path):
    study = make(tmp_path / "s")
    data = read_unsealed(study.path / "study.json")
    del data["cells"][1][key]
    write_sealed(study.path / "study.json", data)
    with pytest.raises(StoreError, match=r"its cell 2 is missing or wrong"):
        Study.open(study.path)


def test_two_runs_in_one_folder_are_refused(tmp_path):
    study = make(tmp_path / "s")
    with lock_folder(study.path, "study.lock"):
        for work in (lambda: study.run(cells(), ThreadRunner(1)), study.verify):
            with pytest.raises(StoreError, match="another program is writing"):
                work()
    assert study.run(cells(), ThreadRunner(1)) == {}


def test_a_cell_that_refuses_does_not_stop_the_others(tmp_path):
    some = [SweepCell("bad", Toy(refuses=1), {"a": 1}, rows=23, chunk=5), *cells(1)]
    study = make(tmp_path / "s", some)
    problems = study.run(some, ThreadRunner(2))
    assert list(problems) == ["bad"]
    assert "one too many" in str(problems["bad"])
    assert study.status()[1].is_complete


def test_tasks_in_hand_are_bounded(tmp_path):
    many = [SweepCell("many", Toy(), {"a": 1}, rows=300, chunk=1)]
    study = make(tmp_path / "s", many)
    asked = 0

    class Counting(ThreadRunner):
        def results(self, tasks, stop):
            def watched():
                nonlocal asked
                for task in tasks:
                    asked += 1
                    yield task

            for done, result in enumerate(super().results(watched(), stop)):
                assert asked - done <= 2 * self.count + 2
                yield result

    study.run(many, Counting(2), stop=lambda: asked > 40)
    assert asked > 40


def test_status_of_very_many_chunks(tmp_path):
    many = [SweepCell("many", Toy(), {"a": 1}, rows=10_000_000, chunk=100)]
    study = make(tmp_path / "s", many)
    study.cell_folder(0).mkdir(parents=True)
    one = tmp_path / "one"
    lines = []
    j = Journal(one)
    for k in range(2):
        j.add(k, JournalEntry("ab" * 16, 100, 0.5, 0))
    assert len(one.read_bytes().splitlines()) == 2
    for k in range(99_999):
        lines.append(b"%d %s 100 0.5 0" % (k, b"ab" * 16))
    ChecksumLines(study.cell_folder(0) / Store.JOURNAL).append(*lines)
    (status,) = study.status()
    assert (status.chunks, status.chunks_done, status.rows_done, status.seconds) == (100_000, 99_999, 9_999_900, 49_999.5)


def test_checksums_tell_types_names_and_bits_apart():
    x = np.arange(6.0)
    marks = {
        digest_columns({"x": x}),
        digest_columns({"y": x}),
        digest_columns({"x": x.astype("f4")}),
        digest_columns({"x": x.reshape(2, 3)}),
        digest_columns({"x": -x}),
        digest_columns({"x": x, "y": x}),
    }
    assert len(marks) == 6
    assert digest_columns({"x": x[::-1][::-1]}) == digest_columns({"x": x})


# ---- killed ------------------------------------------------------------------------------------------------------------

RUN = """
import sys
sys.path.insert(0, sys.argv[2])
from toy import cells
from holdfast.core.sweeps import Study, ThreadRunner
some = cells(slow=0.05)
Study.create(sys.argv[1], "toy", 1, cells=some).run(some, ThreadRunner(2), lambda done, *_: print(done, flush=True))
"""


def test_a_killed_program_loses_at_most_the_chunks_in_hand(tmp_path, straight):
    command = [sys.executable, "-c", RUN, str(tmp_path / "s"), HERE]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        said = [int(process.stdout.readline()) for _ in range(4)]
        process.kill()
        process.wait(30)
    study = Study.open(tmp_path / "s")
    assert said[-1] <= len(bits(study)) < 10
    study = make(tmp_path / "s")
    study.run(cells(), ThreadRunner(2))
    assert bits(study) == bits(straight)
    assert study.verify() == []


def test_a_program_killed_while_it_wrote_the_first_file_does_not_make_the_folder_foreign(tmp_path):
    (tmp_path / "s").mkdir()
    (tmp_path / "s" / ".holdfast-4711-0badcafe.tmp").write_text('{"format": "hold')
    make(tmp_path / "s")
    assert Study.open(tmp_path / "s").cells


@pytest.mark.parametrize("name", ["study.json", "made.json"])
def test_a_file_that_is_nested_too_deep_is_refused_with_a_sentence(tmp_path, name):
    make(tmp_path / "s")
    (tmp_path / "s" / name).write_text("[" * 100_000)
    with pytest.raises(StoreError, match="nested too deep"):
        Study.open(tmp_path / "s").run(cells(), ThreadRunner(1))
