"""What is said to be finished after a lock, against closed forms, integration by scipy, and forgers."""

from __future__ import annotations

import contextlib
import copy
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest
import written
from driven import SEGMENT, Driven
from scipy.optimize import least_squares
from written import put, shifted

import holdfast as hf
from holdfast.certificates import path_claim, verifier
from holdfast.certificates.taylor import CertificateChain
from holdfast.certificates.tool_paths import march
from holdfast.certificates.tool_paths.forms import LockedTrackingEnclosure
from holdfast.certificates.verifier_parts import motions
from holdfast.certificates.verifier_parts.taylor import TaskErrorEnclosure
from holdfast.core.errors import InputError

pytest.importorskip("flint", reason="python-flint is not installed")
START = np.radians([-35, -45, 51, -111, -46, 84, -3])


def straight(arm, start, move, count):
    """Knots whose tools lie on a line, turned as at the start."""
    q, found = np.array(start), [np.array(start)]
    first = arm.forward_kinematics(q)
    for k in range(1, count + 1):
        for _ in range(6):
            now = arm.forward_kinematics(q)
            turn = sum(np.cross(now[:3, i], first[:3, i]) for i in range(3)) / 2
            away = first[:3, 3] + np.array(move) * k / count - now[:3, 3]
            q = q + np.linalg.pinv(arm.jacobian(q)) @ np.append(away, turn)
        found.append(q)
    return np.array(found)


def whole(check):
    return check.rejected == 0 and check.accepted == check.leaves > 0 and check.undecided == 0


@pytest.fixture(scope="module")
def moved(panda):
    """A Panda whose tool goes down by 60 mm, in a tube of 0.1 mm and 0.1 mrad."""
    return hf.certify(path_claim(panda, straight(panda, START, [0, 0, -0.06], 6), tube=1e-4), halvings=3)


@pytest.fixture(scope="module")
def elbow(moved, panda):
    """Its elbow, of which the first sixth is refuted."""
    return hf.certify(path_claim(panda, moved.claim.knots, failures=[3], during=(0, 1 / 6)), halvings=0)


@pytest.fixture(scope="module")
def bent(three):
    """A planar arm that stretches: after some locks the end is out of reach."""
    knots = np.array([0.3, 1.6, 0.7]) + np.linspace(0, 1, 7)[:, None] * [0.2, -1.2, -0.5]
    return hf.certify(path_claim(three, knots, task="planar"), halvings=4)


def test_a_panda_finishes_whatever_locks_but_its_elbow(moved, tmp_path):
    proved = [float(part.proved) for part in moved.parts]
    assert [proved[k] for k in (0, 1, 2, 4, 5, 6)] == [1] * 6
    assert proved[3] < 0.5
    check = hf.check_certificate(moved.write(tmp_path / "a.certificate"))
    assert (check.rejected, check.undecided, check.tolerant) == (0, moved.undecided, moved.tolerant)
    assert [(part.refuted, part.undecided) for part in check.parts] == [(part.refuted, part.undecided) for part in moved.parts]
    assert moved.leaves == check.accepted


def test_integration_finishes_from_random_lock_instants(moved, bent, tmp_path, rng):
    """An integrator of scipy's, on what the files say, comes to the end, within the limits."""
    for proof, each in ((moved, 1), (bent, 4)):
        driven = Driven(proof.write(tmp_path / "a.certificate"))
        for lock in driven.document["locks"]:
            slabs = driven.slabs(lock)
            for which in rng.integers(len(slabs), size=each * bool(slabs)):
                off, beyond = driven.finished(lock, rng.uniform(*slabs[which]))
                assert off < 1e-6
                assert beyond < 1e-9


