"""Directional velocity: what it means, where it is 0, and that its setting goes wherever the index goes."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast.core.errors import StoreError
from holdfast.kinematics.indices import directional_velocity, minimum_singular_value

LABEL = "directional-velocity:1,0,0"


@pytest.fixture(autouse=True)
def _no_compilation(monkeypatch):
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")


def test_no_rates_of_norm_one_are_faster_and_some_are_as_fast(mixed7, rng):
    """Random unit rates of the failed arm, projected so that the other rows are at rest, never pass it; the best meet it."""
    q, u = oracles.inside(mixed7, rng, 1)[0], rng.normal(size=3)
    u /= np.linalg.norm(u)
    by_joint = directional_velocity(mixed7, 3 * u, "position").by_joint(q)
    for k, limit in enumerate(by_joint):
        j = np.delete(oracles.jacobian(mixed7, q[None])[0, :3], k, axis=1)
        across = np.linalg.svd(u[None])[2][1:] @ j
        kept = np.linalg.svd(across)[2][2:]  # rates that move the tool along u alone
        rates = kept.T @ rng.normal(size=(len(kept), 500))
        speeds = np.abs(u @ j @ rates) / np.linalg.norm(rates, axis=0)
        assert speeds.max() <= limit * (1 + 1e-9)
        best = kept.T @ (kept @ (u @ j))
        np.testing.assert_allclose(u @ j @ best / np.linalg.norm(best), limit, rtol=1e-9)


def test_neither_the_length_nor_the_size_of_the_direction_counts_and_a_side_has_no_sign(mixed8, rng):
    q, u = oracles.inside(mixed8, rng, 20), rng.normal(size=3)
    expected = directional_velocity(mixed8, u).by_joint(q)
    for direction, length in ((u, 0.2), (7 * u, 1.0), (-u, 3.0)):
        found = directional_velocity(mixed8, direction, length=length).by_joint(q)
        np.testing.assert_allclose(found, expected, rtol=1e-7, atol=1e-12)


def test_the_slowest_direction_is_the_smallest_singular_value(mixed7, rng):
    """Of a position, with each joint locked in turn: the left singular vector."""
    q = oracles.inside(mixed7, rng, 1)[0]
    j = oracles.jacobian(mixed7, q[None])[0, :3]
    expected = minimum_singular_value(mixed7, "position").by_joint(q)
    for k in range(7):
        slowest = np.linalg.svd(np.delete(j, k, axis=1))[0][:, -1]
        assert directional_velocity(mixed7, slowest, "position").by_joint(q)[k] == pytest.approx(expected[k], rel=1e-9)


def test_where_the_failed_arm_cannot_move_along_it_alone():
    """Four slides, one along z: with that one locked z is lost and x is not, although the other rows are singular."""
    axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0]]
    joints = tuple(hf.Joint(f"s{k}", "prismatic", np.eye(4), axis=np.array(a, float)) for k, a in enumerate(axes))
    arm, q = hf.Arm(name="slides", joints=joints), np.zeros(4)
    along_z = directional_velocity(arm, [0, 0, 1], "position")
    np.testing.assert_allclose(along_z.by_joint(q), [1, 1, 0, 1], atol=1e-12)
    np.testing.assert_array_equal(along_z.gradient(q), 0)
    along_x = directional_velocity(arm, [1, 0, 0], "position").by_joint(q)
    # x alone needs y = 0: of x, y and the diagonal d = (1, 1) / sqrt(2) the least rates for x = 1.
    alone = 1 / np.linalg.norm(np.linalg.pinv([[1, 0, np.sqrt(0.5)], [0, 1, np.sqrt(0.5)]]) @ [1, 0])
    np.testing.assert_allclose(along_x, [np.sqrt(0.5) / np.sqrt(1.5), 1, alone, 1], atol=1e-12)


def test_a_results_folder_and_its_report_hold_the_setting(tmp_path):
    arm, region = hf.arms.load("planar-3r"), hf.Region.joints([0.1, 0.3, 0.5], [0.5, 0.7, 0.9])
    index = directional_velocity(arm, [1, 0, 0], "planar")
    run = hf.assess(arm, region, index, poses=30, seed=1, store=tmp_path / "run")
    loaded = hf.load(tmp_path / "run")
    assert loaded.index.label == LABEL
    assert type(loaded.index) is type(index)
    np.testing.assert_array_equal(loaded.dataset["index"].values, run.dataset["index"].values)
    page = run.report(tmp_path / "report.html").read_text(encoding="utf-8")
    for said in (f"--index {LABEL}", "directional velocity along 1, 0, 0", "direction 1,0,0", "Source: Chiu 1988"):
        assert said in page
    with pytest.raises((StoreError, hf.InputError), match='but "directional-velocity:0,1,0" was requested'):
        hf.assess(arm, region, "directional-velocity:0,1,0", poses=30, seed=1, store=tmp_path / "run", task="planar")


def test_it_can_be_optimised():
    arm = hf.arms.load("planar-3r")
    start = np.array([0.3, 0.5, 0.7])
    index = directional_velocity(arm, [1, 0, 0], "planar")
    found = hf.optimise(arm, arm.forward_kinematics(start), index, task="planar", starts=64)
    every = oracles.three_link_fibre(arm, arm.forward_kinematics(start)[:2, 3], 4000)
    best = index(every).max()  # of points 1.6e-3 rad apart; the maximum is a crease
    assert best - 1e-9 <= found.value <= best + 5e-3


def test_a_study_holds_the_setting(tmp_path):
    from holdfast.studies import read_study_file

    file = tmp_path / "study.yaml"
    file.write_text(
        "seed: 1\nposes: 4\nchunk: 4\narms: [planar-3r]\n"
        "assess: {indices: ['directional-velocity:direction=1,0,0', manipulability]}\n"
    )
    one, other = read_study_file(file).cells
    assert one.plan["index"] == LABEL
    assert other.plan["index"] == "manipulability"
