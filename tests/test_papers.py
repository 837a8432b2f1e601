"""What the papers' folders compute, against numbers found by other routes."""

from __future__ import annotations

import numpy as np
import pytest
from papers.abdi2012.__main__ import nominal
from papers.claims import Claim, table
from papers.english1998 import measures, planar
from papers.english1998.planar import Borders, Planar
from papers.seven_dof import __main__ as seven_dof
from papers.seven_dof import study

import holdfast as hf


@pytest.fixture(scope="module")
def arm() -> Planar:
    return Planar.load()


def test_table():
    assert table([Claim("a", "b", "c", "d")])[-1] == "| a | b | c | d |"
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
    ends = [hf.free_swing(panda, q, k) for k in range(panda.n)]
    away = [np.linalg.norm(e.tool_position[-1] - e.tool_position[0]) for e in ends]
    assert measures.fallen(hf.susceptibility.swing_angle(panda), q[None])[0] == pytest.approx(max(away), abs=1e-3)
    assert measures.moved_after(panda, q, 3) == pytest.approx(ends[3].drops[1].distance, abs=1e-6)


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
        runs = [hf.simulate(law, drawn.q0, drawn.target, [k], time_limit=60.0) for k in range(7)]
        arrived = np.mean([r.outcome == "converged" for r in runs])
        (row,) = (line for line in lines if line.startswith(f"| panda, position | {law.label} | {100 * arrived:.1f} ("))
        assert len(row.split("|")) == 12
    assert {p.name for p in (tmp_path / "figures").iterdir()} == {"panda-position.png", "gains.png", "healthy-position.png"}
    monkeypatch.setattr(study.hf, "compare_laws", lambda *_, **__: pytest.fail("done already"))
    assert seven_dof.run({"position": 6}, ["panda"], tmp_path, tmp_path / "parts") == lines
