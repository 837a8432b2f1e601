"""The verifier accepts what is true and proved, and refuses what a forger makes of it; it needs nothing of holdfast."""

from __future__ import annotations

import contextlib
import copy
import json
import re
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest
import written
from scipy.spatial.transform import Rotation
from written import Chain, place, planar, put, shifted, turn

from holdfast.certificates import verifier
from holdfast.certificates.verifier_parts import balls, files, targets

pytest.importorskip("flint", reason="python-flint is not installed")
START = np.radians([0, -10, 0, -110, 0, 100, 45])


def box_around(centre, half):
    return [[x - half, x + half] for x in centre]


@pytest.fixture(scope="module")
def panda():
    return written.panda()


@pytest.fixture(scope="module")
def locked(panda):
    """A Panda with its fourth joint locked: 8 leaves."""
    box = box_around(panda.tip(START)[:3, 3], 0.05)
    return written.certificate(panda, "position", box, START, locked=3, angle=[-1.95, -1.89], splits=(1, 1, 1, 0))


def bend(document, tmp_path):
    return verifier.verify(written.stored(document, tmp_path / "a.certificate"))


def whole(verdict):
    return verdict.rejected == 0 and verdict.accepted == verdict.leaves > 0 and verdict.undecided == 0


# ---- what is true ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("lock", range(-1, 7))
def test_a_panda_reaches_a_small_cube_whatever_is_locked(panda, tmp_path, lock):
    angle = None if lock < 0 else [START[lock] - 0.02, START[lock] + 0.02]
    box = box_around(panda.tip(START)[:3, 3], 0.01)
    splits = (1, 1, 1) if lock < 0 else (1, 1, 1, 1)
    assert whole(bend(written.certificate(panda, "position", box, START, locked=lock, angle=angle, splits=splits), tmp_path))


@pytest.mark.parametrize(
    ("lengths", "lock"), [((1, 1), -1), ((1, 1, 1), -1), ((1, 1, 1), 0), ((1, 1, 1), 1), ((1, 0.8, 0.6), 2)]
)
def test_a_planar_arm_reaches_a_square(tmp_path, lengths, lock):
    arm, start = planar(lengths), np.array([-0.5, 1.0, 1.0][: len(lengths)])
    angle = None if lock < 0 else [start[lock] - 0.1, start[lock] + 0.1]
    box = box_around(arm.tip(start)[:2, 3], 0.06)
    splits = (2, 2) if lock < 0 else (2, 2, 2)
    verdict = bend(written.certificate(arm, "planar", box, start, locked=lock, angle=angle, splits=splits), tmp_path)
    assert whole(verdict)
    assert "Proved: 100 %, undecided: 0 %" in verdict.summary


@pytest.mark.parametrize("free", [False, True])
def test_a_panda_reaches_poses(panda, tmp_path, free):
    start = np.add(START, [0.2, 0, 0.3, 0, -0.2, 0.1, 0.4])
    tip = panda.tip(start)
    box, rotation = box_around(tip[:3, 3], 0.005), None if free else tip[:3, :3]
    if free:
        box += box_around(Rotation.from_matrix(tip[:3, :3]).as_euler("xyz"), 0.01)
        roll, pitch, yaw = np.mean(box[3:], axis=1)
        np.testing.assert_allclose(turn(2, yaw) @ turn(1, pitch) @ turn(0, roll), tip[:3, :3], atol=1e-12)
        assert min(abs(roll), abs(pitch), abs(yaw), abs(abs(roll) - abs(yaw))) > 0.1
    verdict = bend(written.certificate(panda, "pose", box, start, rotation=rotation, splits=(1, 1, 1)), tmp_path)
    assert whole(verdict)
    assert ("Rz(yaw) Ry(pitch) Rx(roll)" in verdict.document["claim"]) == free


