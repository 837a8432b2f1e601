"""Workspace analysis: the numbers of the specification, brute force beside the procedure, and other routes to the pieces."""

from __future__ import annotations

import json
import sys

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import holdfast as hf
from cards import check_card
from holdfast.control import damped, pseudoinverse
from holdfast.control.convergence.analysis import TargetAnalysis, _find_sinks
from holdfast.control.convergence.healthy_motion import HealthyPaths
from holdfast.control.convergence.late_convergence import is_near_attracting_solution
from holdfast.control.convergence.places import configurations_at, make_lattice, read_places
from holdfast.interface.presentation.convergence import workspace as workspace_output

# Starts, then R100 and Ravg of joints 1 to 3 and an arbitrary one: shared mathematics, section 11.
PUBLISHED = {
    (2.0, -1.4): ((40.6, 70.7, 64.2, 16.9), (59.39, 80.63, 76.76, 30.40)),
    (-0.9, -1.5): ((0, 1.8, 13.9, 0), (32.02, 43.78, 56.34, 5.06)),
    (0.9, 2.5): ((89.3, 100, 100, 89.3), (93.21, 100, 100, 93.21)),
    (0.3, -0.4): ((33.9, 22.7, 35.6, 0), (49.68, 44.21, 60.98, 10.30)),
}


@pytest.fixture(scope="module")
def arm():
    return hf.arms.load("planar-3r")


@pytest.fixture(scope="module")
def law(arm):
    return pseudoinverse(arm, "planar")


@pytest.fixture(scope="module")
def small(law):
    """The same starts by brute force and by the procedure."""
    options = {"starts": "grid:7", "configurations": 6, "points": 4, "cells": 30}
    # Sinks and folded lines of the specification, section 10.
    arcs = {
        0: [(114.295, 335.705), (-16.8745, -16.8745), (106.8745, 106.8745)],
        1: [(111.797, 248.203)],
        2: [(111.797, 248.203)],
    }
    sinks = {joint: np.deg2rad(found) for joint, found in arcs.items()}
    return {
        "brute": hf.workspace(law, [1.5, 1.5], method="brute", **options),
        "procedure": hf.workspace(law, [1.5, 1.5], method="procedure", sinks=sinks, **options),
    }


def test_a_notebook_shows_its_maps(small):
    check_card(small["procedure"])


def test_the_lattice_has_the_points_of_the_paper(arm, law):
    places = make_lattice(arm, law.task)
    assert len(places) == 2032
    assert np.diff(places.axes[0]) == pytest.approx(6 / 51)
    assert (np.linalg.norm(places.points, axis=1) <= 3 + 1e-9).all()
    x, y = (axis[places.cells[:, k]] for k, axis in enumerate(places.axes))
    assert np.allclose(places.points[:, :2], np.stack([x, y], axis=1))


def test_ranges_are_those_of_the_specification(law):
    w = hf.workspace(law, [1.5, 1.5], list(PUBLISHED), configurations=240, points=0, cells=300)
    assert np.rad2deg([arcs[0] for arcs in w.bounds]) == pytest.approx(
        np.array([[-24.295, 114.295], [-111.797, 111.797], [-111.797, 111.797]]), abs=1e-3
    )
    full, average = (np.array([row[k] for row in PUBLISHED.values()]) for k in (0, 1))
    assert w.reach.full == pytest.approx(full, abs=1.5)
    assert w.reach.average == pytest.approx(average, abs=0.5)
    assert list(w.configurations) == [240, 240, 240, 480]  # two curves inside the unit circle
    assert np.isnan(w.finish.full).all()
    assert w.ends.sum() == 0


def test_brute_force_and_the_procedure_agree(small):
    brute, procedure = small["brute"], small["procedure"]
    for name, values in brute.measures.items():
        assert np.array_equal(values, procedure.measures[name], equal_nan=True), name
    assert brute.simulated_count == procedure.simulated_count + procedure.ends[:, 5].sum()
    assert procedure.skipped_fraction > 0.9
    assert np.nanmin(brute.finish.average) == 100  # no failure within the ranges gets stuck at this target
    assert brute.undecided_fraction < 0.05
    assert (brute.ends[:, [1, 2]] == 0).all()


def test_the_arbitrary_joint_is_never_better_than_one(small):
    w = small["brute"]
    for values in (w.reach.full, w.reach.average, w.finish.full):
        known = ~np.isnan(values[:, 3])
        assert (values[known, 3] <= values[known, :3].min(axis=1) + 1e-9).all()


