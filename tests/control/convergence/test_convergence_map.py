"""Maps of how motions end, beside single simulations and closed forms; laws on the same failures."""

from __future__ import annotations

import json

import numpy as np
import pytest

import cells
import holdfast as hf
import oracles
from holdfast.control import damped, pseudoinverse
from holdfast.control.convergence.maps import average_fraction
from holdfast.core.probability.intervals import Interval
from holdfast.interface.presentation.convergence.law_choice import present
from holdfast.model.cell import Sphere


@pytest.fixture(scope="module")
def spatial(generator):
    """Five joints, two of them to spare, and the last one, about the tool's axis, idle."""
    arm = oracles.alternating_arm(generator("maps"), 5)
    return arm.with_tool(oracles.pose(position=0.2 * arm.joints[-1].axis))


@pytest.fixture(scope="module")
def goal(spatial):
    return spatial.forward_kinematics((np.maximum(spatial.lower, -2) + np.minimum(spatial.upper, 2)) / 2 + 0.3)


@pytest.fixture(scope="module")
def sampled(spatial, goal):
    return hf.convergence_map(pseudoinverse(spatial, "position"), goal, 12, configurations=4, seed=3)


@pytest.fixture(scope="module")
def flat():
    """Planar arm: targets on a lattice, one fixed start."""
    law = pseudoinverse(hf.arms.load("planar-3r"), "planar")
    return hf.convergence_map(law, "grid:9", over="targets", q0=[0.3, 0.9, 0.8], time_limit=300.0)


def test_every_run_is_that_of_simulate(sampled, spatial):
    m = sampled
    assert m.code.shape == (12, 4, 6)
    assert spatial.forward_kinematics(m.q0.reshape(-1, 5))[:, :3, 3] == pytest.approx(
        np.repeat(m.places.points, 4, 0), abs=1e-8
    )
    assert ((m.q0 >= spatial.lower) & (m.q0 <= spatial.upper)).all()
    for joint in (0, 1, 3):
        runs = hf.simulate(m.law, m.q0.reshape(-1, 5), m.target[0, 0], locked=[joint], time_limit=500.0, tolerance=1e-8)
        assert (runs.code == m.code[..., joint].ravel()).all()
        assert (runs.limits_passed.any(axis=1) == m.limits_passed[..., joint].ravel()).all()
    healthy = hf.simulate(m.law, m.q0.reshape(-1, 5), m.target[0, 0], time_limit=500.0, tolerance=1e-8)
    assert (healthy.code == m.code[..., 5].ravel()).all()


def test_undecided_runs_have_a_reason(sampled):
    undecided = sampled.has_outcome("undecided")
    assert (undecided == (sampled.reason != 0))[sampled.has_configuration].all()
    assert sum(sampled.count_undecided().values()) == undecided.sum()


def test_joints_that_do_not_move_the_point_do_not_matter(sampled):
    assert (sampled.values("converged")[:, 4] == sampled.values("converged")[:, 5]).all()


def test_shares_and_values_beside_numpy(sampled):
    m = sampled
    total = sum(m.values(word) for word in ("converged", "stuck", "moving", "undecided"))
    assert total == pytest.approx(1)
    assert m.has_outcome("in_reach")[m.has_outcome("converged")].all()
    assert not (m.has_outcome("trapped") & m.has_outcome("converged")).any()
    for k, interval in enumerate(m.shares().values()):
        assert interval.value == pytest.approx((m.code[..., k] == 0).mean())
        assert interval.low <= interval.value <= interval.high
    assert "in reach" in "\n".join(m.describe())


