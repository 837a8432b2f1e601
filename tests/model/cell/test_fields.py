"""The distance from meshes and clouds: never above the true one, which brute force, a formula, coal and a k-d tree tell."""

import coal
import numpy as np
import pytest
import trimesh
from scipy.spatial import ConvexHull, cKDTree
from scipy.spatial.transform import Rotation

import holdfast as hf
from holdfast.model.cell import Box, HalfSpace, Mesh, Points, Sphere, field, outside

POSE = np.eye(4)
POSE[:3, :3], POSE[:3, 3] = Rotation.from_rotvec([0.3, -0.8, 0.5]).as_matrix(), (0.1, 0.4, 0.5)


@pytest.fixture(autouse=True)
def coarse(monkeypatch):
    monkeypatch.setattr(field, "_MAX_NODES", 30_000)  # a full grid takes seconds


def bracket() -> trimesh.Trimesh:
    """A ring and a hollow block: not convex."""
    outer = trimesh.creation.torus(0.25, 0.08, major_sections=20, minor_sections=10)
    block = trimesh.creation.box((0.5, 0.3, 0.2), transform=trimesh.transformations.translation_matrix([0.7, 0, 0]))
    hollow = trimesh.creation.box((0.4, 0.2, 0.1), transform=trimesh.transformations.translation_matrix([0.7, 0, 0]))
    hollow.invert()
    return trimesh.util.concatenate([outer, block, hollow])


def signed(shape: trimesh.Trimesh, points: np.ndarray) -> np.ndarray:
    """By brute force: the nearest point of every triangle, and the sum of the solid angles (van Oosterom and Strackee)."""
    out = np.empty(len(points))
    for k, point in enumerate(points):
        corners = shape.triangles
        nearest = trimesh.triangles.closest_point(corners, np.repeat(point[None], len(corners), axis=0))
        a, b, c = (corners[:, i] - point for i in range(3))
        la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
        below = la * lb * lc + (a * b).sum(1) * lc + (b * c).sum(1) * la + (c * a).sum(1) * lb
        turns = np.arctan2((a * np.cross(b, c)).sum(1), below).sum() / (2 * np.pi)
        out[k] = np.linalg.norm(nearest - point, axis=1).min() * (-1 if turns > 0.5 else 1)
    return out