def test_an_arm_on_a_rail_reaches_a_box(tmp_path):
    sideways = place(turn(1, np.pi / 2), [0, 0, 0.1])  # the rail runs along x
    up = place(turn(1, -np.pi / 2), [0, 0, 0])
    frames = [sideways, up, place(turn(0, np.pi / 2), [0, 0, 0.3]), place(np.eye(3), [0.4, 0, 0])]
    rail = Chain(frames, place(np.eye(3), [0.3, 0, 0]), [[-1, 1], [-3, 3], [-3, 3], [-3, 3]], [True, False, False, False])
    start = np.array([0.1, 0.4, 0.9, -1.2])
    box = box_around(rail.tip(start)[:3, 3], 0.015)
    for lock, splits in ((-1, (2, 2, 2)), (0, (1, 1, 1, 1)), (2, (1, 1, 1, 1))):
        angle = None if lock < 0 else [start[lock] - 0.02, start[lock] + 0.02]
        assert whole(bend(written.certificate(rail, "position", box, start, locked=lock, angle=angle, splits=splits), tmp_path))


# ---- the bound itself ------------------------------------------------------------------------------------------------


def random_chain(rng, n, slides):
    def rotation():
        q, r = np.linalg.qr(rng.normal(size=(3, 3)))
        q = q * np.sign(np.diag(r))
        return q * np.linalg.det(q)

    frames = [place(rotation(), rng.uniform(-0.5, 0.5, 3)) for _ in range(n)]
    return Chain(frames, place(rotation(), rng.uniform(-0.5, 0.5, 3)), [[-9, 9]] * n, slides)


def rotation_error(off):
    return np.array([off[2, 1] - off[1, 2], off[0, 2] - off[2, 0], off[1, 0] - off[0, 1]]) / 2


def tightness(rng, chain, q, task, half, *, lock, angle, where, rotation=None, section=None):
    """The largest ratio of a true error, by forward kinematics in plain NumPy, to its bound; none may be above 1."""
    n = len(q)
    document = written.certificate_of(
        chain, task, np.column_stack([np.subtract(where, half), np.add(where, half)]), [q], locked=lock, angle=angle,
        rotation=rotation,
    )  # fmt: skip
    leaves = targets.ReachVerifier(document)
    counts = np.round(q * 2**24).astype(int) * (np.arange(n) != lock)
    widths = np.array([float(w) / 2 for w in leaves.width])
    with balls.flint.ctx.workprec(64), np.errstate(all="ignore"):
        found, _ = leaves.enclose_leaves([(((0, 0),) * len(leaves.width), counts)])
        matrix = leaves.choose_joint_response(found.error)[0]
        w = np.concatenate([widths, rng.uniform(0.1, 1, found.m) * np.max(half) if section is None else section])
        found.half_widths[:] = w
        found.update_bounds()
    e, far = found.excess, found.joint_travel
    ends = rng.choice([-1.0, 1.0], (300, len(w))) * np.where(rng.random((300, len(w))) < 0.7, 1, rng.random((300, len(w))))
    tight = 0.0
    for step in ends * w:
        moved = matrix @ step
        assert (np.abs(moved) <= far[0] + 1e-15).all()
        at = chain.tip(q + moved[:n])
        wanted = written.target_pose(document["target"]["axes"], where + step[: len(where)], rotation)
        g = np.append(at[:3, 3] - wanted[:3, 3], rotation_error(at[:3, :3] @ wanted[:3, :3].T))[: found.m]
        gap = np.abs(g - step[len(widths) :])
        assert (gap <= e[0] + 1e-12).all()
        tight = max(tight, float((gap / e[0]).max()))
    return tight


