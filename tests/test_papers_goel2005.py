"""What papers/goel2005 and the studies around it compute, against closed forms and small runs of other routes."""

from __future__ import annotations

import numpy as np
import pytest
from measurements.stuck_panda import study
from papers.goel2005 import reachability, rest_points, statements, three_links, workspaces
from papers.tolerant_workspace import __main__ as tolerant

import holdfast as hf
from holdfast.control.equilibria import Kind, orbit


def family(degrees, folded, sign, x):
    """Closed form of the rest points with joint 2 locked, rad: theta3 = -theta2 / 2, or that + 180 deg; None: there is none."""
    second = np.deg2rad(degrees)
    third = -second / 2 + (np.pi if folded else 0)
    far = np.exp(1j * second) + np.exp(1j * (second + third))
    cosine = ((1 + far) * far.conjugate()).real / (np.linalg.norm(x) * abs(far))
    if abs(cosine) > 1:
        return None
    return np.array([np.arctan2(x[1], x[0]) + sign * np.arccos(cosine) - np.angle(far), second, third])


# ---- reachability ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("x", [(1.5, 1.5), *reachability.OTHERS])
def test_arcs_are_those_of_the_triangle(x):
    found = reachability.arcs(np.array(x))
    assert reachability.farthest(found, reachability.closed_form(np.array(x))) < 1e-6


def test_the_closed_form_gives_the_printed_bounds():
    assert np.array(reachability.closed_form(three_links.TARGET))[:, 0] == pytest.approx(
        np.array(reachability.PRINTED), abs=0.006
    )


def test_numbers_of_arcs_that_differ_are_told():
    assert reachability.farthest([[(0.0, 1.0)]], [[]]) == np.inf


# ---- rest points -----------------------------------------------------------------------------------------------------------


def test_rest_points_are_those_of_the_specification(monkeypatch):
    monkeypatch.setattr(rest_points, "TABLE", {key: rest_points.TABLE[key] for key in ((0, 125), (1, 100))})
    lines, angle, eigenvalue, more = rest_points.point_table()
    assert angle < 1e-4
    assert eigenvalue < 1e-5
    assert more == 0
    assert not any("(specification" in line for line in lines)


def test_rest_points_are_on_the_closed_form_families(rng):
    x = np.array([1.1, 0.2])
    angle = float(rng.uniform(130, 170))
    found = hf.stationary_points(three_links.law(), x, {1: np.deg2rad(angle)})
    erroneous = found.q[found.kind != Kind.SOLUTION]
    expected = [family(angle, folded, sign, x) for folded in (False, True) for sign in (1, -1)]
    expected = [q for q in expected if q is not None]
    assert len(erroneous) == len(expected)
    for q in expected:
        assert min(three_links.away(p, np.degrees(q)) for p in erroneous) < 1e-6


def test_sinks_folds_and_lines_of_the_three_joints():
    found = rest_points.curves()
    for c, sinks, folds in zip(found, rest_points.SINKS, rest_points.FOLDS, strict=True):
        assert np.degrees(c.sink_arcs) == pytest.approx(np.array(sinks), abs=0.01)
        turns = np.concatenate(
            [three_links.wrapped(np.degrees(k.locked_values[k.folds])) for k in c.curves if not k.degenerate]
        )
        assert np.sort(turns) == pytest.approx(np.array(folds), abs=0.02)
    # Closed form of the fold of joint 3: cos(h) + 2 cos(h)^2 = norm(x), h half its angle.
    half = np.arccos((-1 + np.sqrt(1 + 8 * np.linalg.norm(three_links.TARGET))) / 4)
    assert np.abs(turns) == pytest.approx(np.degrees(2 * half), abs=1e-3)
    assert rest_points.changes(found) == (12, 0)
    assert rest_points.complement(found) < 1e-3
    assert any("| theta3 = -theta2 / 2 |" in line and "| sink |" in line for line in rest_points.range_table(found))


def test_starts_on_either_side_of_the_boundary_end_at_different_solutions():
    found = hf.basins(three_links.law(), three_links.TARGET, {1: np.deg2rad(45)}, grid=12)
    assert found.convergence.value == 1
    assert rest_points.split_by(found) > 0.9
    assert len(rest_points.basin_table(found)) == 4


# ---- statements ------------------------------------------------------------------------------------------------------------


def test_stuck_commands_are_those_of_the_corrected_theorem(monkeypatch):
    monkeypatch.setattr(statements, "TRIALS", 200)
    worst, agree = statements.exact_form()
    assert worst < 1e-9
    assert agree == 200