def test_a_start_out_of_reach_has_no_measures(law):
    w = hf.workspace(law, [1.5, 1.5], [[2, 2], [3, 3]], configurations=4, points=2, cells=20)
    assert list(w.configurations) == [4, 0]
    assert np.isnan(w.reach.full[1]).all()
    assert w.reach.full[0] == pytest.approx(100)
    assert w.finish.spread[0] == pytest.approx(0)


def test_the_whole_way_counts_the_part_outside(law):
    options = {"starts": [[-1, -1], [2, 2]], "configurations": 6, "points": 3, "cells": 40}
    inside = hf.workspace(law, [1.5, 1.5], **options)
    whole = hf.workspace(law, [1.5, 1.5], relative_to="whole", **options)
    assert whole.finish.average == pytest.approx(inside.reach.average)  # everything inside arrives
    assert inside.finish.average[0, 0] == 100


def test_a_limit_cycle_is_simulated_by_the_procedure(law, rng):
    """Reachable, no sink, and still no convergence: joint 2 at 168.30 deg, target (0.9, 0)."""
    from holdfast.control.convergence.measures import is_in_arcs

    arcs = _find_sinks(law, read_places(law.arm, law.task, [0.9, 0], rng).poses[0])
    angles = np.deg2rad([168.0, 168.3, 168.5, -168.3, 100.0, 150.0])
    assert list(is_in_arcs(angles, arcs[1], True)) == [True, True, True, True, False, False]


def test_runs_ended_by_the_time_limit_are_told_by_the_solution_beside_them(law, rng):
    pose = read_places(law.arm, law.task, [1.5, 1.5], rng).poses[0]
    edge = np.deg2rad(111.79706935452342)
    q = np.array([[0.1, edge - 1e-4, -0.9], [0.1, edge + 1e-2, -0.9], [0.3, 1.0, 0.5]])
    runs = hf.simulate(law, q, pose, locked=np.full(3, 1), time_limit=300.0)
    slow = np.flatnonzero(runs.outcome == "undecided")
    assert 0 in slow
    found = is_near_attracting_solution(law, runs.q_final[:2], pose, np.full(2, 1))
    assert list(found) == [True, False]
    longer = hf.simulate(law, q[:2], pose, locked=np.full(2, 1), time_limit=3e5)
    assert longer.error[0] < 1e-4
    assert longer.error[1] > 1e-4


@pytest.mark.parametrize("damping", [0.0, 0.2])
def test_healthy_motions_against_scipy(arm, damping, rng):
    law = damped(arm, damping, "planar") if damping else pseudoinverse(arm, "planar")
    low, high = np.maximum(arm.lower, -2.0), np.minimum(arm.upper, 2.0)
    q0 = rng.uniform(low, high, (3, arm.n))
    goal = arm.forward_kinematics(rng.uniform(low, high, arm.n))
    cells = 12
    found = np.stack(list(HealthyPaths(law).iterate_cell_midpoints(q0, np.broadcast_to(goal, (3, 4, 4)), cells)))
    rows = law.task.rows[:, :3]
    at = (np.arange(cells) + 0.5) / cells
    for k, start in enumerate(q0):

        def rates(_, q):
            return law.velocity(q, law.gain * rows @ (goal[:3, 3] - arm.forward_kinematics(q)[:3, 3]))

        oracle = solve_ivp(rates, (0, 5), start, method="DOP853", rtol=1e-10, atol=1e-12, t_eval=-np.log(1 - at))
        assert found[:, k] == pytest.approx(oracle.y.T, abs=2e-5)


def test_configurations_are_equally_far_apart_on_the_curve(arm, law):
    places = read_places(arm, law.task, [[2.0, -1.4], [0.3, -0.4]], np.random.default_rng(0))
    owner, q = configurations_at(arm, law.task, places.poses, count=40, seed=0)
    assert list(np.bincount(owner)) == [40, 80]
    assert arm.forward_kinematics(q)[:, :2, 3] == pytest.approx(places.points[owner, :2], abs=1e-9)
    steps = np.linalg.norm(np.diff(q[:40], axis=0), axis=1)  # chords of equal arcs
    assert steps.max() / steps.min() < 1.05


def test_limits_of_a_whole_turn_are_none(arm):
    free = arm.without_idle_limits
    assert np.isinf(free.lower).all()
    panda = hf.arms.load("panda")
    assert panda.without_idle_limits is panda