def test_the_interval_knows_that_the_motions_of_a_place_are_alike(rng):
    """Coverage of 95 % for places that all succeed or all fail, and for independent motions, which say more."""
    widths = {}
    for alike in (True, False):
        found = []
        for _ in range(200):
            values = (rng.random(60) < 0.7).astype(float) if alike else rng.binomial(20, 0.7, 60) / 20
            found.append(average_fraction(values, 20, 0.95))
        assert sum(s.low <= 0.7 <= s.high for s in found) >= 180
        widths[alike] = np.mean([s.high - s.low for s in found])
        normal = 2 * 1.96 * np.sqrt(0.21 / (60 if alike else 1200))
        assert normal < widths[alike] < 2.2 * normal
    assert widths[True] > 2.5 * widths[False]


def test_one_motion_of_each_place_is_a_count():
    assert average_fraction(np.array([1.0, 0, 1, np.nan, 1]), 1, 0.95) == Interval.from_counts(3, 4)


def test_reach_with_a_joint_locked_is_that_of_two_links(flat):
    """Joint 2 or 3 of three unit links locked: two links of lengths 1 and |1 + exp(i angle)| about the first joint."""
    m = flat
    r = np.linalg.norm(m.places.points, axis=1)
    for joint in (1, 2):
        other = abs(1 + np.exp(1j * m.q0[0, 0, joint]))
        room = np.minimum(r - abs(other - 1), 1 + other - r)
        clear = np.abs(room) > 1e-3
        assert (m.in_reach[clear, 0, joint] == (room > 0)[clear]).all()
    assert m.q0.shape[1] == 1  # one start: it is not simulated twice
    assert m.has_outcome("converged")[r < 2.9, :, 3].all()


def test_seeds(spatial):
    law = pseudoinverse(spatial, "position")
    a, b, c = (hf.convergence_map(law, 2, 4, configurations=2, seed=s, time_limit=20.0) for s in (1, 1, 2))
    assert np.array_equal(a.q0, b.q0)
    assert np.array_equal(a.code, b.code)
    assert not np.array_equal(a.q0, c.q0)


def test_one_spare_joint_takes_points_of_the_traced_curves(flat, rng):
    law = flat.law
    m = hf.convergence_map(law, [0.9, 0.4], [[1.0, 0.5], [0.2, 0.3]], configurations=6, time_limit=30.0)
    assert m.has_configuration.all()
    there = law.arm.forward_kinematics(m.q0.reshape(-1, 3))[:, :2, 3]
    assert there == pytest.approx(np.repeat([[1.0, 0.5], [0.2, 0.3]], 6, axis=0), abs=1e-8)
    assert len(np.unique(m.q0[0, :, 0])) == 6


def test_places_out_of_reach_are_left_out(spatial, goal):
    law = pseudoinverse(spatial, "position")
    m = hf.convergence_map(law, goal, np.stack([goal[:3, 3], [50.0, 0, 0]]), configurations=2, time_limit=20.0)
    assert list(m.has_configuration.any(axis=1)) == [True, False]
    assert (m.code[1] == 255).all()
    assert np.isnan(m.values()[1]).all()
    far = hf.convergence_map(law, goal, [[50.0, 0, 0]], configurations=2)
    with pytest.raises(hf.InputError, match="within reach"):
        far.shares()


def test_files(sampled, tmp_path):
    names = {file.name for file in sampled.save(tmp_path / "a")}
    assert names == {"map.csv", "map.json", "outcomes.png", "map-top.png", "map-side.png", "report.html"}
    data = json.loads((tmp_path / "a" / "map.json").read_text())
    assert data["motions"] == 48
    assert data["fractions"]["converged"][sampled.columns[3]]["fraction"] == pytest.approx(sampled.values()[:, 3].mean())
    assert len((tmp_path / "a" / "map.csv").read_text().splitlines()) == 13