def test_eigenvalues_cross_the_axis_where_the_determinant_does_not_vanish():
    w = statements.window()
    assert w.hopf == pytest.approx(168.2262, abs=1e-4)
    assert w.fold == pytest.approx(167.909, abs=1e-3)
    assert abs(w.eigenvalue.real) < 1e-6
    assert w.eigenvalue.imag == pytest.approx(0.086, abs=1e-3)
    assert w.determinant > 0
    # By differences of the law on the closed-form family: the trace changes sign there, the determinant does not.
    law = three_links.law()

    def slopes(degrees):
        signs = [family(degrees, False, s, statements.NEAR) for s in (1, -1)]

        def rates(q):
            return law.velocity(q, statements.NEAR - law.arm.forward_kinematics(q)[:2, 3])[[0, 2]]

        columns = [[(rates(q + h) - rates(q - h)) / 2e-6 for h in 1e-6 * np.eye(3)[[0, 2]]] for q in signs]
        return [np.transpose(c) for c in columns]

    before, after = slopes(w.hopf - 0.05), slopes(w.hopf + 0.05)
    crossing = [k for k in range(2) if np.trace(before[k]) < 0 < np.trace(after[k])]
    assert len(crossing) == 1
    assert np.linalg.det(before[crossing[0]]) > 0
    assert np.linalg.det(after[crossing[0]]) > 0


def test_a_reachable_target_without_a_sink_that_is_never_reached():
    points = statements.at(168.42)
    assert statements.kinds(points) == (2, ["saddle", "saddle", "saddle", "source"])
    run = statements.beside_source(points, 3.0)
    assert run.outcome == "moving"
    found = orbit(run)
    assert np.degrees(found.amplitude[0]) == pytest.approx(17.770, abs=2e-3)
    assert found.period == pytest.approx(107.28, abs=0.01)
    assert found.stable


# ---- workspaces ------------------------------------------------------------------------------------------------------------


def test_starts_of_the_specification(monkeypatch):
    places = ((2.0, -1.4), (2, 2), (0.3, -0.4))
    monkeypatch.setattr(workspaces, "TABLE", {x: workspaces.TABLE[x] for x in places})
    lines, gaps, w = workspaces.starts_table(configurations=120, cells=200)
    assert (gaps < (2.5, 0.6, 3.0)).all()
    assert len(lines) == 5
    assert list(w.configurations) == [120, 120, 240]


def test_measures_over_a_small_lattice():
    w, seconds = workspaces.analysis("procedure", 7)
    values = dict(zip((what for what, _ in workspaces.GRID), workspaces.grid_values(w), strict=True))
    assert values["mean R100, %"] == pytest.approx(np.nanmean(w.reach.full[:, 3]))
    assert values["starts with R100 = 0"] == (w.reach.full[:, 3] == 0).sum()
    assert values["first quartile of Ravg, %"] < values["median of Ravg, %"] < values["third quartile of Ravg, %"]
    assert seconds > 0
    assert any("Brute force" in line for line in workspaces.work(w, seconds))


# ---- the Panda, and the failure-tolerant workspace -------------------------------------------------------------------------


def test_stuck_runs_of_the_panda_end_where_rest_points_are():
    found = study.elbow("position", "pseudoinverse", -90.0, starts=8)
    assert sum(found.outcomes.values()) == 8
    assert found.isolated + found.continuum + found.elsewhere == found.outcomes["stuck"] == len(found.errors)
    assert found.elsewhere == 0
    assert found.continuum > 0
    every, attracting = found.levels
    assert set(attracting) <= set(every)
    assert (found.excess >= -1e-9).all()


def test_undecided_runs_widen_the_difference_of_two_laws():
    laws = {name: law for name, law in study.laws("position").items() if name in study.SHOWN[:2]}
    choice = hf.compare_laws(laws, 6, study.target(), best=True, configurations=1, time_limit=20.0, seed=3)
    first, second = choice.names
    d = study.against(choice, first, second)
    assert d.worst <= d.value <= d.best
    assert d.low <= d.value <= d.high
    assert d.value == pytest.approx(-study.against(choice, second, first).value)


def test_no_limits_on_a_coarse_grid_are_better_than_the_optimum():
    best = tolerant.search(20.0, step=60.0)
    assert best.tried == len(tolerant.grid(20.0, 60.0))
    assert best.area < 3.5621
    region = hf.tolerant_workspace(hf.arms.load("planar-3r"), task="planar", limits=np.radians(best.limits))
    assert region.size == pytest.approx(best.area, abs=1e-3)
