"""What is proved about collisions rests on shapes that are known, never on covers or on an assumed radius."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from tests.model.collision import geometry

import cells
import holdfast as hf
from holdfast.model.collision.exact import certainty, engines
from holdfast.model.collision.exact.bodies import body_from_piece
from holdfast.model.collision.exact.certainty import describe_unknown_shape, name_certain_contacts
from holdfast.model.shapes.pieces import Missing
from holdfast.response.recovery import RecoveryOutcome

pytest.importorskip("coal")


@pytest.fixture(scope="module")
def panda():
    return hf.arms.load("panda")


@pytest.fixture(scope="module")
def between(panda):
    """Configurations at which covering capsules overlap: where meshes are 5 mm apart, and where they touch, by coal."""
    clearance = hf.Clearance(panda)
    q = np.random.default_rng(0).uniform(panda.lower, panda.upper, (4000, 7))
    q = q[clearance.margin_left(q) < 0]
    apart = clearance.exact(q)
    return q[apart >= 5e-3], q[apart == 0]


def test_starts_and_goals_that_only_covers_block_are_solved(panda, between):
    """Joint 7 alone is locked, where both ends have it: they are joined by straight lines or short detours."""
    free, _ = between
    assert len(free) > 20
    at = np.array(hf.arms.about("panda").home)
    solved = 0
    for q in free[:8]:
        at[6] = q[6]
        away = hf.recover(panda, ["panda_joint7"], q, goal=panda.forward_kinematics(at), samples=0, tries=2, starts=64)
        back = hf.recover(panda, ["panda_joint7"], at, goal=q, samples=0, tries=2)
        for found in (away, back):
            assert found.verdict.answer in ("solved", "undecided"), found.verdict
            solved += found.ok
            if found.ok:
                assert hf.Clearance(panda).sign(cells.finely(found.q)).all()
    assert solved >= 14


def test_a_start_whose_meshes_touch_is_proved_and_named(panda, between):
    """By the surfaces of the meshes in Pinocchio, of links that are not adjacent."""
    pin, _, touching = pytest.importorskip("pinocchio"), *between
    scene = geometry.InCoal(hf.Cell([]))
    parents = [piece.parentJoint for piece in scene.shapes.geometryObjects]
    for a, b in combinations(range(len(parents)), 2):
        if abs(parents[a] - parents[b]) > 1:
            scene.shapes.addCollisionPair(pin.CollisionPair(a, b))
    placed = scene.shapes.createData()
    for q in touching[:20]:
        assert pin.computeCollisions(scene.model, scene.data, scene.shapes, placed, q, True)
        found = hf.recover(panda, ["panda_joint7"], q, samples=0)
        assert (found.verdict.answer, found.verdict.kind) == ("proved infeasible", "start"), found.verdict
        assert "certain for " in found.reason
    with pytest.raises(hf.InputError, match="goal: at that configuration the arm collides with itself"):
        hf.recover(panda, ["panda_joint7"], hf.arms.about("panda").home, goal=touching[0], samples=0)


@pytest.mark.parametrize("what", ["assumed", "stored cover", "no library", "no mesh"])
def test_without_exact_shapes_nothing_is_proved_and_the_verdict_names_them(panda, between, what, monkeypatch):
    _, touching = between
    shape = hf.Clearance(panda).capsules
    named = {
        "assumed": (hf.Capsules.along_links(panda), "the shape of the arm was not read: assumed radius 0.0"),
        "stored cover": (replace(shape, shape=None), "the shapes that the capsules contain were not read: cover of"),
        "no library": (shape, "exact distances need python-fcl, which is not installed"),
    }
    if what == "no mesh":
        known = shape.shape
        missing = tuple(Missing(link, "link.stl was not found") for link in range(-1, 7))
        capsules = replace(shape, shape=replace(known, pieces=(), missing=missing))
        sentence = "the shape of base, panda_joint1"
    else:
        capsules, sentence = named[what]
    if what == "no library":
        monkeypatch.setattr(engines, "find_spec", lambda _: None)
    clearance = hf.Clearance(panda, capsules)
    q = touching[clearance.margin_left(touching) < 0][0]
    found = hf.recover(panda, ["panda_joint7"], q, clearance=clearance, samples=0)
    assert (found.ending, found.verdict.answer) == (RecoveryOutcome.START_TOO_CLOSE, "undecided")
    assert sentence in found.verdict.why
    assert not found.ok
    at = np.array(hf.arms.about("panda").home)
    at[6] = q[6]
    if clearance.margin_left(at) > 0:
        back = hf.recover(panda, ["panda_joint7"], at, goal=q, clearance=clearance, samples=0)
        assert back.verdict.answer == "undecided"
        assert sentence in back.verdict.why


def test_an_arm_without_meshes_is_decided_by_a_radius_that_is_given(tmp_path):
    """A folded arm whose file names meshes that are not there."""
    links, joints = [], []
    places = [(0, 0, 0.3), (0, 0, 0.06), (0, 0, 0.3), (0.06, 0, 0.03), (0.06, 0, -0.2), (0, 0, -0.15), (0.05, 0, -0.08)]
    for k in range(8):
        links.append(
            f'<link name="h{k}"><collision><geometry><mesh filename="package://h/shell{k}.stl"/></geometry></collision></link>'
        )
    for k, place in enumerate(places):
        axis, origin = ("0 0 1" if k % 2 == 0 else "0 1 0"), " ".join(map(str, place))
        joints.append(
            f'<joint name="hj{k + 1}" type="revolute"><parent link="h{k}"/><child link="h{k + 1}"/><origin xyz="{origin}"/>'
            f'<axis xyz="{axis}"/><limit lower="-2" upper="2" velocity="2" effort="50"/></joint>'
        )
    fixed = '<joint name="m" type="fixed"><parent link="h7"/><child link="tool"/><origin xyz="0 0 -0.1"/></joint>'
    joints.append(f'<link name="tool"/>{fixed}')
    file = tmp_path / "folded.urdf"
    file.write_text(f'<robot name="folded">{"".join(links + joints)}</robot>')
    arm = hf.Arm.from_urdf(file)
    goal = np.array([0, 0.3, 0, -0.6, 0, 0.3, 0])
    for at, to in ((np.zeros(7), goal), (goal, np.zeros(7))):
        found = hf.recover(arm, ["hj1"], at, goal=to, samples=0)
        assert found.verdict.answer == "undecided"
        assert "package://h/shell0.stl was not read" in found.verdict.why
        slim = hf.Clearance(arm, hf.Capsules.along_links(arm, 0.02))
        assert hf.recover(arm, ["hj1"], at, goal=to, clearance=slim, samples=0).ok
    thick = hf.Clearance(arm, hf.Capsules.along_links(arm, 0.07))
    found = hf.recover(arm, ["hj1"], np.zeros(7), goal=goal, clearance=thick, samples=0)
    assert (found.verdict.answer, found.verdict.kind) == ("proved infeasible", "start"), "a radius that is given is the shape"


def test_a_certain_contact_is_one_for_mujoco_too(panda):
    """Random configurations among primitives: what is certain touches, also of balls alone, and hardly a contact is missed."""
    cell = geometry.of_primitives()
    clearance, mujoco = hf.Clearance(panda, cell=cell), geometry.InMujoco(cell)
    q = np.random.default_rng(1).uniform(panda.lower, panda.upper, (600, 7))
    q = q[clearance.self_only.exact(q) > 0]  # MuJoCo looks at objects alone here
    touches = mujoco.touches(q)
    certain = np.array([bool(name) for name in name_certain_contacts(clearance, q)])
    assert not (certain & ~touches).any()
    assert certain[touches].mean() > 0.99
    assert touches.sum() > 100


def test_balls_alone_tell_contacts_without_a_library(panda, monkeypatch):
    cell = geometry.of_primitives()
    clearance, mujoco = hf.Clearance(panda, cell=cell), geometry.InMujoco(cell)
    q = np.random.default_rng(2).uniform(panda.lower, panda.upper, (300, 7))
    monkeypatch.setattr(certainty, "is_library_installed", lambda: False)
    certain = np.array([bool(name) for name in name_certain_contacts(clearance, q)])
    assert certain.sum() > 50
    assert mujoco.touches(q[certain]).all()


def test_balls_within_a_body_lie_within_its_mesh(panda):
    """By random points: none on the surface of a ball is outside of the mesh, by its solid angle."""
    rng, seen = np.random.default_rng(0), 0
    for piece in hf.Clearance(panda).capsules.shape.pieces:
        body = body_from_piece(piece)
        if body.filled is None:
            continue
        centres, radii = body.inner_spheres
        for centre, radius in zip(centres, radii, strict=True):
            way = rng.normal(size=(60, 3))
            points = centre + 0.999 * radius * way / np.linalg.norm(way, axis=1, keepdims=True)
            assert all(body.filled.contains_point(point) for point in points)
            seen += len(points)
    assert seen > 500


def test_a_margin_that_a_mesh_comes_closer_than_is_certain(panda, between):
    free, _ = between
    clearance = hf.Clearance(panda)
    apart = clearance.exact(free[:10])
    for q, least in zip(free, apart, strict=False):
        assert not name_certain_contacts(clearance, q[None], float(least) - 1e-4)[0]
        assert name_certain_contacts(clearance, q[None], float(least) + 1e-4)[0]
    assert describe_unknown_shape(clearance) == ""
