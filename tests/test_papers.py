"""What the papers' folders compute, against numbers found by other routes."""

from __future__ import annotations

import numpy as np
import pytest
from measurements.seven_dof import __main__ as seven_dof
from measurements.seven_dof import study
from papers.abdi2012.__main__ import nominal
from papers.claims import PAGE, PAPERS, Claim, Verdict, page, read, stored, table
from papers.english1998 import measures, planar
from papers.english1998.planar import Borders, Planar
from papers.goel2003 import laws
from papers.goel2003.peak_error import PeakError, golden
from papers.goel2005 import three_links, two_link_motion, two_links
from papers.numbers import beside
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles


@pytest.fixture(scope="module")
def arm() -> Planar:
    return Planar.load()


def test_table():
    claims = [Claim("a", "b", "c", "d"), Claim("e", "f", "g, h", "i", Verdict.FALSE)]
    assert table(claims)[-1] == "| e | f | g, h | i | false as written |"
    assert read(["text", *table(claims), "", "| x | y |", "|---|---|", "| not | it |"]) == claims
    assert len(nominal(hf.arms.load("pa10-9dof"))) == 2


def test_best_and_worst_of_a_point(arm):
    # Values of an independent implementation, by a scan of all configurations in closed form.
    found = planar.extremes(arm, arm.torque, *planar.POINT)
    np.testing.assert_allclose(found.values, (0.088498, 0.405835), atol=2e-6)
    np.testing.assert_allclose(found.traced, found.values, atol=1e-4)
    np.testing.assert_allclose(arm.largest / 9.81, (4.5, 2, 0.5), rtol=1e-9)


def test_worst_cost_on_the_line_and_its_mirror_image(arm):
    there, back = (arm.run(arm.torque, *planar.LINE, way, gain=planar.TORQUE_GAIN, samples=501) for way in (True, False))
    assert there.on_path
    assert there.value.max() == pytest.approx(0.3815, abs=2e-4)
    np.testing.assert_allclose(back.value, there.value, atol=1e-5)


def test_borders_of_the_region_of_zero_cost_are_algorithmic_singularities(arm, rng):
    search = Borders(arm)
    worst = [(search.closest(x, y)[0] / np.pi) ** 2 for x, y in planar.SWING_LINES]
    np.testing.assert_allclose(worst, 0.021, atol=1e-4)
    found = [b for y in rng.uniform(-1.5, 0.5, 3) for b in search.on_line(float(y))]
    assert len(found) >= 3
    assert max(b.curvature for b in found) < 1e-5
    assert min(b.reach for b in found) > 0.05


def test_joints_of_the_planar_arm_are_where_they_are_drawn(arm, rng):
    q = rng.uniform(-3, 3, 3)
    places = arm.joints(q)
    np.testing.assert_allclose(places[-1], arm.arm.forward_kinematics(q)[:2, 3], atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(np.diff(places, axis=0), axis=1), 1)


def test_where_the_tool_ends_is_where_it_hangs_in_the_simulation():
    panda = hf.arms.load("panda")
    q = np.array(hf.arms.about("panda").home)
    frictions = [hf.Friction(viscous=5 * measures.visible_friction(panda, q, k)) for k in range(panda.n)]
    falls = [
        hf.power_loss(panda, q, free=[k], friction=friction, stops=False, duration=20) for k, friction in enumerate(frictions)
    ]
    start = panda.forward_kinematics(q)[:3, 3]
    away = [np.linalg.norm(fall.tool_at(20.0) - start) for fall in falls]
    assert measures.fallen(hf.susceptibility.swing_angle(panda), q[None])[0] == pytest.approx(max(away), abs=1e-3)
    physical = hf.power_loss(
        panda, q, free=[3], friction=hf.Friction(viscous=measures.visible_friction(panda, q, 3)), stops=False, duration=0.1
    ).physical(clearance=False)
    assert measures.moved_after(panda, q, 3) == pytest.approx(np.linalg.norm(physical.tool_position[-1] - start), abs=1e-6)


# ---- claims --------------------------------------------------------------------------------------------------------------


def test_the_page_of_claims_is_what_the_papers_last_found():
    assert PAGE.read_text(encoding="utf-8") == page(), "run python -m papers.claims"


@pytest.mark.parametrize("name", PAPERS)
def test_every_paper_has_claims_with_a_verdict(name):
    claims = stored(name)
    assert any(c.verdict == Verdict.HOLDS for c in claims)
    assert all(c.where and c.paper and c.ours for c in claims)


def test_differences_are_told():
    assert beside(1.00000049, 1.0) == "1.000000 (0)"
    assert beside(1.5, 1.0, 2) == "1.50 (+0.5)"
    assert beside(-1e-9, 0.0) == "0.000000 (0)"


# ---- Goel, Maciejewski, Balakrishnan 2005 ---------------------------------------------------------------------------------


