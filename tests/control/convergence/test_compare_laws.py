"""Control laws on the same motions, against runs one by one, closed forms and finely sampled paths."""

from __future__ import annotations

import csv
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import cells
import holdfast as hf
import oracles
from holdfast.control.convergence import healthy_cost
from holdfast.control.convergence.healthy_cost import measure_healthy_cost
from holdfast.control.simulation import Reason, batch
from holdfast.interface.presentation.convergence.law_comparison import present
from holdfast.interface.presentation.renderers import build_page
from holdfast.interface.report import page
from holdfast.model.cell import Sphere

sys.path.insert(0, str(Path(__file__).parents[2] / "interface" / "report"))
from wellformed import check

LIMIT = 300.0  # 1/Ke


@pytest.fixture(scope="module")
def arm():
    return hf.arms.load("planar-3r")


@pytest.fixture(scope="module")
def motions(arm, generator):
    return hf.point_to_point(arm, 30, seed=int(generator("laws").integers(1 << 30)))


@pytest.fixture(scope="module")
def laws(arm):
    return [hf.control.pseudoinverse(arm, "planar"), hf.control.damped(arm, 0.3, "planar")]


@pytest.fixture(scope="module")
def compared(laws, motions):
    return hf.compare_laws(laws, motions.q0, motions.target, time_limit=LIMIT)


def test_every_case_is_a_simulation_of_its_own(compared, laws, motions):
    for law in laws:
        for failure in compared.failures:
            case = compared.case(law.label, failure)
            locked = [] if failure == "healthy" else [failure]
            alone = hf.simulate(law, motions.q0, motions.target, locked=locked, time_limit=LIMIT)
            np.testing.assert_array_equal(case.code, alone.code)
            np.testing.assert_array_equal(case.error, alone.error)
            np.testing.assert_array_equal(case.past_limits, alone.limits_passed.any(axis=1))
            np.testing.assert_allclose(case.excursion, (alone.q_high - alone.q_low).sum(axis=1))
            assert case.share("stuck").value == pytest.approx(alone.counts()["stuck"] / 30)


def test_least_errors_are_those_of_the_triangle(compared, motions):
    """A locked joint leaves two links, which reach a ring: closed form."""
    x, q = motions.target[:, :2, 3], motions.q0
    for joint in range(3):
        bent = np.abs(1 + np.exp(1j * q[:, joint]))
        at = np.stack([np.cos(q[:, 0]), np.sin(q[:, 0])], axis=1) if joint == 0 else 0.0
        first, second = [(1.0, 1.0), (bent, 1.0), (1.0, bent)][joint]
        r = np.linalg.norm(x - at, axis=1)
        least = np.maximum(np.maximum(r - (first + second), np.abs(first - second) - r), 0.0)
        np.testing.assert_allclose(compared.least_error[1 + joint], least, atol=1e-5)
        for name in compared.names:
            case = compared.case(name, joint)
            clear = np.abs(least - 1e-5) > 9e-6
            np.testing.assert_array_equal(case.reachable[clear], (least <= 1e-5)[clear])
            assert (case.excess >= 0).all()
            assert not (case.has_outcome("converged") & ~case.reachable).any()


def test_the_healthy_pseudoinverse_costs_nothing_but_time(compared, motions):
    """It goes straight, and its error falls as exp(-Ke t): closed form."""
    cost = compared.healthy[0]
    assert cost.deviation.max() < 1e-7
    assert cost.angle.max() < 1e-6
    expected = np.log(compared.way / (1e-3 * compared.arm.length_unit))
    np.testing.assert_allclose(cost.time, np.maximum(expected, 0.0), atol=1e-5)
    np.testing.assert_allclose(compared.way, motions.distance, atol=1e-12)
    case = compared.case("pseudoinverse")
    np.testing.assert_allclose(case.path_ratio, 1.0, atol=1e-5)


