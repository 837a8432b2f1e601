"""What the prover finds, against closed forms, sampled errors and inverse kinematics of another library."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pinocchio as pin
import pytest
from fuzzed import Claimed
from rivals import half_widths
from scipy.optimize import least_squares

import holdfast as hf
import oracles
from holdfast.certificates import reach_claim, verifier
from holdfast.certificates.target_boxes.search import TargetBoxSearch
from holdfast.certificates.taylor import CertificateChain, ReachSolver, TaylorForm
from holdfast.certificates.tree import compute_undecided_fraction
from holdfast.certificates.verifier import format_percent
from holdfast.core.errors import InputError
from holdfast.kernels import set_threads


def test_the_chain_of_the_file_is_the_arm(panda, rng):
    """Joints turn about the z axes of the frames that the file holds."""
    for arm in (panda, oracles.random_arm(rng, types="RRPRR", limits=2.0)):
        chain, q, place = CertificateChain.from_arm(arm), rng.uniform(-1.5, 1.5, arm.n), np.eye(4)
        for k in range(arm.n + 1):
            frame, turn = np.eye(4), np.eye(4)
            frame[:3, :3], frame[:3, 3] = chain.rotations[k], chain.origins[k]
            if k < arm.n and arm.prismatic[k]:
                turn[2, 3] = q[k]
            elif k < arm.n:
                turn[:2, :2] = [[np.cos(q[k]), -np.sin(q[k])], [np.sin(q[k]), np.cos(q[k])]]
            place = place @ frame @ turn
        np.testing.assert_allclose(place, arm.forward_kinematics(q), atol=1e-12)


@pytest.mark.parametrize(
    ("types", "locked"), [("RRRRR", -1), ("RRRRR", 1), ("RRRRR", 3), ("RPRRP", -1), ("RPRPR", 1), ("RPRPR", 2)]
)
def test_the_error_is_never_larger_than_its_bound(types, locked, rng):
    """The third-order remainder and all before it, at random points of random boxes; far from it the bound would be useless."""
    arm = oracles.random_arm(rng, types=types, limits=2.5)
    reach = ReachSolver(arm, "position", locked, np.tile([-9.0, 9.0], (5, 1)), angle=np.array([-1.6, 1.6]))
    q = rng.uniform(-1.5, 1.5, (40, 5))
    at = arm.forward_kinematics(q)[:, :3, 3]
    form = TaylorForm.expand_at(reach, q, at + rng.uniform(-1e-3, 1e-3, (40, 3)))
    axes = 3 + (locked >= 0)
    cells, sections = rng.uniform(0, 0.08, (40, axes)), rng.uniform(0, 0.08, (40, 3))
    above, below, far = form.bound_error_and_travel(cells, sections)
    jacobians = arm.jacobian(q)[:, :3]
    inverse = np.zeros((40, 5, 3))
    inverse[:, reach.free] = np.linalg.pinv(jacobians[:, :, reach.free])
    closest = 0.0
    for _ in range(50):
        delta, s = rng.choice([-1.0, 1.0, 0.3], cells.shape) * cells, rng.choice([-1.0, 1.0, 0.3], (40, 3)) * sections
        follow = (inverse @ (delta[:, :3] + s)[:, :, None])[..., 0]
        if locked >= 0:
            follow -= (inverse @ jacobians[:, :, [locked]])[..., 0] * delta[:, [3]]
            follow[:, locked] = delta[:, 3]
        assert (np.abs(follow) <= far + 1e-12).all()
        error = arm.forward_kinematics(q + follow)[:, :3, 3] - (at - form.error) - delta[:, :3] - s
        assert (error <= above + 1e-12).all()
        assert (-error <= below + 1e-12).all()
        closest = max(closest, float(np.maximum(error / above, -error / below).max()))
    assert closest > 0.15


def reached(box, angle, count=400):
    """Share of targets and angles of joint 2 where three unit links, full turns, reach: |r - 2 cos(theta/2)| <= 1."""
    x, y = (np.linspace(*side, 2 * count + 1)[1::2] for side in box)
    far = np.hypot(x[:, None], y[None]).ravel()
    arms = 2 * np.cos(np.linspace(*angle, 2 * 60 + 1)[1::2] / 2)
    return float(np.mean([(abs(far - a) <= 1).mean() for a in arms]))


def test_what_is_proved_is_no_more_than_the_truth(three, tmp_path):
    claim = reach_claim(three, (1.9, 1.9), 1.2, locked={"joint2": (1.0, 1.6)})
    proof = hf.certify(claim, halvings=4)
    truth = reached(claim.box, claim.angle)
    assert proof.proved + proof.undecided == 1
    assert truth - 0.2 < float(proof.proved) <= truth + 1e-3  # the grid of the truth has cells too
    assert not proof.ok
    check = hf.check_certificate(proof.write(tmp_path / "a.certificate"))
    assert check.ok
    assert check.accepted == proof.leaves
    assert check.undecided == proof.undecided
    coarser = hf.certify(claim, halvings=3)
    assert coarser.undecided > proof.undecided > 0


def test_a_box_within_reach_is_proved_whole_and_twice_alike(three, tmp_path):
    claim = reach_claim(three, (1.2, 0.9), (0.3, 0.2), locked={"joint3": (0.8, 1.5)})
    proof = hf.certify(claim)
    assert proof.ok
    assert proof.undecided == 0
    assert proof.proved == Fraction(1)
    set_threads(2)
    try:
        assert hf.certify(claim).document["digest"] == proof.document["digest"]
    finally:
        set_threads(None)
    assert hf.check_certificate(proof.write(tmp_path / "a.certificate")).ok
    assert "not yet verified" in " ".join(proof.describe())


@pytest.fixture(scope="module")
def elbow(panda):
    claim = reach_claim(panda, (0.5, 0.05, 0.5), 0.1, locked={"panda_joint4": (-2.0, -1.9)})
    return claim, hf.certify(claim, seed=3)


def test_every_target_of_a_panda_has_a_configuration(panda, elbow, rng, tmp_path):
    """Random targets and angles, corners among them: scipy and Pinocchio find a configuration within the limits."""
    claim, proof = elbow
    assert proof.ok
    assert hf.check_certificate(proof.write(tmp_path / "a.certificate")).rejected == 0
    claimed = Claimed(tmp_path / "a.certificate")
    assert claimed.unreached(rng, 400) == (0, pytest.approx(0, abs=1e-12))
    claimed.corner[:, 0] += 1.0  # the judge can say no
    assert claimed.unreached(rng, 1, tries=2)[0] == 1
    model, tool = oracles.to_pinocchio(panda)
    data = model.createData()
    free = [k for k in range(7) if k != 3]

    def off(x, q, point):
        q[free] = x
        pin.framesForwardKinematics(model, data, q)
        return data.oMf[tool].translation - point

    for _ in range(15):
        share = rng.uniform(-0.2, 1.2, 4).clip(0, 1)
        point = claim.box[:, 0] + share[:3] * np.diff(claim.box)[:, 0]
        q = np.zeros(7)
        q[3] = claim.angle[0] + share[3] * np.diff(claim.angle)[0]
        for _ in range(60):
            start = rng.uniform(panda.lower[free], panda.upper[free])
            bounds = panda.lower[free], panda.upper[free]
            found = least_squares(off, start, bounds=bounds, args=(q, point), xtol=1e-15, ftol=1e-15, gtol=1e-15)
            if np.abs(found.fun).max() < 1e-9:
                break
        else:
            raise AssertionError(f"no configuration for {point} at {q[3]}")


@pytest.mark.parametrize("lock", [{}, {"rail": (0.05, 0.15)}, {"elbow_joint": (1.4, 1.6)}])
def test_an_arm_on_a_rail(lock, rng, tmp_path):
    """A slide counts, free or locked; the verifier agrees, and so does Pinocchio at random targets."""
    arm = hf.arms.load("ur5-rail")
    start = np.array([0.3, 0.3, -1.2, 1.5, -0.6, -1.2, 0.2])
    claim = reach_claim(
        arm, arm.forward_kinematics(start)[:3, 3], 0.05, locked=lock or None, limits={} if "rail" in lock else {0: (0, 0.5)}
    )
    proof = hf.certify(claim)
    assert proof.ok
    assert hf.check_certificate(proof.write(tmp_path / "a.certificate")).rejected == 0
    assert Claimed(tmp_path / "a.certificate").unreached(rng, 100)[0] == 0
    assert '"prismatic"' in (tmp_path / "a.certificate").read_text()
    model, tool = oracles.to_pinocchio(arm)
    data, free = model.createData(), [k for k in range(7) if k != claim.locked]
    for _ in range(5):
        point = rng.uniform(*claim.box.T)
        q = np.zeros(7)
        if lock:
            q[claim.locked] = rng.uniform(*claim.angle)
        low, high = claim.limits[free].T

        def off(x, q=q, point=point):
            q[free] = x
            pin.framesForwardKinematics(model, data, q)
            return data.oMf[tool].translation - point

        tries = (
            least_squares(off, rng.uniform(low, high), bounds=(low, high), xtol=1e-15, ftol=1e-15, gtol=1e-15)
            for _ in range(40)
        )
        assert any(np.abs(found.fun).max() < 1e-9 for found in tries)


def test_what_nothing_reaches_is_refused_before_the_search(panda):
    with pytest.raises(InputError, match="no configuration was found for any of 250 sampled targets"):
        hf.certify(reach_claim(panda, (1.5, 0, 0.3), 0.1))


def test_a_time_limit_leaves_the_rest_undecided(panda):
    proof = hf.certify(reach_claim(panda, (0.5, 0, 0.5), 0.6), time_limit=0.01)
    assert not proof.finished
    assert 0 < proof.undecided <= 1
    assert proof.proved + proof.undecided == 1
    tokens = verifier.decompress_payload(proof.document["tree"], 10**7, "tree")
    assert sum(token >= 16 for token in tokens) + 1 == sum(token < 16 for token in tokens)


def test_what_is_proved_first(three):
    """A time limit in batches: the share proved grows all the way, and never shrinks."""
    claim = reach_claim(three, (1.3, 0.6), 0.8, locked={"joint2": (0.6, 2.0)})
    root = np.vstack([claim.box, claim.angle])
    search = TargetBoxSearch(ReachSolver(three, "planar", 1, claim.limits), root, 8, 0)
    shares = []
    search.run(
        report_progress=lambda: shares.append(
            (1 - search.open_fraction, search.nodes, float(1 - compute_undecided_fraction(search.tree.preorder_tokens())))
        )
    )
    closed, nodes, proved = np.array(shares).T
    assert (np.diff(closed) >= 0).all()
    assert (np.diff(proved) >= 0).all()
    assert closed[-1] == pytest.approx(1)
    half = np.searchsorted(nodes, nodes[-1] / 2)
    assert proved[half] > 0.4 * proved[-1]  # breadth first it would be nearly nothing


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"centre": (0.5, 0, np.nan)}, "finite"),
        ({"centre": (0.5,)}, "three finite numbers"),
        ({"size": -0.1}, "size of the box"),
        ({"locked": {"panda_joint9": (0, 1)}}, "no joint 'panda_joint9'"),
        ({"locked": {"panda_joint4": (-1.0, -2.0)}}, "lower one first"),
        ({"locked": {"panda_joint4": (-4.0, -2.0)}}, "outside of its limits"),
        ({"locked": {"panda_joint4": (-2, -1), "panda_joint1": (0, 1)}}, "one, or none"),
        ({"limits": {"panda_joint1": (-9.0, 0.0)}}, "outside of its limits"),
        ({"locked": {"panda_joint4": (-2.5, -1.0)}, "limits": {"panda_joint4": (-2.0, -1.5)}}, "beyond the limits"),
    ],
)
def test_what_makes_no_claim(panda, change, sentence):
    with pytest.raises(InputError, match=sentence):
        reach_claim(panda, **({"centre": (0.5, 0, 0.5), "size": 0.1} | change))


def test_limits_of_the_joint_that_locks_are_kept(panda):
    claim = reach_claim(
        panda,
        (0.5, 0, 0.5),
        0.1,
        locked={"panda_joint4": (-2, -1.9)},
        limits={"panda_joint4": (-2.5, -1.5), "panda_joint1": (-1, 1)},
    )
    np.testing.assert_array_equal(claim.limits[[0, 3]], [[-1, 1], [-2.5, -1.5]])


@pytest.mark.parametrize(
    ("part", "down", "up"),
    [
        (Fraction(0), "0 %", "0 %"),
        (Fraction(1), "100 %", "100 %"),
        (Fraction(2, 3), "66.666666 %", "66.666667 %"),
        (Fraction(1, 2**16), "0.0015 %", "0.0016 %"),
        (1 - Fraction(1, 2**10), "99.902343 %", "99.902344 %"),
        (1 - Fraction(1, 2**40), "99.999999 %", "all but 9.0e-11 %"),
    ],
)
def test_what_is_proved_is_never_rounded_up(part, down, up):
    assert (format_percent(part), format_percent(part, up=True)) == (down, up)


def test_what_is_refused(panda, three, mixed5, tmp_path):
    with pytest.raises(InputError, match="lengths, m"):
        reach_claim(mixed5, (0.5, 0, 0.5), 0.1, locked={int(np.flatnonzero(mixed5.prismatic)[0]): (1, 0)})
    with pytest.raises(InputError, match="2 joints are free for 3 task rows"):
        reach_claim(three, (0.5, 0.5, 0.0), 0.1, locked={"joint1": (0, 1)})
    with pytest.raises(InputError, match="halvings"):
        hf.certify(reach_claim(three, (1, 1), 0.1), halvings=30)
    with pytest.raises(InputError, match="cannot read"):
        hf.check_certificate(tmp_path / "none.certificate")
    (tmp_path / "bad.certificate").write_text("{}")
    with pytest.raises(InputError, match="form"):
        hf.check_certificate(tmp_path / "bad.certificate")


def test_smaller_boxes_take_fewer_cells(three):
    sizes = [hf.certify(reach_claim(three, (1.5, 0.8), size, locked={"joint1": (0.2, 0.6)})).leaves for size in (0.1, 0.4, 0.8)]
    assert all(a <= b for a, b in pairwise(sizes))


@pytest.mark.parametrize("locked", [-1, 1])
def test_boxes_are_much_wider_than_those_of_intervals(panda, rng, locked):
    """At the same configurations with the same sections (K5: six times; measured: 8 to 17)."""
    at = rng.uniform((0.4, -0.1, 0.45), (0.6, 0.1, 0.6), (3, 3))
    q = rng.uniform((-0.5, -0.5, -0.5, -2.0, -1.0, 1.2, -1.0), (0.5, 0.5, 0.5, -1.8, 1.0, 2.2, 1.0), (3, 7))
    ours, theirs = half_widths(panda, locked, at if locked < 0 else np.column_stack([at, q[:, locked]]), q)
    assert len(ours) > 0
    assert np.median(ours / theirs) > 6
