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
from holdfast.certificates import reach_claim, tolerant_claim
from holdfast.certificates.target_boxes import jobs
from holdfast.errors import InputError, StoreError
from holdfast.present.certificates.console import state

RANGES = {"joint1": (-1.0, 0.5), "joint2": (0.0, 1.4), "joint3": (0.0, 1.4)}
WORDS = ["--range", "1=-1..0.5", "--range", "2=0..1.4", "--range", "3=0..1.4", "--no-check"]


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
    assert state(lines[-1]).endswith(f"open 0 %; {whole.nodes:,} boxes")
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


def test_a_search_that_was_killed_is_resumed(claim, whole, tmp_path):
    journal = tmp_path / "store" / "search.journal"
    words = ["tolerant", "planar-3r", "--box", "1.5 0.5", "--size", "0.3", "--halvings", "6", "--store", str(journal.parent)]
    run = [sys.executable, "-m", "holdfast", "certify", *words, *WORDS, "--out", str(tmp_path / "a.zip")]
    with subprocess.Popen(run, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        end = time.monotonic() + 100
        while process.poll() is None and time.monotonic() < end:
            if journal.exists() and journal.read_bytes().count(b"\n") > 1:
                os.kill(process.pid, signal.SIGKILL)
                break
            time.sleep(0.002)
    assert journal.read_bytes().count(b'"part"') >= 1
    assert proofs(hf.certify(claim, halvings=6, store=journal.parent)) == proofs(whole)


def test_a_part_of_many_cells_is_cut(three, tmp_path, monkeypatch):
    monkeypatch.setattr(jobs, "_LARGE", 4)
    monkeypatch.setattr(jobs, "_JOB", 2)
    claim = reach_claim(three, (1.5, 0.5), 0.6, locked={1: (0.5, 1.2)})
    proof = hf.certify(claim, store=tmp_path / "store")
    lines = (tmp_path / "store" / "search.journal").read_text()
    assert lines.count("box") > 4
    assert proof.ok
    check = hf.check_certificate(proof.write(tmp_path / "a.certificate"))
    assert (check.rejected, check.undecided, check.leaves) == (0, 0, proof.leaves)
    again = hf.certify(claim, store=tmp_path / "store")
    assert again.document["digest"] == proof.document["digest"]


def test_what_workers_and_stores_are_not_for(three):
    with pytest.raises(InputError, match="leave them out"):
        hf.certify(hf.certificates.out_of_reach_claim(three, (2.9, 1), 0.1), workers=2)
    with pytest.raises(InputError, match="workers is 0"):
        hf.certify(reach_claim(three, (1, 1), 0.1), workers=0)