def test_the_cost_of_damping_is_that_of_the_path(compared, laws, motions):
    """Against a finely sampled path of each run."""
    law, cost = laws[1], compared.healthy[1]
    runs = hf.simulate(law, motions.q0, motions.target, time_limit=LIMIT)
    for k in range(4):
        path = runs.path(k, 4000, until=40.0)
        start, goal = path.x[0, :2], motions.target[k, :2, 3]
        along = (goal - start) / np.linalg.norm(goal - start)
        left = path.x[:, :2] - start
        off = np.abs(left @ np.array([-along[1], along[0]])).max()
        assert cost.deviation[k] <= off + 1e-9
        assert cost.deviation[k] == pytest.approx(off, rel=0.05, abs=1e-4)
        near = 1e-3 * law.arm.length_unit
        late = np.flatnonzero(path.error > near)
        if late[-1] + 1 < len(path.time):
            assert cost.time[k] == pytest.approx(path.time[late[-1] + 1], abs=0.05)
        error = np.hstack([goal - path.x[:, :2]])
        rates = law.velocity(path.q, error)
        moved = np.einsum("nij,nj->ni", law.arm.jacobian(path.q)[:, :2], rates)
        cosine = (moved * error).sum(axis=1) / np.linalg.norm(moved, axis=1) / np.linalg.norm(error, axis=1)
        angle = np.arccos(np.clip(cosine, -1, 1))[path.error > near].max()
        assert cost.angle[k] <= angle * (1 + 1e-3) + 1e-6
        assert cost.angle[k] == pytest.approx(angle, rel=0.2, abs=0.02)


def test_differences_are_paired(compared):
    name = "damped:0.3"
    for joint in compared.joints:
        before, after = (compared.case(n, joint).has_outcome("converged") for n in compared.names)
        assert compared.gain(name, joint).value == pytest.approx(after.mean() - before.mean())
        errors = [compared.case(n, joint).error for n in compared.names]
        assert compared.change(name, "error", joint).value == pytest.approx((errors[1] - errors[0]).mean())
    every = compared.gain(name)
    assert every.value == pytest.approx(np.mean([compared.gain(name, j).value for j in compared.joints]))
    assert every.low <= every.value <= every.high
    low, high = compared.gain(name, undecided="against"), compared.gain(name, undecided="for")
    assert low.value <= every.value <= high.value
    same = compared.gain("pseudoinverse", 1, than="pseudoinverse", among_reachable=True)
    assert (same.value, same.p_value) == (0, 1)
    pooled = compared.share_any(name)
    assert pooled.value == pytest.approx(
        np.mean([compared.case(name, j).has_outcome("converged").mean() for j in compared.joints])
    )
    assert pooled.low < pooled.value < pooled.high


def test_the_table_holds_what_the_cases_hold(compared):
    assert len(compared.table) == 2 * 4
    for row in compared.table:
        case = compared.case(row["law"], row["failure"])
        assert sum(row[o] for o in ("converged", "stuck", "moving", "undecided")) == pytest.approx(1)
        assert row["converged_low"] <= row["converged"] <= row["converged_high"]
        assert row["position_error_m_50"] == pytest.approx(np.median(case.error))
        assert row["converged_within_limits"] <= min(row["converged"], 1 - row["past_limits"] + 1e-12)
    assert any("pseudoinverse" in line for line in compared.describe())


def test_a_row_of_the_table_by_runs_of_scipy(compared, motions, arm):
    """Outcomes, errors, ways and excursions with joint 2 locked, from an integrator and a law of its own."""
    row = next(r for r in compared.table if r["law"] == compared.names[1] and r["failure"] == "joint2")
    error, closest, ratio, excursion, past, least, there = (np.zeros(30) for _ in range(7))
    for k, (q0, pose) in enumerate(zip(motions.q0, motions.target, strict=True)):
        target = pose[:2, 3]
        run = oracles.planar_run([1, 1, 1], 0.3, q0, target, 1, LIMIT, 1e-7)
        at = run.sol(np.linspace(0, run.t[-1] ** 0.2, 4000) ** 5).T
        hand = oracles.planar_hand([1, 1, 1], at)
        far = np.linalg.norm(target - hand, axis=1)
        error[k], closest[k], there[k] = far[-1], far.min(), run.t_events[0].size
        ratio[k] = np.linalg.norm(np.diff(hand, axis=0), axis=1).sum() / far[0]
        excursion[k] = np.ptp(at, axis=0).sum()
        past[k] = ((at < arm.lower) | (at > arm.upper)).any()
        middle, inner, outer = oracles.two_link_ring([1, 1, 1], 1, q0[1])
        r = np.linalg.norm(target - middle)
        least[k] = max(inner - r, r - outer, 0.0)
    assert row["converged"] == pytest.approx(there.mean())
    assert row["reachable"] == pytest.approx((least == 0).mean())
    assert row["past_limits"] == pytest.approx(past.mean())
    for level in (5, 25, 50, 75, 95):
        assert row[f"position_error_m_{level:02d}"] == pytest.approx(np.quantile(error, level / 100), abs=1e-5)
        assert row[f"excess_{level:02d}"] == pytest.approx(np.quantile(error - least, level / 100), abs=1e-5)
    assert row["closest"] == pytest.approx(np.median(closest), abs=1e-5)
    assert row["path_ratio"] == pytest.approx(np.median(ratio), rel=1e-3)
    assert row["excursion"] == pytest.approx(np.median(excursion), rel=1e-3)
    assert row["position_error_m_astray"] == pytest.approx(np.median(error[there == 0]), abs=1e-5)


