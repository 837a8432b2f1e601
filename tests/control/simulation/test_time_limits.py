"""How a run ends does not depend on the time limit: what a short limit claims, a longer one confirms."""

from __future__ import annotations

import csv

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import holdfast as hf
from holdfast.control.simulation import Reason, RunOutcome, simulate

LIMITS = (5.0, 10.0, 20.0, 60.0, 3000.0, 20_000.0)
DECIDED = (RunOutcome.CONVERGED, RunOutcome.STUCK, RunOutcome.MOVING)


def random_motions(arm, count, generator):
    low, high = (np.where(np.isfinite(x), x, d) for x, d in ((arm.lower, -np.pi), (arm.upper, np.pi)))
    starts, ends = generator.uniform(low, high, (2, count, arm.n))
    return starts, arm.forward_kinematics(ends), generator.integers(0, arm.n, count)


@pytest.mark.parametrize(("name", "task", "count"), [("planar-3r", "planar", 250), ("panda", "position", 60)])
def test_a_longer_limit_contradicts_no_shorter_one(name, task, count, rng):
    arm = hf.arms.load(name)
    law = hf.control.pseudoinverse(arm, task)
    q0, target, locked = random_motions(arm, count, rng)
    runs = [simulate(law, q0, target, locked=locked, time_limit=limit) for limit in LIMITS]
    known = np.full(count, RunOutcome.UNDECIDED)
    for limit, found in zip(LIMITS, runs, strict=True):
        decided = np.isin(found.code, DECIDED)
        both = decided & (known != RunOutcome.UNDECIDED)
        np.testing.assert_array_equal(found.code[both], known[both])
        # A run that was at rest stays so; one that repeats its motion may run out of steps only.
        rested = np.isin(known, (RunOutcome.CONVERGED, RunOutcome.STUCK))
        assert decided[rested].all()
        known[decided] = found.code[decided]
        for k in np.flatnonzero(found.reason == Reason.TIME_LIMIT)[:3]:
            assert found.time[k] == pytest.approx(limit)
            assert found.ending_sentence(k) == f"is still moving at the limit of {limit:g} s"
    assert (known == RunOutcome.UNDECIDED).mean() < 0.1


def test_what_never_stops_repeats_itself(rng):
    """By SciPy, for as long again as the horizon of a default run: the same extent and never at rest."""
    arm = hf.arms.load("planar-3r")
    law = hf.control.pseudoinverse(arm, "planar")
    q0, target, locked = random_motions(arm, 400, rng)
    runs = simulate(law, q0, target, locked=locked, time_limit=60.0)
    moving = np.flatnonzero(runs.outcome == "moving")
    assert moving.size
    for k in moving[:2]:
        mask, goal = np.arange(3) != locked[k], target[k, :2, 3]

        def rates(_, q, mask=mask, goal=goal):
            angle = np.cumsum(q)
            j = np.array([-np.cumsum(np.sin(angle)[::-1])[::-1], np.cumsum(np.cos(angle)[::-1])[::-1]])
            return mask * (np.linalg.pinv(j) @ (goal - [np.cos(angle).sum(), np.sin(angle).sum()]))

        later = solve_ivp(rates, (0, 150), runs.q_final[k], "DOP853", rtol=1e-9, atol=1e-11, dense_output=True)
        q = later.sol(np.linspace(0, 150, 3001)).T
        speed = np.linalg.norm([rates(0, x) for x in q], axis=1)
        assert speed.min() > 1e-3
        assert speed[1500:].min() == pytest.approx(speed[:1500].min(), rel=0.05)
        assert speed[1500:].max() == pytest.approx(speed[:1500].max(), rel=0.05)


def test_an_arm_that_slows_down_is_still_moving_at_every_limit_but_the_last():
    """The found case: fast at its limits of 5 to 60 s, and at its target in the end."""
    arm = hf.arms.load("planar-3r")
    law = hf.control.pseudoinverse(arm, "planar")
    rng = np.random.default_rng(1)
    q0, target = rng.uniform(-np.pi, np.pi, (400, 3)), arm.forward_kinematics(rng.uniform(-np.pi, np.pi, (400, 3)))
    locked = rng.integers(0, 3, 400)
    k = 129
    words = [simulate(law, q0[k], target[k], locked=[int(locked[k])], time_limit=limit).ending_sentence() for limit in LIMITS]
    assert words == [f"is still moving at the limit of {t:g} s" for t in LIMITS[:4]] + ["reaches the target"] * 2


def test_neither_the_page_nor_the_table_ends_before_the_motion(tmp_path):
    """A run that moves for 500 s is drawn and written to its end; the rest of a repeated motion is left out with a sentence."""
    arm = hf.arms.load("planar-3r")
    law = hf.control.pseudoinverse(arm, "planar")
    slow = simulate(law, np.deg2rad([88.0, -34.4697, 131.81]), [1.5, 1.5], locked=[0], time_limit=500.0)
    cycle = simulate(law, np.deg2rad([-130.0, 168.30, -84.0]), [0.9, 0.0], locked=[1])
    for runs in (slow, cycle):
        rows = list(csv.DictReader(runs.to_csv(tmp_path / "run.csv").read_text().splitlines()))
        assert float(rows[-1]["time_s"]) == pytest.approx(float(runs.time))
        assert "position_error_mm" in rows[0]
        assert "angle_error_deg" not in rows[0]
        np.testing.assert_allclose(float(rows[-1]["position_error_mm"]), 1000 * runs.error, atol=1e-6)
    page = cycle.report(tmp_path / "cycle.html").read_text()
    assert "never stops, because it repeats its motion" in page
    assert "The figure ends after 200" in page
    assert "no visible motion" not in page