@pytest.mark.parametrize("task", ["position", "pose", "turned pose"])
def test_the_bound_holds_at_random_points(rng, task):
    tight = []
    for trial in range(12):
        n = 4 + trial % 4
        slides = [bool(rng.random() < 0.3) for _ in range(n)] if trial % 2 else [False] * n
        chain, q = random_chain(rng, n, slides), np.round(rng.uniform(-1, 1, n) * 2**24) / 2**24
        lock, turned, half = n - 1 if trial % 3 else -1, rng.uniform(-1, 1, 3), 10 ** rng.uniform(-3, -0.7)
        if task == "turned pose":  # a tool that is nearly turned as the target is
            wanted = Rotation.from_euler("ZYX", turned[::-1]).as_matrix() @ turn(0, 0.1) @ turn(1, 0.1)
            chain.tool[:3, :3] = chain.tool[:3, :3] @ chain.tip(q)[:3, :3].T @ wanted
        tip = chain.tip(q)
        where = np.array([*(tip[:3, 3] + 1e-3), *turned][: 6 if task == "turned pose" else 3])
        rotation = tip[:3, :3] @ turn(2, 0.1) @ turn(1, 0.1) if task == "pose" else None
        angle = None if lock < 0 else [q[lock] - half / 2, q[lock] + half / 2]
        tight.append(tightness(rng, chain, q, task.split()[-1], half, lock=lock, angle=angle, where=where, rotation=rotation))
    assert max(tight) > 0.3  # a bound that means something


def along(axes, slides, tool):
    """Joints through one point, about or along coordinate axes."""
    frames, before = [], np.eye(4)
    for axis in axes:
        to_axis = place((turn(1, np.pi / 2), turn(0, -np.pi / 2), np.eye(3))["xyz".index(axis)], [0, 0, 0])
        frames.append(before.T @ to_axis)
        before = to_axis
    return Chain(frames, before.T @ place(np.eye(3), tool), [[-3, 3]] * len(axes), slides)


def test_the_bound_is_sharp_for_a_turned_slide(rng):
    """Locked 2 m out, 1 m of it tool: 2 (sin d - d) across it. Free: second and third order in both."""
    arm, q = along("zx", [False, True], [1, 0, 0]), np.array([0.0, 1.0])
    half, where = np.array([1e-3, 0.3, 1e-3]), arm.tip(q)[:3, 3]
    assert tightness(rng, arm, q, "position", half, lock=1, angle=[1, 1], where=where) > 0.9
    assert tightness(rng, arm, q, "planar", np.array([0.3, 0.2]), lock=-1, angle=None, where=where[:2]) > 0.5
    arm = along("zx", [False, True], [0, 0, 0])
    assert tightness(rng, arm, q, "planar", np.array([0.3, 0.2]), lock=-1, angle=None, where=where[:2] - [1, 0]) > 0.5


@pytest.mark.parametrize("row", [3, 4, 5])
def test_the_bound_is_sharp_for_a_wrist(rng, row):
    """One joint of a gantry's wrist: sin d - d."""
    arm, section = along("xyzzyx", [True] * 3 + [False] * 3, [0, 0, 0]), np.full(6, 1e-6)
    section[row] = 0.5
    kept = {"lock": -1, "angle": None, "where": np.zeros(3), "rotation": np.eye(3), "section": section}
    assert tightness(rng, arm, np.zeros(6), "pose", 1e-6, **kept) > 0.9


def test_a_tool_turned_by_half_a_turn_is_not_where_it_should_be(panda, tmp_path):
    """The axial part of the rotation that is left is 0 there, too."""
    tip = panda.tip(START)
    for angle, fine in ((0.0, True), (np.pi, False)):
        document = written.certificate_of(
            panda, "pose", box_around(tip[:3, 3], 1e-3), [START], rotation=tip[:3, :3] @ turn(2, angle)
        )
        assert (bend(document, tmp_path).rejected == 0) == fine


@pytest.mark.parametrize("half", [0.01, 0.5, 50.0])
def test_joints_without_limits_reach_no_further(tmp_path, half):
    """What grows without bound is no proof, however far the joints may go."""
    arm = planar((1.0, 1.0, 1.0), np.inf)
    for q in ([0.0, 0.0, 0.0], [0.5, -0.5, 0.2], [-0.4, 1.0, 2.0]):
        document = written.certificate_of(arm, "planar", [[5 - half, 5 + half], [-half, half]], [q])
        assert bend(document, tmp_path).rejected == 1


