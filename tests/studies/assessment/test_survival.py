"""What is left after a lock, against closed forms and brute force."""

import shutil
from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.probability.distribution import Interval
from holdfast.interface.presentation import commands as rerun
from holdfast.kinematics.solvers import solver
from holdfast.model.arm.task import as_task


@pytest.fixture(scope="module")
def arm():
    return hf.arms.load("planar-3r")


@pytest.fixture(scope="module")
def region():
    return hf.Region.box([1.2, 0.3, 0.0], [2.4, 2.4, 0.0])


def annulus(position, joint, angle):
    """Unit-link 3R arm with one joint locked: two links remain, so the hand reaches an annulus (inner, distance, outer)."""
    if joint == 0:  # the foot of what is left is the end of the first link
        foot, links = np.array([np.cos(angle), np.sin(angle)]), (1.0, 1.0)
    else:
        bent = np.sqrt(2 + 2 * np.cos(angle))  # two unit links that keep their angle
        foot, links = np.zeros(2), ((bent, 1.0) if joint == 1 else (1.0, bent))
    # Joint 1 locked: links 1 and 2 are one of length bent, then link 3. Joint 2 locked: link 1, then links 2 and 3 as one.
    return abs(links[0] - links[1]), float(np.linalg.norm(position - foot)), sum(links)


@pytest.mark.parametrize("joint", [0, 1, 2])
def test_a_locked_joint_leaves_an_annulus(arm, rng, joint):
    count = 400
    poses = np.tile(np.eye(4), (count, 1, 1))
    poses[:, :2, 3] = rng.uniform(-2.5, 2.5, (count, 2))
    angles = rng.uniform(-3, 3, count)
    engine = solver(arm, as_task(arm, "planar"))
    found = engine.is_reachable_with_lock(poses, np.full(count, joint), angles, np.random.SeedSequence(1), 30, 1e-6)
    inner, distance, outer = np.array([annulus(p[:2, 3], joint, a) for p, a in zip(poses, angles, strict=True)]).T
    clear = (np.abs(distance - inner) > 1e-3) & (np.abs(distance - outer) > 1e-3)
    truth = (inner < distance) & (distance < outer)
    assert 50 < truth.sum() < 350
    assert not found[clear & ~truth].any()
    assert found[clear & truth].mean() > 0.99  # joints turn by +-pi, so every pose of the annulus has a configuration


def test_shares_are_what_the_rows_say(arm, region):
    run = hf.assess(arm, region, poses=1500, seed=3, task="planar", after_lock=True)
    rows = run.dataset["survives"].values
    reached = run.dataset["status"].values == 0
    assert set(np.unique(rows[reached])) <= {0, 1}
    assert (rows[~reached] == -1).all()
    shares = run.survival()
    assert list(shares) == ["joint1", "joint2", "joint3"]
    for k, share in enumerate(shares.values()):
        assert share == Interval.from_counts(int((rows[:, k] == 1).sum()), 1500)
    assert run.survival("joint2") == {"joint2": shares["joint2"]}
    expected = (2 * shares["joint1"].value + shares["joint3"].value) / 3
    assert run.expected_survival({"joint1": 2.0, 2: 1.0}) == pytest.approx(expected, rel=1e-14)


def test_shares_agree_with_a_plain_monte_carlo_of_annuli(arm):
    run = hf.assess(arm, hf.Region.box([0, 0, 0], [5.0, 5.0, 0.0]), poses=2000, seed=5, task="planar", after_lock=True)
    data = run.dataset
    reached = data["status"].values == 0
    position, q = data["position"].values[reached], data["q"].values[reached]
    generator = np.random.default_rng(0)
    for joint in range(3):
        other = q[generator.integers(len(q), size=len(q)), joint]
        parts = np.array([annulus(p[:2], joint, a) for p, a in zip(position, other, strict=True)])
        share = ((parts[:, 0] < parts[:, 1]) & (parts[:, 1] < parts[:, 2])).sum() / 2000
        interval = run.survival(joint, confidence=0.9999)[f"joint{joint + 1}"]
        assert interval.low - 0.03 < share < interval.high + 0.03