def test_laws_meet_the_same_failures():
    arm = hf.arms.load("planar-3r")
    plain, weak = pseudoinverse(arm, "planar"), damped(arm, 9.0, "planar")
    choice = hf.compare_laws(
        {"plain": plain, "again": plain, "weak": weak}, 8, [1.5, 1.0], best=True, configurations=2, time_limit=40.0
    )
    assert all(np.array_equal(m.q0, choice.maps[0].q0) for m in choice.maps)
    same = choice.difference("again", "plain")
    assert same.value == 0
    assert same.low == pytest.approx(-same.high)
    assert same.low < -0.1  # eight places without a difference do not prove that there is none
    assert same.p_value == 1
    worse, better = choice.difference("weak", "plain"), choice.difference("plain", "weak")
    assert worse.value == pytest.approx(-better.value)
    assert worse.low == pytest.approx(-better.high, abs=1e-8)
    assert choice.ranking[-1] == "weak"
    assert choice.share("plain", 2).value == pytest.approx(choice.maps[0].values()[:, 2].mean())
    assert worse.value == pytest.approx(choice.share("weak").value - choice.share("plain").value)
    (table,) = present(choice).list_tables()
    assert table.texts().rows[-1][-1] == f"{100 * worse.value:+.1f} ({100 * worse.low:+.1f} to {100 * worse.high:+.1f})"


def test_the_best_law_by_runs_of_scipy():
    """Share of every law, their differences and the ranking, from an integrator and a law of its own."""
    arm = hf.arms.load("planar-3r")
    laws = {"plain": pseudoinverse(arm, "planar"), "weak": damped(arm, 1.5, "planar")}
    choice = hf.compare_laws(laws, 4, [2.1, 1.2], best=True, configurations=2, seed=5)
    shares = {}
    for name, damping in (("plain", 0.0), ("weak", 1.5)):
        q0 = choice.map_of(name).q0
        there = np.zeros((*q0.shape[:2], 3))
        for place in np.ndindex(*q0.shape[:2]):
            for joint in range(3):
                run = oracles.planar_run([1, 1, 1], damping, q0[place], np.array([2.1, 1.2]), joint, 500.0, 1e-6)
                there[place][joint] = run.t_events[0].size > 0
        shares[name] = there.mean(axis=(1, 2))
        assert choice.share(name).value == pytest.approx(shares[name].mean())
        assert choice.share(name, 1).value == pytest.approx(there[..., 1].mean())
    assert 0 < min(s.mean() for s in shares.values()) < 1
    assert choice.difference("weak", "plain").value == pytest.approx((shares["weak"] - shares["plain"]).mean(), abs=1e-12)
    assert choice.share(choice.best).value == pytest.approx(max(s.mean() for s in shares.values()))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"over": "joints"}, "starts or targets"),
        ({"configurations": 0}, "configurations is 0"),
        ({"q0": np.zeros(5)}, "over='targets'"),
        ({"targets": [0.1, 0.2]}, r"\(P, 3\)"),
        ({"over": "targets", "q0": np.full(5, np.nan)}, "NaN"),
        ({"over": "targets", "starts": [[50.0, 0, 0]]}, "within reach"),
    ],
)
def test_bad_input_is_told(spatial, goal, change, message):
    options = {"targets": goal, "starts": 2, "configurations": 2} | change
    with pytest.raises(hf.InputError, match=message):
        hf.convergence_map(pseudoinverse(spatial, "position"), **options)


def test_words_that_are_none_are_told(sampled, spatial):
    with pytest.raises(hf.InputError, match="trapped"):
        sampled.values("lost")
    law = pseudoinverse(spatial, "position")
    with pytest.raises(hf.InputError, match="two or more"):
        hf.compare_laws([law], 1, 1, best=True)
    with pytest.raises(hf.InputError, match="another arm or task"):
        hf.compare_laws({"a": law, "b": pseudoinverse(hf.arms.load("planar-3r"), "planar")}, 1, 1, best=True)


def test_motions_as_a_data_set(sampled):
    data = sampled.to_xarray()
    for k, name in enumerate(sampled.columns):
        share = float((data.code.sel(locked=name) == 0).mean())
        assert share == pytest.approx(sampled.shares()[name].value)
        assert np.array_equal(data.in_reach[..., k], sampled.in_reach[..., k])
    assert np.array_equal(data.q0.sel(joint=sampled.law.arm.joint_names[0]), sampled.q0[..., 0])