def test_what_is_accepted_of_a_disc_lies_in_it(tmp_path):
    """Closed form: the annulus of two links of 1 m and 0.6 m; a row of squares goes from far inside to outside."""
    arm, accepted = planar((1.0, 0.6)), []
    for x in np.arange(0.3, 1.8, 0.05):
        corner = np.hypot(x + 0.025, 0.025), x - 0.025
        middle = min(max(x, 0.4), 1.6)
        elbow = np.arccos(np.clip((middle**2 - 1.36) / 1.2, -1, 1))
        q = np.array([-np.arctan2(0.6 * np.sin(elbow), 1 + 0.6 * np.cos(elbow)), elbow])
        document = written.certificate_of(arm, "planar", [[x - 0.025, x + 0.025], [-0.025, 0.025]], [q])
        verdict = bend(document, tmp_path)
        if verdict.accepted:
            assert corner[0] <= 1.6
            assert corner[1] >= 0.4
            accepted.append(x)
    assert len(accepted) > 12


def test_limits_count(tmp_path):
    """A square needs joint 2 from 0.9 to 1.1: whole within wider limits, nothing within narrower ones."""
    arm, start = planar((1.0, 1.0)), np.array([-0.5, 1.0])
    box = box_around(arm.tip(start)[:2, 3], 0.01)
    for half, fine in ((0.1, True), (0.001, False)):
        limits = [[-3, 3], [1 - half, 1 + half]]
        verdict = bend(written.certificate(arm, "planar", box, start, limits=limits, splits=(0, 0)), tmp_path)
        assert (verdict.rejected == 0) == fine
        assert (verdict.undecided == 0) == fine


# ---- what forgers do -------------------------------------------------------------------------------------------------


def truly(document, rng, points=4):
    """Whether random targets and locked values of each leaf have a configuration near its centre, by Newton alone."""

    def frame(given):
        numbers = [[float.fromhex(x) for x in given[key]] for key in ("rotation", "origin")]
        return place(np.reshape(numbers[0], (3, 3)), numbers[1])

    limits = [[float.fromhex(x) for x in pair] for pair in document["limits"]]
    chain = Chain([frame(joint) for joint in document["arm"]["joints"]], frame(document["arm"]["tool"]), limits)
    lock, n, m = document["locked"], len(chain.frames), len(document["target"]["axes"])
    free = [k for k in range(n) if k != lock]
    roots = [
        [float.fromhex(x) for x in pair] for pair in [*document["target"]["box"], *([document["angle"]] if lock >= 0 else [])]
    ]
    centres = iter(np.frombuffer(written.unpacked(document["centres"]), "<i4").reshape(-1, n) / 2**24)

    def leaves(tokens, cell):
        token = next(tokens)
        if token < 16:
            yield token, cell
            return
        for upper in (0, 1):
            half = [list(pair) for pair in cell]
            half[token - 16][1 - upper] = sum(cell[token - 16]) / 2
            yield from leaves(tokens, half)

    for token, cell in leaves(iter(written.unpacked(document["tree"])), roots):
        if token:
            continue
        q = next(centres).copy()
        for _ in range(points):
            u = np.array([rng.choice([*pair, rng.uniform(*pair)]) for pair in cell])
            if lock >= 0:
                q[lock] = u[-1]
            try:
                found = written.reached(
                    chain, q, document["task"], written.target_pose(document["target"]["axes"], u[:m], None), free=free
                )
            except AssertionError:
                return False
            low, high = chain.limits.T
            if (found < low - 1e-9)[free].any() or (found > high + 1e-9)[free].any():
                return False
    return True


def test_the_judge_of_forgeries_can_say_no(locked, rng):
    assert truly(locked, rng)
    forged = copy.deepcopy(locked)
    forged["target"]["box"][0][1] = (2.0).hex()
    assert not truly(forged, rng)


