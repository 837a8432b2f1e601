"""What is left after a lock, against closed forms and brute force."""

import shutil

import numpy as np
import pytest

import holdfast as hf
from holdfast.arm.task import as_task
from holdfast.assess.distribution import Interval
from holdfast.solve import solver


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
    found = engine.reaches_locked(poses, np.full(count, joint), angles, np.random.SeedSequence(1), 30, 1e-6)
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
        assert share == Interval.of(int((rows[:, k] == 1).sum()), 1500)
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
    assert "What survives a locked joint" in again.report(tmp_path / "report.html").read_text()


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
    assert "What choosing configurations gains" in again.report(tmp_path / "report.html").read_text()


@pytest.mark.parametrize("lost", ["survives", "optimised_worst", "optimised_index", "optimised_q"])
def test_a_lost_column_is_a_sentence_and_not_a_result(arm, region, tmp_path, lost):
    hf.assess(arm, region, poses=50, seed=2, task="planar", optimise=True, after_lock=True, store=tmp_path / "run")
    shutil.rmtree(tmp_path / "run" / "samples.zarr" / lost / "c")
    with pytest.raises(hf.StoreError, match=f"'{lost}' is lost"):
        hf.load(tmp_path / "run")