def test_the_best_law_in_a_cell_is_told_with_what_it_touches():
    """The cell changes no run, and of each law the runs that touch are those of its own map."""
    arm, cell = hf.arms.load("planar-3r"), hf.Cell([Sphere("post", 0.3, pose=cells.placed(0.9, 1.1, 0))], name="disc")
    laws = {"plain": pseudoinverse(arm, "planar"), "weak": damped(arm, 0.5, "planar")}
    call = {"configurations": 1, "time_limit": 30.0, "seed": 4}
    choice = hf.compare_laws(laws, 2, [1.5, 0.9], best=True, cell=cell, **call)
    plain = hf.compare_laws(laws, 2, [1.5, 0.9], best=True, **call)
    assert choice.ranking == plain.ranking
    alone = hf.convergence_map(laws["weak"], [1.5, 0.9], 2, cell=cell, **call)
    touched = alone.touched[alone.has_configuration]
    np.testing.assert_array_equal(choice.map_of("weak").touched[alone.has_configuration], touched)
    assert choice.share("weak", outcome="touched").value == pytest.approx(touched[:, :-1].mean())
    assert touched.any()
    with pytest.raises(hf.InputError, match="outcome 'touched' is not known"):
        plain.share("plain", outcome="touched")
    assert not any("touch" in line for line in plain.describe())
    told = present(choice)
    assert told.tables[0].headers[-1].label == "touches something, at most"
    assert [row[-1] for row in told.tables[0].rows] == [choice.share(name, outcome="touched").value for name in choice.ranking]
    assert told.answer.endswith("of the motions touch something on the way.")
    assert cell.digest[:12] in dict(told.method)["Contacts"]


def test_what_runs_touch_is_what_plane_geometry_finds_in_their_replay(tmp_path):
    """Runs sampled finely, and the distance of three segments from a disc in closed form."""
    arm, at, radius, width = hf.arms.load("planar-3r"), (0.9, 1.1), 0.3, 0.03
    law = pseudoinverse(arm, "planar")
    cell = hf.Cell([Sphere("post", radius, pose=cells.placed(*at, 0))], name="disc")
    clear = hf.Clearance(arm, hf.Capsules.along_links(arm, width), itself=False)
    call = {"configurations": 2, "time_limit": 100.0, "seed": 4}
    m = hf.convergence_map(law, [1.5, 0.9], 3, clearance=clear, cell=cell, **call)
    plain = hf.convergence_map(law, [1.5, 0.9], 3, **call)
    np.testing.assert_array_equal(m.code, plain.code)
    seen = 0
    for p, c, k in np.argwhere(np.repeat(m.has_configuration[..., None], 4, axis=2)):
        run = hf.simulate(law, m.q0[p, c], m.target[p, c], locked=[k] if k < 3 else [], time_limit=100.0, tolerance=1e-8)
        gap = cells.from_disc([1, 1, 1], width, run.path(samples=1500).q, at, radius).min()
        if gap < -1e-3 or gap > 0.01:  # spheres that cover a capsule reach a little beyond it
            assert m.touched[p, c, k] == (gap < 0)
            seen += 1
    assert seen > 12
    assert 0 < m.touched[m.has_configuration].mean() < 1
    said = m.to_dict()
    assert said["fractions"]["touched"]["none"]["fraction"] == m.values("touched")[:, -1].mean()
    assert said["clearance"]["cell"]["sha256"] == cell.digest
    assert not {"clearance"} & {*plain.to_dict()}
    with pytest.raises(hf.InputError, match="outcome 'touched' is not known; use converged"):
        plain.values("touched")
    text = " ".join(m.report(tmp_path / "report.html").read_text().split())
    for part in ("touch something", cell.digest[:12], "Contacts", "lower bounds"):
        assert part in text