def test_random_bytes_of_payloads(locked, tmp_path, rng):
    """Digests and volumes repaired: what is still accepted is still true, and a change of a leading byte is noticed."""
    noticed = {"centres": 0, "tree": 0}
    for trial in range(36):
        forged, key = copy.deepcopy(locked), ("centres", "tree")[trial % 3 == 2]
        data = bytearray(written.unpacked(forged[key]))
        data[rng.integers(len(data))] ^= rng.integers(1, 256)
        forged[key] = written.packed(bytes(data))
        try:
            parts = [
                (t, verifier.compute_disjoint_volume([cell]))
                for t, cell in verifier.iterate_cells(written.unpacked(forged["tree"]), 4)
            ]
            share = sum((v for t, v in parts if t == 0), Fraction(0))
            text = [f"{v.numerator}/2^{v.denominator.bit_length() - 1}" for v in (share, Fraction(0), 1 - share)]
            forged["volumes"] = dict(zip(("proved", "refuted", "undecided"), text, strict=True))
            verdict = bend(written.repaired(forged), tmp_path)
        except verifier.CertificateRejected:
            noticed[key] += 1
            continue
        noticed[key] += verdict.rejected > 0
        if verdict.rejected == 0 and verdict.accepted:
            assert truly(forged, rng, 1)
    assert noticed["centres"] > 4
    assert noticed["tree"] > 5


def test_random_bytes_of_the_file(locked, tmp_path, rng):
    """Without repair everything is refused that is not for people, a space, or the same number."""
    path = written.stored(locked, tmp_path / "a.certificate")
    text = path.read_bytes()
    for _ in range(200):
        changed = bytearray(text)
        changed[rng.integers(len(text))] ^= 1 << rng.integers(8)
        path.write_bytes(bytes(changed))
        try:
            found = verifier.load_certificate(path)
        except verifier.CertificateRejected:
            continue
        left = [{k: v for k, v in file.items() if k not in verifier.FOR_PEOPLE} for file in (found, locked)]
        assert left[0] == left[1]


def mirrored(numbers):
    return [(-float.fromhex(x) if k % 3 == 2 else float.fromhex(x)).hex() for k, x in enumerate(numbers)]


def _centre_moved(d):
    data = np.frombuffer(written.unpacked(d["centres"]), "<i4").reshape(-1, 7).copy()
    data[0, 1] += int(0.5 * 2**24)
    d["centres"] = written.packed(data.tobytes())


def _centres_swapped(d):
    data = np.frombuffer(written.unpacked(d["centres"]), "<i4").reshape(-1, 7).copy()
    data[[0, 7]] = data[[7, 0]]
    d["centres"] = written.packed(data.tobytes())


def _locked_centre(d):
    data = np.frombuffer(written.unpacked(d["centres"]), "<i4").reshape(-1, 7).copy()
    data[0, 3] = 5
    d["centres"] = written.packed(data.tobytes())


def _tree(change):
    def forge(d):
        d["tree"] = written.packed(change(written.unpacked(d["tree"])))

    return forge


@pytest.mark.parametrize(
    "forge",
    [
        _centre_moved,
        _centres_swapped,
        _locked_centre,
        _tree(lambda t: t.replace(b"\0", b"\2", 1)),  # volumes as before
        _tree(lambda t: t[:-1]),
        _tree(lambda t: t + b"\0"),
        _tree(lambda t: t.replace(b"\x10", b"", 1)),  # a split less
        _tree(lambda t: b"\0"),
        _tree(lambda t: t.replace(b"\x10", b"\x13", 1)),  # the locked angle, not x
        _tree(lambda t: t.replace(b"\x10", b"\x14", 1)),  # no such axis
        _tree(lambda t: t.replace(b"\0", b"\7", 1)),
        put(["target", "box", 0, 1], lambda x: shifted(x, 0.03)),
        put(["angle", 0], lambda x: shifted(x, -0.5)),
        put(["arm", "joints", 5, "origin", 0], lambda x: shifted(x, 0.05)),
        put(["arm", "joints", 5, "rotation", 0], lambda x: shifted(x, 1e-6)),
        put(["limits", 3, 1], lambda x: shifted(x, 1.0)),  # beyond the arm's own
        put(["limits", 1], [(-0.174).hex(), (-0.173).hex()]),
        put(["locked"], 2),
        put(["locked"], True),
        put(["volumes", "proved"], "7/2^3"),
        put(["volumes", "undecided"], "1/2^0"),
        put(["unit"], (2.0**-23).hex()),
        put(["task"], "planar"),
        put(["refutations"], ["all"]),
    ],
)
def test_forged_with_digests_repaired(locked, tmp_path, forge):
    forged = copy.deepcopy(locked)
    forge(forged)
    try:
        verdict = bend(written.repaired(forged), tmp_path)
    except verifier.CertificateRejected:
        return
    assert verdict.rejected > 0
    assert verdict.undecided > 0