def test_the_report_is_well_formed_and_its_tables_can_be_read(compared, tmp_path):
    told = replace(compared, about="some <motions>")
    html = (
        told.report(tmp_path / "r.html", command="holdfast compare-laws x").read_text(encoding="utf-8").replace("\u00a0", " ")
    )
    check(html)
    assert "some &lt;motions&gt;" in html
    assert "95 %" in html
    files = {}
    *tables, written = compared.save(tmp_path / "tables")
    assert written == tmp_path / "tables" / "report.html"
    for file in tables:
        with file.open(encoding="utf-8", newline="") as stream:
            files[file.name] = len(list(csv.DictReader(stream)))
    assert files == {
        "outcomes.csv": 8,
        "healthy.csv": 2,
        "gains.csv": 4,
        "runs.csv": 240,
    }
    with pytest.raises(hf.StoreError):
        compared.save(tmp_path / "r.html")


def test_nothing_failed_and_control_cycles(laws, motions):
    limited = hf.control.pseudoinverse(laws[0].arm, "planar", speed_limit=0.05)
    found = hf.compare_laws([limited], motions.q0[:4], motions.target[:4], failures=None, cycles=True)
    case = found.case("pseudoinverse")
    assert found.joints == ()
    assert case.has_outcome("converged").all()
    # Straight on at 0.05 m per cycle until within 0.1 m, give or take a cycle for the Euler steps.
    expected = np.ceil((found.way - 0.1) / 0.05)
    assert (np.abs(found.healthy[0].time - expected) <= 1.5).all()
    assert found.healthy[0].deviation.max() < 0.02
    check(compare_html(found))
    with pytest.raises(hf.InputError, match="no joint was locked"):
        found.pool_values("pseudoinverse", "error")


def compare_html(found):
    return page.render(build_page(present(found)))


def test_bad_rows_stay_theirs(laws, motions):
    q0 = motions.q0[:3].copy()
    q0[1, 0] = np.nan
    found = hf.compare_laws({"a": laws[0]}, q0, motions.target[0], failures=["joint2"], time_limit=LIMIT)
    case = found.case("a", "joint2")
    assert case.has_outcome("undecided")[1]
    assert np.isfinite(case.error[[0, 2]]).all()
    assert np.isnan(found.healthy[0].time[1])
    check(compare_html(found))


def test_targets_as_the_rows_of_the_task(laws, motions, compared):
    found = hf.compare_laws(laws[:1], motions.q0[:5], motions.target[:5, :2, 3], failures=[1], time_limit=LIMIT)
    np.testing.assert_allclose(found.way, compared.way[:5], atol=1e-12)
    np.testing.assert_array_equal(found.case("pseudoinverse", 1).code, compared.case("pseudoinverse", 1).code[:5])
    np.testing.assert_allclose(found.healthy[0].time, compared.healthy[0].time[:5], rtol=1e-6)


def test_wrong_input_is_one_sentence(laws, motions, compared, pa10_7):
    q0, target = motions.q0, motions.target
    other = hf.control.damped(pa10_7, 0.1, "position")
    for arguments, words in [
        (([], q0, target), "no law to compare"),
        (([laws[0], laws[0]], q0, target), "two laws have the name 'pseudoinverse'"),
        (([laws[0], other], q0, target), "has another arm or task"),
        ((laws, q0[:3], target[:2]), "q0 has 3 rows and target 2"),
    ]:
        with pytest.raises(hf.InputError, match=words):
            hf.compare_laws(*arguments)
    for failures, words in [
        ("all", "failures 'all' is not known"),
        ([1, "joint2"], "listed twice among the failures"),
        ([["joint1", "joint2"]], "failure 'joint1.joint2' locks several joints at once; give joints that lock one at a time"),
    ]:
        with pytest.raises(hf.TaskError, match=words):
            hf.compare_laws(laws, q0, target, failures=failures)
    for call, words in [
        (lambda: compared.case("magic"), "law 'magic' is not in this comparison"),
        (lambda: compared.case("pseudoinverse", "elbow"), "failure 'elbow' is not in this comparison"),
        (lambda: compared.case("pseudoinverse").share("lost"), "outcome 'lost'"),
    ]:
        with pytest.raises(hf.InputError, match=words):
            call()


