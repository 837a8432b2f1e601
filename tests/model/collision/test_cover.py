"""Covers of collision shapes, against coal and against random points of the shapes themselves."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast import arms
from holdfast.core.errors import ArmError, InputError
from holdfast.model.arms.builtin import DATA_FOLDER
from holdfast.model.cell.solids import Box, Capsule, Cylinder, Sphere
from holdfast.model.collision.cover import MAX_MEAN_EXCESS_M, choose_capsules, fit_capsules, make_cover
from holdfast.model.collision.shape import CollisionModel, corner_points
from holdfast.model.collision.sphere_cover import make_sphere_cover
from oracles import random_pose

FAR = np.array([[1.0, 0, 0, 5], [0, 1, 0, 5], [0, 0, 1, 5], [0, 0, 0, 1]])

ARM = """
<robot name="three"><link name="foot"><collision><geometry>{foot}</geometry></collision></link>
<link name="upper"><collision><origin xyz="0 0 0.2" rpy="0.1 0 0"/>
<geometry><box size="0.1 0.08 0.4"/></geometry></collision></link>
<link name="lower"><collision><origin xyz="0.15 0 0" rpy="0 1.5707963267948966 0"/>
<geometry><cylinder radius="0.05" length="0.3"/></geometry></collision></link>
<link name="tip"><collision><geometry><sphere radius="0.07"/></geometry></collision></link>
<joint name="a" type="continuous"><parent link="foot"/><child link="upper"/><axis xyz="0 1 0"/></joint>
<joint name="b" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="0 0 0.4"/><axis xyz="0 1 0"/></joint>
<joint name="c" type="fixed"><parent link="lower"/><child link="tip"/><origin xyz="0.3 0 0"/></joint></robot>
"""

MODEL = """
<mujoco model="three"><compiler angle="radian"/><worldbody><geom type="plane" size="1 1 1"/><body name="foot">
<geom type="box" size="0.1 0.1 0.05"/><geom type="box" size="1 1 1" contype="0" conaffinity="0"/>
<body name="upper"><joint name="a" axis="0 1 0"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
<geom type="box" size="0.05 0.04 0.2" pos="0 0 0.2" euler="0.1 0 0"/>
<body name="lower" pos="0 0 0.4"><joint name="b" axis="0 1 0"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
<geom type="cylinder" size="0.05 0.15" pos="0.15 0 0" euler="0 1.5707963267948966 0"/>
<body name="tip" pos="0.3 0 0"><geom type="sphere" size="0.07"/></body></body></body></body></worldbody></mujoco>
"""


@pytest.fixture(scope="module")
def panda() -> tuple[hf.Arm, CollisionModel, hf.Capsules]:
    arm = arms.load("panda")
    shape = CollisionModel.from_arm(arm)
    return arm, shape, make_cover(shape, arm)


@pytest.fixture
def three(tmp_path: Path) -> hf.Arm:
    return write(tmp_path, "<box size='0.2 0.2 0.1'/>")


def write(folder: Path, foot: str) -> hf.Arm:
    (folder / "three.urdf").write_text(ARM.format(foot=foot))
    return hf.Arm.from_urdf(folder / "three.urdf")


def depths(points: np.ndarray, capsules: hf.Capsules, link: int) -> np.ndarray:
    """Of points (N, 3) in the frame of a link in the capsules of the link, m; below 0 outside of all."""
    out = []
    for part in capsules:
        if part.link == link:
            span = np.subtract(part.end, part.start)
            share = np.clip((points - part.start) @ span / max(span @ span, 1e-300), 0, 1)
            out.append(part.radius - np.linalg.norm(points - part.start - share[:, None] * span, axis=1))
    return np.max(out, axis=0)


def within(vertices: np.ndarray, rng: np.random.Generator, count: int = 300) -> np.ndarray:
    """Random points of a hull, its corners and its edges among them."""
    few = rng.dirichlet(np.full(len(vertices), 0.05), count)
    return np.concatenate([vertices, few @ vertices])


def test_every_hull_of_the_panda_lies_in_its_capsules_and_these_in_their_spheres(panda, rng):
    _, shape, capsules = panda
    balls = make_sphere_cover(capsules)
    assert len(shape.missing) == 0
    assert {hull.link for hull in shape.hulls} == set(range(-1, 7))
    assert all(hull.is_convex for hull in shape.hulls)
    for hull in shape.hulls:
        points = within(hull.vertices, rng)
        assert depths(points, capsules, hull.link).min() >= 0
        own = balls.link == hull.link
        gap = np.linalg.norm(points[:, None] - balls.center[own], axis=2) - balls.radius[own]
        assert gap.min(axis=1).max() <= 0


def test_the_cover_of_the_panda_is_as_tight_as_it_is_said_to_be(panda):
    _, _, capsules = panda
    balls = make_sphere_cover(capsules)
    assert len(balls.radius) <= 60
    assert capsules.source.startswith("cover of the collision shapes of panda.urdf: ")
    assert f"{len(capsules)} capsules" in capsules.source
    assert capsules.describe(panda[0]) == capsules.source
    assert hf.Capsules.from_dict(capsules.to_dict(panda[0]), panda[0]).source == capsules.source


def test_the_stored_cover_of_the_panda_is_what_a_fit_gives(panda):
    _, shape, capsules = panda
    rows, _, _ = fit_capsules(shape, MAX_MEAN_EXCESS_M)
    assert shape.digest in json.loads(DATA_FOLDER.joinpath("covers.json").read_text())
    assert len(rows) == len(capsules)
    for part, (link, start, end, radius, _) in zip(capsules, sorted(rows, key=lambda row: row[0]), strict=True):
        assert part.link == link
        stored, ends = np.array([part.start, part.end]), np.array([start, end])
        if np.abs(stored - ends).max() > np.abs(stored - ends[::-1]).max():  # which end is the first one is up to rounding
            ends = ends[::-1]
        np.testing.assert_allclose([*stored.ravel(), part.radius], [*ends.ravel(), radius], atol=1e-5)


def test_the_bound_is_below_the_exact_distance_and_misses_no_penetration(panda, rng):
    coal = pytest.importorskip("coal")
    arm, shape, capsules = panda
    objects, theirs = [], []
    for k in range(8):
        pose = random_pose(rng)
        pose[:3, 3] = rng.uniform([0.3, -0.6, 0.1], [0.7, 0.6, 0.9])
        size = rng.uniform(0.05, 0.3, 3)
        made, exact = [
            (Box(f"{k}", size.tolist(), pose=pose), coal.Box(*size)),
            (Cylinder(f"{k}", size[0] / 2, size[1], pose=pose), coal.Cylinder(size[0] / 2, size[1])),
            (Capsule(f"{k}", size[0] / 2, size[1], pose=pose), coal.Capsule(size[0] / 2, size[1])),
            (Sphere(f"{k}", size[0] / 2, pose=pose), coal.Sphere(size[0] / 2)),
        ][k % 4]
        objects.append(made)
        theirs.append((exact, coal.Transform3s(pose[:3, :3], pose[:3, 3])))
    clearance = hf.Clearance(arm, capsules, hf.Cell(objects), itself=False)
    q = rng.uniform(arm.lower, arm.upper, (60, arm.n))
    bound = clearance.by_pair(q).reshape(len(q), -1, 8)
    links = clearance.obstacles.links.tolist()
    exact = np.full(bound.shape, np.inf)
    frames = arm.frames(q)
    for hull in shape.hulls:
        if hull.link < 0:
            continue
        cloud = coal.StdVec_Vec3s()
        cloud.extend(list(hull.vertices))
        body = coal.ConvexBase.convexHull(cloud, True, "Qt")
        for row, frame in enumerate(frames[:, hull.link + 1]):
            for k, (other, place) in enumerate(theirs):
                here, found = coal.Transform3s(frame[:3, :3], frame[:3, 3]), coal.DistanceResult()
                d = coal.distance(body, here, other, place, coal.DistanceRequest(), found)
                at = links.index(hull.link)
                exact[row, at, k] = min(exact[row, at, k], d)
    clear = exact > 1e-6
    assert (bound[clear] <= exact[clear] + 1e-9).all()
    assert (~clear).sum() > 15
    assert (bound[~clear] < 1e-9).all()  # none missed
    nearest = exact.min(axis=(1, 2))
    assert np.mean((nearest - bound.min(axis=(1, 2)))[nearest > 0]) < 0.014


def test_no_collision_of_the_links_with_each_other_is_missed(panda, rng):
    coal = pytest.importorskip("coal")
    arm, shape, capsules = panda
    q = rng.uniform(arm.lower, arm.upper, (400, arm.n))
    near = hf.Clearance(arm, capsules)(q) < 0.05
    bodies = []
    for hull in shape.hulls:
        cloud = coal.StdVec_Vec3s()
        cloud.extend(list(hull.vertices))
        bodies.append((hull.link, hull.owner, coal.ConvexBase.convexHull(cloud, True, "Qt")))
    checked = [
        (one, other)
        for k, one in enumerate(bodies)
        for other in bodies[k + 1 :]
        if abs(one[0] - other[0]) > 1 and tuple(sorted((one[1], other[1]))) not in shape.unchecked
    ]
    found = hf.Clearance(arm, capsules)(q[near]) < 0
    hits = []
    for frames in arm.frames(q[near]):
        places = [coal.Transform3s(frame[:3, :3], frame[:3, 3]) for frame in frames]
        ask = coal.CollisionRequest()
        touch = (
            coal.collide(a, places[i + 1], b, places[j + 1], ask, coal.CollisionResult()) for (i, _, a), (j, _, b) in checked
        )
        hits.append(any(bool(x) for x in touch))
    assert sum(hits) >= 5
    assert found[np.array(hits)].all()


def test_primitives_are_covered_where_the_file_puts_them(three, rng):
    shape = CollisionModel.from_arm(three)
    assert [(p.link, p.owner, p.kind) for p in shape.pieces] == [
        (-1, "foot", "box"),
        (0, "upper", "box"),
        (1, "lower", "cylinder"),
        (1, "tip", "sphere"),
    ]
    capsules = choose_capsules(three)
    ball = [part for part in capsules if part.length == 0 and part.radius == 0.07]
    assert [part.start for part in ball] == [pytest.approx((0.3, 0, 0))]  # a sphere is its own cover
    turns = rng.uniform(-np.pi, np.pi, 500)
    rim = np.column_stack([0.05 * np.cos(turns), 0.05 * np.sin(turns), rng.choice([-0.15, 0.15], 500)])
    cylinder = shape.pieces[2]
    assert depths(rim @ cylinder.pose[:3, :3].T + cylinder.pose[:3, 3], capsules, 1).min() >= 0
    np.testing.assert_allclose(np.ptp(corner_points(shape.pieces[2]), axis=0), [0.3, 0.1, 0.1], rtol=0.006)
    assert depths(shape.hulls[1].vertices, capsules, 0).min() >= 0


def test_the_same_arm_as_a_model_of_mujoco_has_the_same_cover(three, tmp_path):
    pytest.importorskip("mujoco")
    (tmp_path / "three.xml").write_text(MODEL)
    other = hf.Arm.from_mjcf(tmp_path / "three.xml")
    shape = CollisionModel.from_arm(other)
    assert [(p.link, p.owner) for p in shape.pieces] == [(-1, "foot"), (0, "upper"), (1, "lower"), (1, "tip")]
    for a, b in zip(choose_capsules(three), choose_capsules(other), strict=True):
        np.testing.assert_allclose([*a.start, *a.end, a.radius], [*b.start, *b.end, b.radius], atol=1e-4)


def test_what_hangs_on_the_chain_is_part_of_the_link_it_hangs_on(panda, rng):
    arm, shape, _ = panda
    assert {p.owner for p in shape.pieces if p.link == 6} == {
        "panda_link7",
        "panda_hand",
        "panda_leftfinger",
        "panda_rightfinger",
    }
    open_, shut = (
        np.concatenate([corner_points(p) for p in made.pieces if "finger" in p.owner])
        for made in (CollisionModel.from_arm(arm, hold={"panda_finger_joint1": 0.04}), shape)
    )
    # The second finger mimics the first; in the frame of the last joint both are turned by -45 deg.
    assert np.ptp(open_ @ [np.sqrt(0.5), np.sqrt(0.5), 0]) == pytest.approx(
        np.ptp(shut @ [np.sqrt(0.5), np.sqrt(0.5), 0]) + 0.08
    )
    with pytest.raises(ArmError, match="panda_finger_joint9"):
        CollisionModel.from_arm(arm, hold={"panda_finger_joint9": 0.04})


def test_a_missing_mesh_gives_that_link_its_assumed_capsule_and_says_so(tmp_path):
    arm = write(tmp_path, "<mesh filename='package://nowhere/foot.stl'/>")
    capsules = choose_capsules(arm)
    assert "1 not read, such as package://nowhere/foot.stl: assumed capsules along base instead" in capsules.source
    assert [part.link for part in capsules if part.link == -1] == []  # this base has no length
    (tmp_path / "meshes").mkdir()
    box = arms.builtin.DATA_FOLDER.joinpath(
        "example-robot-data/robots/panda_description/meshes/collision/link0.stl"
    ).read_bytes()
    (tmp_path / "meshes" / "foot.stl").write_bytes(box)
    found = hf.Arm.from_urdf(tmp_path / "three.urdf", meshes=tmp_path / "meshes")
    assert len(CollisionModel.from_arm(found).pieces[0].vertices) == 102
    assert (
        CollisionModel.from_arm(found).digest
        == CollisionModel.from_arm(arm, tmp_path / "meshes").digest
        != CollisionModel.from_arm(arm).digest
    )
    assert "not read" not in choose_capsules(found).source
    (tmp_path / "meshes" / "foot.stl").write_bytes(box[:-20])
    assert "cut off or damaged" in choose_capsules(found).source


def test_an_arm_from_no_file_has_assumed_capsules(flat4):
    assert len(CollisionModel.from_arm(flat4)) == 0
    assert choose_capsules(flat4) == hf.Capsules.along_links(flat4)


def test_an_arm_that_is_not_that_of_its_file_is_refused(three):
    from dataclasses import replace

    longer = three.joints[1].origin.copy()
    longer[2, 3] *= 2
    other = replace(three, joints=(three.joints[0], replace(three.joints[1], origin=longer)))
    with pytest.raises(ArmError, match="joint 'b' of 'three' differs from the file of the arm"):
        CollisionModel.from_arm(other)


def test_a_mesh_that_is_not_convex_is_cut_where_its_hull_is_hollow(tmp_path, rng):
    trimesh = pytest.importorskip("trimesh")
    bars = [trimesh.creation.box((0.5, 0.08, 0.08)), trimesh.creation.box((0.08, 0.08, 0.5))]
    bars[1].apply_translation([0.21, 0, 0.29])
    bent = trimesh.util.concatenate(bars)
    bent.export(tmp_path / "bent.stl")
    arm = write(tmp_path, "<mesh filename='bent.stl'/>")
    shape = CollisionModel.from_arm(arm)
    assert not shape.hulls[0].is_convex
    capsules = choose_capsules(arm)
    foot = [part for part in capsules if part.link == -1]
    assert len(foot) >= 2
    points, _ = trimesh.sample.sample_surface(bent, 2000, seed=1)
    assert depths(np.asarray(points), capsules, -1).min() >= 0
    assert depths(np.array([[-0.2, 0.0, 0.45]]), capsules, -1) < 0  # the hollow is open


def test_a_limit_that_is_no_length_is_refused(panda):
    with pytest.raises(InputError, match="spheres_to is 0 m"):
        make_cover(panda[1], panda[0], 0.0)


def test_pairs_that_an_srdf_file_disables_are_not_checked(panda, tmp_path):
    arm, _, capsules = panda
    names = hf.Clearance(arm, capsules).pair_names
    # Only the fingers, the last capsule of the last link, are left against link 5, which the hand may touch in the file.
    assert [name for name in names if name.startswith("panda_joint5 ")] == ["panda_joint5 & panda_joint7 (3)"]
    assert not [name for name in names if name.startswith("panda_joint1 & panda_joint3")]
    again = hf.Capsules.from_dict(capsules.to_dict(arm), arm)
    assert again == capsules
    assert hf.Clearance(arm, again).pair_names == names
    three = write(tmp_path, "<sphere radius='0.1'/>")
    assert hf.Clearance(three, choose_capsules(three)).pair_names == ["base & b (1)", "base & b (2)"]
    pairs = "".join(f"<disable_collisions link1='{a}' link2='foot'/>" for a in ("lower", "tip"))
    (tmp_path / "three.srdf").write_text(f"<robot name='three'>{pairs}</robot>")
    three = hf.Arm.from_urdf(tmp_path / "three.urdf")
    assert hf.Clearance(three, choose_capsules(three)).pair_names == []
    elsewhere = tmp_path / "pairs.srdf"
    elsewhere.write_text("<robot name='three'><disable_collisions link1='foot' link2='tip'/></robot>")
    three = hf.Arm.from_urdf(tmp_path / "three.urdf", srdf=elsewhere)
    assert len(hf.Clearance(three, choose_capsules(three)).pair_names) == 1


def test_what_is_held_moves_with_the_last_link(panda, rng):
    arm, _, capsules = panda
    pose = random_pose(rng)
    pose[:3, 3] = [0, 0, 0.1]
    held = [Capsule("bar", 0.02, 0.6, pose=pose), Box("part", [0.1, 0.06, 0.3])]
    cell = hf.Cell([Sphere("ball", 0.1, pose=np.eye(4))], held=held, may_touch=[("ball", "base")])
    clearance = hf.Clearance(arm, capsules, cell)
    extra = clearance.capsules.parts[len(capsules) :]
    assert clearance.capsules.without_held == capsules
    assert clearance.capsules.held == len(extra)
    assert {part.link for part in extra} == {arm.n - 1}
    q = rng.uniform(arm.lower, arm.upper, (20, arm.n))
    for tool, row in zip(arm.forward_kinematics(q), clearance.by_pair(q), strict=True):
        ends = [(tool @ pose @ np.array([0, 0, z, 1]))[:3] for z in np.linspace(-0.3, 0.3, 2001)]
        exact = np.linalg.norm(ends, axis=1).min() - 0.12
        assert row[clearance.pair_names.index("panda_joint7 & ball")] <= exact + 1e-9
    box = np.array([[x, y, z] for x in (-0.05, 0.05) for y in (-0.03, 0.03) for z in (-0.15, 0.15)])
    points = within(box, rng) @ arm.tool[:3, :3].T + arm.tool[:3, 3]
    assert depths(points, hf.Capsules(extra), arm.n - 1).min() >= 0
    names = [name for name in clearance.pair_names if "joint7 (4)" in name]
    # Against its neighbour as well, which the link itself meets by construction; never against its own link.
    assert "panda_joint6 (1) & panda_joint7 (4)" in names
    assert not any(name.count("panda_joint7") > 1 for name in names)
    assert clearance.capsules.describe(arm) == f"{capsules.source}; {len(extra)} more around held objects"
    assert hf.Capsules.from_dict(clearance.capsules.to_dict(arm), arm) == capsules
    free = clearance.with_cell(hf.Cell(cell.objects, may_touch=cell.may_touch))
    assert free.capsules == capsules
    assert free.pair_names == hf.Clearance(arm, capsules, free.cell).pair_names
    assert clearance.with_cell(cell.with_poses({"ball": random_pose(rng)})).capsules is clearance.capsules
    assumed = hf.Capsules.along_links(arm)
    assert hf.Clearance(arm, assumed, cell).capsules.is_assumed(arm)


def test_a_cell_says_which_shape_an_arm_has_in_it(panda, tmp_path):
    arm, _, capsules = panda

    def shape(**options):
        return hf.Clearance(arm, cell=hf.Cell([Sphere("ball", 0.1, pose=FAR)], **options), itself=False).capsules

    assert shape() == capsules
    assert shape(shape="assumed") == hf.Capsules.along_links(arm)
    assert len(shape(spheres_to=0.025)) < len(capsules)
    assert shape(hold={"panda_finger_joint1": 0.04}) != capsules
    (tmp_path / "own.yaml").write_text("radius: 0.05")
    assert shape(shape=str(tmp_path / "own.yaml")) == hf.Capsules.along_links(arm, 0.05)
    other = arms.load("xarm7")
    with pytest.raises(
        InputError, match="asks for the meshes of 'xarm7', and no file gives it collision shapes; give their fol"
    ):
        hf.Clearance(other, cell=hf.Cell([], shape="meshes"))
    with pytest.raises(ArmError, match="finger9"):
        shape(hold={"finger9": 0.04})
