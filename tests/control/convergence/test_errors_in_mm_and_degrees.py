"""Errors of tasks with lengths and angles: never one norm over both, on any console, page, or file."""

from __future__ import annotations

import csv

import numpy as np
import pytest

import holdfast as hf
from holdfast.control.equilibria import Kind
from holdfast.core.formatting import format_number


@pytest.fixture(scope="module")
def arm():
    return hf.arms.load("planar-3r")


def errors_by_hand(q, target):
    """Return distances and angles of three links of 1 m, at q (N, 3), from poses (N, 4, 4)."""
    angles = np.cumsum(q, axis=1)
    tool = np.column_stack([np.cos(angles).sum(axis=1), np.sin(angles).sum(axis=1)])
    wanted = np.arctan2(target[:, 1, 0], target[:, 0, 0])
    turned = (angles[:, 2] - wanted + np.pi) % (2 * np.pi) - np.pi
    return np.linalg.norm(tool - target[:, :2, 3], axis=1), np.abs(turned)


@pytest.fixture(scope="module")
def compared(arm):
    laws = [hf.control.pseudoinverse(arm, "planar-pose"), hf.control.damped(arm, 0.3, "planar-pose")]
    drawn = hf.point_to_point(arm, 12, seed=3, distance=(0.3, 2.0))
    return hf.compare_laws(laws, drawn.q0, drawn.target, time_limit=60), drawn.target


def test_cases_have_distance_and_angle_apart(compared):
    result, target = compared
    for name, runs in zip(result.names, result.runs, strict=True):
        distance, angle = errors_by_hand(runs.q_final, np.tile(target, (len(result.failures), 1, 1)))
        for f, failure in enumerate(result.failures):
            case, rows = result.case(name, failure), slice(f * len(result), (f + 1) * len(result))
            np.testing.assert_allclose(case.position_error, distance[rows], atol=1e-7)
            np.testing.assert_allclose(case.angle_error, angle[rows], atol=1e-7)
            np.testing.assert_allclose(np.hypot(case.position_error, case.angle_error), case.error, atol=1e-9)
    row = next(r for r in result.table if (r["law"], r["failure"]) == (result.names[1], "joint2"))
    case = result.case(result.names[1], "joint2")
    assert row["angle_error_rad_75"] == pytest.approx(np.quantile(case.angle_error, 0.75))
    assert "excess_50" not in row


def test_a_comparison_never_states_a_norm(compared, tmp_path):
    result, target = compared
    files = result.save(tmp_path / "r")
    page = next(f for f in files if f.suffix == ".html").read_text(encoding="utf-8")
    assert "m and rad" not in page
    assert "distance from the target, mm" in page
    assert "angle from the target, degrees" in page
    with (tmp_path / "r" / "runs.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert {"position_error_m", "angle_error_rad"} <= rows[0].keys()
    assert not {"error", "excess", "closest"} & rows[0].keys()
    k = next(i for i, r in enumerate(rows) if (r["failure"], r["motion"]) == ("joint1", "5"))
    law = result.names.index(rows[k]["law"])
    ends = result.runs[law].q_final[len(result) * result.failures.index("joint1") + 5]
    distance, angle = errors_by_hand(ends[None], target[5][None])
    assert float(rows[k]["position_error_m"]) == pytest.approx(distance[0], abs=1e-7)
    assert float(rows[k]["angle_error_rad"]) == pytest.approx(angle[0], abs=1e-7)


def test_stationary_points_have_distance_and_angle_apart(arm, tmp_path):
    law, target = hf.control.pseudoinverse(arm, "planar-pose"), arm.forward_kinematics([0.3, 0.9, -0.7])
    points = hf.stationary_points(law, target, {"joint2": 2.0})
    distance, angle = errors_by_hand(points.q, np.tile(target, (len(points), 1, 1)))
    assert len(points)
    np.testing.assert_allclose(points.position_error, distance, atol=1e-7)
    np.testing.assert_allclose(points.angle_error, angle, atol=1e-7)
    page = points.report(tmp_path / "points.html").read_text(encoding="utf-8")
    assert "m and rad" not in page
    holds = points.attracting & (points.kind != Kind.SOLUTION)
    k = int(np.argmin(np.where(holds, np.hypot(distance, angle), np.inf)))
    assert holds[k]
    assert f"{format_number(1000 * distance[k])} mm and {format_number(np.rad2deg(angle[k]))}°" in page.replace("\u00a0", " ")
