"""The bound of an arm's distance from a cell, against formulas in NumPy, differences, and points on the arm."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tests import oracles

import holdfast as hf
from holdfast.model.cell import Box, Capsule, Cylinder, HalfSpace, Sphere
from holdfast.model.collision.objects.one_row import SingleConfigurationClearance


def at(x: float, y: float, z: float, turn=None) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    pose[:3, :3] = np.eye(3) if turn is None else turn.as_matrix()
    return pose


def random_cell(rng, count: int = 9) -> hf.Cell:
    made = []
    for k in range(count):
        name, size = f"o{k}", rng.uniform(0.05, 0.3, 3)
        pose = at(*(rng.uniform(0.5, 0.9, 3) * rng.choice([-1, 1], 3)), Rotation.from_rotvec(rng.normal(size=3)))
        kind = k % 5
        if kind == 0:
            made.append(Box(name, size, pose=pose))
        elif kind < 3:
            made.append((Cylinder, Capsule)[kind - 1](name, size[0], size[1], pose=pose))
        else:
            made.append(Sphere(name, size[0], pose=pose, margin=0.05) if kind == 3 else HalfSpace(name, pose=at(0, 0, -1.5)))
    return hf.Cell(made)


def covered(arm, capsules, cell, q):
    """(N, L K) distances of the spheres' centres by NumPy, less the radii."""
    from holdfast.model.collision.sphere_cover import make_sphere_cover

    balls, frames = make_sphere_cover(capsules), arm.frames(q)
    links = sorted({int(x) for x in balls.link if x >= 0})
    out = np.full((len(q), len(links), len(cell)), np.inf)
    for link, centre, radius in zip(balls.link, balls.center, balls.radius, strict=True):
        if link >= 0:
            at = frames[:, link + 1, :3, :3] @ centre + frames[:, link + 1, :3, 3]
            for k, solid in enumerate(cell):
                row = out[:, links.index(link), k]
                np.minimum(row, solid.signed_distance(at) - radius, out=row)
    return out.reshape(len(q), -1)


@pytest.fixture(scope="module")
def scene(generator):
    rng = generator("obstacles")
    arm = oracles.random_arm(rng, types="RPRR", limits=2.0, base=False)
    return arm, hf.Capsules.along_links(arm, 0.03), random_cell(rng)


def test_distances_are_those_of_the_spheres(rng, scene):
    arm, capsules, cell = scene
    clearance = hf.Clearance(arm, capsules, cell, itself=False)
    q = rng.uniform(arm.lower, arm.upper, (300, arm.n))
    expected = covered(arm, capsules, cell, q)
    np.testing.assert_allclose(clearance.by_pair(q), expected, atol=1e-12)
    np.testing.assert_allclose(clearance(q), expected.min(axis=1), atol=1e-12)
    np.testing.assert_allclose(clearance.margin_left(q), (expected - clearance.margins).min(axis=1), atol=1e-12)


def test_no_rows_have_no_distances(scene):
    clearance = hf.Clearance(*scene)
    nothing = np.zeros((0, clearance.arm.n))
    assert clearance.by_pair(nothing).shape == (0, len(clearance.pair_names))
    assert clearance.margin_left(nothing).shape == (0,)
    assert clearance.gradient(nothing).shape == (0, clearance.arm.n)


def test_gradient_agrees_with_differences(rng, scene):
    arm, capsules, cell = scene
    clearance = hf.Clearance(arm, capsules, cell)
    q = rng.uniform(arm.lower, arm.upper, (300, arm.n))
    step = 1e-6
    slope = np.stack(
        [(clearance.margin_left(q + step * e) - clearance.margin_left(q - step * e)) / (2 * step) for e in np.eye(arm.n)],
        axis=1,
    )
    error = np.abs(slope - clearance.gradient(q)).max(axis=1)
    assert np.quantile(error, 0.97) < 1e-6  # the rest are where two pairs tie within the step, or at an edge


@pytest.mark.parametrize("types", ["RPRR", "RRRR"])
def test_no_distance_from_an_object_changes_faster_than_its_bound(rng, types):
    arm = oracles.random_arm(rng, types=types, limits=2.0)
    clearance = hf.Clearance(arm, hf.Capsules.along_links(arm, 0.03), random_cell(rng))
    low, high = (np.where(arm.prismatic, np.clip(x, -1, 1), x) for x in (arm.lower, arm.upper))
    bound = clearance.lipschitz_bounds(low, high)
    a, b = (rng.uniform(low, high, (2000, arm.n)) for _ in range(2))
    b = a + 10 ** rng.uniform(-3, 0, (2000, 1)) * (b - a)
    change = np.abs(clearance.by_pair(a) - clearance.by_pair(b))
    allowed = np.abs(b - a) @ bound.T
    assert (change <= allowed + 1e-9).all()
    assert (change > 0.3 * allowed).any()