def test_closed_form_of_a_planar_arm(bent, tmp_path):
    """Three links of 1 m: after a lock the tool turns about an elbow, or at the end of a longer link, in an annulus."""
    assert whole(hf.check_certificate(bent.write(tmp_path / "a.certificate"))) == bent.ok
    driven, knots = Driven(tmp_path / "a.certificate"), bent.claim.knots
    at = (np.arange(6 * 64) + 0.5) / 64
    healthy = np.array([driven.healthy(s)[0] for s in at])
    angle = np.cumsum(healthy, axis=1)
    tool = np.exp(1j * angle).sum(axis=1)
    for part in bent.parts:
        true = np.zeros(len(at), dtype=bool)
        for k, q in enumerate(healthy):
            pivot = np.exp(1j * q[0]) if part.joint == 0 else 0
            long = 1.0 if part.joint == 0 else 2 * np.cos(q[part.joint] / 2)
            away = np.abs(np.append(tool[k:], np.exp(1j * np.cumsum(knots[-1])).sum()) - pivot)
            true[k] = away.max() < 1 + long and away.min() > abs(1 - long)
        said = np.zeros(len(at), dtype=bool)
        for begin, stop in part.proved_lock_intervals:
            said |= (at > begin / SEGMENT) & (at < stop / SEGMENT)
        assert not (said & ~true).any()
        assert (true & ~said).mean() < 0.05
        never = np.zeros(len(at), dtype=bool)
        for begin, stop in part.refuted_lock_intervals:
            never |= (at > begin / SEGMENT) & (at < stop / SEGMENT)
        assert not (never & true).any()
        assert (~never & ~true).mean() < 0.02
    assert 0 < bent.tolerant < 1
    assert [part.refuted > 0 for part in bent.parts] == [True] * 3