def test_the_seeds_that_a_run_names_give_its_configurations_and_locks(arm, region):
    """By hand: the starts of block b are drawn from the seed (1, b), the locked angles from (3, b)."""
    run = hf.assess(arm, region, poses=60, seed=7, task="planar", after_lock=True)
    assert "starts of block b: (1, b)" in run.plan.to_dict()["seeds"]
    assert "of its locks (3, b)" in run.plan.to_dict()["seeds"]
    engine = solver(arm, as_task(arm, "planar"))
    poses = region.poses(next(region.blocks(0, 7, count=60))[:60])
    found = engine.solve(poses, np.random.SeedSequence(7, spawn_key=(1, 0)), run.plan.restarts, engine.scale_tolerance(1e-6))
    rows, data = np.flatnonzero(found.success), run.dataset
    np.testing.assert_array_equal(data["q"].values[rows], found.q[rows])
    draw = np.random.default_rng(np.random.SeedSequence(7, spawn_key=(3, 0)).spawn(2)[0])
    angles = [found.q[draw.choice(rows, rows.size), k] for k in range(3)]
    np.testing.assert_array_equal(data["lock_angle"].values[rows], np.transpose(angles))


def test_a_weighted_share_of_all_poses_is_1_whatever_the_rounding(arm):
    poses = np.tile(np.eye(4), (3, 1, 1))
    poses[:, 0, 3] = 0.5, 1.0, 1.5
    run = hf.assess(arm, hf.Region.from_poses(poses, [0.1, 0.2, 0.3]), poses=3, task="planar", after_lock=True)
    total = run.distribution.total_weight()
    all_survive = replace(run, survivors=np.full(3, np.nextafter(total, 1)))  # the same weights, added in another order
    for share in all_survive.survival().values():
        assert share.value == share.high == 1


def test_threads_and_folders_do_not_matter(arm, region, tmp_path):
    first = hf.assess(arm, region, poses=1100, seed=2, task="planar", after_lock=True)
    try:
        hf.set_threads(1)
        second = hf.assess(arm, region, poses=1100, seed=2, task="planar", after_lock=True, store=tmp_path / "run")
    finally:
        hf.set_threads(None)
    np.testing.assert_array_equal(first.dataset["survives"].values, second.dataset["survives"].values)
    again = hf.load(tmp_path / "run")
    np.testing.assert_array_equal(again.survivors, first.survivors)
    assert "Poses still reached after a lock" in again.report(tmp_path / "report.html").read_text()


def test_sentences(arm, region):
    run = hf.assess(arm, region, poses=20, seed=1, task="planar")
    with pytest.raises(hf.InputError, match="after_lock=True"):
        run.survival()
    run = hf.assess(arm, region, poses=20, seed=1, task="planar", after_lock=True)
    for rates in ({"joint1": -1.0}, {"joint1": 0.0}, {}, {"joint1": np.nan}):
        with pytest.raises(hf.InputError, match="rates"):
            run.expected_survival(rates)
    with pytest.raises(hf.InputError, match="no joint 'elbow'"):
        run.survival("elbow")
    with pytest.raises(hf.InputError, match="give a box"):
        hf.assess(arm, hf.Region.joints([-1, -1, -1], [1, 1, 1]), poses=10, task="planar", after_lock=True)


def test_optimised_runs_through_the_folder(arm, region, tmp_path):
    plain = hf.assess(arm, region, poses=1100, seed=2, task="planar")
    run = hf.assess(arm, region, poses=1100, seed=2, task="planar", optimise=True, store=tmp_path / "run")
    data = run.dataset
    np.testing.assert_array_equal(data["index"].values, plain.dataset["index"].values)  # the found sample is the same
    reached = data["status"].values == 0
    assert (data["optimised_index"].values[reached] >= data["index"].values[reached]).all()
    again = hf.load(tmp_path / "run")
    h = np.linspace(0, 0.6, 50)
    np.testing.assert_array_equal(again.cdf(h, optimised=True), run.cdf(h, optimised=True))
    assert (run.cdf(h, optimised=True) <= run.cdf(h)).all()
    with pytest.raises(hf.InputError, match="optimise=True"):
        plain.cdf(0.1, optimised=True)
    assert "Gain from choosing the best configurations" in again.report(tmp_path / "report.html").read_text()