def test_a_stopped_analysis_goes_on(law, tmp_path, monkeypatch):
    module = sys.modules[hf.Workspace.__module__]
    monkeypatch.setattr(module, "_CHUNK_STARTS", 3)
    options = {"starts": "grid:5", "configurations": 2, "points": 1, "cells": 8}
    seen = []

    def stop(done, total):
        seen.append((done, total))
        if done >= 6:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        hf.workspace(law, [1.5, 1.5], store=tmp_path / "run", progress=stop, **options)
    analysed = []
    analyse = TargetAnalysis.analyse
    monkeypatch.setattr(TargetAnalysis, "analyse", lambda job, *rows: analysed.append(rows[-1]) or analyse(job, *rows))
    again = hf.workspace(law, [1.5, 1.5], store=tmp_path / "run", **options)
    assert sum(analysed) == len(again.places) - 6
    alone = hf.workspace(law, [1.5, 1.5], **options)
    for name, values in again.measures.items():
        assert np.array_equal(values, alone.measures[name], equal_nan=True)
    with pytest.raises(hf.StoreError, match="points"):
        hf.workspace(law, [1.5, 1.5], store=tmp_path / "run", **{**options, "points": 2})


def test_laws_that_differ_in_a_late_digit_are_two_runs(tmp_path):
    arm, options = hf.arms.load("planar-3r"), {"starts": [[1.2, 1.3]], "configurations": 1, "points": 0, "cells": 4}

    def run(damping, gain=1.0):
        law = hf.control.damped(arm, damping, "planar", gain=gain)
        return hf.workspace(law, [1.5, 1.5], store=tmp_path / "run", **options)

    first = run(0.1)
    with pytest.raises(hf.StoreError, match=r'its law is "damped:0.1", but "damped:0.10000001" was requested'):
        run(0.10000001)
    with pytest.raises(hf.StoreError, match=r"its gain is 1.0, but 1.00000001 was requested"):
        run(0.1, 1.00000001)
    np.testing.assert_array_equal(run(0.1).reach.full, first.reach.full)


def test_files(small, tmp_path, monkeypatch):
    w = small["procedure"]
    monkeypatch.setattr(workspace_output, "_list_maps", lambda *given: {})  # those of the command are looked at in its test
    assert [file.name for file in w.save(tmp_path)] == ["workspace.csv", "workspace.json", "report.html"]
    lines = (tmp_path / "workspace.csv").read_text().splitlines()
    assert len(lines) == len(w.places) + 1
    assert "R100_joint1_percent" in lines[0]
    assert "Fsens_any_percent" in lines[0]
    data = json.loads((tmp_path / "workspace.json").read_text())
    assert data == w.to_dict()
    assert data["mean_percent"]["R100"]["any"] == pytest.approx(np.nanmean(w.reach.full[:, 3]))
    assert any("no sink was found at the locked value" in line for line in w.describe())


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"method": "quick"}, "brute, procedure or sampled"),
        ({"relative_to": "all"}, "inside or whole"),
        ({"configurations": 0}, "configurations is 0"),
        ({"points": -1}, "points is -1"),
        ({"target": [9.0, 9.0]}, "within its reach"),
        ({"target": [[1.0, 1.0], [0.5, 1.0]]}, "2 targets"),
        ({"starts": "circle"}, "grid:52"),
        ({"starts": [[1.0, 2.0, 3.0]]}, r"\(P, 2\)"),
        ({"starts": [[1.0, np.nan]]}, "NaN"),
        ({"starts": 0}, "1 or more"),
        ({"sinks": {0: [(0, 1)]}}, "procedure"),
    ],
)
def test_bad_input_is_told(law, change, message):
    options = {"target": [1.5, 1.5], "starts": [[2.0, 2.0]], "configurations": 2, "points": 1} | change
    with pytest.raises(hf.InputError, match=message):
        hf.workspace(law, **options)


def test_an_arm_without_redundancy_is_refused():
    law = pseudoinverse(hf.arms.load("planar-2r"), "planar")
    with pytest.raises(hf.TaskError, match="redundancy"):
        hf.workspace(law, [1.0, 1.0], [[0.5, 0.5]])
    panda = pseudoinverse(hf.arms.load("panda"), "position")
    with pytest.raises(hf.TaskError, match="lattice"):
        hf.workspace(panda, [0.5, 0, 0.5], "grid:5")


def test_measures_as_a_data_set(small):
    w = small["procedure"]
    data = w.to_xarray()
    mean = data.Ravg.sel(joint="any").mean("place", skipna=True)
    assert float(mean) == pytest.approx(w.means()["Ravg"][-1])
    assert int(data.ends.sel(ending="converged").sum()) == w.ends[:, 0].sum()
    at = int(np.argmax(w.configurations))
    assert [float(data[axis][at]) for axis in "xyz"] == w.places.points[at].tolist()
