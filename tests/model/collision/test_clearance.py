"""The clearance against Pinocchio and coal, closed forms and finite differences."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import Capsules, Clearance, arms
from holdfast.core.errors import InputError
from holdfast.kernels import Kernel
from holdfast.model.arm import kinematics
from holdfast.model.collision import LinkCapsule

TYPES = ["RRRR", "RPRPR", "PRRRRRR", "RRCRRRRRR"]


def random_capsules(arm, rng, count=7):
    """Capsules anywhere on any link, some of them spheres."""
    parts = []
    for link in sorted(rng.integers(-1, arm.n, count)):
        start, step = rng.uniform(-0.3, 0.3, 3), rng.uniform(-0.3, 0.3, 3) * (rng.random() > 0.25)
        parts.append(LinkCapsule(int(link), start, start + step, radius=rng.uniform(0.01, 0.1)))
    return Capsules(tuple(parts))


def along_z(direction):
    """A rotation that turns z into the direction."""
    z = direction / np.linalg.norm(direction)
    x = np.cross(np.eye(3)[np.abs(z).argmin()], z)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def coal_distances(arm, capsules, pairs, q):
    """Signed distances (N, P): Pinocchio moves coal's capsules and spheres."""
    pin, coal = pytest.importorskip("pinocchio"), pytest.importorskip("coal")
    model, _ = oracles.to_pinocchio(arm)
    shapes = pin.GeometryModel()
    for k, part in enumerate(capsules):
        start, span = np.array(part.start), np.subtract(part.end, part.start)
        middle = pin.SE3(along_z(span) if part.length else np.eye(3), start + span / 2)
        shape = coal.Capsule(part.radius, part.length) if part.length else coal.Sphere(part.radius)
        frame = pin.SE3.Identity() if part.link >= 0 else pin.SE3(np.array(arm.base))
        shapes.addGeometryObject(pin.GeometryObject(f"part{k}", part.link + 1, frame * middle, shape))
    for a, b in pairs:
        shapes.addCollisionPair(pin.CollisionPair(a, b))
    data, moved = model.createData(), pin.GeometryData(shapes)
    out = np.empty((len(q), len(pairs)))
    for i, row in enumerate(q):
        pin.computeDistances(model, data, shapes, moved, row)
        out[i] = [result.min_distance for result in moved.distanceResults]
    return out


@pytest.fixture(scope="module", params=TYPES)
def clearance(request, generator):
    rng = generator(f"clearance {request.param}")
    arm = oracles.random_arm(rng, types=request.param, limits=2.5)
    return Clearance(arm, random_capsules(arm, rng))


@pytest.fixture(scope="module")
def panda():
    arm = arms.load("panda")
    return Clearance(arm, Capsules.along_links(arm))


def test_pinocchio_and_coal_agree_on_random_arms(clearance, rng):
    q = rng.uniform(-4, 4, (60, clearance.arm.n))
    theirs = coal_distances(clearance.arm, clearance.capsules, clearance.pairs, q)
    np.testing.assert_allclose(clearance.by_pair(q), theirs, atol=2e-8)
    np.testing.assert_allclose(clearance(q), theirs.min(axis=1), atol=2e-8)


@pytest.mark.parametrize("name", ["panda", "ur5-rail", "planar-3r", "kinova-j2s6s200"])
def test_pinocchio_and_coal_agree_on_built_in_arms(name, rng):
    arm = arms.load(name)
    ours = Clearance(arm)
    q = np.concatenate([[arms.about(name).home], oracles.inside(arm, rng, 200), np.zeros((1, arm.n))])
    theirs = coal_distances(arm, ours.capsules, ours.pairs, q)
    np.testing.assert_allclose(ours.by_pair(q), theirs, atol=2e-8)


@pytest.mark.parametrize("name", arms.names())
def test_every_built_in_arm_is_clear_of_itself_at_home(name):
    made = Clearance(arms.load(name))
    home = made(arms.about(name).home)
    if name == "planar-2r":
        assert made.pairs == []
        assert home == np.inf
    else:
        assert made.pairs
        assert 0 < home < 2


def test_closed_form_of_a_folded_chain(tmp_path):
    """Three links of 1 m from a URDF file: at right angles, and folded onto each other."""
    links = "".join(f'<link name="l{k}"/>' for k in range(5))
    joint = '<joint name="j{0}" type="{1}"><parent link="l{0}"/><child link="l{2}"/><origin xyz="{3} 0 0"/>{4}</joint>'
    turning = '<axis xyz="0 0 1"/><limit lower="-4" upper="4" effort="1" velocity="1"/>'
    joints = "".join(joint.format(k, "revolute", k + 1, float(k > 0), turning) for k in range(3))
    path = tmp_path / "chain.urdf"
    path.write_text(f'<robot name="chain">{links}{joints}{joint.format(3, "fixed", 4, 1.0, "")}</robot>')
    arm = hf.Arm.from_urdf(path)
    ours = Clearance(arm, Capsules.along_links(arm, 0.1))
    assert ours.pair_names == ["j0 & j2"]
    right = np.pi / 2
    q = [[0, 0, 0], [0.3, right, right], [1, right, 0], [0, right, 3 * right], [0, 2 * right, 2 * right]]
    np.testing.assert_allclose(ours(q), [0.8, 0.8, 0.8, 0.8, -0.2], atol=1e-12)
    np.testing.assert_allclose(ours.gradient(q[2]), [0, 0, 0], atol=1e-12)  # the feet: end of one link, start of the other