def about(shape: trimesh.Trimesh, rng, count: int = 300) -> np.ndarray:
    """Points close to the surface, in the box, and far away."""
    near = trimesh.sample.sample_surface(shape, count, seed=1)[0] + rng.normal(scale=0.01, size=(count, 3))
    low, high = shape.bounds
    return np.concatenate([near, rng.uniform(low, high, (count, 3)), rng.uniform(low - 2, high + 2, (count // 3, 3))])


def in_world(points: np.ndarray) -> np.ndarray:
    return points @ POSE[:3, :3].T + POSE[:3, 3]


@pytest.mark.parametrize("solid", ["exact", "hull"])
def test_a_mesh_is_never_farther_than_said_and_not_much_nearer(rng, solid):
    shape = bracket()
    truth = shape if solid == "exact" else trimesh.convex.convex_hull(shape)
    made = Mesh("bracket", (shape.vertices, shape.faces), solid=solid, pose=POSE)
    points = about(truth, rng)
    exact, bound = signed(truth, points), made.signed_distance(in_world(points))
    assert (exact < 0).sum() > 100
    assert (bound <= exact + 1e-9).all()
    width = made.field.grid.width
    close = (np.abs(exact) < 2 * width) & (np.arange(len(points)) < 600)
    assert (exact - bound)[close].max() < 2 * made.field.max_underestimate  # what interpolation can lose at most, twice
    assert (exact - bound)[:600].max() < 3.2 * made.field.max_underestimate


def test_shells_that_overlap_are_solid_together(rng):
    shape = trimesh.util.concatenate([trimesh.creation.box((0.4, 0.4, 0.4)), trimesh.creation.icosphere(2, 0.25)])
    made = Mesh("both", (shape.vertices, shape.faces))
    points = rng.uniform(-0.14, 0.14, (500, 3))  # in both: passed twice
    assert (made.signed_distance(points) < 0).all()


def test_a_grid_whose_lines_run_through_edges_and_corners(rng):
    steps = trimesh.util.concatenate(
        [
            trimesh.creation.box((1, 1, 1), transform=trimesh.transformations.translation_matrix([k, 0, 0.25 * k]))
            for k in (0, 2)
        ]
    )
    made = Mesh("steps", (steps.vertices, steps.faces))
    points = np.round(rng.uniform(-1, 3, (300, 3)) * 8) / 8 + rng.normal(scale=1e-4, size=(300, 3))
    exact = signed(steps, points)
    assert (made.signed_distance(points) <= exact + 1e-9).all()
    assert (made.signed_distance(points)[exact > 3 * made.field.max_underestimate] > 0).all()


def test_a_cloud_of_50000_points(rng):
    cloud = Rotation.random(50_000, rng=rng).apply([0.5, 0, 0]) * [1, 1, 0.3] + rng.normal(scale=0.003, size=(50_000, 3))
    made = Points("scan", cloud, radius=0.01, pose=POSE)
    points = np.concatenate([cloud[:2000] + rng.normal(scale=0.02, size=(2000, 3)), rng.uniform(-2, 2, (3000, 3))])
    exact = cKDTree(cloud).query(points)[0] - 0.01
    bound = made.signed_distance(in_world(points))
    assert (exact < 0).sum() > 100
    assert (bound <= exact + 1e-9).all()
    assert (exact - bound)[:2000].max() < 2.5 * made.field.max_underestimate


@pytest.mark.parametrize("kind", ["mesh", "points"])
def test_gradients_agree_with_differences(rng, kind):
    shape = bracket()
    made = (
        Mesh("bracket", (shape.vertices, shape.faces), pose=POSE)
        if kind == "mesh"
        else Points("scan", shape.vertices, radius=0.02, pose=POSE)
    )
    points = in_world(about(shape, rng, 200))
    value, slope = made.distance_and_gradient(points)
    np.testing.assert_array_equal(value, made.signed_distance(points))
    step = 1e-7
    numeric = np.stack(
        [(made.signed_distance(points + step * e) - made.signed_distance(points - step * e)) / (2 * step) for e in np.eye(3)],
        axis=1,
    )
    error = np.abs(numeric - slope).max(axis=1)
    assert np.quantile(error, 0.99) < 1e-6  # the rest are at the side of a cube within the step


def test_what_is_not_finite_stays_so():
    made = Points("scan", np.zeros((1, 3)), radius=0.02)
    assert np.isnan(made.signed_distance([np.nan, 0, 0]))
    np.testing.assert_allclose(made.signed_distance([[1.0, 0, 0]]), 0.98, atol=2e-3)
    assert made.signed_distance(np.zeros((4, 5, 3))).shape == (4, 5)


def test_a_field_is_kept_on_the_disk(monkeypatch, tmp_path):
    monkeypatch.setenv("HOLDFAST_CACHE", str(tmp_path))
    points = np.random.default_rng(3).uniform(-1, 1, (20, 3))
    first = Points("scan", points, radius=0.01).field
    monkeypatch.setattr(field, "node_distance_bounds", None)
    again = Points("other", points, radius=0.02).field
    np.testing.assert_array_equal(first.values, again.values)
    assert again.offset == 0.02


# ---- as an arm meets them ------------------------------------------------------------------------------------------


@pytest.fixture
def scene(rng):
    shape = bracket()
    place = np.eye(4)
    place[:3, :3], place[:3, 3] = POSE[:3, :3], (0.5, 0.1, 0.4)  # not at random: it may be nearest to everything, or to nothing
    corner = np.eye(4)
    corner[:3, 3] = -0.3, -0.4, 0.3
    objects = [
        Box("table", [1, 1, 0.1], pose=translated(0.7, 0, -0.3)),
        Mesh("jig", (shape.vertices, shape.faces), pose=place),
        Sphere("ball", 0.15, pose=translated(0, 0.6, 0.6)),
        Points("scan", rng.uniform(-0.1, 0.1, (2000, 3)), radius=0.01, pose=translated(-0.3, 0.5, 0.5), margin=0.05),
        HalfSpace("floor", pose=translated(0, 0, -0.5)),
        Mesh("part", (shape.vertices, shape.faces), solid="hull", pose=corner),
    ]
    links = [f"panda_joint{k}" for k in (2, 4)]
    cell = hf.Cell(objects, margin=0.01, may_touch=[("jig", link) for link in [*links, "base"]] + [("part", "base")])
    return hf.arms.load("panda"), cell


def translated(x: float, y: float, z: float) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def test_objects_of_both_kinds_are_merged_in_their_order(rng, scene):
    from tests.model.collision.test_obstacles import covered

    arm, cell = scene
    capsules = hf.Capsules.along_links(arm)
    clearance = hf.Clearance(arm, capsules, cell, itself=False)
    q = rng.uniform(arm.lower, arm.upper, (200, arm.n))
    expected = covered(arm, capsules, cell, q)
    off = [name in ("panda_joint2 & jig", "panda_joint4 & jig") for name in clearance.pair_names]
    assert sum(off) == 2
    found = clearance.by_pair(q)
    assert (found[:, off] > 1e8).all()
    expected[:, off] = np.inf
    np.testing.assert_allclose(found[:, ~np.array(off)], expected[:, ~np.array(off)], atol=1e-12)
    room = (expected - clearance.margins).min(axis=1)
    np.testing.assert_allclose(clearance(q), expected.min(axis=1), atol=1e-12)
    np.testing.assert_allclose(clearance.margin_left(q), room, atol=1e-12)
    nearest, pair, slope = clearance.obstacles.nearest_margin_and_gradient(q)
    np.testing.assert_allclose(nearest, room, atol=1e-12)
    np.testing.assert_array_equal(pair, (expected - clearance.margins).argmin(axis=1))
    assert len({clearance.pair_names[k].partition(" & ")[2] for k in pair}) > 3
    step = 1e-7
    numeric = np.stack(
        [(clearance.margin_left(q + step * e) - clearance.margin_left(q - step * e)) / (2 * step) for e in np.eye(arm.n)],
        axis=1,
    )
    assert np.quantile(np.abs(numeric - slope).max(axis=1), 0.95) < 1e-6
    one = clearance.obstacles.nearest_margin_and_gradient(q[:1])
    np.testing.assert_allclose(one[2], slope[:1], atol=1e-12)
    q[3] = np.nan
    assert np.isnan(clearance.margin_left(q)[3])
    assert clearance.obstacles.nearest_margin_and_gradient(q)[1][3] == -1


def test_only_objects_with_a_grid(rng, scene):
    arm, cell = scene
    alone = hf.Cell([cell.objects[1]])
    clearance = hf.Clearance(arm, cell=alone, itself=False)
    q = rng.uniform(arm.lower, arm.upper, (5, arm.n))
    np.testing.assert_allclose(clearance(q), clearance.by_pair(q).min(axis=1))
    assert (clearance.closest_pair(q) == clearance.obstacles.nearest_margin_and_gradient(q)[1]).all()


def test_no_penetration_that_coal_sees_is_missed(rng, scene):
    arm, cell = scene
    meshes = [cell.objects[1], cell.objects[5]]
    capsules = hf.Capsules.along_links(arm)
    clearance = hf.Clearance(arm, capsules, hf.Cell(meshes, may_touch=[("part", "base")]), itself=False)
    q = rng.uniform(arm.lower, arm.upper, (200, arm.n))
    bound = clearance.by_pair(q).reshape(len(q), -1, 2)
    shapes = []
    for solid in meshes:
        model = coal.BVHModelOBBRSS()
        model.beginModel(len(solid.surface.faces), len(solid.surface.vertices))
        model.addSubModel(coal_points(solid.surface.vertices), coal_faces(solid.surface.faces))
        model.endModel()
        shapes.append((model, coal.Transform3s(solid.pose[:3, :3], solid.pose[:3, 3])))
    hits = 0
    for row, frames in enumerate(arm.frames(q)):
        for part in capsules:
            if part.link < 0:
                continue
            at = clearance.obstacles.links.tolist().index(part.link)
            frame = frames[part.link + 1]
            start, end = (frame[:3, :3] @ np.array(x) + frame[:3, 3] for x in (part.start, part.end))
            turn = Rotation.align_vectors([(end - start) / part.length], [[0, 0, 1]])[0].as_matrix()
            capsule, place = coal.Capsule(part.radius, part.length), coal.Transform3s(turn, (start + end) / 2)
            for k, (model, pose) in enumerate(shapes):
                answer = coal.DistanceResult()
                exact = coal.distance(capsule, place, model, pose, coal.DistanceRequest(), answer)
                hit = coal.collide(capsule, place, model, pose, coal.CollisionRequest(), coal.CollisionResult())
                if hit:
                    hits += 1
                    assert bound[row, at, k] < 0
                else:
                    assert bound[row, at, k] <= exact + 1e-6  # coal's own tolerance
    assert hits > 100


def coal_points(vertices: np.ndarray) -> coal.StdVec_Vec3s:
    out = coal.StdVec_Vec3s()
    out.extend(list(vertices))
    return out


def coal_faces(faces: np.ndarray) -> coal.StdVec_Triangle:
    out = coal.StdVec_Triangle()
    out.extend([coal.Triangle(*map(int, face)) for face in faces])
    return out


def test_the_hull_is_that_of_scipy(rng):
    points = rng.normal(size=(60, 3))
    hull = ConvexHull(points)
    made = Mesh("stone", (points, hull.simplices), solid="hull")
    np.testing.assert_allclose(made.surface.volume, hull.volume, rtol=1e-12)
    assert made.surface.is_closed


# ---- from outside ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["convex", "not convex", "points", "flat"])
def test_from_afar_little_is_lost(rng, kind):
    shape = bracket()
    made = {
        "convex": lambda: Mesh("hull", (shape.vertices, shape.faces), solid="hull"),
        "not convex": lambda: Mesh("bracket", (shape.vertices, shape.faces)),
        "points": lambda: Points("scan", shape.vertices, radius=0.02),
        "flat": lambda: Points("plate", rng.uniform(-0.4, 0.4, (500, 3)) * [1, 1, 0], radius=0.02),
    }[kind]()
    middle, half = made.field.center, outside.half_edges(made.field.grid)
    points = middle + (half + 0.05) * 2 ** rng.uniform(0, 3, (500, 1)) * on_cube(rng, 500)
    if isinstance(made, Points):
        exact = cKDTree(made.centres).query(points)[0] - made.radius
    else:
        exact = signed(trimesh.Trimesh(made.surface.vertices, made.surface.faces), points)
    bound = made.signed_distance(points)
    assert (bound <= exact + 1e-9).all()
    size = np.ptp(made.surface.vertices if isinstance(made, Mesh) else made.centres, axis=0).max()
    assert (exact - bound).mean() < 0.002 * size
    # Where the nearest point changes between two nodes, 1 / 16 apart, E is at most 1 / 32 of the way between them too large,
    # and d^2 by r times as much too small; r is about 3 / 2 d at a distance of half the size.
    assert (exact - bound).max() < 0.75 / 32 * size


def on_cube(rng, count: int) -> np.ndarray:
    points = rng.uniform(-1, 1, (count, 3))
    return points / np.abs(points).max(axis=1, keepdims=True)


SIZES = {
    "cube": (1, 1, 1),
    "needle": (1, 0.001, 0.001),
    "plate": (1, 1, 1e-4),
    "tiny": (0.001, 0.0007, 0.0005),
    "hall": (49, 30, 4),
}


@pytest.mark.parametrize("kind", SIZES)
def test_a_box_is_never_farther_than_the_formula_says(rng, kind):
    size = np.array(SIZES[kind])
    shape = trimesh.creation.box(size)
    made = Mesh(kind, (shape.vertices, shape.faces))
    points = where_it_may_fail(rng, made.field, 300)
    exact = Box(kind, size).signed_distance(points)
    assert (exact < 0).any()
    assert (made.signed_distance(points) <= exact + 1e-10).all()


CLOUDS = {
    "one": np.array([[0.1, 0.2, 0.3]]),
    "two": np.array([[0.0, 0, 0], [1, 0, 0]]),
    "same": np.full((5, 3), 0.4),
    "line": np.linspace(-1, 1, 30)[:, None] * [1, 2, 3],
    "far away": np.random.default_rng(0).normal([50, 0, 0], size=(200, 3)),
}


@pytest.mark.parametrize("kind", CLOUDS)
def test_a_cloud_of_few_points_is_never_farther_than_a_tree_says(rng, kind):
    made = Points(kind, CLOUDS[kind], radius=0.01)
    points = where_it_may_fail(rng, made.field, 300)
    exact = cKDTree(made.centres).query(points)[0] - made.radius
    assert (made.signed_distance(points) <= exact + 1e-10).all()


def where_it_may_fail(rng, made: field.DistanceField, count: int) -> np.ndarray:
    """On nodes; on faces, edges and corners of the box of the grid, just off them and a width within; inside; far away."""
    half, middle, width, shape = outside.half_edges(made.grid), made.center, made.grid.width, made.grid.shape
    on_box = on_cube(rng, count)
    on_edge = np.where(rng.uniform(size=(count, 3)) < 0.5, np.sign(on_box), on_box)
    just_off = rng.choice([-1, 1], (count, 3)) * rng.choice([1e-15, 1e-12, 1e-9], (count, 1))
    return np.concatenate(
        [
            made.grid.origin + width * rng.integers(0, shape, (count, 3)),
            middle + half * rng.choice([-1.0, 0.0, 1.0], (count, 3)),
            *(middle + half * u for u in (on_box, on_edge, on_edge + just_off)),
            *(middle + (half - inward * width) * on_edge for inward in (0.5, 1, 1.5, 2)),
            middle + (half - 2 * width) * rng.uniform(-1, 1, (count, 3)),
            middle + half.max() * on_edge * 10 ** rng.uniform(0, 5, (count, 1)),
        ]
    )


def test_the_bound_has_no_step(rng):
    shape = bracket()
    made = Mesh("bracket", (shape.vertices, shape.faces))
    through = trimesh.sample.sample_surface(shape, 40, seed=2)[0]
    along = rng.normal(size=(40, 1, 3))
    along /= np.linalg.norm(along, axis=2, keepdims=True)
    step = 2e-5
    points = through[:, None] + along * step * np.arange(-20_000, 20_000)[:, None]  # from within to beyond the grid
    rise = np.abs(np.diff(made.signed_distance(points), axis=1)) / step
    assert rise.max() < 10  # a step of 1 mm would be 50


def test_of_many_points_few_are_looked_at_and_the_bound_holds(rng, monkeypatch):
    monkeypatch.setattr(outside, "_MAX_SURFACE_POINTS", 500)
    cloud = on_cube(rng, 3000) * [0.5, 0.3, 0.2]
    made = Points("scan", cloud, radius=0.01)
    points = rng.uniform(-1, 1, (2000, 3)) * 2
    exact = cKDTree(cloud).query(points)[0] - 0.01
    bound = made.signed_distance(points)
    assert (bound <= exact + 1e-9).all()
    assert np.median(exact - bound) < 0.08  # the cubes have edges of 0.06 m
