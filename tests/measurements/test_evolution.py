"""Designs by an evolution strategy: workspaces against sampling and closed forms, self-motions against the tracer."""

import numpy as np
import pytest
from measurements.record_designs.__main__ import main
from measurements.record_designs.annuli import compute_tolerant_area
from measurements.record_designs.self_motions import design_for_self_motion
from measurements.record_designs.strategy import minimise_by_evolution
from measurements.record_designs.sweeps import SelfMotionTracer
from measurements.record_designs.workspaces import design_for_workspace

import holdfast as hf
from holdfast.kinematics.workspace.closed_form import ThreeLinks, workspace_area
from holdfast.studies.designs.family import Family

FULL = [-np.pi, np.pi]
LENGTHS = {"a1": (0.05, 2.9), "a2": (0.05, 2.9), "a3": (0.05, 2.9)}


def planar(n, length):
    return hf.Arm.from_dh([hf.DH(length, 0.0, 0.0)] * n, name=f"planar-{n}r")


def test_the_strategy_finds_the_bottom_of_a_long_valley(rng):
    turn = np.linalg.qr(rng.normal(size=(6, 6)))[0]

    def cost(x):
        return ((x - 0.3) @ turn) ** 2 @ 10.0 ** np.arange(6)

    told = []
    x, least = minimise_by_evolution(
        cost,
        np.zeros(6),
        np.ones(6),
        population=16,
        generations=400,
        rng=rng,
        on_generation=lambda c: told.append(c) or c < 1e-12,
    )
    assert least == pytest.approx(cost(x[None])[0])
    assert least < 1e-12
    assert x == pytest.approx(0.3, abs=1e-5)
    assert len(told) < 400


def test_rings_are_the_closed_form_of_three_joints(rng):
    count = 60
    lengths = np.column_stack([rng.uniform(0.2, 0.6, count), rng.uniform(0.8, 1.4, (count, 2))])
    middle, half = rng.uniform(-2.5, 2.5, count), rng.uniform(0, 0.4, count)
    limits = np.stack([middle - half, middle + half], axis=1)
    found = compute_tolerant_area(lengths, limits[:, None], 401)
    exact = [
        workspace_area(ThreeLinks(each, np.zeros(2), np.zeros(3), np.ones(3)), np.array([[FULL, FULL, pair]]), 400)[0]
        for each, pair in zip(lengths, limits, strict=True)
    ]
    assert (found > 0).sum() > 20
    assert found == pytest.approx(np.array(exact), abs=2e-3)


def sampled_area(lengths, limits):
    """Of a planar arm of four joints by angles drawn, for radii on a grid: nothing of closed forms."""
    rng = np.random.default_rng(0)
    ends = np.vstack([[FULL], [FULL], limits])

    def distances(links, low, high, count=6_000):
        turns = np.cumsum(rng.uniform(low, high, (count, len(links))), axis=1)
        found = abs(np.exp(1j * turns) @ links)
        return found.min(), found.max()

    r = np.linspace(0, lengths.sum(), 301)
    low, high = distances(lengths, *ends.T)
    inside = (r >= low) & (r <= high)
    for k in range(1, 4):
        for angle in np.linspace(*ends[k], 9):
            joined = np.array([*lengths[: k - 1], abs(lengths[k - 1] + lengths[k] * np.exp(1j * angle)), *lengths[k + 1 :]])
            low, high = distances(joined, *np.tile(FULL, (3, 1)).T)
            inside &= (r >= low) & (r <= high)
    low, high = distances(lengths[1:], *np.tile(FULL, (3, 1)).T)
    for direction in np.linspace(0, np.pi, 21):
        away = abs(r - lengths[0] * np.exp(1j * direction))
        inside &= (away >= low) & (away <= high)
    return 2 * np.pi * np.trapezoid(r * inside, r)


def test_rings_of_four_joints_are_what_sampling_finds(rng):
    for lengths, limits in (
        ([0.3, 1.2, 0.3, 1.2], [FULL, FULL]),
        ([0.4, 1.0, 0.6, 1.0], [[0.2, 1.0], [-0.5, 0.9]]),
        ([0.3, 1.1, 0.5, 1.1], [[-2.0, -1.0], [1.0, 2.0]]),
    ):
        lengths, limits = np.array(lengths), np.array(limits)
        found = float(compute_tolerant_area(lengths[None], limits[None], 41)[0])
        assert found > 1
        assert found == pytest.approx(sampled_area(lengths, limits), rel=0.08)


