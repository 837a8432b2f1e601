"""Checks a certificate, whoever wrote it: ``python verifier.py FILE``; needs NumPy and python-flint, and nothing of holdfast.

The file holds a bisection tree and a configuration for each leaf. Around it the rows g of the task's error are expanded: exact
first and second derivatives as balls (Arb), a bound for the third. With a section variable s this bounds |g - s| by e(S) over
the leaf and a box of half widths S. Where e(S) <= S, the map s -> s - g sends that box into itself, so by Brouwer's theorem
some s has g = 0: a configuration that reaches the target. Any matrix D may span the section; it decides whether e(S) <= S.

A refutation is a tree over joints and targets. In each leaf a point of some link is farther from the target than the tool
can be from this point, or nearer. How far that is, is a lemma, with a tree of its own over the joints behind the link.
Distances are bounded by exact derivatives at the centre, in arrays of balls, and a bound for the third.

A ceiling of relative manipulability is a tree over joints. With the moments a_l of any wrench about the axes, it is at most
sqrt(A / (A + a_k^2)) after a lock of joint k, A the sum of the other a_l^2. In each leaf a wrench that is affine in the joints
shows this, and one k. As its axes are seen from a link in the middle of the arm, first and last joint count nothing.
A floor has a motion x of the joints in each leaf, x = nu + N (q - q_c) + P s, and for some s the tool is still (Brouwer again):
after a lock of joint k at least |x_k| / |x| is left.

A structural zero holds where all axes before a joint meet in one point, and all behind it in another: a force along the line
through both has no moment about any other axis, so A = 0 (or the arm is singular). It is checked in rationals.
"""

from __future__ import annotations

import argparse
import json
import math
import random
import re
import sys
import time
import zipfile
import zlib
from collections.abc import Callable, Collection, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from itertools import islice
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

try:
    import flint
except ImportError:  # told when a file is to be checked: the sentence of a claim needs no balls
    flint = None

if TYPE_CHECKING or __package__:
    from holdfast.certificates.verified import motions as motions
    from holdfast.certificates.verified import paths as paths
    from holdfast.certificates.verified.balls import LEAST, UP, Balls, above, crossed, defect, joined, length, stacked, times
    from holdfast.certificates.verified.forms import (
        COMMON,
        HASH,
        LIMITS,
        MOST_BYTES,
        NUMBER,
        RATIONAL,
        TEXT,
        UNIT,
        WHOLE,
        fit,
        need,
        real,
        spans,
        within,
    )
    from holdfast.certificates.verified.forms import FOR_PEOPLE as FOR_PEOPLE
    from holdfast.certificates.verified.forms import Refused as Refused
    from holdfast.certificates.verified.forms import digest as digest
    from holdfast.certificates.verified.forms import unpacked as unpacked
else:  # run as a file: the folder lies beside it
    from verified import motions, paths
    from verified.balls import *  # noqa: F403
    from verified.forms import *  # noqa: F403

Array = NDArray[np.float64]
Cell = tuple[tuple[int, int], ...]  # for each axis (k, d): the part from k to k + 1 of 2^d equal ones

MOST_LEAVES, MOST_DEPTH, MOST_JOINTS, CHUNK = 1 << 24, 200, 64, 256
MOST_STEPS = 1_000_000  # to find what overlapping cells cover
PROVED, SPLIT = 0, 16  # token 2 is undecided; so is 1, refuted, as a reach of version 1 holds no refutations
LOCK = 128  # in a ceiling: what a lock of the first joint costs enough; 2 is undecided
LEMMA = 3  # in a refutation: what the first lemma excludes; 0: where the tool itself is elsewhere
SIX = {"pose": [0, 1, 2, 3, 4, 5], "planar-pose": [0, 1, 5]}  # rows of a ceiling or floor, positions first
ROWS_OF_SCREWS = {6: [0, 1, 2, 3, 4, 5], 3: [2, 3, 4]}  # the same, axes first
ROWS = {"planar xy": 2, "position xyz": 3, "pose xyz": 6, "pose xyzRPY": 6}  # by task and axes of the target


def sentence(document: dict[str, Any]) -> str:
    """The claim of a certificate, made from its other keys; its decimals are the shortest that mean the same doubles."""
    if document["kind"] == "path":
        return paths.sentence(document)
    names = [joint["name"] for joint in document["arm"]["joints"]]
    if document["kind"] == "structural-zero":
        near = "{} rad and {} m".format(*(f"{_two_digits(Fraction(x), True):g}" if x else "0" for x in snap(document)))
        text = f"For every configuration of an arm whose frames are within {near} of the file's, relative manipulability of the"
        return f"{text} pose after a lock of {names[document['locked']]} is 0; arm {document['arm_digest'][:12]}."
    if document["kind"] in ("ceiling", "floor"):
        least = f"the least relative manipulability of the {document['task']} after a lock of one of "
        least += (
            f"{', '.join(names[k] for k in document['locks'])} is at {'most' if document['kind'] == 'ceiling' else 'least'} "
        )
        least += repr(real(document["threshold"]))
        text = f"For every configuration with {spans(names, document['joint_box'])}, {least}"
        return f"{text}; angles in rad, arm {document['arm_digest'][:12]}."
    target = document["target"]
    axes = [{"R": "roll", "P": "pitch", "Y": "yaw"}.get(axis, axis) for axis in target["axes"]]
    turned = f" and the rotation {[real(x) for x in target['orientation']]}" if target["orientation"] else ""
    turned += " and the rotation Rz(yaw) Ry(pitch) Rx(roll)" * ("R" in target["axes"])
    text = f"For every {document['task']} target with {spans(axes, target['box'])}{turned}"
    kept = f"a configuration within the limits ({spans(names, document['limits'])})"
    if document["kind"] == "bundle":
        text += (
            f", a configuration within the working ranges ({spans(names, document['working_ranges'])}) reaches it, and after"
        )
        text += f" a lock of any one of {', '.join(names[i] for i in document['locks'])} at any value of its range"
        kept += " with that value"
    elif document["locked"] >= 0:
        text += f", and every value {spans(['from'], [document['angle']])} at which {names[document['locked']]} may be locked"
        kept += " with that value"
    if document["kind"] == "refutation":
        text, kept = f"{text} and every configuration{kept.removeprefix('a configuration')}: the tool is elsewhere", ""
    ends = f", {kept} reaches it" if kept else ""
    return f"{text}{ends}; lengths in m, angles in rad, base frame, arm {document['arm_digest'][:12]}."


def load(path: Path | zipfile.Path) -> dict[str, Any]:
    """A certificate of the right form, whose digests fit and whose claim is what its keys say; raises :class:`Refused`.

    Of an archive (``.zip``), in which the parts of a bundle lie beside it, that is its first file.
    """

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        need(len(dict(pairs)) == len(pairs), f"a key is given twice in an object of {path.name}")
        return dict(pairs)

    try:
        path = _first(path)
        size = path.stat().st_size if isinstance(path, Path) else path.root.getinfo(path.at).file_size  # never is more read
        need(size <= MOST_BYTES, f"{path.name} is larger than {MOST_BYTES >> 20} MB")
        document = json.loads(
            path.read_bytes().decode(), object_pairs_hook=once, parse_constant=lambda x: need(0, f"{x} in it")
        )
        _check(document if isinstance(document, dict) else {})
    except Refused:
        raise
    except OSError as error:
        raise Refused(f"cannot read {path.name}: {error.strerror}") from None
    except (ValueError, OverflowError, RuntimeError, LookupError, EOFError, zipfile.BadZipFile, zlib.error) as error:
        raise Refused(f"{path.name} cannot be read as JSON and its numbers: {str(error)[:80]}") from None
    return dict(document)


def _first(path: Path | zipfile.Path) -> Path | zipfile.Path:
    """The first file of an archive; of another, itself."""
    if not isinstance(path, Path) or path.suffix != ".zip":
        return path
    archive = zipfile.ZipFile(path)
    return zipfile.Path(archive, archive.namelist()[0])