def test_gradient_against_finite_differences(clearance, rng):
    q = rng.uniform(-3, 3, (150, clearance.arm.n))
    gradient = clearance.gradient(q)
    reach = np.array([sum(clearance.capsules.parts[k].radius for k in pair) for pair in clearance.pairs])
    step, errors = 1e-6, []
    for row, g in zip(q, gradient, strict=True):
        around = np.concatenate([row + step * np.eye(len(row)), row - step * np.eye(len(row))])
        pair = clearance.closest_pair(around)
        if len(set(pair)) > 1 or clearance(row) + reach[pair[0]] < 0.01:
            continue  # a kink: another pair takes over, or the axes cross
        plus, minus = np.split(clearance(around), 2)
        errors.append(np.abs((plus - minus) / (2 * step) - g).max())
    assert len(errors) > 100
    assert np.quantile(errors, 0.9) < 2e-8
    assert max(errors) < 1e-3  # a foot that reaches an end of its segment: the second derivative jumps


def test_slopes_are_the_derivatives_of_the_distances(clearance, rng):
    n = clearance.arm.n
    x = ca.SX.sym("x", n)
    directions = [ca.cos(x[0]) * ca.DM(rng.normal(size=n)), ca.DM(np.eye(n)[1]) + x]
    slopes = clearance.slopes(2 * x, directions)  # of the distances at 2 x
    values = ca.vertcat(*clearance.distances(2 * x))
    f = Kernel("slopes", [x], [ca.vertcat(*[y for row in slopes for y in row])])
    expected = ca.horzcat(*[ca.jtimes(values, x, v) / 2 for v in directions])  # exact too, only longer
    g = Kernel("derivatives", [x], [expected], backend="casadi")
    q = rng.uniform(-1.5, 1.5, (40, n))
    np.testing.assert_allclose(f.rows(q), g.rows(q), atol=1e-7)
    assert np.array(Kernel("values", [x], [values]).rows(q)) == pytest.approx(clearance.by_pair(2 * q), abs=1e-13)


def test_gradient_is_finite_where_axes_are_parallel_or_cross(flat4):
    ours = Clearance(flat4)
    q = np.concatenate([np.zeros((1, 4)), np.pi / 2 * np.array(list(np.ndindex(3, 3, 3, 3)))])
    assert np.isfinite(ours(q)).all()
    assert np.isfinite(ours.gradient(q)).all()
    x = kinematics.joint_symbols(flat4)
    for backend in ("llvm", "casadi"):
        everything = Kernel("all", [x], [ca.jacobian(ca.vertcat(*ours.distances(x)), x)], backend=backend)
        assert np.isfinite(everything.rows(q)).all()


def test_backends_agree(panda, rng):
    x = kinematics.joint_symbols(panda.arm)
    q = oracles.inside(panda.arm, rng, 100)
    plain = Kernel("distances", [x], [ca.vertcat(*panda.distances(x))], backend="casadi")
    np.testing.assert_allclose(panda.by_pair(q), plain.rows(q), atol=1e-13)


def test_the_smallest_pair_is_the_clearance(clearance, rng):
    q = rng.uniform(-3, 3, (50, clearance.arm.n))
    each = clearance.by_pair(q)
    assert each.shape == (50, len(clearance.pairs)) == (50, len(clearance.pair_names))
    np.testing.assert_array_equal(clearance(q), each.min(axis=1))
    np.testing.assert_array_equal(clearance.closest_pair(q), each.argmin(axis=1))
    assert clearance(q[3]) == clearance(q)[3]
    assert clearance.closest_pair(q[3]) == clearance.closest_pair(q)[3]
    np.testing.assert_array_equal(clearance.gradient(q[3]), clearance.gradient(q)[3])
    np.testing.assert_array_equal(clearance.by_pair(q[3]), each[3])


def test_where_the_arm_stands_and_how_thick_it_is(panda, rng):
    q = oracles.inside(panda.arm, rng, 30)
    elsewhere = Clearance(panda.arm.with_base(oracles.random_pose(rng)), panda.capsules)
    np.testing.assert_array_equal(elsewhere(q), panda(q))
    radius = panda.capsules.parts[0].radius
    thin = Clearance(panda.arm, Capsules.along_links(panda.arm, radius / 2))
    shared = [thin.pair_names.index(name) for name in panda.pair_names]
    np.testing.assert_allclose(thin.by_pair(q)[:, shared], panda.by_pair(q) + radius, atol=1e-14)