@pytest.mark.parametrize(
    "forge",
    [
        put(["target", "box", 0, 1], lambda x: shifted(x, 1e-6)),
        put(["angle", 0], lambda x: shifted(x, -1e-6)),
        put(["limits", 0, 1], lambda x: shifted(x, -0.5)),
        put(["arm", "joints", 5, "origin", 0], lambda x: shifted(x, 1e-6)),
    ],
)
def test_a_changed_claim_that_the_leaves_prove_is_accepted_and_true(locked, tmp_path, rng, forge):
    forged = copy.deepcopy(locked)
    forge(forged)
    assert whole(bend(written.repaired(forged), tmp_path))
    assert truly(forged, rng, 1)


# ---- bad files -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("forge", "said"),
    [
        (put(["version"], 2), "version must be a whole number from 1 to 1"),
        (put(["version"], True), "version"),
        (put(["format"], "else"), "format"),
        (put(["kind"], "miracle"), "kind"),
        (put(["claim"], "every target is reached"), "claim does not match the rest"),
        (put(["digest"], "0" * 64), "digest does not match the rest"),
        (put(["arm_digest"], "0" * 64), "arm_digest does not match the rest"),
        (put(["target", "box", 0, 0], 0.3), "box of target"),
        (put(["target", "box", 0, 0], "0.3"), "box of target"),
        (put(["target", "box", 0, 0], "nan"), "box of target"),
        (put(["target", "box", 0, 0], "inf"), "box of target"),
        (put(["target", "box", 0, 0], "0x1.0p+9999"), "too large"),
        (put(["target", "box", 0], ["0x1.0p+0", "0x0.0p+0"]), "upside down"),
        (put(["target", "box"], lambda x: x[:2]), "list of 3"),
        (put(["target", "orientation"], []), "must be null"),
        (put(["limits", 0], ["inf", "inf"]), "upside down"),
        (put(["limits", 0, 0], lambda x: shifted(x, -1)), "exceeds"),
        (put(["angle"], ["-0x1.9p+1", "-0x1.9p+1"]), "exceeds"),
        (put(["angle"], None), "angle"),
        (put(["arm", "joints"], []), "1 to 64 joints"),
        (put(["arm", "joints", 0, "name"], "joint2"), "different names"),
        (put(["arm", "joints", 0, "name"], "a\nb"), "200 letters to print"),
        (put(["arm", "joints", 0, "type"], "screw"), "revolute"),
        (put(["arm", "joints", 0, "mass"], "1"), "'mass'"),
        (lambda d: d.pop("centres"), "'centres'"),
        (put(["extra"], 1), "'extra'"),
        (put(["tree"], "*"), "tree cannot be unpacked"),
        (put(["tree"], lambda x: written.base64.b64encode(b"abc").decode()), "tree cannot be unpacked"),
        (put(["tree"], lambda x: written.packed(b"\x10" * 2**12)), "holds too much"),
        (put(["tree"], lambda x: written.base64.b64encode(written.base64.b64decode(x) + b"more").decode()), "holds too much"),
        (put(["arm", "tool", "rotation"], mirrored), "right-handed"),
        (put(["centres"], lambda x: written.packed(b"\0" * 2**12)), "holds too much"),
        (put(["centres"], lambda x: written.packed(written.unpacked(x)[:-4])), "fewer centres"),
        (put(["centres"], lambda x: x[: len(x) // 8 * 4]), "truncated"),
        (put(["tree"], lambda x: written.packed(b"\x10" * 300)), "deeper than 200"),
    ],
)  # fmt: skip
def test_a_bad_file_gets_one_sentence(locked, tmp_path, forge, said):
    bad = copy.deepcopy(locked)
    forge(bad)
    if "does not match" not in said:
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(files, "claim_sentence", lambda d: "a claim")
            patch.setattr(verifier, "claim_sentence", lambda d: "a claim")
            patch.setattr(targets, "MAX_LEAVES", 1000)
            with contextlib.suppress(KeyError, ValueError, OverflowError):
                bad = written.repaired(bad)
            with pytest.raises(verifier.CertificateRejected, match=re.escape(said)) as caught:
                bend(bad, tmp_path)
    else:
        with pytest.raises(verifier.CertificateRejected, match=re.escape(said)) as caught:
            bend(bad, tmp_path)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "cannot be read as JSON"),
        (b"\xff\xfe", "cannot be read as JSON"),
        (b"[]", "format"),
        (b'{"format": 1, "format": 2}', "given twice"),
        (b'{"seconds": NaN}', "NaN"),
        (b"[" * 100_000, "cannot be read as JSON"),
        (b"9" * 5000, "cannot be read as JSON"),
    ],
)
def test_no_certificate_at_all(tmp_path, content, said):
    path = tmp_path / "a.certificate"
    path.write_bytes(content)
    with pytest.raises(verifier.CertificateRejected, match=said):
        verifier.verify(path)