def test_the_four_targets_of_the_two_link_arm():
    found = [two_link_motion.ended(case) for case in two_link_motion.CASES]
    assert [str(f.run.outcome) for f in found] == ["converged", "stuck", "stuck", "moving"]
    assert two_links.period(found[-1]) == pytest.approx(2 * np.pi / np.sqrt(3), rel=1e-5)
    for f in found[:3]:
        assert f.angle == pytest.approx(f.case.angle, abs=1e-4)
    # (15) is row 2 of the inverse Jacobian times the error
    x, angle = two_link_motion.target(1.7, 50), 0.8
    j = np.array([[-np.sin(angle), -np.sin(angle)], [1 + np.cos(angle), np.cos(angle)]])
    assert two_link_motion.rate(angle, x) == pytest.approx(np.linalg.solve(j, x - two_link_motion.hand(angle))[1])


@pytest.mark.parametrize("joint", [0, 1, 2])
def test_postures_reach_the_place_with_the_joint_where_it_is(joint, rng):
    for angle in rng.uniform(-80, 80, 3):
        found = three_links.postures([1.2, 0.9], joint, angle)
        np.testing.assert_allclose(found[:, joint], angle)
        hand = three_links.law().arm.forward_kinematics(np.deg2rad(found))[:, :2, 3]
        np.testing.assert_allclose(hand, [[1.2, 0.9]] * 2, atol=1e-12)


def test_cases_of_figures_5_to_7():
    for case in three_links.cases():
        run = three_links.run(case.start, case.joint, case.target)
        assert run.outcome == case.outcome, case.name
        assert case.final is None or three_links.away(run.q_final, case.final) < 1e-4


# ---- Goel, Maciejewski, Balakrishnan, Proctor 2003 --------------------------------------------------------------------------


def test_closed_form_of_the_peak_error(rng):
    j, u = rng.normal(size=(6, 4, 6)), rng.normal(size=(6, 4))
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    error = PeakError(j, u, 0.4)
    damping = rng.uniform(0, 2, 6)
    for k in range(6):
        rates = j[k].T @ np.linalg.solve(j[k] @ j[k].T + damping[k] ** 2 * np.eye(4), u[k])
        failed = u[k][:, None] - (j[k] @ rates)[:, None] + j[k] * rates
        assert error(damping)[k] == pytest.approx(np.linalg.norm(failed, axis=0).max(), rel=1e-9)
        most = j[k].T @ np.linalg.solve(j[k] @ j[k].T + error.largest[k] ** 2 * np.eye(4), u[k])
        assert np.linalg.norm(u[k] - j[k] @ most) == pytest.approx(0.4, rel=1e-9)
    np.testing.assert_allclose(error(damping[:, None])[:, 0], error(damping), rtol=1e-12)


def test_searches_of_the_damping():
    found = golden(lambda x: (x - 0.3) ** 2, np.zeros(2), np.array([1.0, 0.2]), 60)
    np.testing.assert_allclose(found, [0.3, 0.2], atol=1e-6)
    q, u = np.array(laws.COUNTEREXAMPLE_Q), np.array(laws.COUNTEREXAMPLE_U)
    error = PeakError(laws.jacobians("pose", q[None]), (u / np.linalg.norm(u))[None], 0.5)
    local = error.golden_section()
    assert local[0] == pytest.approx(0.671012, abs=1e-5)
    assert error(local)[0] == pytest.approx(0.526479, abs=1e-6)
    least, minima = error.dense()
    assert least[0] == pytest.approx(0.430388, abs=1e-6)
    assert minima[0] == 2
    for damping, value in laws.COUNTEREXAMPLE:
        assert error(np.array([damping]))[0] == pytest.approx(value, abs=2e-6)


def test_statistics_of_the_planar_arm():
    s = laws.statistics("planar", 1000)
    assert len(s) == 1000
    told = dict(zip([what for what, _ in laws.EXPECTED], laws.summary(s), strict=True))
    assert told["more than one local minimum, %"] == 0
    assert told["PAD > 30 deg, %"] == pytest.approx(70.5, abs=5)
    assert told["optimum at the largest damping, %"] == pytest.approx(41.6, abs=5)
    assert told["healthy angle, largest, deg"] < 30