def test_rows_hold_the_angle_of_the_lock(arm):
    """With it every answer can be looked at again: it is where some pose of the run had the joint, and the annulus agrees."""
    box = hf.Region.box([0, 0, 0], [5.0, 5.0, 0.0])
    data = hf.assess(arm, box, poses=300, seed=5, task="planar", after_lock=True, locked={"joint3": 0.4}).dataset
    reached, angles, left = data["status"].values == 0, data["lock_angle"].values, data["survives"].values
    assert np.isnan(angles[~reached]).all()
    np.testing.assert_array_equal(angles[reached, 2], 0.4)
    for joint in range(2):
        assert np.isin(angles[reached, joint], data["q"].values[reached, joint]).all()
        assert len(np.unique(angles[reached, joint])) > 20
    for joint in range(3):
        parts = [
            annulus(p[:2], joint, a) for p, a in zip(data["position"].values[reached], angles[reached, joint], strict=True)
        ]
        inner, distance, outer = np.array(parts).T
        clear = (np.abs(distance - inner) > 1e-3) & (np.abs(distance - outer) > 1e-3)
        truth = (inner < distance) & (distance < outer)
        assert (left[reached, joint][clear] == truth[clear]).mean() > 0.99
    given = hf.assess(arm, box, poses=20, seed=5, task="planar", locked={"joint3": 0.4}).dataset["lock_angle"].values
    assert np.isnan(given[:, :2]).all()


@pytest.mark.parametrize("lost", ["lock_angle", "survives", "optimised_worst", "optimised_index", "optimised_q"])
def test_a_lost_column_is_a_sentence_and_not_a_result(arm, region, tmp_path, lost):
    hf.assess(arm, region, poses=50, seed=2, task="planar", optimise=True, after_lock=True, store=tmp_path / "run")
    shutil.rmtree(tmp_path / "run" / "samples.zarr" / lost / "c")
    with pytest.raises(hf.StoreError, match=r"chunk 1 of .* is damaged .*; give 'holdfast study verify"):
        hf.load(tmp_path / "run")


# ---- locks at given angles -----------------------------------------------------------------------------------------

WIDE = hf.Region.box([0, 0, 0], [7.0, 7.0, 0.0])


@pytest.mark.parametrize("angle", [-2.0, 0.3, 1.7])
def test_locks_at_given_angles_leave_the_area_of_their_annuli(arm, angle):
    run = hf.assess(arm, WIDE, poses=2000, seed=7, task="planar", locked={"joint1": angle, 1: angle, "joint3": angle})
    data = run.dataset
    left, position = data["survives"].values, data["position"].values[:, :2]
    for joint in range(3):
        inner, distance, outer = np.array([annulus(p, joint, angle) for p in position]).T
        truth = (inner < distance) & (distance < outer)
        clear = (np.abs(distance - inner) > 1e-3) & (np.abs(distance - outer) > 1e-3)
        found = left[:, joint] == 1
        assert not found[clear & ~truth].any()
        assert found[clear & truth].mean() > 0.99
        area = np.pi * (outer[0] ** 2 - inner[0] ** 2) / 49
        interval = run.survival(joint, confidence=0.9999)[f"joint{joint + 1}"]
        assert interval.low - 0.005 < area < interval.high + 0.005
    assert run.locks == {"joint1": angle, "joint2": angle, "joint3": angle}