def test_no_file_and_no_flint(tmp_path, monkeypatch):
    with pytest.raises(verifier.CertificateRejected, match="cannot read none"):
        verifier.verify(tmp_path / "none")
    monkeypatch.setattr(balls, "flint", None)
    with pytest.raises(verifier.CertificateRejected, match=re.escape("pip install 'holdfast-arms[certify]'")):
        verifier.verify(tmp_path / "none")


# ---- bundles, samples, processes -------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def bundle(tmp_path_factory):
    """A planar arm, healthy within working ranges and after a lock of joint 1 or 3."""
    folder, arm, start = tmp_path_factory.mktemp("bundle"), planar((1.0, 1.0, 1.0)), np.array([-0.5, 1.0, 1.0])
    box = box_around(arm.tip(start)[:2, 3], 0.03)
    ranges = [[x - 0.1, x + 0.1] for x in start]
    files = {"healthy": written.certificate(arm, "planar", box, start, limits=ranges, splits=(1, 1))}
    for lock in (0, 2):
        files[f"joint{lock + 1}"] = written.certificate(
            arm, "planar", box, start, locked=lock, angle=ranges[lock], splits=(1, 1, 2)
        )
    for name, part in files.items():
        written.stored(part, folder / f"{name}.certificate")
    written.stored(written.bundle(files, locks=[0, 2], ranges=ranges), folder / "all.certificate")
    return folder


def test_a_bundle(bundle):
    told = []
    verdict = verifier.verify(bundle / "all.certificate", progress=told.append)
    assert whole(verdict)
    assert [part.leaves for part in verdict.parts] == [4, 16, 16]
    assert sum(told) == verdict.leaves == 36
    assert verdict.tolerant_fraction == 1
    assert "any one of joint1, joint3" in verdict.document["claim"]


def test_a_bundle_with_a_part_that_is_rejected(bundle, tmp_path):
    for file in bundle.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes())
    part = json.loads((tmp_path / "joint1.certificate").read_text())
    data = np.frombuffer(written.unpacked(part["centres"]), "<i4").reshape(-1, 3).copy()
    data[0, 1] += 2**23
    part["centres"] = written.packed(data.tobytes())
    written.stored(written.repaired(part), tmp_path / "joint1.certificate")
    whole_file = json.loads((tmp_path / "all.certificate").read_text())
    with pytest.raises(verifier.CertificateRejected, match="not the part"):
        verifier.verify(tmp_path / "all.certificate")
    whole_file["parts"][1]["digest"] = part["digest"]
    verdict = bend(written.repaired(whole_file), tmp_path)
    assert verdict.rejected == 1
    assert verdict.undecided == Fraction(1, 16)  # of the box times the angles
    assert verdict.tolerant_fraction == Fraction(3, 4)  # of the box
    assert "undecided: 6.25" in verdict.summary


