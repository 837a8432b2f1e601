"""The reachability map: annuli of planar arms in closed form, brute force with Pinocchio, and its numpy file."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest

import holdfast as hf
from holdfast import InputError
from holdfast.model.arms.builtin import DATA_FOLDER


def planar_arm(lengths):
    return hf.Arm.from_dh([hf.DH(a=length, alpha=0.0) for length in lengths], name=f"{len(lengths)}R")


def distance_range(centers, size, point):
    """Smallest and largest distance from a point (2,) to squares (V, 2) with edges ``size``."""
    offset = np.abs(centers - point)
    return np.linalg.norm(np.maximum(offset - size / 2, 0), axis=-1), np.linalg.norm(offset + size / 2, axis=-1)


def check_annulus(centers, is_reached, size, point, inner, outer):
    """Every reached square meets the annulus, and every square inside the annulus is reached."""
    nearest, farthest = distance_range(centers, size, point)
    assert not is_reached[(nearest > outer + 1e-9) | (farthest < inner - 1e-9)].any()
    assert is_reached[(nearest >= inner) & (farthest <= outer)].all()


def all_squares(reachability, reach):
    """Centres (V, 2) of the whole grid, and the row of each in the map, -1 if it is not reached."""
    size = reachability.cell_size
    count = int(np.ceil(reach / size))
    steps = np.stack(np.meshgrid(*[np.arange(-count, count + 1)] * 2), axis=-1).reshape(-1, 2)
    found = np.rint(reachability.centers[:, :2] / size).astype(int)
    rows = {tuple(cell): row for row, cell in enumerate(found)}
    return steps * size, np.array([rows.get(tuple(step), -1) for step in steps])


def test_two_links_cover_their_annulus_and_locks_their_circles(rng):
    lengths = rng.uniform([0.8, 0.3], [1.2, 0.7])
    arm, at = planar_arm(lengths), rng.uniform(-2, 2, 2)
    result = hf.reachability_map(arm, at=at, cell_size=0.1, samples=60_000)
    centers, rows = all_squares(result, lengths.sum())
    check_annulus(centers, rows >= 0, 0.1, np.zeros(2), abs(lengths[0] - lengths[1]), lengths.sum())
    survives = np.zeros((len(rows), 2), dtype=bool)
    survives[rows >= 0] = (result.reached_locked > 0).all(axis=2)[rows[rows >= 0]]
    elbow = lengths[0] * np.array([np.cos(at[0]), np.sin(at[0])])
    for joint, (point, radius) in enumerate(
        [(elbow, lengths[1]), (np.zeros(2), abs(lengths[0] + lengths[1] * np.exp(1j * at[1])))]
    ):
        nearest, farthest = distance_range(centers, 0.1, point)
        assert not survives[(nearest > radius + 1e-9) | (farthest < radius - 1e-9), joint].any()
        # A square that the circle cuts by more than a sliver is found.
        cut = (nearest < radius - 0.02) & (farthest > radius + 0.02) & (np.linalg.norm(centers - point, axis=1) - radius < 0.02)
        cut &= np.linalg.norm(centers - point, axis=1) > radius - 0.02
        assert cut.any()
        assert survives[cut, joint].all()


def test_three_links_reach_the_directions_of_their_wrist_annulus(rng):
    lengths = rng.uniform(0.5, 1.0, 3)
    result = hf.reachability_map(planar_arm(lengths), cell_size=0.15, bands=2, samples=300_000, lock_values=1)
    assert result.directions == 8
    centers, rows = all_squares(result, lengths.sum())
    # A pose is reached if and only if the wrist is in the annulus of the first two links.
    fractions = np.linspace(0.02, 0.98, 9)
    inside = np.stack(np.meshgrid(fractions, fractions, np.arange(8)[:, None] + fractions), axis=-1).reshape(-1, 3)
    points = centers[:, None] + 0.15 * (inside[None, :, :2] - 0.5)
    angles = inside[:, 2] * 2 * np.pi / 8
    wrist = np.linalg.norm(points - lengths[2] * np.stack([np.cos(angles), np.sin(angles)], axis=-1), axis=-1)
    is_reached = (wrist >= abs(lengths[0] - lengths[1])) & (wrist <= lengths[0] + lengths[1])
    sector = inside[:, 2].astype(int)
    shares = np.stack([is_reached[:, sector == k].mean(axis=1) for k in range(8)], axis=1)
    reached = np.where(rows >= 0, result.reached[rows], 0)
    assert (reached >= (shares > 0.05).sum(axis=1)).mean() > 0.995
    # Sampled points of a cell can miss a corner that the arm reaches, but only next to a direction that they reach.
    assert (reached > (shares > 0).sum(axis=1) + 1).mean() < 0.005


@pytest.fixture(scope="module")
def panda_map():
    arm = hf.arms.load("panda")
    at = np.array([0.3, -0.7, 0.2, -2.0, 0.1, 1.6, 0.8])
    return at, hf.reachability_map(arm, at=at, cell_size=0.2, bands=2, samples=150_000)


def test_brute_force_with_pinocchio_finds_no_other_cells(panda_map, rng):
    at, result = panda_map
    model = pin.buildModelFromUrdf(str(DATA_FOLDER / "panda.urdf"))
    data, tip = model.createData(), model.getFrameId("panda_hand_tcp")
    joints = [model.joints[model.getJointId(name)].idx_q for name in result.arm.joint_names]
    lower, upper = model.lowerPositionLimit[joints], model.upperPositionLimit[joints]
    rows = {tuple(cell): row for row, cell in enumerate(np.rint((result.centers - [0, 0, 0.333]) / 0.2).astype(int))}
    hits = {}
    for case in range(-1, 7):
        for _ in range(2500):
            q = pin.neutral(model)
            q[joints] = rng.uniform(lower, upper)
            if case >= 0:
                q[joints[case]] = at[case]
            pin.framesForwardKinematics(model, data, q)
            z = data.oMf[tip].rotation[:, 2]
            cell = np.rint((data.oMf[tip].translation - [0, 0, 0.333]) / 0.2).astype(int)
            direction = int(z[2] >= 0) * 4 + int(np.arctan2(z[1], z[0]) % (2 * np.pi) // (np.pi / 2))
            hits.setdefault((case, tuple(cell)), set()).add(direction)
    missed = total = 0
    for (case, cell), directions in hits.items():
        row = rows.get(cell)
        counted = 0 if row is None else int(result.reached[row] if case < 0 else result.reached_locked[row, case, 0])
        missed += max(len(directions) - counted, 0)
        total += len(directions)
    assert total > 3000
    assert missed / total < 0.005
    assert (result.reached <= 8).all()
    assert result.size < 4 / 3 * np.pi * (result.arm.end_to_end + 0.2 * np.sqrt(3)) ** 3


def test_a_lock_never_adds_a_direction(panda_map):
    _, result = panda_map
    assert (result.reached_locked <= result.reached[:, None, None]).all()
    assert (result.locked_index <= result.index[:, None]).all()
    assert (result.harmless_locks >= (result.locked_index > 0)).all()


def test_an_arm_that_cannot_tilt_reaches_one_direction():
    joints = [hf.Joint("lift", "prismatic", np.eye(4), axis=[0, 0, 1], lower=0, upper=0.5)]
    offset = np.eye(4)
    offset[0, 3] = 0.4
    joints += [hf.Joint(name, "revolute", offset, axis=[0, 0, 1], lower=-3, upper=3) for name in ("turn", "elbow")]
    scara = hf.Arm(name="scara", joints=tuple(joints), tool=offset)
    assert set(hf.reachability_map(scara, samples=20_000).reached) == {1}


def test_the_numpy_file_is_read_without_holdfast(panda_map, tmp_path):
    at, result = panda_map
    with np.load(result.to_npz(tmp_path / "map.npz"), allow_pickle=False) as file:
        assert file["joint_names"].tolist() == list(result.arm.joint_names)
        assert file["arm"] == "panda"
        assert np.array_equal(file["lock_values"][:, 0], at)
        assert np.array_equal(file["centers_m"], result.centers)
        assert np.array_equal(file["reached"] / file["directions"], result.index)
        assert np.array_equal(file["reached_locked"].mean(axis=2) / file["directions"], result.locked_index)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"bands": 0}, "bands"),
        ({"samples": 1}, "samples"),
        ({"cell_size": 0.0}, "cell_size"),
        ({"cell_size": 1e-4}, "larger cell_size"),
        ({"at": [9, 0, 0]}, "within the limits"),
        ({"at": [[0, 0, 0], [0, 0, 0]]}, "one configuration"),
    ],
)
def test_bad_options_are_named(options, words):
    arm = hf.arms.load("planar-3r").with_limits([-3] * 3, [3] * 3)
    if options.get("cell_size") == 1e-4:
        arm = hf.arms.load("panda")
    with pytest.raises(InputError, match=words):
        hf.reachability_map(arm, **options)