def test_a_base_that_touches_an_object_is_refused_with_what_to_say():
    arm = hf.arms.load("panda")
    table = Box("table", [1.0, 1.0, 0.1])
    with pytest.raises(hf.InputError, match=r"may_touch: \[\[table, base\]\]"):
        hf.Clearance(arm, cell=hf.Cell([table]))
    clearance = hf.Clearance(arm, cell=hf.Cell([table], may_touch=[("table", "base")]))
    assert "panda_joint4 & table" in clearance.pair_names


def test_a_pair_that_may_touch_is_not_looked_at(rng):
    arm = hf.arms.load("panda")
    ball = Sphere("ball", 0.3, pose=at(0.5, 0, 0.5))
    cell = hf.Cell([ball], may_touch=[("ball", name) for name in arm.joint_names])
    q = rng.uniform(arm.lower, arm.upper, (50, arm.n))
    clearance = hf.Clearance(arm, cell=cell, itself=False)
    assert (clearance(q) > 1e8).all()


def test_a_changed_cell_compiles_nothing(rng, scene):
    arm, capsules, cell = scene
    first = hf.Clearance(arm, capsules, cell, itself=False)
    second = hf.Clearance(arm, capsules, random_cell(rng, 3), itself=False)
    made = first.obstacles._formula_objects._distance_kernel.source_digest
    assert made is not None
    assert made == second.obstacles._formula_objects._distance_kernel.source_digest


def test_one_row_after_the_other_has_the_same_bits(rng):
    arm = oracles.random_arm(rng, types="RPR", limits=2.0, base=False)  # few joints: this code is compiled on level 1
    q = rng.uniform(arm.lower, arm.upper, (30, arm.n))
    clearance = hf.Clearance(arm, hf.Capsules.along_links(arm, 0.03), random_cell(rng))
    rooms, slopes = clearance.nearest(q)
    one = SingleConfigurationClearance(clearance)
    for row, room, slope in zip(q, rooms, slopes, strict=True):
        found = one(row)
        assert found[0] == room
        np.testing.assert_array_equal(found[1], slope)


def room_of_the_end(clearance, poses, values):
    """(N, V) least room of the last two links with the tool at poses and the last joint at values, by frames and formulas."""
    arm, balls, cell = clearance.arm, clearance.obstacles.spheres, clearance.cell
    last = poses[:, None] @ np.linalg.inv(arm.tool)
    back = np.array([np.linalg.inv(arm.joints[-1].origin @ arm.joints[-1].motion(value)) for value in values])
    out = np.full((len(poses), len(values)), np.inf)
    for link, frame in ((arm.n - 1, last), (arm.n - 2, last @ back)):
        for k in np.flatnonzero((balls.link == link) & (link >= 0)):
            centre = frame[..., :3, :3] @ balls.center[k] + frame[..., :3, 3]
            for solid in cell:
                if (solid.name, arm.joint_names[link]) not in cell.may_touch:
                    np.minimum(out, solid.signed_distance(centre) - balls.radius[k] - cell.margin_of(solid), out=out)
    return out


@pytest.mark.parametrize("types", ["RRPRRR", "RRCRP", "RC", "R"])
def test_a_pose_that_is_never_clear_is_so_wherever_its_last_joint_is(rng, types):
    arm, cell = oracles.random_arm(rng, types=types, limits=2.0), random_cell(rng)
    mounted = [(solid.name, "base") for solid in cell]
    cell = hf.Cell(cell.objects, may_touch=[("o0", arm.joint_names[-1]), *mounted])
    clearance = hf.Clearance(arm, hf.Capsules.along_links(arm, 0.1), cell, itself=False)
    poses = np.array([oracles.random_pose(rng, 1.0) for _ in range(120)])
    low, high = max(arm.lower[-1], -np.pi), min(arm.upper[-1], np.pi)
    best = room_of_the_end(clearance, poses, np.linspace(low, high, 60)).max(axis=1)
    margin = float(np.quantile(best, 0.7))
    found = clearance.obstacles.are_poses_always_colliding(poses, margin)
    # A sphere goes no farther between two of the angles than half of what the joint does between them.
    far = 1.0 if types[-1] == "P" else np.linalg.norm(clearance.obstacles.spheres.center, axis=1).max() + 0.7
    assert not (found & (best >= margin)).any()
    assert found[best < margin - far * (high - low) / 48 - 2e-5].all()
    assert 0 < found.sum() < 120


def test_nothing_is_said_of_a_pose_where_there_is_nothing_to_say_it_by(rng):
    arm = oracles.random_arm(rng, types="RRRR", limits=2.0)
    first = hf.Capsules((hf.collision.LinkCapsule(0, (0, 0, 0), (0.1, 0, 0), radius=0.05),))
    poses = arm.forward_kinematics(rng.normal(size=(3, 4)))
    cloud = hf.cell.Points("scan", points=rng.normal(size=(20, 3)) + 4, radius=0.01)
    for capsules, cell in ((first, random_cell(rng)), (hf.Capsules.along_links(arm, 0.1), hf.Cell([cloud]))):
        seen = hf.Clearance(arm, capsules, cell, itself=False).obstacles
        assert not seen.are_poses_always_colliding(poses, 10.0).any()
        assert seen.are_poses_always_colliding(poses[:0], 10.0).shape == (0,)