@pytest.mark.parametrize(
    "forge",
    [
        put(["parts"], lambda x: x[:2]),
        put(["parts"], lambda x: [x[0], x[2], x[1]]),
        put(["parts", 1, "file"], "../a"),
        put(["parts", 1, "file"], "no.certificate"),
        put(["parts", 1, "locked"], 2),
        put(["locks"], [0, 1]),
        put(["locks"], [2, 0]),
        put(["locks"], []),
        put(["target", "box", 0, 1], lambda x: shifted(x, 1e-6)),
        put(["working_ranges", 0, 1], lambda x: shifted(x, 1e-6)),
        put(["working_ranges", 0, 1], lambda x: shifted(x, 9)),
        put(["limits", 0, 1], lambda x: shifted(x, -1e-6)),
        put(["volumes", "proved"], "1/2^1"),
        put(["arm", "tool", "origin", 0], lambda x: shifted(x, 1e-6)),
    ],
)
def test_a_forged_bundle_is_refused(bundle, forge):
    forged = json.loads((bundle / "all.certificate").read_text())
    forge(forged)
    with pytest.raises(verifier.CertificateRejected):
        bend(written.repaired(forged), bundle)


def test_what_overlapping_cells_cover(rng):
    """Against a grid; and never less where the steps are spent."""
    for _ in range(20):
        cells = set()
        for _ in range(rng.integers(1, 30)):
            depths = rng.integers(0, 5, 3)
            cells.add(tuple((int(rng.integers(1 << d)), int(d)) for d in depths))
        grid = np.zeros((16,) * 3, dtype=bool)
        for cell in cells:
            grid[tuple(slice(k << (4 - d), (k + 1) << (4 - d)) for k, d in cell)] = True
        exact = Fraction(int(grid.sum()), 16**3)
        assert verifier.compute_covered_volume(cells, [10**6]) == exact
        assert verifier.compute_covered_volume(cells, [50]) >= exact


def test_a_sample_is_said_to_be_one(locked, tmp_path):
    path = written.stored(locked, tmp_path / "a.certificate")
    verdict = verifier.verify(path, sample=3)
    assert (verdict.accepted, verdict.leaves) == (3, 8)
    assert "sampled, not verified" in verdict.summary
    assert "not verified" not in verifier.verify(path).summary


def test_two_processes_find_the_same(locked, tmp_path):
    path = written.stored(locked, tmp_path / "a.certificate")
    one, two = verifier.verify(path), verifier.verify(path, workers=2)
    assert (one.accepted, one.rejected, one.undecided) == (two.accepted, two.rejected, two.undecided)


def test_it_runs_where_holdfast_cannot_be_imported(locked, tmp_path):
    """Copies of its files alone, in a process in which an import of holdfast fails."""
    path = written.stored(locked, tmp_path / "a.certificate")
    forged = copy.deepcopy(locked)
    _centre_moved(forged)
    other = written.stored(written.repaired(forged), tmp_path / "b.certificate")
    alone = written.alone(tmp_path / "alone")
    for file, code, said in ((path, 0, "accepted: 8, rejected: 0"), (other, 1, "accepted: 7, rejected: 1")):
        done = subprocess.run([sys.executable, alone, file], capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (code, "")
        assert said in done.stdout
    source = "".join(file.read_text(encoding="utf-8") for file in alone.parent.rglob("*.py"))
    imported = set(re.findall(r"^\s*(?:from|import) (\w+)", source, re.MULTILINE)) - {"flint", "numpy"}
    assert imported <= sys.stdlib_module_names | {"holdfast", "verifier_parts"}  # holdfast where it is part of it


def test_the_command_says_what_is_wrong_and_ends_with_2(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["verifier.py", str(tmp_path / "none")])
    assert verifier.main() == 2
    assert capsys.readouterr().err == "refused: cannot read none: No such file or directory\n"
