"""Searches that are stopped, killed and shared among processes: the same certificate."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from itertools import count

import numpy as np
import pytest

import holdfast as hf
from holdfast.certificates import reach_claim, search_pool, tolerant_claim
from holdfast.certificates.joint_boxes import halving as boxes
from holdfast.certificates.target_boxes import jobs
from holdfast.certificates.tool_paths import proof as motions
from holdfast.core.errors import InputError, StoreError
from holdfast.interface.cli.certify_search import format_state

RANGES = {"joint1": (-1.0, 0.5), "joint2": (0.0, 1.4), "joint3": (0.0, 1.4)}
WORDS = ["--range", "1=-1..0.5", "--range", "2=0..1.4", "--range", "3=0..1.4"]


def proofs(found):
    """What does not depend on the clock."""
    return [part.document["digest"] for part in found.parts], [part.nodes for part in found.parts]


@pytest.fixture(scope="module")
def claim(three):
    return tolerant_claim(three, (1.5, 0.5), 0.3, working_ranges=RANGES)


@pytest.fixture(scope="module")
def whole(claim):
    return hf.certify(claim, halvings=6)


def test_two_processes_find_the_same(claim, whole, tmp_path):
    told, lines = [], []
    found = hf.certify(claim, halvings=6, workers=2, store=tmp_path, progress=lambda *at: told.append(at), state=lines.append)
    assert proofs(found) == proofs(whole)
    assert told[-1] == (40_000, 40_000)
    assert lines[-1].open == 0
    assert lines[-1].proved == pytest.approx(np.mean([float(part.proved) for part in whole.parts]))
    assert format_state(lines[-1]).endswith(f"open 0 %; {whole.nodes:,} boxes")
    remembered = hf.certify(claim, halvings=6, store=tmp_path)
    assert proofs(remembered) == proofs(whole)
    assert remembered.seconds == found.seconds  # nothing was computed again
    with pytest.raises(StoreError, match="another search"):
        hf.certify(claim, halvings=6, seed=1, store=tmp_path)


def test_a_search_that_was_stopped_is_resumed(claim, whole, tmp_path):
    asked = count()
    some = hf.certify(claim, halvings=6, store=tmp_path, stop=lambda: next(asked) > 12)
    assert not some.finished
    assert proofs(hf.certify(claim, halvings=6, store=tmp_path)) == proofs(whole)


def test_a_busy_machine_finds_the_same(three, monkeypatch):
    """Boxes of a claim that is cut take turns; what each begins with takes as long as it takes."""
    monkeypatch.setattr(jobs, "_SPLIT_ABOVE_CELLS", 8)
    monkeypatch.setattr(jobs, "_CELLS_PER_JOB", 8)
    claim = reach_claim(three, (1.5, 0.5), 0.8, locked={"joint2": (0.7, 1.3)})
    quiet = hf.certify(claim, halvings=4)
    monkeypatch.setattr(search_pool, "_TIME_SLICE_S", 1e-3)
    busy = hf.certify(claim, halvings=4)
    assert quiet.document["digest"] == busy.document["digest"]


def killed(words, journal):
    """A search in another process, killed when a part of it is done."""
    run = [sys.executable, "-m", "holdfast", "certify", *map(str, words), "--store", str(journal.parent), "--no-check"]
    with subprocess.Popen(run, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        end = time.monotonic() + 100
        while process.poll() is None and time.monotonic() < end:
            if journal.exists() and journal.read_bytes().count(b"\n") > 1:
                os.kill(process.pid, signal.SIGKILL)
                break
            time.sleep(0.002)
    assert journal.read_bytes().count(b'"part"') >= 1


def test_a_search_that_was_killed_is_resumed(claim, whole, tmp_path):
    journal = tmp_path / "store" / "search.journal"
    words = ["tolerant", "planar-3r", "--box", "1.5 0.5", "--size", "0.3", "--halvings", "6", *WORDS]
    killed([*words, "--out", tmp_path / "a.zip"], journal)
    assert proofs(hf.certify(claim, halvings=6, store=journal.parent)) == proofs(whole)


def test_a_path_that_was_killed_is_resumed(three, tmp_path):
    journal, motion = tmp_path / "store" / "search.journal", tmp_path / "motion.csv"
    rows = [",".join(map(repr, row)) for row in BEND.tolist()]
    motion.write_text("\n".join(["joint1_rad,joint2_rad,joint3_rad", *rows]), encoding="utf-8")
    words = ["path", "planar-3r", motion, "--task", "planar", "--halvings", "2", "--out", tmp_path / "a.certificate"]
    killed(words, journal)
    claim = hf.certificates.path_claim(three, BEND, task="planar")
    found, whole = (hf.certify(claim, halvings=2, store=store) for store in (journal.parent, None))
    assert found.document["digest"] == whole.document["digest"]
    assert (found.nodes, found.finished, found.refuted > 0) == (whole.nodes, True, True)


def test_a_part_of_many_cells_is_cut(three, tmp_path, monkeypatch):
    monkeypatch.setattr(jobs, "_SPLIT_ABOVE_CELLS", 4)
    monkeypatch.setattr(jobs, "_CELLS_PER_JOB", 2)
    claim = reach_claim(three, (1.5, 0.5), 0.6, locked={1: (0.5, 1.2)})
    proof = hf.certify(claim, store=tmp_path / "store")
    lines = (tmp_path / "store" / "search.journal").read_text()
    assert lines.count("box") > 4
    assert proof.ok
    check = hf.check_certificate(proof.write(tmp_path / "a.certificate"))
    assert (check.rejected, check.undecided, check.leaves) == (0, 0, proof.leaves)
    again = hf.certify(claim, store=tmp_path / "store")
    assert again.document["digest"] == proof.document["digest"]


BEND = np.array([0.3, 1.6, 0.7]) + np.linspace(0, 1, 7)[:, None] * [0.2, -1.2, -0.5]
FOUR = np.column_stack([[-0.2, 0.4, 0.5, -0.4], [0.2, 0.8, 1.0, 0.1]])


def asked(kind, three, flat4):
    """A claim, and how deep it is looked into."""
    made = hf.certificates
    if kind == "path":
        return made.path_claim(three, BEND, task="planar", failures=[0, 1]), 3
    if kind == "out-of-reach":
        return made.out_of_reach_claim(three, (2.5, 1), 0.2, locked={1: (1.45, 1.75)}), 16
    return made.floor_claim(flat4, FOUR, 0.146, task="planar-pose"), 12


@pytest.mark.parametrize("kind", ["path", "out-of-reach", "floor"])
def test_what_is_halved_and_marches_is_resumed_as_well(three, flat4, tmp_path, monkeypatch, kind):
    """In jobs so small that there are some: stopped and resumed, in two processes, and what is remembered, all the same."""
    monkeypatch.setattr(motions, "_CELLS_PER_JOB", 60)
    monkeypatch.setattr(boxes, "_BOXES_PER_JOB", 6)
    claim, halvings = asked(kind, three, flat4)
    whole, journal = hf.certify(claim, halvings=halvings), tmp_path / "search.journal"
    some = hf.certify(claim, halvings=halvings, store=tmp_path, stop=lambda: '"part"' in journal.read_text())
    assert not some.finished
    assert some.undecided > whole.undecided
    again = hf.certify(claim, halvings=halvings, store=tmp_path, workers=1 + (kind == "path"))
    assert journal.read_text().count('"part"') > 2
    assert again.document["digest"] == whole.document["digest"]
    assert (again.nodes, again.leaves, again.finished) == (whole.nodes, whole.leaves, True)
    check = hf.check_certificate(again.write(tmp_path / "a.certificate"))
    assert (check.rejected, check.undecided) == (0, whole.undecided)
    remembered = hf.certify(claim, halvings=halvings, store=tmp_path, stop=lambda: True)
    assert remembered.document["digest"] == whole.document["digest"]
    with pytest.raises(StoreError, match="another search"):
        hf.certify(claim, halvings=halvings - 1, store=tmp_path)


def test_how_many_workers(three):
    with pytest.raises(InputError, match="workers is 0"):
        hf.certify(reach_claim(three, (1, 1), 0.1), workers=0)
