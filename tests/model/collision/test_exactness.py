"""Exact answers about collisions, against MuJoCo, Pinocchio with coal, formulas and brute force."""

import numpy as np
import pytest
from tests.model.collision import geometry
from tests.model.collision.geometry import pose

import holdfast as hf
from holdfast.model.cell import Box, Mesh, Points, Sphere
from holdfast.model.collision.capsules import LinkCapsule
from holdfast.model.collision.cover import choose_capsules
from holdfast.model.collision.exact import engines
from holdfast.model.collision.exact.bodies import body_from_capsule, body_from_solid

pytest.importorskip("fcl")
CONTACT = 1e-5  # m: nearer than this the libraries may differ


@pytest.fixture(scope="module")
def panda():
    arm = hf.arms.load("panda")
    return arm, choose_capsules(arm)


def drawn(arm, count, seed=0):
    return np.random.default_rng(seed).uniform(arm.lower, arm.upper, (count, arm.n))


def without_coal(monkeypatch):
    monkeypatch.setattr(engines, "find_spec", lambda name: None if name == "coal" else name)


# ---- the Panda's meshes in cells --------------------------------------------------------------------------------------


@pytest.mark.parametrize("make", [geometry.of_primitives, geometry.of_hulls])
def test_sign_is_that_of_mujoco(panda, make):
    arm, capsules = panda
    pytest.importorskip("mujoco")
    q = drawn(arm, 400)
    clear = hf.Clearance(arm, capsules, make(), itself=False).sign(q)
    np.testing.assert_array_equal(clear, ~geometry.InMujoco(make()).touches(q))
    assert 100 < clear.sum() < 350


@pytest.mark.parametrize("make", [geometry.of_primitives, geometry.of_hulls, geometry.of_channels])
@pytest.mark.parametrize("coal", [True, False])
def test_sign_and_distance_are_those_of_coal(panda, make, coal, monkeypatch):
    pytest.importorskip("pinocchio")
    arm, capsules = panda
    q = drawn(arm, 100 if make is geometry.of_channels else 200, 1)
    expected = geometry.InCoal(make()).distances(q)
    if not coal:
        without_coal(monkeypatch)
    clearance = hf.Clearance(arm, capsules, make(), itself=False)
    apart = np.abs(expected) > CONTACT
    np.testing.assert_array_equal(clearance.sign(q)[apart], (expected > 0)[apart])
    found = clearance.exact(q)
    assert ("coal" in clearance.exact_by) == coal
    np.testing.assert_allclose(found, np.maximum(expected, 0), atol=2e-6 if coal else 2e-3)
    assert (found == 0).any()


def test_the_bound_is_below_the_exact_distance(panda):
    arm, capsules = panda
    clearance = hf.Clearance(arm, capsules, geometry.of_primitives(), itself=False)
    q = drawn(arm, 300, 2)
    bound, exact = clearance(q), clearance.exact(q)
    assert (bound <= exact + 1e-9).all()
    assert not clearance.sign(q)[exact == 0].any()
    assert (exact - bound)[exact > 0].mean() <= 0.012
    assert len(clearance.obstacles.spheres.link) <= 60


def test_the_arm_with_itself_is_that_of_pinocchio_with_the_srdf(panda):
    pin = pytest.importorskip("pinocchio")
    arm, capsules = panda
    clearance = hf.Clearance(arm, capsules)
    checked = geometry.InCoal(hf.Cell([]))
    shapes = checked.shapes
    shapes.addAllCollisionPairs()
    pin.removeCollisionPairs(checked.model, shapes, str(geometry.panda_urdf().with_suffix(".srdf")))
    for pair in list(shapes.collisionPairs):
        a, b = (shapes.geometryObjects[k].parentJoint for k in (pair.first, pair.second))
        if abs(a - b) <= 1:  # one link, or adjacent ones
            shapes.removeCollisionPair(pair)
    for piece in shapes.geometryObjects:
        piece.geometry = checked.hull(piece.geometry)
    placed, data = shapes.createData(), checked.model.createData()
    q = drawn(arm, 1000, 3)
    hits = np.array([pin.computeCollisions(checked.model, data, shapes, placed, row, True) for row in q])
    np.testing.assert_array_equal(clearance.sign(q), ~hits)
    assert 10 < hits.sum() < 500


# ---- what can go wrong ------------------------------------------------------------------------------------------------


@pytest.fixture
def bar():
    """An arm of one capsule, 1 m long, that turns about z."""
    joint = hf.Joint("turn", "revolute", np.eye(4), axis=[0, 0, 1], lower=-np.pi, upper=np.pi)
    tool = pose(1, 0, 0)
    arm = hf.Arm(name="bar", joints=(joint,), tool=tool)
    return arm, hf.Capsules((LinkCapsule(0, (0.3, 0, 0), (1, 0, 0), radius=0.05),))