def test_where_a_lock_is_refuted_nothing_is_found(moved, elbow, tmp_path, rng):
    """By scipy's least squares, which finds the tool's place again if the elbow locks later."""
    assert (elbow.refuted, hf.check_certificate(elbow.write(tmp_path / "b.certificate")).refuted) == (1, 1)
    driven = Driven(moved.write(tmp_path / "a.certificate"))
    lock = driven.document["locks"][3]
    (first, *_, last), free = lock["refutations"], [0, 1, 2, 4, 5, 6]
    goal, wanted, _ = driven.tool(driven.knots[first["at"] // SEGMENT])
    low, high = driven.low[free], driven.high[free]
    for instant, found in ((first["begin"], False), (last["stop"] - 1, False), (5.9 * SEGMENT, True)):
        q = driven.healthy(instant / SEGMENT)[0]

        def missed(x, q=q):
            place, turn, _ = driven.tool(np.insert(x, 3, q[3]))
            return np.append(place - goal, (turn - wanted).ravel() / 2)

        starts = [q[free], *rng.uniform(low, high, (5, 6))]
        left = min(least_squares(missed, x.clip(low, high), bounds=(low, high)).cost for x in starts)
        assert (left < 1e-16) == found


def test_joints_that_are_left_over_follow(tmp_path, rng):
    """Nine joints and six rows: two of those that are left go on with the healthy motion."""
    arm = hf.arms.load("pa10-9dof")
    knots = np.radians([10, 40, -15, 80, 20, 18, -10, 36, 5]) + np.linspace(0, 0.1, 4)[:, None] * rng.normal(size=9)
    proof = hf.certify(path_claim(arm, knots, failures=[0, 3], during=(0.3, 0.9)))
    assert all(len(part.followers) == 2 for part in proof.parts)
    assert proof.proved > 0.9
    file = proof.write(tmp_path / "a.certificate")
    check = hf.check_certificate(file)
    assert (check.rejected, check.undecided) == (0, proof.undecided)
    driven = Driven(file)
    lock = driven.document["locks"][1]
    off, beyond = driven.finished(lock, rng.uniform(*driven.slabs(lock)[-1]))
    assert off < 1e-6 > beyond


def test_an_arm_on_a_rail(tmp_path, rng):
    """A slide that locks, and one that goes on; what is behind the second order is bounded with it as well."""
    arm = hf.arms.load("ur5-rail")
    start = np.array([0.2, 0.3, -1.2, 1.4, -1.0, -1.3, 0.2])
    proof = hf.certify(path_claim(arm, straight(arm, start, [0.02, 0.03, 0.02], 3), failures=[0, 2]))
    check = hf.check_certificate(proof.write(tmp_path / "a.certificate"))
    assert (check.rejected, check.undecided) == (0, proof.undecided)
    driven = Driven(tmp_path / "a.certificate")
    for lock in driven.document["locks"]:
        off, beyond = driven.finished(lock, rng.uniform(*driven.slabs(lock)[0]))
        assert off < 1e-6 > beyond
    assert proof.proved > 0.9
    faults = motions.PathVerifier(proof.document)
    q, h = start + rng.normal(size=(2, 7)) * 0.05
    with motions.flint.ctx.workprec(64):
        error, first, second = (x.center for x in between(faults, q, h))
    for d in rng.normal(size=(100, 14)) * 0.1:
        far = np.abs(d)
        (place, _, _), (goal, _, _) = driven.tool(q + d[:7]), driven.tool(h + d[:6:-1])
        line = error + first @ d + np.einsum("akl,k,l->a", second, d, d) / 2
        left = [
            faults.chain.bound_derivative(3, x[None], faults.chain.link_lengths, y[None])[0] / 6
            for x, y in ((far[:7], q), (far[:6:-1], h))
        ]
        assert (np.abs(place - goal - line[:3]) <= sum(left) + 1e-12).all()


def test_a_rail_that_locks_too_early(tmp_path):
    """From where the shoulder then is, the links are not so long, one behind the other."""
    arm = hf.arms.load("ur5-rail")
    knots = np.array([[0.5, 0.2, -1.2, 1.5, -0.8, -1.5, 0.3]]) + [[0], [1.4]] * np.eye(7)[0]
    proof = hf.certify(path_claim(arm, knots, failures=[0], during=(0, 0.25)), halvings=0)
    assert proof.refuted == 1
    assert hf.check_certificate(proof.write(tmp_path / "a.certificate")).refuted == 1
    places = np.array([frame[:3, 3] for frame in arm.frames(knots[1])[2:]])
    moved_back = 0.75 * 1.4
    assert np.linalg.norm(places[-1] - places[0] + [0, moved_back, 0]) > np.linalg.norm(np.diff(places, axis=0), axis=1).sum()


def test_a_tool_that_points(panda, tmp_path, rng):
    """It may turn about its axis: five rows, and one joint that follows."""
    proof = hf.certify(path_claim(panda, straight(panda, START, [0, 0, -0.03], 2), failures=[1, 4], task="pointing"))
    check = hf.check_certificate(proof.write(tmp_path / "a.certificate"))
    assert (check.rejected, check.undecided) == (0, proof.undecided)
    assert proof.ok
    driven = Driven(tmp_path / "a.certificate")
    for lock in driven.document["locks"]:
        off, beyond = driven.finished(lock, rng.uniform(0, 2))
        assert off < 1e-6 > beyond
    faults = motions.PathVerifier(proof.document)
    (q, h), e = START + rng.normal(size=(2, 7)) * 0.02, 1e-4
    across = driven.tool(h)[1][:, :2].T

    def missed(move):
        (place, turn, _), (goal, wanted, _) = driven.tool(q + move[:7]), driven.tool(h + move[:6:-1])
        return np.append(place - goal, across @ (turn - wanted)[:, 2])

    with motions.flint.ctx.workprec(64):
        error, first, second = (x.center for x in between(faults, q, h))
    assert error == pytest.approx(missed(np.zeros(14)), abs=1e-14)
    for a, b in e * np.eye(14)[rng.integers(14, size=(15, 2))]:
        assert first @ a == pytest.approx((missed(a) - missed(-a)) / 2, abs=1e-11)
        bend = (missed(a + b) - missed(a - b) - missed(b - a) + missed(-a - b)) / 4
        assert a @ second @ b == pytest.approx(bend, abs=1e-13)


def test_closed_form_of_a_planar_pose(flat4, tmp_path, rng):
    """The pose says where the last joint is, and its lock where the one before is: again there are annuli."""
    knots = np.array([0.3, 0.9, 0.5, -0.6]) + np.linspace(0, 1, 3)[:, None] * [0.2, -0.5, -0.3, 0.4]
    proof = hf.certify(path_claim(flat4, knots, task="planar-pose"), halvings=3)
    check = hf.check_certificate(proof.write(tmp_path / "a.certificate"))
    assert (check.rejected, check.undecided, check.refuted) == (0, proof.undecided, proof.refuted)
    driven, links = Driven(tmp_path / "a.certificate"), np.array([1.0, 0.8, 0.6, 0.4])
    at = (np.arange(2 * 32) + 0.5) / 32
    healthy = np.array([driven.healthy(s)[0] for s in [*at, 2.0]])
    ends = links * np.exp(1j * np.cumsum(healthy, axis=1))
    for part in proof.parts:
        true = np.zeros(len(at), dtype=bool)
        for k, q in enumerate(healthy[:-1]):
            goal = ends[k:, :3].sum(axis=1)  # of the last joint
            long, short = abs(links[0] + links[1] * np.exp(1j * q[1])), links[2]
            if part.joint == 0:
                goal, long, short = goal - np.exp(1j * q[0]), *links[1:3]
            elif part.joint == 2:
                long, short = links[0], abs(links[1] + links[2] * np.exp(1j * q[2]))
            elif part.joint == 3:
                goal = goal - links[2] * np.exp(1j * (healthy[k:].sum(axis=1) - q[3]))
                long, short = links[:2]
            true[k] = np.abs(goal).max() < long + short and np.abs(goal).min() > abs(long - short)
        said, never = np.zeros((2, len(at)), dtype=bool)
        for which, spans in ((said, part.proved_lock_intervals), (never, part.refuted_lock_intervals)):
            for begin, stop in spans:
                which |= (at > begin / SEGMENT) & (at < stop / SEGMENT)
        assert not (said & ~true).any()
        assert not (never & true).any()
        assert (~said & ~never).mean() < 0.15
    assert proof.refuted > 0
    lock = next(lock for lock in driven.document["locks"] if driven.slabs(lock))
    off, beyond = driven.finished(lock, rng.uniform(*driven.slabs(lock)[0]))
    assert off < 1e-6 > beyond


@pytest.fixture(scope="module")
def singular(three):
    """A planar arm whose last joint comes straight while its first, which locks, draws the tool inwards: fast as a root is."""
    knots = np.array([0.3, 1.2, 0.25]) + np.linspace(0, 1, 5)[:, None] * [-0.3, -0.2, -0.5]
    return hf.certify(path_claim(three, knots, failures=[0], task="planar"), halvings=4)


def turned_cells(document, lock=0):
    """Where the half widths of turned cells are among the numbers of a lock."""
    values, at, found = numbers(document, lock), 0, []
    while at < len(values):
        cells = range(at + 3, at + 3 + values[at + 2])
        found += [k for k in cells if values[k] < 0]
        at = cells[-1] + 1
    return found


def test_by_a_singular_configuration(singular, three, tmp_path, rng, monkeypatch):
    """Cells that are turned come near to it, others do not; scipy's integrator starts there as well, before it and behind."""
    file = singular.write(tmp_path / "a.certificate")
    assert turned_cells(singular.document)
    check = hf.check_certificate(file)
    assert (check.rejected, check.undecided) == (0, singular.undecided)
    driven = Driven(file)
    (lock,) = driven.document["locks"]
    near = sorted(driven.slabs(lock), key=lambda slab: abs(sum(slab) / 2 - 2))[:4]
    assert {begin > 2 for begin, _ in near} == {False, True}
    for slab in near:
        off, beyond = driven.finished(lock, rng.uniform(*slab))
        assert off < 1e-6 > beyond
    monkeypatch.setattr(march, "march_through_singularity", lambda _, slabs: [None] * len(slabs))
    plain = hf.certify(singular.claim, halvings=4)
    assert singular.proved > 0.9
    assert singular.proved > plain.proved + Fraction(1, 5)


def test_turned_cells_that_a_forger_changes_are_rejected(singular, tmp_path):
    """Made wider, without the one behind, moved along the path: never more is proved than before."""
    where = turned_cells(singular.document)
    last = max(k for k in where if k + 1 not in where)
    rows = numbers(singular.document, 0, "centres", "<i4").reshape(-1, 3)
    row = int(np.flatnonzero(rows[:, 0])[0])
    forgers = [
        recut(moved_by(where[0], -(1 << 28))),
        recut(moved_by(where[0], numbers(singular.document, 0)[where[0]] * -1 + SEGMENT)),
        recut(moved_by(3 * row, 1 << 17), key="centres", kind="<i4"),
        recut(moved_by(3 * row + 1, 1 << 22), key="centres", kind="<i4"),
        recut(moved_by(last + 1, -(1 << 19))),
        put(("tube", 0), (1e-5).hex()),
    ]
    for forge in forgers:
        document = copy.deepcopy(singular.document)
        forge(document)
        path = written.stored(written.repaired(document), tmp_path / "a.certificate")
        with contextlib.suppress(verifier.CertificateRejected):
            assert verifier.verify(path).rejected > 0


def flipped(monkeypatch, knot):
    """A search that takes the other elbow from a knot on: what it finds there exists, and no motion leads to it."""
    before = LockedTrackingEnclosure.predict_cell_centers

    def guessed(self, forms, cells, middle):
        q = before(self, forms, cells, middle)
        other = np.stack([q[:, 0], q[:, 1] + q[:, 2], -q[:, 2]], axis=1)
        other[:, 1] += 2 * np.arctan2(np.sin(q[:, 2]), 1 + np.cos(q[:, 2])) - q[:, 2]
        return np.where((cells.start == knot * SEGMENT)[:, None], other, q)

    monkeypatch.setattr(LockedTrackingEnclosure, "predict_cell_centers", guessed)


def test_existence_in_every_cell_is_no_motion(three, tmp_path, monkeypatch):
    """A march without glue proves what is none, and only glue tells: by the march's own, and by the verifier's."""
    knots = np.array([0.3, 0.8, 1.1]) + np.linspace(0, 1, 9)[:, None] * [0.2, -0.1, 0.2]
    claim = path_claim(three, knots, failures=[0], task="planar")
    assert hf.certify(claim).ok
    flipped(monkeypatch, 5)
    glued = hf.certify(claim, halvings=1)
    assert [(part.proved_lock_intervals[0][0], part.proved) for part in glued.parts] == [(5 * SEGMENT, 3 / 8)]
    monkeypatch.setattr(LockedTrackingEnclosure, "continues_previous_solution", lambda self, before, forms: forms.good)
    loose = hf.certify(claim, halvings=1)
    assert loose.ok
    check = hf.check_certificate(loose.write(tmp_path / "a.certificate"))
    assert check.undecided == 5 / 8
    assert check.rejected == 5


# ---- forgers ---------------------------------------------------------------------------------------------------------


def numbers(document, lock, key="cells", kind="<i8"):
    return np.frombuffer(written.unpacked(document["locks"][lock][key]), kind).copy()


def recut(change, lock=0, key="cells", kind="<i8"):
    """A forger of a payload."""

    def forge(document):
        values = change(numbers(document, lock, key, kind))
        document["locks"][lock][key] = written.packed(values.tobytes())

    return forge


def swapped(values):
    rows = values.reshape(-1, 7)
    rows[[2, 3]] = rows[[3, 2]]
    return values


def dropped(values):
    """The second cell of the first slab, as if the first went as far."""
    values[2] -= 1
    return np.delete(values, 3)


def moved_by(place, by):
    def change(values):
        values[place] += by
        return values

    return change


def said(key, value):
    def forge(document):
        document["volumes"][key] = value

    return forge


@pytest.mark.parametrize(
    "forge",
    [
        put(("knots", 4, 1), lambda x: shifted(x, 0.02)),
        put(("tube", 0), lambda x: shifted(x, 0.01)),
        put(("tube", 1), lambda x: shifted(x, 0.02)),
        put(("arm", "joints", 5, "origin", 0), lambda x: shifted(x, 0.02)),
        put(("limits", 1, 1), lambda x: shifted(x, -2.6)),
        put(("locks", 1, "joint"), 2),
        put(("locks", 0, "followers"), [1]),
        recut(swapped, key="centres", kind="<i4"),
        recut(moved_by(8, 10_000_000), key="centres", kind="<i4"),
        recut(lambda x: x[:-7], key="centres", kind="<i4"),
        recut(dropped),
        recut(moved_by(3, 1 << 18)),
        recut(moved_by(1, 1 << 18)),
        recut(moved_by(0, -1)),
        recut(moved_by(2, 1)),
        recut(lambda x: x[:-1]),
        recut(lambda x: np.append(x, [1, 2, 0])),
        put(("during", 1), 7 * SEGMENT),
        put(("locks", 3, "proved"), "1/1"),
        said("proved", "1/1"),
        said("undecided", "0/1"),
        put(("task",), "position"),
        put(("unit",), (2.0**-24).hex()),
        put(("knots", 3, 2), "0x1.8000000000000p+2"),
    ],
)
def test_what_a_forger_changes_is_rejected(moved, tmp_path, forge):
    """With all digests made anew."""
    document = copy.deepcopy(moved.document)
    forge(document)
    path = written.stored(written.repaired(document), tmp_path / "a.certificate")
    with contextlib.suppress(verifier.CertificateRejected):
        assert verifier.verify(path).rejected > 0


@pytest.mark.parametrize(
    "forge",
    [
        put(("locks", 0, "refuted"), "1/2"),
        put(("locks", 0, "refutations", 0, "begin"), 1),
        put(("locks", 0, "refutations", 0, "stop"), 2 * SEGMENT),
        put(("locks", 0, "refutations", 0, "at"), SEGMENT),
        put(("locks", 0, "refutations", 0, "tree"), lambda x: written.packed(written.unpacked(x)[:-1])),
        put(("locks", 0, "refutations", 0, "tree"), written.packed(b"\0")),
        put(("points", 0, "place", 2), lambda x: shifted(x, 0.5)),
        put(("pairs", 0), [3, 1]),
        put(("locks", 0, "refutations"), []),
        lambda document: put(("knots", 6, 3), document["knots"][0][3])(document),  # as it was at the lock
        put(("knots", 0, 3), lambda x: shifted(x, -0.1)),
    ],
)
def test_refutations_that_a_forger_changes_are_rejected(elbow, tmp_path, forge):
    document = copy.deepcopy(elbow.document)
    forge(document)
    path = written.stored(written.repaired(document), tmp_path / "a.certificate")
    with contextlib.suppress(verifier.CertificateRejected):
        assert verifier.verify(path).rejected > 0


@pytest.mark.parametrize("value", [-7.5, 7.5])
def test_knots_beyond_seven_radians_are_refused(moved, tmp_path, value):
    """A joint with wide limits goes there; the verifier computes with angles below 7 rad only."""
    document = copy.deepcopy(moved.document)
    wide = [(-8.0).hex(), (8.0).hex()]
    for path in (("arm", "joints", 0, "limits"), ("limits", 0)):
        put(path, wide)(document)
    put(("knots", 2, 0), value.hex())(document)
    with pytest.raises(verifier.CertificateRejected, match="beyond 7 rad"):
        verifier.verify(written.stored(written.repaired(document), tmp_path / "a.certificate"))


def test_a_change_that_the_same_cells_prove_is_accepted(moved, tmp_path):
    """Then the file is a certificate of another claim, and a true one."""
    document = copy.deepcopy(moved.document)
    put(("knots", 4, 1), lambda x: shifted(x, 1e-9))(document)
    assert verifier.verify(written.stored(written.repaired(document), tmp_path / "a.certificate")).rejected == 0


def test_the_same_bytes_and_a_process_without_holdfast(moved, panda, tmp_path):
    claim = path_claim(panda, moved.claim.knots[:3], failures=[0, 2])
    assert len({hf.certify(claim).document["digest"] for _ in range(2)}) == 1
    file = moved.write(tmp_path / "a.certificate")
    done = subprocess.run(
        [sys.executable, written.alone(tmp_path / "alone"), file], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert f"accepted: {moved.leaves}, rejected: 0" in done.stdout
    assert "sampled" in verifier.verify(file, sample=3).summary


# ---- bounds ----------------------------------------------------------------------------------------------------------


def between(faults, q, goal):
    """The verifier's form of the error at q from where the tool is at another configuration."""
    joints, places = (list(map(motions.enclose_sines_and_cosines, x[:, None])) for x in (q, goal))
    error = TaskErrorEnclosure(faults.task, faults.chain, joints, faults.chain, places)
    return (x[0, : faults.m] for x in (error.value, error.slopes, error.second))


def test_error_and_derivatives_of_the_verifier(moved, tmp_path, rng):
    """Against differences of what the file says, by scipy's rotations."""
    driven = Driven(moved.write(tmp_path / "a.certificate"))
    faults = motions.PathVerifier(moved.document)
    q, h = START + rng.normal(size=(2, 7)) * 0.02
    with motions.flint.ctx.workprec(64):
        error, first, second = between(faults, q, h)

    def missed(move):
        place, turn, _ = driven.tool(q + move[:7])
        goal, wanted, _ = driven.tool(h + move[:6:-1])  # the healthy joints backwards
        off = turn @ wanted.T
        return np.append(place - goal, np.array([off[2, 1] - off[1, 2], off[0, 2] - off[2, 0], off[1, 0] - off[0, 1]]) / 2)

    steps = np.eye(14)
    slopes = np.array([missed(1e-6 * x) - missed(-1e-6 * x) for x in steps]).T / 2e-6
    assert error.center == pytest.approx(missed(np.zeros(14)), abs=1e-14)
    assert (np.abs(error.center - missed(np.zeros(14))) <= error.radius + 1e-15).all()
    assert error.radius.max() < 1e-11
    assert first.center == pytest.approx(slopes, abs=1e-8)
    e = 1e-4
    for i, j in rng.integers(14, size=(20, 2)):
        a, b = e * steps[i], e * steps[j]
        bend = (missed(a + b) - missed(a - b) - missed(b - a) + missed(-a - b)) / (4 * e**2)
        assert second.center[:, i, j] == pytest.approx(bend, abs=1e-6)


def test_what_is_behind_the_second_order_is_bounded(panda, rng):
    """The search's bound, and so the verifier's lengths, at random points, with the verifier's second derivatives."""
    proof = hf.certify(path_claim(panda, START + np.array([[0.0], [0.01]]), failures=[1]))
    faults, chain = motions.PathVerifier(proof.document), CertificateChain.from_arm(panda)
    assert (faults.chain.link_lengths >= chain.lengths).all()
    assert faults.chain.link_lengths == pytest.approx(chain.lengths, abs=1e-9)
    limits = np.column_stack([panda.lower, panda.upper])
    following = LockedTrackingEnclosure(chain, proof.claim.knots, "pose", driven=[1], tube=np.empty(0), limits=limits)
    q, goal = START[None] + 0.01, START[None]
    with motions.flint.ctx.workprec(64):
        error, first, second = (x.center for x in between(faults, q[0], goal[0]))
    for d in rng.normal(size=(200, 14)) * 0.1:
        ours, theirs = d[:7], d[:6:-1]  # the healthy joints backwards
        now = following.tracking_error_and_jacobian(
            following.tool_pose_and_jacobian(q + ours), following.tool_pose_and_jacobian(goal + theirs)
        )[0][0]
        line = error + first @ d + np.einsum("akl,k,l->a", second, d, d) / 2
        assert (
            np.abs(now - line)
            <= following._third_order_remainder(np.abs(np.append(ours, theirs))[None], np.zeros((1, 14)))[0] + 1e-12
        ).all()


# ---- claims ----------------------------------------------------------------------------------------------------------


def test_motions_are_thinned_and_time_ends(three, tmp_path):
    knots = np.array([0.3, 0.8, 1.1]) + np.sin(np.linspace(0, 1, 101))[:, None] * [0.2, -0.1, 0.2]
    claim = path_claim(three, knots, task="planar", segments=10)
    assert claim.segments == 10
    tools = three.forward_kinematics(knots)[:, :3, 3]
    assert 0 < claim.deviation < np.linalg.norm(np.diff(tools, axis=0), axis=1).max() / 10
    stopped = hf.certify(claim, time_limit=1e-6)
    assert (stopped.proved, stopped.finished, stopped.ok) == (0, False, False)
    check = hf.check_certificate(stopped.write(tmp_path / "a.certificate"))
    assert (check.undecided, check.rejected) == (1, 0)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"motion": np.zeros((1, 3))}, "two configurations or more"),
        ({"motion": np.zeros((3, 2))}, "two configurations or more"),
        ({"motion": np.array([[0, 0, 0], [0, 4, 0]])}, "configuration 2 of the motion is beyond the limits of joint2"),
        ({"motion": np.zeros((300, 3))}, "for example segments=50"),
        ({"segments": 0}, "segments is 0"),
        ({"during": (0.5, 0.5)}, "during must be"),
        ({"tube": -1.0}, "the tube must be"),
        ({"task": "pointing", "tube": 0.1}, "it must be 0 for a pointing path"),
        ({"task": "turning"}, "task is 'turning'"),
    ],
)
def test_what_makes_no_claim(three, given, said):
    motion = given.pop("motion", np.linspace([0.1, 0.2, 0.3], [0.2, 0.3, 0.5], 5))
    with pytest.raises(InputError, match=said):
        path_claim(three, motion, **{"task": "planar", **given})


def test_words_and_picture(bent):
    told = bent.to_dict()
    assert told["parts"]["joint1"]["proved"]["value"] == float(bent.parts[0].proved)
    assert list(bent.figures()) == ["slices"]
    assert "one continuous motion" in bent.describe()[1]
    assert march.SEGMENT_INSTANTS == SEGMENT
