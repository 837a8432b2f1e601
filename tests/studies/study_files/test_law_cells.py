"""Workspaces and task banks as cells of a study: what the functions give, whoever computes, with and without a stop."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.control.convergence.analysis import MEASURE_NAMES
from holdfast.control.convergence.places import read_places
from holdfast.core.errors import InputError
from holdfast.core.sweeps import Chunk, Study, ThreadRunner
from holdfast.studies import read_study_file
from holdfast.teleop.bank.tasks import make_task_bank
from holdfast.teleop.trials.scenarios import Scenario

SEED = 7
FILE = """
seed: 7
poses: 5
chunk: 2
arms: [planar-3r]
workspace: {laws: [pseudoinverse], targets: [[1.2, 0.4]], configurations: 2, points: 1}
bank: {laws: [pseudoinverse], distance: 0.5}
"""
ARM = hf.arms.load("planar-3r")


def asked(tmp_path, text=FILE):
    path = tmp_path / "laws.yaml"
    path.write_text(text)
    return read_study_file(path)


def begun(folder, file) -> Study:
    return Study.create(folder, file.name, file.seed, cells=file.cells, source=file.text)


def bits(study: Study) -> dict[tuple[int, int], str]:
    return {(k, n): e.digest for k in range(len(study.cells)) for n, e in study.cell_entries(k).items()}


@pytest.fixture(scope="module")
def straight(tmp_path_factory) -> Study:
    """Computed by one thread without a stop."""
    folder = tmp_path_factory.mktemp("straight")
    file = asked(folder)
    study = begun(folder / "s", file)
    assert study.run(file.cells, ThreadRunner(1)) == {}
    assert study.is_complete
    return study


def found(study, cell, number) -> dict:
    store = study.cell_store(cell)
    return store.read_chunk(number, [c.name for c in store.columns])


def chunks(study, cell):
    rows, size = study.cells[cell]["rows"], study.cells[cell]["chunk"]
    return [Chunk(n, s, min(s + size, rows), seed=SEED) for n, s in enumerate(range(0, rows, size))]


def test_a_chunk_of_a_workspace_is_the_workspace_of_its_starts_and_seed(straight):
    law = hf.control.pseudoinverse(ARM, "planar")
    places = read_places(ARM, law.task, 5, np.random.default_rng(SEED))
    for c in chunks(straight, 0):
        w = hf.workspace(law, [1.2, 0.4], places.poses[c.start : c.stop], configurations=2, points=1, seed=c.own_seed)
        rows = found(straight, 0, c.number)
        for name, values in zip(MEASURE_NAMES, (*w.reach.parts, *w.finish.parts), strict=True):
            np.testing.assert_array_equal(rows[name], values, err_msg=name)
        for name in ("configurations", "lost", "ends"):
            np.testing.assert_array_equal(rows[name], getattr(w, name))
        assert rows["configurations"].sum() > 0


def test_a_chunk_of_a_bank_is_the_task_bank_of_its_seed(straight):
    scenarios = [Scenario(1, "pseudoinverse", failed=False), Scenario(2, "pseudoinverse", failed=True)]
    for c in chunks(straight, 1):
        bank = make_task_bank(ARM, len(c), distance=0.5, seed=c.own_seed, scenarios=scenarios)
        rows = found(straight, 1, c.number)
        for joint in range(3):
            mine = bank.tasks.joint == joint
            np.testing.assert_array_equal(rows["q0"][:, joint], bank.tasks.q0[mine])
            np.testing.assert_array_equal(rows["target"][:, joint], bank.tasks.target[mine])
            np.testing.assert_array_equal(rows["end"][:, joint], bank.end[:, mine].T)
            np.testing.assert_array_equal(rows["measures"][:, joint], bank.measures[:, mine].swapaxes(0, 1))


def test_two_threads_and_a_stop_change_no_bit(tmp_path, straight):
    file = asked(tmp_path)
    study = begun(tmp_path / "s", file)
    seen = []
    study.run(file.cells, ThreadRunner(2), lambda *x: seen.append(x), stop=lambda: len(seen) > 1)
    assert 0 < len(bits(study)) < len(bits(straight))
    assert begun(tmp_path / "s", file).run(file.cells, ThreadRunner(2)) == {}
    assert bits(study) == bits(straight)


@pytest.mark.filterwarnings("default")
def test_a_dask_worker_changes_no_bit(tmp_path, straight):
    pytest.importorskip("distributed")
    from holdfast.core.sweeps import Cluster

    file = asked(tmp_path)
    study = begun(tmp_path / "s", file)
    seen = []
    with Cluster("local:1") as cluster:
        study.run(file.cells, cluster, lambda *x: seen.append(x), stop=lambda: len(seen) > 1)
        assert 0 < len(bits(study)) < len(bits(straight))
        assert study.run(file.cells, cluster) == {}
    assert bits(study) == bits(straight)


def test_their_report_has_a_row_for_each_law(straight, tmp_path):
    text = straight.report(tmp_path / "r.html").read_text().replace("\u00a0", " ")
    for words in ("Start positions from which the target is", "Tasks under computer control", "pseudoinverse"):
        assert words in text, words


def test_a_bank_counts_cycles_not_seconds(tmp_path):
    with pytest.raises(InputError, match=r"bank\.time_limit: the key 'time_limit' is not known"):
        asked(tmp_path, FILE.replace("distance: 0.5", "distance: 0.5, time_limit: 5"))