# ---- which pairs ---------------------------------------------------------------------------------------------------


def test_every_pair_on_different_links_is_checked_or_has_a_reason(clearance):
    links = [part.link for part in clearance.capsules]
    different = {(a, b) for a in range(len(links)) for b in range(len(links)) if links[a] < links[b]}
    found = clearance.pairs + [x.pair for x in clearance.ignored]
    assert len(found) == len(set(found))
    assert set(found) == different
    for x in clearance.ignored:
        a, b = (links[k] for k in x.pair)
        assert (abs(a - b) == 1) == (x.reason == "adjacent links")
    assert len(set(clearance.pair_names)) == len(clearance.pairs)


def test_pairs_that_always_overlap_are_not_checked(rng):
    arm = arms.load("pa10-7dof")
    made = Clearance(arm)
    touching = [x for x in made.ignored if x.reason.startswith("overlap in")]
    assert [x.name for x in touching] == ["joint1 & joint3", "joint3 & joint5", "joint5 & joint7"]
    assert touching[0].reason == "overlap in 100.0 % of 512 configurations within the limits"
    q = oracles.inside(arm, rng, 300)
    assert (coal_distances(arm, made.capsules, [x.pair for x in touching], q) < 0).all()


def test_what_a_person_ignores(panda):
    q = arms.about("panda").home
    closest = panda.pairs[panda.closest_pair(q)]
    links = tuple(panda.capsules.parts[k].link for k in closest)
    less = Clearance(panda.arm, Capsules(panda.capsules.parts, (links[::-1],)))
    assert [x.pair for x in less.ignored if x.reason == "to be ignored"] == [closest]
    assert len(less.pairs) == len(panda.pairs) - 1
    assert less(q) > panda(q)


def test_capsules_of_one_link_are_numbered():
    arm = arms.load("planar-3r")
    parts = (
        LinkCapsule(0, (0, 0, 0), (0.4, 0, 0), radius=0.1),
        LinkCapsule(0, (0.5, 0, 0), (1, 0, 0), radius=0.1),
        LinkCapsule(2, (0, 0, 0), (1, 0, 0), radius=0.1),
    )
    made = Clearance(arm, Capsules(parts))
    assert made.pair_names == ["joint1 (1) & joint3", "joint1 (2) & joint3"]
    assert repr(made) == "<clearance of 'planar-3r': 3 capsules, 2 pairs checked>"


# ---- bad and empty input -------------------------------------------------------------------------------------------


def test_nan_stays_in_its_row(panda, rng):
    q = oracles.inside(panda.arm, rng, 20)
    clean, gradient = panda.by_pair(q), panda.gradient(q)
    q[[3, 11], [0, 6]] = np.nan, np.inf
    bad = np.isin(np.arange(20), [3, 11])
    np.testing.assert_array_equal(np.isnan(panda(q)), bad)
    np.testing.assert_array_equal(np.isnan(panda.gradient(q)).all(axis=1), bad)
    np.testing.assert_array_equal(panda.by_pair(q)[~bad], clean[~bad])
    np.testing.assert_array_equal(panda.gradient(q)[~bad], gradient[~bad])
    np.testing.assert_array_equal(panda.closest_pair(q) == -1, bad)
    for ask in (panda, panda.by_pair, panda.closest_pair, panda.gradient):
        with pytest.raises(InputError, match="q for 'panda' holds NaN or infinity; give 7 finite numbers"):
            ask(q[3])
        with pytest.raises(InputError, match="6 values per configuration"):
            ask(q[:, :6])
        assert len(ask(q[:0])) == 0


@pytest.mark.parametrize("parts", [(), (LinkCapsule(0, (0, 0, 0), (0, 0, 1), radius=0.1),)])
def test_an_arm_without_a_pair_is_never_in_its_own_way(panda, parts):
    ours = Clearance(panda.arm, Capsules(parts))
    q = np.zeros((3, 7))
    q[1, 2] = np.nan
    np.testing.assert_array_equal(ours(q), [np.inf, np.nan, np.inf])
    np.testing.assert_array_equal(ours.gradient(q)[[0, 2]], 0)
    assert np.isnan(ours.gradient(q)[1]).all()
    assert ours.by_pair(q).shape == (3, 0)
    assert ours.closest_pair(q).tolist() == [-1, -1, -1]
    assert ours(q[0]) == np.inf
    assert ours.distances(kinematics.joint_symbols(panda.arm)) == []
    assert ours.slopes(kinematics.joint_symbols(panda.arm), [ca.DM.ones(7)]) == []