def _check(document: dict[str, Any]) -> None:
    for key in ("format", "version", "kind", "arm", "task"):  # what the form of the rest depends on
        fit(document.get(key), COMMON[key], key)
    joints, locks, target = document["arm"]["joints"], document.get("locks"), document.get("target")
    n, axes, names = len(joints), str(target.get("axes") if isinstance(target, dict) else ""), [one["name"] for one in joints]
    need(1 <= n <= MOST_JOINTS and len(set(names)) == n, f"there must be 1 to {MOST_JOINTS} joints of different names")
    need(all(x.isprintable() and x and len(x) <= 200 for x in names), "joints must have names of 1 to 200 letters to print")
    turning = all(joint["type"] == "revolute" for joint in joints)
    if document["kind"] == "path":
        paths.check(document)
    elif document["kind"] in ("ceiling", "floor"):
        need(turning and document["task"] in SIX, f"ceilings and floors are of joints that turn, and of {' and '.join(SIX)}")
        fit(document, {"joint_box": [[NUMBER, 2], n], "threshold": NUMBER, "locks": [range(n), ...], "tree": TEXT,
                        "found": [NUMBER, n], **COMMON}, "the certificate")  # fmt: skip
        within(document["joint_box"], [joint["limits"] for joint in joints], "joint_box")
        need(1e-6 <= real(document["threshold"]) < 1, "threshold must be from 1e-6 to 1")
    elif document["kind"] == "structural-zero":
        snapped = [{"rotation": [WHOLE, 4], "origin": [RATIONAL, 3]}, n]
        need(n > 2 and turning, "structural zeros are of joints that turn")
        fit(document, {"locked": range(1, n - 1), "snapped": snapped, "points": [RATIONAL, n], **COMMON}, "the certificate")
        need(document["task"] == "pose", "structural zeros are of the pose")
        need(all(any(int(x) for x in frame["rotation"]) for frame in document["snapped"]), "a quaternion is 0")
    else:
        _check_targets(document, joints, target, locks, axes, turning)
    need(
        document["kind"] not in ("bundle", "ceiling", "floor") or (locks and locks == sorted(set(locks))),
        "locks must be in order, each once",
    )
    for key, value in (("arm_digest", digest(document["arm"])), ("claim", sentence(document)), ("digest", digest(document))):
        need(document[key] == value, f"{key} is not what the rest of the file gives: the file was changed or damaged")


def _check_targets(document: dict[str, Any], joints: list[Any], target: Any, locks: Any, axes: str, turning: bool) -> None:
    n, rows = len(joints), ROWS.get(f"{document['task']} {axes}")
    need(rows, f"task and axes of the target must be one of: {', '.join(ROWS)}")
    turned: Any = [NUMBER, 9] if rows == 6 and axes == "xyz" else None
    form = {"target": {"axes": axes, "box": [[NUMBER, 2], len(axes)], "orientation": turned}, "limits": [LIMITS, n], **COMMON}
    if document["kind"] == "bundle":
        part = {"file": r"\w[\w.-]*", "digest": HASH, "locked": range(-1, n)}
        form |= {"working_ranges": [LIMITS, n], "locks": [range(n), ...]}
        form |= {"parts": [part, len(locks) + 1 if isinstance(locks, list) else 0]}
    else:
        form |= {"locked": range(-1, n), "angle": None if document.get("locked") == -1 else [NUMBER, 2], "tree": TEXT}
    if document["kind"] == "reach":
        form |= {"centres": TEXT, "unit": re.escape(UNIT.hex()), "refutations": [..., 0]}
    if document["kind"] == "refutation":
        need(rows != 6 and turning, "refutations are of positions, and of joints that turn")
        lemma = {"link": range(n), "point": [NUMBER, 3], "least": NUMBER, "most": NUMBER, "tree": TEXT}
        form |= {"lemmas": [lemma, ...], "witness": [NUMBER, n] if document.get("witness") else None}
    fit(document, form, "the certificate")
    limits = document["limits"]
    within(limits, [joint["limits"] for joint in joints], "limits")
    within(document["target"]["box"], [["-inf", "inf"]] * len(axes), "box of the target")
    within(document.get("working_ranges", limits), limits, "working_ranges")
    if document.get("angle"):
        within([document["angle"]], [limits[document["locked"]]], "angle")


def cells(tree: bytes, axes: int, last: int = 2, locks: int = 256) -> Iterator[tuple[int, Cell]]:
    """Token and cell of each leaf, in the order of the tree; tokens up to the last are those of leaves, and from ``locks``."""
    waiting: list[Cell] = [((0, 0),) * axes]
    for token in tree:
        need(waiting, "the tree goes on behind its end")
        cell, axis = waiting.pop(), token - SPLIT
        if token <= last or token >= locks:
            yield token, cell
            continue
        good = 0 <= axis < axes and sum(d for _, d in cell) < MOST_DEPTH
        need(good, f"token {token} is unknown, or the tree deeper than {MOST_DEPTH}")
        (k, d), after = cell[axis], cell[axis + 1 :]
        waiting += [(*cell[:axis], (2 * k + upper, d + 1), *after) for upper in (1, 0)]
    need(not waiting, "the tree ends early")


def volume(parts: Iterable[Cell]) -> Fraction:
    """What part of the root box cells are."""
    return sum((Fraction(1, 1 << sum(d for _, d in cell)) for cell in parts), Fraction(0))


def covered(parts: Collection[Cell], steps: list[int]) -> Fraction:
    """What part of the root box cells cover that may overlap; something above that once ``steps`` (one number) are spent."""
    steps[0] -= len(parts)
    if len(parts) < 2 or steps[0] < 0 or any(not any(d for _, d in cell) for cell in parts):
        return min(Fraction(1), volume(parts))
    axis = min(range(len(next(iter(parts)))), key=lambda a: sum(cell[a][1] == 0 for cell in parts))
    halves: tuple[set[Cell], set[Cell]] = set(), set()
    for cell in parts:
        (k, d), before, after = cell[axis], cell[:axis], cell[axis + 1 :]
        for upper in (0, 1) if d == 0 else (k >> (d - 1),):
            halves[upper].add((*before, (k - (upper << (d - 1)), d - 1) if d else (0, 0), *after))
    return (covered(halves[0], steps) + covered(halves[1], steps)) / 2


def per_cent(part: Fraction, up: bool = False) -> str:
    """A share in per cent, rounded down, or up: what is proved is never said to be more, what is undecided never less."""
    if part in (0, 1):
        return f"{100 * int(part)} %"
    if part < Fraction(1, 10_000):
        return f"{_two_digits(100 * part, up):g} %"
    millionths = math.ceil(part * 10**8) if up else math.floor(part * 10**8)
    if millionths == 10**8:
        return f"all but {_two_digits(100 * (1 - part), False):g} %"
    return f"{millionths // 10**6}.{millionths % 10**6:06d} %"


def _two_digits(x: Fraction, up: bool) -> Decimal:
    """The decimal of two digits above or below."""
    return Context(prec=2, rounding=ROUND_CEILING if up else ROUND_FLOOR).divide(Decimal(x.numerator), Decimal(x.denominator))