def test_capsules_without_a_mesh_are_the_shape(bar):
    arm, capsules = bar
    block = Box("block", [0.2, 0.2, 0.2], pose=pose(0, 1.0, 0))
    clearance = hf.Clearance(arm, capsules, hf.Cell([block]), itself=False)
    q = np.linspace(-np.pi, np.pi, 400)[:, None]
    # The corner (-0.1, 0.9) or (0.1, 0.9) of the block, or its side, is nearest: sampled finely.
    way = np.linspace(0.3, 1, 4001)[:, None, None] * np.stack([np.cos(q[:, 0]), np.sin(q[:, 0])], axis=1)
    beyond = np.maximum(np.abs(way - [0, 1.0]) - 0.1, 0)
    expected = np.maximum(np.linalg.norm(beyond, axis=2).min(axis=0) - 0.05, 0)
    np.testing.assert_allclose(clearance.exact(q), expected, atol=1e-4)
    np.testing.assert_array_equal(clearance.sign(q), expected > 0)


def test_what_is_wholly_within_a_mesh_touches_it(bar):
    arm, capsules = bar
    vertices, faces = geometry.channel(6.0, 6.0, 4.0, 2.5)  # its floor is 2.5 m thick
    inside = Mesh("thick", (vertices, faces), pose=pose(0, 0, -1.25))
    above = Mesh("thick", (vertices, faces), pose=pose(0, 0, -2.6))  # between the walls, 0.1 m above the floor
    for solid, expected in ((inside, 0.0), (above, 0.05)):
        clearance = hf.Clearance(arm, capsules, hf.Cell([solid]), itself=False)
        assert body_from_solid(solid).kind == "mesh"
        assert clearance.sign([0.3]) == (expected > 0)
        np.testing.assert_allclose(clearance.exact([0.3]), expected, atol=1e-6)


@pytest.mark.parametrize("meshes", [True, False])
def test_a_cloud_is_the_nearest_of_its_balls(panda, meshes, rng):
    arm, capsules = panda
    if not meshes:
        capsules = hf.Capsules(capsules.parts)  # the capsules themselves: a formula gives the distance of a point
    points = rng.uniform([0.3, -0.4, 0.0], [0.8, 0.4, 0.3], (400, 3))
    cloud = Points("scan", points - [0.1, 0, 0], radius=0.01, pose=pose(0.1, 0, 0))
    q = drawn(arm, 60, 4)
    clearance = hf.Clearance(arm, capsules, hf.Cell([cloud]), itself=False)
    balls = hf.Cell([Sphere(f"ball{k}", 0.01, pose=pose(*point)) for k, point in enumerate(points)])
    expected = hf.Clearance(arm, capsules, balls, itself=False).exact(q)
    np.testing.assert_allclose(clearance.exact(q), expected, atol=2e-6)
    np.testing.assert_array_equal(clearance.sign(q), expected > 0)
    assert (expected == 0).any()
    assert (expected > 0).any()


def test_spheres_within_a_body_are_within_it(panda):
    arm, capsules = panda
    from holdfast.model.collision.exact.narrow_phase import arm_bodies

    bodies = [part.body for part in arm_bodies(arm, capsules)] + [
        body_from_capsule(LinkCapsule(0, (0, 0, 0), (0.1, 0.2, 0.3), radius=0.05))
    ]
    kinds = set()
    for body in bodies:
        kinds.add(body.kind)
        centres, radii = body.inner_spheres
        assert len(radii)
        if body.exact_primitive is not None:
            assert (body.exact_primitive.signed_distance(centres) + radii <= 1e-12).all()
        else:
            normals, offsets = body.face_planes
            assert ((centres @ normals.T - offsets).max(axis=1) + radii <= 1e-12).all()
    assert kinds == {"convex", "box", "capsule"}


def test_a_pair_that_may_touch_is_not_asked_about(panda):
    arm, capsules = panda
    ball = Sphere("ball", 0.3, pose=pose(0.5, 0, 0.5))
    cell = hf.Cell([ball], may_touch=[("ball", name) for name in arm.joint_names])
    clearance = hf.Clearance(arm, capsules, cell, itself=False)
    q = drawn(arm, 50)
    assert clearance.sign(q).all()
    assert np.isinf(clearance.exact(q)).all()


def test_rows_that_are_not_finite_are_not_clear(panda):
    arm, capsules = panda
    q = drawn(arm, 3)
    q[1, 2] = np.nan
    clearance = hf.Clearance(arm, capsules, geometry.of_primitives(), itself=False)
    assert not clearance.sign(q)[1]
    assert np.isnan(clearance.exact(q)[1])
    assert np.isfinite(clearance.exact(q)[[0, 2]]).all()
    assert clearance.sign(q[:0]).shape == (0,)
    assert clearance.exact(q[:0]).shape == (0,)


def test_another_cell_is_another_answer(panda):
    arm, capsules = panda
    first = hf.Clearance(arm, capsules, geometry.of_primitives(), itself=False)
    q = drawn(arm, 100)
    before = first.sign(q)
    assert first.with_cell(hf.Cell([])).sign(q).all()
    np.testing.assert_array_equal(first.sign(q), before)


def test_without_a_library_it_says_what_to_install(panda, monkeypatch):
    arm, capsules = panda
    monkeypatch.setattr(engines, "find_spec", lambda name: None)
    clearance = hf.Clearance(arm, capsules, geometry.of_primitives(), itself=False)
    for ask in (clearance.sign, clearance.exact):
        with pytest.raises(hf.HoldfastError, match=r"pip install 'holdfast-arms\[cell\]'"):
            ask(drawn(arm, 2))