def test_free_links_of_three_joints_reach_a_third_of_the_disc():
    found = design_for_workspace(planar(3, 1.0), LENGTHS, generations=36, restarts=1, seed=1)
    assert found.bound == pytest.approx(3 * np.pi)
    assert 9.40 < found.value <= found.bound * (1 + 1e-9)
    assert found.values.sum() == pytest.approx(3)
    assert hf.tolerant_workspace(found.arm(), "planar", found.limits).size == pytest.approx(found.value, rel=5e-3)
    assert 3.4 < found.given < 3.6  # equal links: 3.5621 with limits of joint 1 (Bader 2020)
    assert "bound is for arms whose joint 1 has no limits" in found.describe()[1]


def test_four_joints_with_a_least_link():
    bounds = {f"a{k}": (0.3, 2.1) for k in (1, 2, 3, 4)}
    found = design_for_workspace(planar(4, 0.75), bounds, generations=150, restarts=1)
    assert found.bound == pytest.approx(np.pi * 2.4**2)
    assert 18.0 < found.value <= found.bound * (1 + 1e-9)


def test_no_random_links_and_limits_are_above_the_bound(rng):
    lengths = rng.dirichlet(np.ones(3), 3000) * 3
    limits = np.sort(rng.uniform(-3, 3, (3000, 1, 2)), axis=2)
    limits[::2, :, 1] = limits[::2, :, 0] + 1e-3
    found = compute_tolerant_area(lengths, limits, 41)
    assert 7 < found.max() <= 3 * np.pi


def test_a_full_self_motion_of_four_joints_is_found():
    record = hf.designs.record_design("self-motion-position-4R-001")
    vary = {
        f"{kind}{k}": (-w, w)
        for k in (1, 2, 3, 4)
        for kind, w in (("a", 1.0), ("d", 1.0), ("alpha", 3.0))
        if (kind, k) != ("d", 1)
    }
    sweeps = SelfMotionTracer(Family(hf.designs.design_space(record.arm, vary), task="position"))
    start = sweeps.family.space.start[None]
    swept = sweeps(np.vstack([start, start]), np.vstack([record.q, record.q + 0.02]), 0.05)
    assert swept.is_closed.all()
    assert abs(swept.winding).tolist() == [[1, 2, 1, 1]] * 2
    found = design_for_self_motion(record.arm, vary, task="position", seed=2)
    assert found.value == pytest.approx(4)
    assert (found.winding != 0).all()
    arm = found.arm()
    assert hf.self_motion(arm, arm.forward_kinematics(found.q), "position", spacing=0.05, starts=3).size == pytest.approx(
        8 * np.pi
    )


def test_what_no_design_is_searched_for():
    with pytest.raises(hf.TaskError, match="the size of a self-motion is that of a curve"):
        design_for_self_motion(planar(4, 1.0), {"a1": (0.5, 2)}, task="planar")
    with pytest.raises(hf.InputError, match="is no planar arm"):
        design_for_workspace(hf.arms.load("panda"), {"a4": (-0.2, 0.2)})
    with pytest.raises(hf.InputError, match="'theta2' is no link length"):
        design_for_workspace(planar(3, 1.0), {"theta2": (-1, 1)})
    with pytest.raises(hf.InputError, match="give at least 1"):
        design_for_workspace(planar(3, 1.0), LENGTHS, generations=0)


def test_the_command_searches_and_writes_the_arm(tmp_path, capsys):
    file = tmp_path / "best.yaml"
    words = ["tolerant-workspace", "planar-3r", "--vary", "a1=0.5..2", "--vary", "a2=0.5..2", "--restarts", "1"]
    assert main([*words, "--generations", "3", "--out", str(file)]) == 0
    said = capsys.readouterr().out
    assert said.startswith("tolerant-workspace: ")
    assert "a2 = " in said
    assert hf.arms.load(str(file)).n == 3
    assert main(["self-motion-size", "self-motion-position-4R-001", "--vary", "a1=0.1..2", "--restarts", "0"]) == 2
    assert "give at least 1" in capsys.readouterr().err