def test_a_motion_whose_steps_lead_nowhere_is_not_tried_again_for_each_piece(monkeypatch):
    """Of 30 motions of a PA10's pose one took all 100,000 steps in each of 64 pieces: a quarter of an hour for nothing."""
    arm = hf.arms.load("planar-3r")
    law = hf.control.pseudoinverse(arm, "planar")
    q0 = np.random.default_rng(5).uniform(-2, 2, (40, 3))
    goals = arm.forward_kinematics(np.random.default_rng(6).uniform(-2, 2, (40, 3)))
    whole = measure_healthy_cost(law, q0, goals, False, 0.1)
    monkeypatch.setattr(batch, "MAX_STEPS", 40)
    asked = []

    def told(law, q, *others, **options):
        runs = hf.simulate(law, q, *others, **options)
        asked.append((len(q), int((runs.reason == Reason.STEPS).sum())))
        return runs

    monkeypatch.setattr(healthy_cost, "simulate", told)
    short = measure_healthy_cost(law, q0, goals, False, 0.1)
    rows, out_of_steps = np.array(asked).T
    assert 0 < out_of_steps.sum() < len(q0)
    np.testing.assert_array_equal(rows[1:], rows[:-1] - out_of_steps[:-1])
    same = short.time == whole.time  # those that never ran out go on as they did
    assert np.isnan(short.time[~same]).all()
    assert same.sum() == len(q0) - out_of_steps.sum()
    np.testing.assert_array_equal(short.deviation[same], whole.deviation[same])


DISC_RADIUS, WIDTH = 0.15, 0.03
BOUND = 0.01  # m: spheres that cover a capsule reach so far beyond it at most


def test_what_runs_touch_is_what_plane_geometry_finds_in_their_replay(laws, motions, arm, tmp_path):
    """Runs sampled finely, and the distance of three segments from a disc in closed form."""
    at = (arm.forward_kinematics(motions.q0[0])[:2, 3] + motions.target[0, :2, 3]) / 2  # in the way of the first
    cell = hf.Cell([Sphere("post", DISC_RADIUS, pose=cells.placed(*at, 0))], name="disc")
    clear = hf.Clearance(arm, hf.Capsules.along_links(arm, WIDTH), itself=False)
    some = {"failures": ["joint2"], "time_limit": 100.0}
    count = 5
    c = hf.compare_laws(laws, motions.q0[:count], motions.target[:count], clearance=clear, cell=cell, **some)
    plain = hf.compare_laws(laws, motions.q0[:count], motions.target[:count], **some)
    for name, runs in zip(c.names, c.runs, strict=True):
        for k, failure in enumerate(c.failures):
            case = c.case(name, failure)
            np.testing.assert_array_equal(case.error, plain.case(name, failure).error)
            for m in range(count):
                path = runs.path(count * k + m, samples=3000, until=min(runs.time[count * k + m], 200.0))
                gap = cells.from_disc([1, 1, 1], WIDTH, path.q, at, DISC_RADIUS).ravel()
                if gap.min() < -1e-3 or gap.min() > BOUND:
                    assert case.has_contact[m] == (gap.min() < 0)
                contact = case.contacts[m]
                if gap.min() < -1e-3:
                    assert contact.time <= path.time[int((gap < 0).argmax())] + 1e-6
                if contact is not None:
                    assert contact.object == "post"
                    assert np.interp(contact.time, path.time, gap) < BOUND
    touched = np.array([[case.has_contact for case in (c.case(n, f) for f in c.failures)] for n in c.names])
    assert touched[:, 0, 0].all()
    row = next(r for r in c.table if (r["law"], r["failure"]) == (c.names[1], "joint2"))
    assert row["touched"] == touched[1, 1].mean()
    assert row["converged_clear"] == ((c.case(c.names[1], "joint2").code == 0) & ~touched[1, 1]).mean()
    assert not {"touched", "clearance"} & {*plain.table[0], *plain.to_dict()}
    assert c.to_dict()["clearance"]["cell"]["sha256"] == cell.digest
    c.save(tmp_path)
    rows = list(csv.DictReader((tmp_path / "runs.csv").read_text().splitlines()))
    assert [bool(row["touched_at"]) for row in rows] == touched.ravel().tolist()
    text = " ".join((tmp_path / "report.html").read_text().split())
    check(text)
    for part in ("Contacts on the way", "Contacts are reported, not enforced", cell.digest[:12], "lower bounds"):
        assert part in text