def _skew(a: Any) -> Any:
    return flint.arb_mat([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def _vee(a: Any) -> Any:
    """The matrix that takes z to vee([z] a), where vee b is the axial vector of (b - b')/2."""
    return (flint.arb_mat([[a.trace() * (i == j) for j in range(3)] for i in range(3)]) - a) / 2


def _turn(axis: int, angle: Any) -> Any:
    """The rotation about a coordinate axis."""
    sine, cosine = angle.sin_cos()
    i, j, turn = (axis + 1) % 3, (axis + 2) % 3, [[int(row == column) for column in range(3)] for row in range(3)]
    turn[i][i], turn[j][j], turn[i][j], turn[j][i] = cosine, cosine, -sine, sine
    return flint.arb_mat(turn)


def _rotation(numbers: list[str]) -> Any:
    """Balls around nine numbers that hold the nearest rotation."""
    off = defect(numbers)
    return flint.arb_mat(3, 3, [flint.arb(real(x), off) for x in numbers])


class Leaves:
    """The leaves of one reach claim and their proofs."""

    def __init__(self, document: dict[str, Any]) -> None:
        self._given = document | {"tree": "", "centres": ""}
        joints, target, self.locked = document["arm"]["joints"], document["target"], document["locked"]
        self.m, self.p, self.n = ROWS[f"{document['task']} {target['axes']}"], len(target["axes"]), len(joints)
        self.linear, self.turning = min(self.m, 3), max(0, self.p - 3)  # rows of position; axes that turn the target
        self.free = [k for k in range(self.n) if k != self.locked]
        self.limits = np.array([[real(x) for x in pair] for pair in document["limits"]])
        self.slides = np.array([joint["type"] == "prismatic" for joint in joints])
        ends = [*target["box"], *([document["angle"]] if self.locked >= 0 else [])]
        self.low, high = ([flint.fmpq(*real(pair[end]).as_integer_ratio()) for pair in ends] for end in (0, 1))
        # How far a locked slide is out, at most.
        self.out = max((abs(real(x)) for x in document["angle"] or () if self.slides[self.locked]), default=0.0)
        self.width = [b - a for a, b in zip(self.low, high, strict=True)]
        frames = [*joints, document["arm"]["tool"]]
        self.rotations = [_rotation(frame["rotation"]) for frame in frames]
        self.origins = [flint.arb_mat(3, 1, [real(x) for x in frame["origin"]]) for frame in frames]
        self.wanted = _rotation(target["orientation"]) if target["orientation"] else None
        # What joint k and those before it turn, and joint k + 1 does not: the part of link k across its axis (all of it where
        # the joint slides), and that of link k + 1 along its axis, which is fixed in link k.
        self.lengths = np.zeros(self.n)
        for k in range(self.n):
            x, y, z = self.origins[k + 1].entries()
            link = flint.arb_mat(3, 1, [x, y, z if self.slides[k] else 0])
            if k + 1 < self.n and not self.slides[k + 1]:
                link += self.rotations[k + 1] * flint.arb_mat(3, 1, [0, 0, self.origins[k + 2][2, 0]])
            self.lengths[k] = math.hypot(*(above(abs(x)) for x in link.entries())) * UP

    def __reduce__(self) -> tuple[Any, ...]:  # balls cannot be sent to another process
        return Leaves, (self._given,)

    def expanded(self, cell: Cell, counts: Any) -> tuple[list[Any], Any, list[Any]]:
        """The rows of the error at the centre as balls, their derivatives by joints and turns of the target, their Hessians."""
        arb, mat, slides = flint.arb, flint.arb_mat, self.slides.tolist()
        centre = [arb(a + w * flint.fmpq(2 * k + 1, 2 << d)) for a, w, (k, d) in zip(self.low, self.width, cell, strict=True)]
        q = [arb(float(count) * UNIT) for count in counts]
        if self.locked >= 0:
            q[self.locked] = centre[-1]
        tip, turn, axes, points, still = mat(3, 1), _turn(0, arb(0)), [], [], [arb(0)] * 3
        for k in range(self.n):
            tip, turn = tip + turn * self.origins[k], turn * self.rotations[k]
            axes.append([turn[i, 2] for i in range(3)])
            points.append(tip)
            if slides[k]:
                tip += turn * mat(3, 1, [0, 0, q[k]])
            else:
                turn *= _turn(2, q[k])
        tip, turn = tip + turn * self.origins[-1], turn * self.rotations[-1]
        turns = [still if slide else z for z, slide in zip(axes, slides, strict=True)] + [still] * self.turning
        columns = [z if s else (_skew(z) * (tip - o)).entries() for z, o, s in zip(axes, points, slides, strict=True)]
        by_joint = mat(columns + [still] * self.turning).transpose()
        # The second derivative by a and a later b is z_a x J_b. For each a there are three rows, for each b a column.
        second = mat([row for z in turns for row in _skew(z).tolist()]) * by_joint
        pairs = [[(min(a, b), max(a, b)) for b in range(len(turns))] for a in range(len(turns))]
        error = [x - u for x, u in zip(tip.entries()[: self.linear], centre, strict=False)]
        hessians = [mat([[second[3 * a + row, b] for a, b in line] for line in pairs]) for row in range(self.linear)]
        rows = by_joint.tolist()[: self.linear]
        if self.m == 6:
            # E is the identity where vee E = 0 and it turns by less than pi, of which its trace here and the angles of the
            # leaf make sure. Turning the target turns E from the right: axes -E b, roll's first.
            roll, pitch, yaw = (_turn(axis, centre[3 + axis] if self.turning else arb(0)) for axis in range(3))
            off = turn * (yaw * pitch * roll if self.wanted is None else self.wanted).transpose()
            if self.turning:
                about_x, about_y = [row[0] for row in (yaw * pitch).tolist()], [row[1] for row in yaw.tolist()]
                turns[self.n :] = [(-off * mat(3, 1, b)).entries() for b in (about_x, about_y, [0, 0, 1])]
            by_turn = mat(turns).transpose()
            second = mat([row for z in turns for row in _vee(_skew(z) * off).tolist()]) * by_turn
            error += [(off[2, 1] - off[1, 2]) / 2, (off[0, 2] - off[2, 0]) / 2, (off[1, 0] - off[0, 1]) / 2]
            hessians += [mat([[second[3 * b + row, a] for a, b in line] for line in pairs]) for row in range(3)]
            rows += (_vee(off) * by_turn).tolist()
            error[0] = error[0] if off.trace() > 2.9 else arb.nan()
        return error, mat(rows), hessians

    def section(self, first: Array) -> Array:
        """Any matrices D (leaves, joints and turns, axes of the cell and of the section); these follow the solution."""
        p, fixed = self.p, self.locked >= 0
        inverse = np.linalg.pinv(np.nan_to_num(first[:, :, self.free]))
        made = np.zeros((len(first), self.n + self.turning, p + fixed + self.m))
        made[:, self.free, : self.linear], made[:, self.free, p + fixed :] = inverse[:, :, : self.linear], inverse
        follow = {axis: self.n + axis - 3 for axis in range(3, p)} | ({p: self.locked} if fixed else {})
        for axis, variable in follow.items():
            made[:, variable, axis] = 1
            made[:, self.free, axis] = -np.einsum("lfm,lm->lf", inverse, first[:, :, variable])
        return np.nan_to_num(made)

    def bounds(self, error: list[Any], first: Any, hessians: list[Any], section: Array) -> list[Any]:
        """Doubles above: error and its negative, what is left of the slopes, second derivatives: mixed, pure up and down."""
        numbers, last = flint.arb_mat(*section.shape, section.ravel().tolist()), section.shape[1] - self.m
        ones = [[int(k == last + a or k == a < self.linear) for k in range(section.shape[1])] for a in range(self.m)]
        slope = [[above(abs(x)) for x in row] for row in (first * numbers - flint.arb_mat(ones)).tolist()]
        second = [(numbers.transpose() * hessian * numbers).tolist() for hessian in hessians]
        mixed = [
            [[above(abs(x)) if a < b else 0.0 for b, x in enumerate(row)] for a, row in enumerate(form)] for form in second
        ]
        pure = [[[max(above(sign * row[a]), 0.0) for a, row in enumerate(form)] for form in second] for sign in (1, -1)]
        return [[above(x) for x in error], [above(-x) for x in error], slope, mixed, *pure]

    def excess(self, bounds: list[Array], reach: Array, q: Array, w: Array) -> tuple[Array, Array, Array]:
        """e(S) for half widths of cells and sections, how far joints go, and the angles that they turn by; all rounded up."""
        above, below, slope, mixed, up, down = bounds
        far = (reach @ w[:, :, None])[:, :, 0] * UP
        angle = np.cumsum(far * np.append(~self.slides, [True] * self.turning), axis=1) * UP
        c, slid = angle[:, : self.n], far[:, : self.n] * self.slides
        third = (c**3 * (self.lengths + np.maximum(abs(q), self.out) * self.slides + slid) + 3 * c**2 * slid).sum(axis=1) / 6
        rest = np.stack([third] * self.linear + [angle[:, -1] ** 3 / 6] * (self.m - self.linear), axis=1)
        rest += (slope @ w[:, :, None])[:, :, 0] + ((mixed @ w[:, None, :, None])[..., 0] * w[:, None]).sum(axis=2)
        high, low = ((rest + (x @ w[:, :, None] ** 2)[:, :, 0] / 2) * UP for x in (up, down))
        return np.nextafter(np.maximum(above + high, below + low), np.inf) + LEAST, far, angle

    def rejected(self, chunk: list[tuple[Cell, Any]]) -> tuple[int, list[Cell]]:
        """How many leaves were checked, and those where not every target and locked value is proved to have a configuration."""
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            parts = [self.expanded(cell, counts) for cell, counts in chunk]
            sections = self.section(np.array([[[float(x) for x in row] for row in first.tolist()] for _, first, _ in parts]))
            made = [self.bounds(*part, section) for part, section in zip(parts, sections, strict=True)]
            bounds = [np.array(x) for x in zip(*made, strict=True)]
            depths = [[2 << d for _, d in cell] for cell, _ in chunk]
            widths = [[above(flint.arb(w / d)) for w, d in zip(self.width, row, strict=True)] for row in depths]
            q = np.array([counts for _, counts in chunk]) * UNIT
            s = np.zeros((len(chunk), self.m))
            # 30 times wider until e(S) <= S; then 8 times narrower: as e grows with S, e(S) is such a box again.
            for i in range(39):
                e, far, angle = self.excess(bounds, np.abs(sections), q, np.concatenate([widths, s], axis=1))
                closed = np.asarray(((e <= s) & (s < 1e3)).all(axis=1))
                s = np.where(closed[:, None], s if i < 30 or i == 38 else e, 1.05 * e + 1e-9)
        low, high = np.nextafter(q - far[:, : self.n], -np.inf), np.nextafter(q + far[:, : self.n], np.inf)
        inside = ((low >= self.limits[:, 0]) & (high <= self.limits[:, 1]))[:, self.free].all(axis=1)
        good = closed & inside & ((angle[:, -1] < 1.5) | (self.m < 6))
        return len(chunk), [cell for (cell, _), proved in zip(chunk, good, strict=True) if not proved]


def exact_rotation(quaternion: Iterable[int]) -> list[list[Fraction]]:
    """The rotation of a quaternion (w, x, y, z) of whole numbers, of any length but 0."""
    w, x, y, z = quaternion
    rows = [[w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]]  # fmt: skip
    return [[Fraction(value, w * w + x * x + y * y + z * z) for value in row] for row in rows]


def snap(document: dict[str, Any]) -> tuple[float, float]:
    """Above the angle, rad, and the distance, m, between frames of a structural zero and those of the file."""
    turned, shifted = 0.0, 0.0
    for frame, joint in zip(document["snapped"], document["arm"]["joints"], strict=True):
        exact = [x for row in exact_rotation(map(int, frame["rotation"])) for x in row]
        off = sum((a - Fraction(real(b))) ** 2 for a, b in zip(exact, joint["rotation"], strict=True))
        need(off < Fraction(1, 10_000), "a frame is turned by more than some hundredths of a radian")
        # |R - R'| (Frobenius) is 2 sqrt 2 sin(angle / 2); the sine of a small x is above x (1 - x^2 / 6).
        turned = max(turned, math.sqrt(off) / math.sqrt(2) * 1.0001)
        far = sum((Fraction(a) - Fraction(real(b))) ** 2 for a, b in zip(frame["origin"], joint["origin"], strict=True))
        shifted = max(shifted, math.sqrt(far) * UP)
    return turned, shifted


def _structural_zero(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None]) -> Verdict:
    """Each pair of neighbouring axes before the joint, and each behind it, has the point in common that both name."""
    began, n, k = time.perf_counter(), len(document["snapped"]), document["locked"]
    points = [Fraction(x) for x in document["points"]]
    pairs, good = [i for i in range(1, n) if i not in (k, k + 1)], 0
    for i in pairs:
        turn = exact_rotation(map(int, document["snapped"][i]["rotation"]))
        place = [Fraction(x) + row[2] * points[i] for x, row in zip(document["snapped"][i]["origin"], turn, strict=True)]
        good += place == [0, 0, points[i - 1]]
    tell(len(pairs))
    _agree(document, Fraction(0))
    return Verdict(
        document=document, leaves=len(pairs), accepted=good, rejected=len(pairs) - good, seconds=time.perf_counter() - began,
        undecided=Fraction(int(good < len(pairs))), shadow=frozenset(),
    )  # fmt: skip


def bent(slope: Array, second: Balls, half: Array) -> Array:
    """Above what slopes (their sizes) and second derivatives, by pairs j <= k, take from a number within half widths."""
    own, pairs = np.diagonal(second.low, axis1=1, axis2=2), np.triu(second.size, 1)
    most = np.where(slope < own * half, slope**2 / (2 * own), slope * half - own * half**2 / 2)
    return np.asarray((most.sum(axis=1) + np.einsum("nj,njk,nk->n", half, pairs, half)) * UP + LEAST)


class Boxes:
    """Boxes of joints, and of targets behind them."""

    def __init__(self, arm: dict[str, Any], ends: list[list[float]], flat: bool) -> None:
        frames, self.n = [*arm["joints"], arm["tool"]], len(arm["joints"])
        self.low, self.width = [Fraction(low) for low, _ in ends], [Fraction(high) - Fraction(low) for low, high in ends]
        self.origins = [np.array([real(x) for x in frame["origin"]]) for frame in frames]
        numbers = [frame["rotation"] for frame in frames]
        self.turns = [Balls(np.reshape([real(x) for x in given], (3, 3)), defect(given)) for given in numbers]
        if flat:  # all that moves, moves in the plane: heights count nothing
            about = [turn.at for turn in self.turns[:-1]]
            good = all(abs(x[2, 2]) == 1 and not x[2, :2].any() and not x[:2, 2].any() for x in about)
            need(good, "a planar task is one of arms that stay in the plane")
            self.origins = [x * [1, 1, 0] for x in self.origins]
        self._known: dict[tuple[int, tuple[int, int]], tuple[float, ...]] = {}

    def middles(self, axis: int, parts: Iterable[tuple[int, int]]) -> Array:
        """Of parts of an axis the middle, a bound of its error, the half width above, sine and cosine (parts, 5)."""
        found = []
        for part in parts:
            if (axis, part) not in self._known:
                k, d = part
                exact, half = self.low[axis] + self.width[axis] * Fraction(2 * k + 1, 2 << d), self.width[axis] / (2 << d)
                sine, cosine = flint.arb(flint.fmpq(exact.numerator, exact.denominator)).sin_cos()
                need(max(above(sine.rad()), above(cosine.rad())) < 2.0**-55, "an angle is too large to be computed with")
                middle, most = float(exact), math.nextafter(float(half), math.inf)
                self._known[axis, part] = middle, 2.0**-52 * abs(middle), most, float(sine), float(cosine)
            found.append(self._known[axis, part])
        return np.array(found)

    def moved(self, first: int, end: Array, joints: list[Array]) -> tuple[Balls, Balls, Balls, Array]:
        """A point of a link seen from another, the axes between, points on these, and the lengths that joints carry."""
        count, last = len(joints[0]) if joints else 1, first + len(joints)
        tip, turn = Balls(np.zeros((count, 3))), Balls(np.broadcast_to(np.eye(3), (count, 3, 3)))
        axes, places, lengths = [], [], np.zeros(len(joints))
        for k, joint in enumerate(joints, first):
            tip, turn = tip + times("nij,j->ni", turn, Balls(self.origins[k])), times("nij,jk->nik", turn, self.turns[k])
            axes.append(turn[:, :, 2])
            places.append(tip)
            about = np.zeros((count, 3, 3))
            about[:, 0, 0] = about[:, 1, 1] = joint[:, 4]
            about[:, 1, 0], about[:, 0, 1], about[:, 2, 2] = joint[:, 3], -joint[:, 3], 1
            turn = times("nij,njk->nik", turn, Balls(about, 2.0**-52))
            whole = Balls((end if k + 1 == last else self.origins[k + 1]) * [1, 1, 0])
            if k + 1 < last:
                after = end if k + 2 == last else self.origins[k + 2]
                whole += times("ij,j->i", self.turns[k + 1], Balls(after * [0, 0, 1]))
            lengths[k - first] = math.hypot(*whole.size) * UP
        tip += times("nij,j->ni", turn, Balls(end))
        none = Balls(np.zeros((count, 0, 3)))
        return tip, stacked(axes, 1) if joints else none, stacked(places, 1) if joints else none, lengths

    def at(self, q: list[str]) -> list[Array]:
        """Joint values as :meth:`moved` takes them: one row for each."""
        values = [real(x) for x in q]
        need(max(map(abs, values)) < 100, "a configuration turns by more than 100 rad")
        return [np.array([[x, 0, 0, *(float(y) for y in flint.arb(x).sin_cos())]]) for x in values]


def columns(tip: Balls, z: Balls, places: Balls) -> Balls:
    """Derivatives of a point by the joints."""
    return times("nkij,nkj->nki", crossed(z), tip[:, None] + -places)


class Apart(Boxes):
    """The leaves of a refutation: the tool is not where the target is."""

    def __init__(self, document: dict[str, Any]) -> None:
        self._given = document | {"tree": ""}
        limits, target, lemmas = list(document["limits"]), document["target"], document["lemmas"]
        if document["locked"] >= 0:
            limits[document["locked"]] = document["angle"]
        full, ends = math.nextafter(math.pi, 4), [[real(x) for x in pair] for pair in limits]
        ends = [[low, high] if high - low < 2 * math.pi else [-full, full] for low, high in ends]
        self.rows = len(target["axes"])
        super().__init__(document["arm"], [*ends, *([real(x) for x in pair] for pair in target["box"])], self.rows == 2)
        self.points = [np.array([real(x) for x in lemma["point"]]) * [1, 1, self.rows > 2] for lemma in lemmas]
        self.links = [lemma["link"] for lemma in lemmas]
        self.least, self.most = ([real(lemma[key]) for lemma in lemmas] for key in ("least", "most"))

    def __reduce__(self) -> tuple[Any, ...]:
        return Apart, (self._given,)

    def nearest(self, v: Balls, z: Balls, columns: Balls, lengths: Array, half: Array, wide: Array) -> Array:
        """Below the distance: along a direction e, of length 1 at most, whichever it is; two are tried."""
        swept = np.concatenate([columns.at * half[:, :, None], np.eye(3) * wide[:, None]], axis=1)
        spread = np.einsum("nka,nkb->nab", swept, swept) + 1e-6 * np.eye(3) * (v.at**2).sum(axis=1)[:, None, None]
        steep = np.linalg.solve(spread + 1e-30 * np.eye(3), v.at[:, :, None])[:, :, 0]
        third, best = (np.cumsum(half, axis=1) ** 3 * lengths).sum(axis=1) / 6, np.full(len(v.at), -np.inf)
        for along in (v.at, steep):
            e = along / np.sqrt((along**2).sum(axis=1))[:, None] * (1 - 1e-12)
            e = Balls(np.where(((e**2).sum(axis=1) < 1 - 1e-13)[:, None], e, 0.0))
            slope = times("na,nka->nk", e, columns).size
            second = times("nja,nka->njk", times("nkij,nj->nki", -crossed(z), e), columns)
            loss = bent(slope, second, half) + (abs(e.at) * wide).sum(axis=1) + third
            best = np.maximum(best, np.nextafter(times("na,na->n", e, v).low - loss * UP, -np.inf))
        return best

    def farthest(self, v: Balls, z: Balls, columns: Balls, lengths: Array, half: Array, wide: Array) -> Array:
        """Above the distance, from half its square: its third derivative is at most 3 |t'| |t''| + |t| times the point's."""
        count, joints = half.shape
        back = Balls(np.broadcast_to(-np.eye(3), (count, 3, 3)))
        whole = Balls(np.concatenate([columns.at, back.at], axis=1), np.concatenate([columns.off, back.off], axis=1))
        bend = times("nja,nka->njk", times("nkij,nj->nki", -crossed(z), v), columns)
        second = times("nja,nka->njk", whole, whole)
        second.off = second.off.copy()
        inner = second[:, :joints, :joints] + bend
        second.at[:, :joints, :joints], second.off[:, :joints, :joints] = inner.at, inner.off
        width, d = np.concatenate([half, wide], axis=1), length(v.size)
        c = np.cumsum(half, axis=1)
        one, two, three = ((c**power * lengths).sum(axis=1) for power in (1, 2, 3))
        one += length(wide)
        total = bent(times("na,nka->nk", v, whole).size, -second, width) + (3 * one * two + (d + one) * three) / 6
        return np.asarray(np.nextafter(np.sqrt((d**2 + 2 * total) * UP), np.inf))

    def excluded(self, which: int, parts: list[Cell]) -> NDArray[np.bool_]:
        """Of leaves of the tree: by a lemma, or by none (-1), in which case the distance of the tool itself must be above 0."""
        last, end = (self.links[which], self.points[which]) if which >= 0 else (self.n, self.origins[-1])
        joints = [self.middles(k, (cell[k] for cell in parts)) for k in range(last)]
        axes = [self.middles(self.n + a, (cell[self.n + a] for cell in parts)) for a in range(self.rows)]
        axes += [np.zeros((len(parts), 5))] * (3 - self.rows)
        target = stacked([Balls(-axis[:, 0], axis[:, 1]) for axis in axes], 1)
        half = np.stack([joint[:, 2] for joint in joints], 1) if joints else np.zeros((len(parts), 0))
        tip, z, places, lengths = self.moved(0, end, joints)
        moves = columns(tip, z, places)
        if not joints:
            z = moves = Balls(np.zeros((len(parts), 0, 3)))
        given = tip + target, z, moves, lengths, half, np.stack([axis[:, 2] for axis in axes], 1)
        least, most = (self.least[which], self.most[which]) if which >= 0 else (0.0, 0.0)
        return np.asarray((self.nearest(*given) > most) | (self.farthest(*given) < least))

    def keeps(self, which: int, parts: list[Cell]) -> NDArray[np.bool_]:
        """Of leaves of a lemma: whether the tool keeps its distance from the point."""
        first, point = self.links[which], self.points[which]
        joints = [self.middles(first + k, (cell[k] for cell in parts)) for k in range(self.n - first)]
        tip, z, places, lengths = self.moved(first, self.origins[-1], joints)
        half, there = np.stack([joint[:, 2] for joint in joints], 1), Balls(np.broadcast_to(point, (len(parts), 3)))
        # Where the first axes pass by the point at a distance, turning about these changes the tool's by so much at most.
        aside, still = np.zeros(len(parts)), np.ones(len(parts), dtype=bool)
        by = times("nkij,nkj->nki", crossed(z), there[:, None] + -places).size
        for k in range(len(joints)):
            cost = length(by[:, k]) * np.minimum(half[:, k], 2) * UP
            still &= cost < 1e-6
            half[:, k], aside = np.where(still, 0.0, half[:, k]), (aside + np.where(still, cost, 0.0)) * UP
        given = tip + -there, z, columns(tip, z, places), lengths, half, np.zeros((len(parts), 3))
        near, far = np.nextafter(self.nearest(*given) - aside, -np.inf), np.nextafter(self.farthest(*given) + aside, np.inf)
        return np.asarray(((near >= self.least[which]) | (self.least[which] <= 0)) & (far <= self.most[which]))

    def holds(self, witness: list[str]) -> bool:
        """Whether a configuration is one of those that are meant, and its tool in the box of targets."""
        q, given = [real(x) for x in witness], self._given
        ranges = [given["angle"] if k == given["locked"] else pair for k, pair in enumerate(given["limits"])]
        within = all(real(pair[0]) <= x <= real(pair[1]) for x, pair in zip(q, ranges, strict=True))
        tip = self.moved(0, self.origins[-1], self.at(witness))[0]
        sides = [[real(x) for x in pair] for pair in given["target"]["box"]]
        low, high = tip.low[0], -(-tip).low[0]
        inside = all(a <= x and y <= b for (a, b), x, y in zip(sides, low, high, strict=False))
        return within and inside

    def rejected(self, chunk: list[tuple[Cell, tuple[int, int]]]) -> tuple[int, list[tuple[Cell, tuple[int, int]]]]:
        """How many leaves were checked, and which of them prove nothing; each with its tree, -1 the main one, and its lemma."""
        bad = list[tuple[Cell, tuple[int, int]]]()
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            for kind in sorted({kind for _, kind in chunk}):
                parts = [cell for cell, other in chunk if other == kind]
                good = self.excluded(kind[1], parts) if kind[0] < 0 else self.keeps(kind[0], parts)
                bad += [(cell, kind) for cell, fine in zip(parts, good, strict=True) if not fine]
        return len(chunk), bad


class Wrenches(Boxes):
    """The leaves of a ceiling of relative manipulability; each has a joint whose lock costs enough."""

    def __init__(self, document: dict[str, Any]) -> None:
        self._given = document | {"tree": ""}
        ends = [[real(x) for x in pair] for pair in document["joint_box"]]
        super().__init__(document["arm"], ends, document["task"] == "planar-pose")
        self.threshold, self.rows, self.locks = real(document["threshold"]), SIX[document["task"]], document["locks"]
        line, column = np.indices(
            (self.n, self.n)
        )  # joint j moves axis l, seen from link n/2: one way behind it, the other before
        self.middle = self.n // 2
        behind, before = (column >= self.middle) & (column < line), (column < self.middle) & (column > line)
        self.sign, self.side = 1.0 * behind - 1.0 * before, np.where(np.arange(self.n) >= self.middle, 1.0, -1.0)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._given,)

    def screws(self, joints: list[Array]) -> tuple[Balls, Balls, Balls, Array, Array]:
        """Axes, moments of these about a point on the middle one, brackets, distances from axis to axis and to the point."""
        tip, z, places, _ = self.moved(0, self.origins[-1], joints)
        path = [places[:, k] for k in range(self.n)]
        links, order = np.zeros((len(places.at), self.n)), [*range(self.middle, self.n), *range(self.middle - 1, -1, -1)]
        for j in order:  # any point of an axis will do: one that is near the one before, of the middle axis near the tool
            last = tip if j == self.middle else path[j - 1 if j > self.middle else j + 1]
            along = np.nan_to_num(((last.at - path[j].at) * z.at[:, j]).sum(axis=1))
            path[j] += times("n,na->na", Balls(along), z[:, j])
            links[:, j] = length((path[j] + -last).size)
        away = stacked(path, 1) + -path[self.middle][:, None]
        v = times("nlij,nlj->nli", crossed(away), z)
        # The derivative of screw l by joint j is the bracket of screws j and l, and so on with joints nearer the middle.
        shifted = times("njab,nlb->njla", crossed(z), v) + times("njab,nlb->njla", crossed(v), z)
        return z, v, joined(times("njab,nlb->njla", crossed(z), z), shifted), links, length(away.size, 2)

    def remains(self, links: Array, away: Array, half: Array) -> list[Array]:
        """Above what is left of axes and of moments behind first order, and behind second: (leaves, n) each."""
        c, v = half @ abs(self.sign).T, np.zeros((3, *links.shape))
        for j in range(self.n):
            between = slice(self.middle, j) if j > self.middle else slice(j + 1, self.middle)
            for r in range(3 if j not in (self.middle, self.middle - 1) else 0):
                carried = slice(j, self.n) if j > self.middle else slice(0, j + 1)
                v[r, :, carried] += (links[:, j] * half[:, between].sum(axis=1) ** (r + 1))[:, None]
        far = away + v[0]
        second, third = v[1] + 2 * v[0] * c + far * c**2, v[2] + 3 * v[1] * c + 3 * v[0] * c**2 + far * c**3
        return [x * UP + LEAST for x in (c**2 / 2, second / 2, c**3 / 6, third / 6)]

    def wrench(self, own: Array, others: Array, moved: Array, half: Array, k: int) -> tuple[Array, Array]:
        """Any wrench y (leaves, 6), and how it follows the joints (leaves, 6, n): such that other moments hardly change."""
        counts = half * self.sign.any(axis=0)
        gram = np.einsum("nla,nlb->nab", others, others) + 0.01 * (counts.max(axis=1) ** 2)[:, None, None] * np.eye(6)
        gram += 1e-30 * np.eye(6)
        y = np.linalg.solve(gram, own[:, :, None])[:, :, 0]
        y = y / (y * own).sum(axis=1)[:, None]
        slopes = np.einsum("nljb,nb->nlj", moved, y)
        turn = -np.linalg.solve(gram, np.einsum("nla,nlj->naj", others, np.delete(slopes, k, axis=1)))
        turn = turn - y[:, :, None] * (np.einsum("na,naj->nj", own, turn) + slopes[:, k])[:, None]
        return np.nan_to_num(y), np.nan_to_num(turn)

    def costs(self, k: int, parts: list[Cell]) -> NDArray[np.bool_]:
        """Of leaves: whether a lock of joint k costs enough."""
        joints = [self.middles(j, (cell[j] for cell in parts)) for j in range(self.n)]
        half = np.stack([joint[:, 2] for joint in joints], 1)
        z, v, bracket, links, away = self.screws(joints)
        screws, moved = joined(z, v), bracket.transposed(0, 2, 1, 3).signed(self.sign[:, :, None])
        y, turn = self.wrench(screws.at[:, k], np.delete(screws.at, k, axis=1), moved.at, half, k)
        wrench, turning = Balls(y), Balls(turn)
        slope = times("nljb,nb->nlj", moved, wrench) + times("nla,naj->nlj", screws, turning)
        force, moment = Balls(y[:, 3:]), Balls(y[:, :3])
        down = -(times("nlab,nb->nla", crossed(z), moment) + times("nlab,nb->nla", crossed(v), force))
        right = -times("nlab,nb->nla", crossed(z), force)
        twice = times("nia,njla->nlij", joined(down, right), bracket)
        mask = abs(self.sign[:, :, None] * self.sign[:, None])
        inner = np.arange(self.n)[:, None, None] >= self.middle  # behind the middle the nearer joint has the lower number
        twice = Balls(*(mask * np.where(inner, x, x.transpose(0, 1, 3, 2)) for x in (twice.at, twice.off)))
        cross = times("nai,nlja->nlij", turning, moved)
        pairs = np.triu((twice + cross + cross.transposed(0, 1, 3, 2)).size, 1)
        own = (Balls(twice.at / 2, twice.off / 2) + cross).size * np.eye(self.n)
        rest = (slope.size * half[:, None]).sum(axis=2) + np.einsum("ni,nlij,nj->nl", half, pairs + own, half)
        more = [(length(x) * half).sum(axis=1) for x in (turn[:, :3], turn[:, 3:])]
        sizes = [x[:, None] for x in (*more, length(y[:, :3]), length(y[:, 3:]))]
        rest = (rest + sum(x * left for x, left in zip(sizes, self.remains(links, away, half), strict=True))) * UP
        moments = times("nla,na->nl", screws, wrench)
        others, least = (moments.size + rest) * UP, np.maximum(np.nextafter(moments.low - rest, -np.inf)[:, k], 0)
        others[:, k], c = 0, self.threshold
        high, low = (others**2).sum(axis=1) * ((1 - c) * (1 + c)) * UP, c**2 * least**2 * (1 - 1e-12)
        return np.asarray((high < low) & (least > 1e-100))

    def rejected(self, chunk: list[tuple[Cell, int]]) -> tuple[int, list[Cell]]:
        """How many leaves were checked, and which of them prove nothing; each with the joint whose lock costs enough."""
        bad = list[Cell]()
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            for k in sorted({k for _, k in chunk}):
                parts = [cell for cell, other in chunk if other == k]
                bad += [cell for cell, good in zip(parts, self.costs(k, parts), strict=True) if not good]
        return len(chunk), bad

    def occurs(self, q: list[str]) -> tuple[float, float]:
        """Around the least relative manipulability at a configuration: its square is 1 - J_k' (JJ')^-1 J_k."""
        tip, z, places, _ = self.moved(0, self.origins[-1], self.at(q))
        made = columns(tip, z, places)
        values, errors = (np.concatenate([x[0], y[0]], 1).T[self.rows] for x, y in ((made.at, z.at), (made.off, z.off)))
        entries = [flint.arb(float(x), float(e)) for x, e in zip(values.flat, errors.flat, strict=True)]
        jacobian = flint.arb_mat(*values.shape, entries)
        try:
            solved = (jacobian * jacobian.transpose()).solve(jacobian)
        except ZeroDivisionError:
            return 0.0, 1.0
        kept = [1 - sum(jacobian[i, k] * solved[i, k] for i in range(len(self.rows))) for k in self.locks]
        low, high = ([-above(-x) for x in kept], [above(x) for x in kept])
        return math.sqrt(max(0.0, min(low))) * (1 - 1e-15), math.sqrt(max(0.0, min(high))) * (1 + 1e-15)