def test_the_study_on_real_arms_writes_what_it_counts_and_goes_on_where_it_stopped(tmp_path, monkeypatch):
    arm = hf.arms.load("panda")
    few = [hf.control.pseudoinverse(arm, "position"), hf.control.damped(arm, 0.2, "position")]
    monkeypatch.setattr(study, "laws", lambda *_: few)
    monkeypatch.setattr(study, "TIME_LIMIT", 60.0)
    lines = seven_dof.run({"position": 6}, ["panda"], tmp_path, tmp_path / "parts")
    text = (tmp_path / "RESULTS.md").read_text(encoding="utf-8")
    assert text == "\n".join(lines)
    drawn = hf.point_to_point(arm, 6, seed=study.SEED)
    for law in few:
        runs = [hf.simulate(law, drawn.q0, drawn.target, locked=[k], time_limit=60.0) for k in range(7)]
        arrived = np.mean([r.outcome == "converged" for r in runs])
        (row,) = (line for line in lines if line.startswith(f"| panda, position | {law.label} | {100 * arrived:.1f} ("))
        assert len(row.split("|")) == 12
    assert {p.name for p in (tmp_path / "figures").iterdir()} == {"panda-position.png", "gains.png", "healthy-position.png"}
    monkeypatch.setattr(study.hf, "compare_laws", lambda *_, **__: pytest.fail("done already"))
    assert seven_dof.run({"position": 6}, ["panda"], tmp_path, tmp_path / "parts") == lines


# What a referee found claimed too strongly: a line that we chose, simulated people, values that are hard to read.
@pytest.mark.parametrize(
    ("name", "start", "verdict"),
    [
        ("english1998", "Fig. 5 worst cost on the line", Verdict.OPEN),
        ("english1998", "VI-B entering or leaving", Verdict.HOLDS),
        ("goel2003", "task 24", Verdict.PARTLY),
        ("goel2003", "conclusion: what failure tolerance costs", Verdict.PARTLY),
        ("goel2005", "5.1 R100 of the start of Fig. 5", Verdict.AS_READ),
        ("goel2005", "5.1 R100 of the start of Fig. 6", Verdict.AS_READ),
        ("goel2005", "5.1 F100 of the start of Fig. 6", Verdict.AS_READ),
    ],
)
def test_no_claim_is_stronger_than_its_evidence(name, start, verdict):
    assert [c.verdict for c in stored(name) if c.where.startswith(start)] == [verdict]


def test_the_angle_is_bounded_by_the_error_whatever_the_vectors(rng):
    """A velocity within r < 1 of a unit command is within arcsin r of its direction (theorem in docs/evidence/claims.md)."""
    command = rng.normal(size=(20_000, 4))
    command /= np.linalg.norm(command, axis=1, keepdims=True)
    off = rng.normal(size=command.shape)
    off *= (rng.random(20_000) / np.linalg.norm(off, axis=1))[:, None]
    velocity = command + off
    angle = np.arccos(np.clip((command * velocity).sum(axis=1) / np.linalg.norm(velocity, axis=1), -1, 1))
    assert (angle <= np.arcsin(np.linalg.norm(off, axis=1)) + 1e-7).all()


# ---- the tool of papers/design -------------------------------------------------------------------------------------------


def test_the_better_tool_is_as_good_as_another_program_says(rng):
    """What papers/design finds for the PA10's tool: 0.29 (0.2591 to 0.3081) for 95 % of the poses.

    Transforms, Jacobian and optimiser of our own here; 120 poses of it gave 0.262 with 3 % not reached (measured).
    """
    alpha = np.radians([-90.0, 90, -90, 90, -90, 90, -61.5305, 91.8417, -45])
    a = np.array([0, 0, 0, 0, 0, 0, -0.2, -0.00264183, 0.121807])
    d = np.array([0.315, 0, 0.450, 0, 0.500, 0, 0.582752, 0.132487, 0.020002])
    theta = np.radians([0, 0, 0, 0, 0, 0, -32.2326, 3.56034, 0])
    low = np.radians([-45.0, -15, -45, 45, -45, -27, -45, -9, -45])
    high = np.radians([45.0, 75, 45, 135, 45, 63, 45, 81, 45])
    rows = np.stack([a, alpha, d, theta], axis=1)
    arm = hf.Arm.from_dh([hf.DH(*r, lower=x, upper=y) for r, x, y in zip(rows, low, high, strict=True)])
    index = hf.indices.relative_manipulability(arm)
    poses, best = [], []
    for _ in range(4):
        turn = np.array([0, np.radians(174.0), 0]) + rng.uniform(-np.pi / 4, np.pi / 4, 3)
        place = np.array([0.968, 0, 0.041]) + rng.uniform(-0.25, 0.25, 3)
        poses.append(oracles.pose(Rotation.from_euler("ZYX", turn).as_matrix(), place))
        best.append(oracles.best_worst_rho(rows, low, high, poses[-1], 1, rng))
    found = hf.optimise(arm, np.array(poses), index, seed=1)
    ours = np.where(found.status == 0, found.value, 0.0)
    assert (ours >= np.array(best) - 1e-4).all()  # a single local search of another program finds nothing better
    assert np.median(ours - best) < 0.05
    assert (ours > 0.2591).sum() >= 2  # of 4 with 95 % each: one in 2,000 has fewer than 2