def test_poses_of_configurations_with_the_joint_there_are_found(rng):
    """Brute force: whatever the failed arm can stand at is a pose that survives."""
    nine = hf.arms.load("pa10-9dof")
    q = rng.uniform(nine.lower, nine.upper, (150, nine.n))
    q[:, 3] = 1.9
    job = hf.Region.from_poses(nine.forward_kinematics(q))
    run = hf.assess(nine, job, locked={"joint4": 1.9, "joint2": nine.lower[1]})
    assert run.survival("joint4")["joint4"].value > 0.9  # of 20 starts; a lower bound
    assert run.survival("joint2")["joint2"].value < 0.6
    assert run.distribution.reached >= int(run.survivors[3])


def test_joints_not_named_keep_their_rule_or_are_left_out(arm, region, tmp_path):
    plain = hf.assess(arm, region, poses=1100, seed=2, task="planar", after_lock=True)
    mixed = hf.assess(arm, region, poses=1100, seed=2, task="planar", after_lock=True, locked={1: 0.5})
    some = hf.assess(arm, region, poses=1100, seed=2, task="planar", locked={"joint2": 0.5}, store=tmp_path / "run")
    a, b, c = (r.dataset["survives"].values for r in (plain, mixed, some))
    np.testing.assert_array_equal(a[:, [0, 2]], b[:, [0, 2]])
    assert (a[:, 1] != b[:, 1]).any()
    np.testing.assert_array_equal((c[:, 1] == -1), plain.dataset["status"].values != 0)
    assert (c[:, [0, 2]] == -1).all()
    assert list(some.survival()) == ["joint2"]
    assert mixed.locks == {"joint1": None, "joint2": 0.5, "joint3": None}
    again = hf.load(tmp_path / "run")
    assert again.plan.lock_at == some.plan.lock_at == ((1, 0.5),)
    assert again.survival() == some.survival()
    assert some.expected_survival({"joint2": 3.0}) == some.survival()["joint2"].value
    for ask in (lambda: again.survival("joint1"), lambda: again.expected_survival({0: 1.0, 1: 1.0})):
        with pytest.raises(hf.InputError, match="did not compute a lock of 'joint1'"):
            ask()
    with pytest.raises(hf.StoreError, match="its lock_at is"):
        hf.assess(arm, region, poses=1100, seed=2, task="planar", locked={"joint2": 0.6}, store=tmp_path / "run")


@pytest.mark.parametrize("after_lock", [False, True])
def test_report_and_command_say_where_joints_lock(arm, region, tmp_path, after_lock):
    run = hf.assess(arm, region, poses=210, task="planar", after_lock=after_lock, locked={2: -1.25})
    html = run.report(tmp_path / "report.html").read_text().replace("\u00a0", " ")
    assert "−71.6 deg (−1.25 rad)" in html
    assert ("at its position for another pose" in html) == after_lock
    assert "Right: with joint" in html
    assert "--lock joint3=-1.25" in html
    command, _ = rerun.build_command_line(run)
    assert ("--after-lock" in command) == after_lock


def test_sentences_about_given_angles(arm, region):
    limited = hf.arms.load("pa10-9dof")
    for given, sentence in (
        ({"joint2": 9.0}, "'joint2' cannot lock at 9 rad: its limits are"),
        ({"elbow": 0.0}, "no joint 'elbow'"),
        ({7: 0.0}, "joint index 7 is out of range"),
        ({"joint2": np.nan}, "'joint2' is locked at nan; give a finite number, rad"),
        ({"joint2": "x"}, "locked is {'joint2': 'x'}"),
        ({"joint2": 0.1, 1: 0.1}, "'joint2' is locked twice"),
        (0.3, "must be a mapping"),
    ):
        with pytest.raises(hf.InputError, match=sentence):
            hf.assess(arm, region, poses=10, task="planar", locked=given)
    with pytest.raises(hf.InputError, match=r"its limits are -0\.785398 to 0\.785398 rad"):
        hf.assess(limited, hf.Region.around_tool(limited), poses=10, locked={0: 1.0})
    with pytest.raises(hf.InputError, match="give a box"):
        hf.assess(arm, hf.Region.joints([-1, -1, -1], [1, 1, 1]), poses=10, task="planar", locked={0: 1.0})