class Motions(Wrenches):
    """The leaves of a floor; each has a motion that keeps the tool where it is."""

    def costs(self, k: int, parts: list[Cell]) -> NDArray[np.bool_]:
        """Of leaves: whether all locks leave enough."""
        joints = [self.middles(j, (cell[j] for cell in parts)) for j in range(self.n)]
        half, rows = np.stack([joint[:, 2] for joint in joints], 1), ROWS_OF_SCREWS[len(self.rows)]
        z, v, bracket, links, away = self.screws(joints)
        screws = joined(z, v)[:, :, rows]
        given = half, z, v, screws, bracket.signed(abs(self.sign).T[:, :, None]), self.remains(links, away, half)
        jacobian = np.nan_to_num(screws.at.transpose(0, 2, 1))
        inverse = np.nan_to_num(np.linalg.pinv(jacobian))
        if self.n - len(rows) == 1:
            return self.leaves_enough(np.linalg.svd(jacobian)[2][:, -1], inverse, self.locks, *given)
        onto = np.eye(self.n) - inverse @ jacobian
        return np.asarray(np.all([self.leaves_enough(onto[:, :, k], inverse, [k], *given) for k in self.locks], axis=0))

    def leaves_enough(
        self,
        nu: Array,
        inverse: Array,
        locks: list[int],
        half: Array,
        z: Balls,
        v: Balls,
        screws: Balls,
        moved: Balls,
        left: Any,
    ) -> NDArray[np.bool_]:
        """Whether some x = nu + N (q - q_c) + P s keeps the tool still all over the leaf, and its parts are large enough."""
        rows, nu = ROWS_OF_SCREWS[len(self.rows)], np.nan_to_num(nu / length(nu)[:, None])
        second, third = (np.stack([a] * 3 + [b] * 3, axis=2)[:, :, rows] for a, b in (left[:2], left[2:]))
        u, side = times("njlb,nl->njb", moved, Balls(nu)), self.side[:, None]
        slope = u.signed(side)[:, :, rows]
        follow = np.nan_to_num(-np.einsum("nlb,njb->nlj", inverse, slope.at))
        slope += times("nlb,nlj->njb", screws, Balls(follow))
        turned, shifted = times("niab,njb->nija", crossed(z), u[:, :, :3]), times("niab,njb->nija", crossed(z), u[:, :, 3:])
        twice = joined(turned, shifted + times("niab,njb->nija", crossed(v), u[:, :, :3]))
        i, j = np.indices((self.n, self.n))  # i nearer the middle than j, or j itself
        nearer = (self.side[:, None] == self.side) & (np.where(self.side > 0, j - i, i - j) >= 0)
        twice = twice.signed(1 * nearer[:, :, None])
        cross = times("njlb,nli->njib", moved, Balls(follow)).signed(side[:, :, None])
        own = Balls(twice.at / 2, twice.off / 2) + cross
        both = twice + twice.transposed(0, 2, 1, 3) + cross + cross.transposed(0, 2, 1, 3)
        pairs = both.size * np.triu(np.ones((self.n, self.n)), 1)[:, :, None]
        bend = (pairs + own.size * np.eye(self.n)[:, :, None])[..., rows]
        off = times("nlb,nl->nb", screws, Balls(nu)).size + np.einsum("njb,nj->nb", slope.size, half)
        off += np.einsum("nijb,ni,nj->nb", bend, half, half) + np.einsum("nl,nlb->nb", abs(nu), third)
        far = np.einsum("nlj,nj->nl", abs(follow), half) * UP
        off = (off + np.einsum("nl,nlb->nb", far, second)) * UP + LEAST
        whole = times("nlb,nlc->nbc", screws, Balls(inverse)) + Balls(
            -np.broadcast_to(np.eye(len(rows)), (len(nu),) + (len(rows),) * 2)
        )
        miss = whole.size + np.einsum("njbc,nj->nbc", times("njlb,nlc->njbc", moved[..., rows], Balls(inverse)).size, half)
        miss = (miss + np.einsum("nlb,nlc->nbc", second, abs(inverse))) * UP + LEAST
        s = off
        for _ in range(12):
            s = 1.02 * (off + np.einsum("nbc,nc->nb", miss, s)) + 1e-15
        # s -> s - J x sends its box into itself; and as miss s < s, J P has an inverse everywhere: nothing is singular.
        closed = ((off + np.einsum("nbc,nc->nb", miss, s)) * UP < s).all(axis=1) & (s < 1e3).all(axis=1)
        shift = np.einsum("nlb,nb->nl", abs(inverse), s) * UP
        long = (
            (nu**2).sum(axis=1)
            + 2 * (times("nl,nlj->nj", Balls(nu), Balls(follow)).size * half).sum(axis=1)
            + (far**2).sum(axis=1)
        )
        long = (np.sqrt(long * UP) + length(shift)) * UP
        least = np.nextafter(abs(nu) - (far + shift) * UP, -np.inf)[:, locks].min(axis=1)
        return np.asarray(closed & (least > 1e-100) & (least > self.threshold * long * UP))


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What the check of a certificate found. What rejected leaves cover counts as undecided."""

    document: dict[str, Any]
    leaves: int
    accepted: int
    rejected: int
    seconds: float
    undecided: Fraction  # of the root box; of a bundle in its worst part
    shadow: frozenset[Cell]  # cells of targets for which something is undecided
    parts: tuple[Verdict, ...] = ()
    refuted: bool = False  # a configuration shows that the claim is false
    occurs: float = 0.0  # of a ceiling: a value that is attained, or less; of a floor, or more
    whichever: Fraction | None = None  # of a path: at least this part of the lock instants is proved for all locks

    @property
    def sampled(self) -> bool:
        """Whether leaves were left out."""
        return self.accepted + self.rejected < self.leaves

    @property
    def tolerant(self) -> Fraction:
        """At least this part of the targets is proved, for every locked value and, of a bundle, every lock."""
        if self.whichever is not None:
            return self.whichever
        return 1 - covered(self.shadow, [MOST_STEPS])

    @property
    def sentence(self) -> str:
        """What was found, for people: never rounded up to the whole or down to nothing."""
        text = "Rejected: the witness is none."
        if self.document.get("witness"):
            at = ", ".join(repr(real(x)) for x in self.document["witness"])
            return f"Refuted: at ({at}) the tool is in the box." if self.refuted else text
        if self.document["kind"] in ("ceiling", "floor"):
            at = ", ".join(repr(real(x)) for x in self.document["found"])
            rounded = math.floor if self.document["kind"] == "ceiling" else math.ceil
            best = f"{rounded(self.occurs * 1e6) / 1e6:.6f} occurs, at ({at})"
            if self.refuted:
                return f"Refuted: {best}."
        text = f"Proved: {per_cent(1 - self.undecided)}, undecided: {per_cent(self.undecided, up=True)}"
        text += " of all pairs of target and configuration" * bool(self.document["kind"] == "refutation")
        text += " of the lock instants" * bool(self.document["kind"] == "path") + " in the worst part" * bool(self.parts)
        if self.document["kind"] in ("ceiling", "floor"):
            text += f" of the box; {best}"
        elif self.document["kind"] == "path":
            text += f"; whichever joint locks, at least {per_cent(self.tolerant)}" * bool(self.parts)
        elif self.document["kind"] != "structural-zero" and self.document.get("locked") != -1:
            text += f"; wherever the lock, at least {per_cent(self.tolerant)} of the targets"
        text += f". Leaves accepted: {self.accepted}, rejected: {self.rejected}; {self.seconds:.1f} s"
        return text + (f"; of {self.leaves}: sampled, not verified." if self.sampled else ".")


def _looked_at(
    leaves: Any, chosen: Iterator[Any], workers: int, tell: Callable[[int], None], chunk: int = CHUNK
) -> tuple[int, list[Any]]:
    """How many leaves were checked, and those that were rejected."""
    checked, rejected = 0, list[Any]()
    with ExitStack() as stack:
        spread: Callable[..., Iterable[tuple[int, list[Any]]]] = map
        if workers > 1:
            spread = stack.enter_context(ProcessPoolExecutor(workers, get_context("spawn"))).map
        for size, bad in spread(leaves.rejected, iter(lambda: list(islice(chosen, chunk)), [])):
            checked, rejected = checked + size, rejected + bad
            tell(size)
    return checked, rejected


def _agree(document: dict[str, Any], undecided: Fraction) -> None:
    """The volumes of the file are those of its tree."""
    volumes = {"proved": 1 - undecided, "refuted": Fraction(0), "undecided": undecided}
    written = {key: f"{part.numerator}/2^{part.denominator.bit_length() - 1}" for key, part in volumes.items()}
    need(document["volumes"] == written, "volumes are not those of the tree")


def _picked(count: int, sample: int | None) -> Iterable[int]:
    """The numbers of the leaves that are checked, ordered by chance or all."""
    return range(count) if sample is None else frozenset(random.SystemRandom().sample(range(count), max(0, min(sample, count))))


def _refutation(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None]) -> Verdict:
    began, leaves, most = time.perf_counter(), Apart(document), 2 * MOST_LEAVES - 1
    main, axes, last = unpacked(document["tree"], most, "tree"), leaves.n + leaves.rows, 2 + len(leaves.links)
    need(last < SPLIT, f"there are more than {SPLIT - LEMMA} lemmas")
    trees = [unpacked(lemma["tree"], most, "tree of a lemma") for lemma in document["lemmas"]]
    undecided = [cell for token, cell in cells(main, axes, last) if token in (1, 2)]
    need(not any(tree.count(token) for tree in trees for token in (1, 2)), "a lemma is not proved everywhere")
    _agree(document, volume(undecided))
    count = sum(tree.count(0) for tree in trees) + sum(main.count(token) for token in (PROVED, *range(LEMMA, last + 1)))

    def proofs() -> Iterator[tuple[Cell, tuple[int, int]]]:
        for k, tree in enumerate(trees):
            yield from ((cell, (k, k)) for _, cell in cells(tree, leaves.n - leaves.links[k]))
        yield from ((cell, (-1, max(token, 2) - LEMMA)) for token, cell in cells(main, axes, last) if token not in (1, 2))

    if document["witness"]:
        need(main == b"\2" and not trees, "beside a witness nothing is proved")
        with flint.ctx.workprec(64):
            count, checked, good = 1, 1, leaves.holds(document["witness"])
        rejected = [] if good else [(undecided[0], (-1, -1))]
    else:
        good, picked = False, _picked(count, sample)
        chosen = (proof for index, proof in enumerate(proofs()) if index in picked)
        checked, rejected = _looked_at(leaves, chosen, workers, tell)
        broken = {tree for _, (tree, _) in rejected if tree >= 0}
        bad = {cell for cell, (tree, _) in rejected if tree < 0}
        undecided += [cell for cell, (tree, which) in proofs() if tree < 0 and (which in broken or cell in bad)]
    return Verdict(
        document=document, leaves=count, accepted=checked - len(rejected), rejected=len(rejected),
        seconds=time.perf_counter() - began, undecided=volume(undecided), refuted=good,
        shadow=frozenset(cell[leaves.n :] for cell in undecided),
    )  # fmt: skip


def _bound(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None]) -> Verdict:
    """A ceiling or a floor."""
    began, ceiling = time.perf_counter(), document["kind"] == "ceiling"
    leaves = Wrenches(document) if ceiling else Motions(document)
    with flint.ctx.workprec(64), np.errstate(all="ignore"):
        inside = all(real(a) <= real(x) <= real(b) for x, (a, b) in zip(document["found"], document["joint_box"], strict=True))
        need(inside, "the configuration that was found is outside of the box")
        low, high = leaves.occurs(document["found"])
    tree, good = unpacked(document["tree"], 2 * MOST_LEAVES - 1, "tree"), {0}
    if ceiling:
        good = {LOCK + k for k in document["locks"]}
    need(set(tree) <= good | {2, *range(SPLIT, SPLIT + leaves.n)}, "a token of the tree is unknown, or not among the locks")
    undecided = [cell for token, cell in cells(tree, leaves.n, 2, LOCK) if token == 2]
    _agree(document, volume(undecided))
    proofs = ((cell, max(token - LOCK, 0)) for token, cell in cells(tree, leaves.n, 2, LOCK) if token != 2)
    count = sum(tree.count(token) for token in good)
    picked = _picked(count, sample)
    checked, rejected = _looked_at(leaves, (proof for i, proof in enumerate(proofs) if i in picked), workers, tell)
    return Verdict(
        document=document, leaves=count, accepted=checked - len(rejected), rejected=len(rejected),
        occurs=low if ceiling else high, seconds=time.perf_counter() - began, undecided=volume(undecided) + volume(rejected),
        refuted=low > leaves.threshold if ceiling else high < leaves.threshold, shadow=frozenset(),
    )  # fmt: skip


def _reach(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None]) -> Verdict:
    began, leaves = time.perf_counter(), Leaves(document)
    tree, axes = unpacked(document["tree"], 2 * MOST_LEAVES - 1, "tree"), len(leaves.width)
    undecided = [cell for token, cell in cells(tree, axes) if token != PROVED]
    count, open_part = tree.count(PROVED), volume(undecided)
    packed = unpacked(document["centres"], 4 * leaves.n * count, "centres")
    need(len(packed) == 4 * leaves.n * count, "there are fewer centres than leaves")
    centres = np.frombuffer(packed, "<i4").reshape(count, leaves.n)
    need(leaves.locked < 0 or not centres[:, leaves.locked].any(), "centres of the locked joint must be 0")
    _agree(document, open_part)
    picked = _picked(count, sample)
    proofs = zip((cell for token, cell in cells(tree, axes) if token == PROVED), centres, strict=True)
    chosen = (proof for index, proof in enumerate(proofs) if index in picked)
    checked, rejected = _looked_at(leaves, chosen, workers, tell)
    return Verdict(
        document=document, leaves=count, accepted=checked - len(rejected), rejected=len(rejected),
        seconds=time.perf_counter() - began, undecided=open_part + volume(rejected),
        shadow=frozenset(cell[: leaves.p] for cell in undecided + rejected),
    )  # fmt: skip


def _path(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None]) -> Verdict:
    began, faults, every = time.perf_counter(), motions.Faults(document), list(paths.slabs(document))
    order, room, picked = list(range(len(every))), sample, set[int]()
    random.SystemRandom().shuffle(order)
    while order and (room is None or room > 0):
        k = order.pop()
        picked.add(k)
        room = None if room is None else room - len(every[k][3])
    chosen = [slab for k, slab in enumerate(every) if k in picked]
    _, bad = _looked_at(faults, iter(chosen), workers, tell, 8)
    parts, broken = [], {(slab[0], slab[1][0]) for slab, _ in bad}
    for which, lock in enumerate(document["locks"]):
        spans = [ends for k, ends, *_ in every if k == which]
        need(lock["proved"] == paths.text(paths.share(spans, document)), "volumes are not those of the slabs")
        count, wrong = sum(len(q) for k, *_, q in chosen if k == which), sum(n for slab, n in bad if slab[0] == which)
        spans = [one for one in spans if (which, one[0]) not in broken]
        text = f"Lock of {document['arm']['joints'][lock['joint']]['name']}."
        parts.append(
            Verdict(
                document=document | {"locked": lock["joint"], "claim": text, "gaps": paths.gaps(spans, document)},
                leaves=sum(len(q) for k, *_, q in every if k == which), accepted=count - wrong, rejected=wrong,
                seconds=0.0, undecided=1 - paths.share(spans, document), shadow=frozenset(),
                whichever=paths.share(spans, document),
            )
        )  # fmt: skip
    proved = min((lock["proved"] for lock in document["locks"]), key=Fraction)
    volumes = {"proved": proved, "refuted": "0/1", "undecided": paths.text(1 - Fraction(proved))}
    need(document["volumes"] == volumes, "volumes are not those of the worst lock")
    left = [gap for part in parts for gap in part.document["gaps"]]
    return Verdict(
        document=document, parts=tuple(parts), seconds=time.perf_counter() - began, shadow=frozenset(),
        undecided=max(part.undecided for part in parts), whichever=1 - paths.share(left, document),
        **{key: sum(getattr(part, key) for part in parts) for key in ("leaves", "accepted", "rejected")},
    )  # fmt: skip


def verify(
    path: str | Path, *, sample: int | None = None, workers: int = 1, progress: Callable[[int], None] | None = None
) -> Verdict:
    """Check a certificate, or as many of its leaves as ``sample`` says; the parts of a bundle lie beside it.

    ``progress`` is told how many leaves were checked since it was told last.

    Raises:
        Refused: A file that cannot be checked.
    """
    need(flint is not None, "checking a certificate needs python-flint; install it with: pip install 'holdfast[certify]'")
    path, tell = Path(path), progress or (lambda size: None)
    document = load(path)
    if document["kind"] != "bundle":
        return {
            "reach": _reach,
            "refutation": _refutation,
            "ceiling": _bound,
            "floor": _bound,
            "structural-zero": _structural_zero,
            "path": _path,
        }[document["kind"]](document, sample, workers, tell)
    folder, ranges = _first(path).parent, document["working_ranges"]
    files = [load(folder / part["file"]) for part in document["parts"]]
    same = {"kind": "reach"} | {key: document[key] for key in ("arm", "task", "target")}
    for part, file, locked in zip(document["parts"], files, [-1, *document["locks"]], strict=True):
        same |= {"digest": part["digest"], "locked": locked, "angle": ranges[locked] if locked >= 0 else None}
        same |= {"limits": document["limits"] if locked >= 0 else ranges}
        good = part["locked"] == locked and all(file.get(key) == value for key, value in same.items())
        need(good, f"{part['file']} is not the part that the bundle needs")
    parts = tuple(_reach(file, sample, workers, tell) for file in files)
    volumes = [file["volumes"] for file in files]
    worst = max(volumes, key=lambda x: Fraction(int(x["undecided"].split("/")[0]), 1 << int(x["undecided"].split("^")[1])))
    need(document["volumes"] == worst, "volumes are not those of the worst part")
    return Verdict(
        document=document, parts=parts, undecided=max(part.undecided for part in parts),
        shadow=frozenset(cell for part in parts for cell in part.shadow),
        **{key: sum(getattr(part, key) for part in parts) for key in ("leaves", "accepted", "rejected", "seconds")},
    )  # fmt: skip


def main() -> int:
    """0: every leaf accepted; 1: some rejected; 2: the file cannot be checked."""
    parser = argparse.ArgumentParser(description="Check a certificate of holdfast.")
    parser.add_argument("file", type=Path)
    parser.add_argument("--sample", type=int, help="check so many leaves of each file, drawn at random")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    options, done = parser.parse_args(), [0]

    def tell(size: int) -> None:
        done[0] += size
        print(f"\r{done[0]} leaves", end="", file=sys.stderr, flush=True)

    try:
        progress = tell if sys.stderr.isatty() else None
        verdict = verify(options.file, sample=options.sample, workers=options.jobs, progress=progress)
    except (Refused, KeyboardInterrupt) as error:
        print(f"refused: {error}" if isinstance(error, Refused) else "stopped: nothing is verified", file=sys.stderr)
        return 2
    print("\r" * bool(done[0]), end="", file=sys.stderr)
    for part in (*verdict.parts, verdict):
        print(part.document["claim"], part.sentence, sep="\n")
    return int(verdict.rejected > 0)


if __name__ == "__main__":
    sys.exit(main())
