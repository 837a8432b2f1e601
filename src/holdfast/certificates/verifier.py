"""Checks a certificate, whoever wrote it: ``python verifier.py FILE``; needs NumPy and python-flint, and nothing of holdfast.

The file holds a bisection tree and a configuration for each leaf. Around it the rows g of the task's error are expanded: exact
first and second derivatives as balls (Arb), a bound for the third. With a section variable s this bounds |g - s| by e(S) over
the leaf and a box of half widths S. Where e(S) <= S, the map s -> s - g sends that box into itself, so by Brouwer's theorem
some s has g = 0: a configuration that reaches the target. Any matrix D may span the section; it decides whether e(S) <= S.
"""

from __future__ import annotations

import argparse
import base64
import hashlib
import json
import math
import random
import re
import sys
import time
import zlib
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from itertools import islice
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

try:
    import flint
except ImportError:  # told when a file is to be checked: the sentence of a claim needs no balls
    flint = None

Array = NDArray[np.float64]
Cell = tuple[tuple[int, int], ...]  # for each axis (k, d): the part from k to k + 1 of 2^d equal ones

MOST_BYTES, MOST_LEAVES, MOST_DEPTH, MOST_JOINTS, CHUNK = 256 << 20, 1 << 24, 200, 64, 256
UNIT, PROVED, SPLIT = 2.0**-24, 0, 16  # token 2 is undecided; so is 1, refuted, as version 1 holds no refutations
UP, LEAST = 1 + 1e-12, 1e-300  # a sum of hundreds of products of non-negative doubles, times UP plus LEAST, is rounded up
ROWS = {"planar xy": 2, "position xyz": 3, "pose xyz": 6, "pose xyzRPY": 6}  # by task and axes of the target
NUMBER, TEXT, HASH = r"-?0x[01]\.[0-9a-f]{1,13}p[+-]\d{1,4}", "[^\0]*", "[0-9a-f]{64}"
LIMITS, FRAME = [f"{NUMBER}|-?inf", 2], {"rotation": [NUMBER, 9], "origin": [NUMBER, 3]}
ARM = {"joints": [{"name": TEXT, "type": "revolute|prismatic", "limits": LIMITS, **FRAME}, ...], "tool": FRAME}
FOR_PEOPLE: dict[str, Any] = dict.fromkeys(("made_by", "made_at", "seconds", "nodes"), ...)
VOLUMES = dict.fromkeys(("proved", "refuted", "undecided"), r"\d{1,100}/2\^\d{1,3}")
COMMON: dict[str, Any] = {"format": "holdfast-certificate", "version": range(1, 2), "kind": "reach|bundle", "arm": ARM}
COMMON |= {"arm_digest": HASH, "source": ..., "claim": TEXT, "task": TEXT, "volumes": VOLUMES, "digest": HASH, **FOR_PEOPLE}
real = float.fromhex


class Refused(ValueError):
    """A file that cannot be checked; one sentence."""


def need(good: object, sentence: str) -> None:
    """Refuse the file unless something holds."""
    if not good:
        raise Refused(sentence)


def _fit(value: Any, form: Any, what: str) -> None:
    """A form: an object of these keys, a list [form, length], text of a pattern, a range of integers, null; ... is anything."""
    if isinstance(form, dict):
        odd = sorted(form.keys() ^ value.keys() if isinstance(value, dict) else form)[:1]
        need(not odd, f"{what} must be an object with the keys {', '.join(form)}: see {''.join(odd)[:40]!r}")
        for key, inner in form.items():
            _fit(value[key], inner, f"{key} of {what}")
    elif isinstance(form, list):
        need(isinstance(value, list) and form[1] in (len(value), ...), f"{what} must be a list of {form[1]}")
        for one in value:
            _fit(one, form[0], what)
    elif isinstance(form, str):
        need(isinstance(value, str) and re.fullmatch(form, value), f"{what} is {str(value)[:40]!r}; it must be like {form}")
    elif isinstance(form, range):
        need(type(value) is int and value in form, f"{what} must be a whole number from {form[0]} to {form[-1]}")
    else:
        need(form is ... or value is None, f"{what} must be null here")


def _within(pairs: list[Any], outer: list[Any], what: str) -> None:
    for (low, high), (least, most) in ([map(real, pair) for pair in both] for both in zip(pairs, outer, strict=True)):
        good = least <= low <= high <= most and low < math.inf and high > -math.inf
        need(good, f"{what}: {low!r} to {high!r} is upside down or goes beyond {least!r} to {most!r}")


def digest(document: dict[str, Any]) -> str:
    """SHA-256 of the canonical JSON of a certificate, without its digest and when and by what it was made; or of an arm."""
    kept = {key: value for key, value in document.items() if key != "digest" and key not in FOR_PEOPLE}
    return hashlib.sha256(json.dumps(kept, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def sentence(document: dict[str, Any]) -> str:
    """The claim of a certificate, made from its other keys; its decimals are the shortest that mean the same doubles."""

    def spans(names: Iterable[str], pairs: Iterable[list[str]]) -> str:
        return ", ".join(f"{name} {' to '.join(repr(real(x)) for x in pair)}" for name, pair in zip(names, pairs, strict=True))

    names, target = [joint["name"] for joint in document["arm"]["joints"]], document["target"]
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
    return f"{text}, {kept} reaches it; lengths in m, angles in rad, base frame, arm {document['arm_digest'][:12]}."


def load(path: Path) -> dict[str, Any]:
    """A certificate of the right form, whose digests fit and whose claim is what its keys say; raises :class:`Refused`."""

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        need(len(dict(pairs)) == len(pairs), f"a key is given twice in an object of {path.name}")
        return dict(pairs)

    try:
        need(path.stat().st_size <= MOST_BYTES, f"{path.name} is larger than {MOST_BYTES >> 20} MB")
        document = json.loads(
            path.read_bytes().decode(), object_pairs_hook=once, parse_constant=lambda x: need(0, f"{x} in it")
        )
        _check(document if isinstance(document, dict) else {})
    except Refused:
        raise
    except OSError as error:
        raise Refused(f"cannot read {path.name}: {error.strerror}") from None
    except (ValueError, OverflowError, RecursionError) as error:
        raise Refused(f"{path.name} cannot be read as JSON and its numbers: {str(error)[:80]}") from None
    return dict(document)


def _check(document: dict[str, Any]) -> None:
    for key in ("format", "version", "kind", "arm", "task"):  # what the form of the rest depends on
        _fit(document.get(key), COMMON[key], key)
    joints, locks, target = document["arm"]["joints"], document.get("locks"), document.get("target")
    n, axes, names = len(joints), str(target.get("axes") if isinstance(target, dict) else ""), [one["name"] for one in joints]
    rows = ROWS.get(f"{document['task']} {axes}")
    need(rows, f"task and axes of the target must be one of: {', '.join(ROWS)}")
    need(1 <= n <= MOST_JOINTS and len(set(names)) == n, f"there must be 1 to {MOST_JOINTS} joints of different names")
    need(all(x.isprintable() and x and len(x) <= 200 for x in names), "joints must have names of 1 to 200 letters to print")
    turned: Any = [NUMBER, 9] if rows == 6 and axes == "xyz" else None
    form = {"target": {"axes": axes, "box": [[NUMBER, 2], len(axes)], "orientation": turned}, "limits": [LIMITS, n], **COMMON}
    if document["kind"] == "bundle":
        part = {"file": r"\w[\w.-]*", "digest": HASH, "locked": range(-1, n)}
        form |= {"working_ranges": [LIMITS, n], "locks": [range(n), ...]}
        form |= {"parts": [part, len(locks) + 1 if isinstance(locks, list) else 0]}
    else:
        form |= {"locked": range(-1, n), "angle": None if document.get("locked") == -1 else [NUMBER, 2]}
        form |= {"tree": TEXT, "centres": TEXT, "unit": re.escape(UNIT.hex()), "refutations": [..., 0]}
    _fit(document, form, "the certificate")
    limits = document["limits"]
    _within(limits, [joint["limits"] for joint in joints], "limits")
    _within(document["target"]["box"], [["-inf", "inf"]] * len(axes), "box of the target")
    _within(document.get("working_ranges", limits), limits, "working_ranges")
    if document.get("angle"):
        _within([document["angle"]], [limits[document["locked"]]], "angle")
    need(document["kind"] == "reach" or (locks and locks == sorted(set(locks))), "locks must be in order, each once")
    for key, value in (("arm_digest", digest(document["arm"])), ("claim", sentence(document)), ("digest", digest(document))):
        need(document[key] == value, f"{key} is not what the rest of the file gives: the file was changed or damaged")


def unpacked(text: str, most: int, what: str) -> bytes:
    """What a payload holds, of which never more than ``most`` bytes are made."""
    opened = zlib.decompressobj()
    try:
        data = opened.decompress(base64.b64decode(text, validate=True), most + 1)
    except (ValueError, zlib.error) as error:
        raise Refused(f"{what} cannot be unpacked: {error}") from None
    need(opened.eof and len(data) <= most and not opened.unused_data, f"{what} is cut off or holds too much")
    return data


def cells(tree: bytes, axes: int) -> Iterator[tuple[int, Cell]]:
    """Token and cell of each leaf, in the order of the tree."""
    waiting: list[Cell] = [((0, 0),) * axes]
    for token in tree:
        need(waiting, "the tree goes on behind its end")
        cell, axis = waiting.pop(), token - SPLIT
        if token <= 2:
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


def _above(ball: Any) -> float:
    """A double above a ball."""
    return math.nextafter(float(ball.upper()), math.inf)


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
    """Balls around nine numbers that hold the nearest rotation: it is nearer than the defect |R'R - I| (Frobenius)."""
    matrix = flint.arb_mat(3, 3, [real(x) for x in numbers])
    gram = (matrix.transpose() * matrix - _turn(0, flint.arb(0))).entries()
    defect = math.hypot(*(_above(abs(x)) for x in gram)) * UP
    good = defect < 1e-12 and matrix.det() > 0
    need(good, "a rotation of the file is none: its columns must be orthonormal to 1e-12 and right-handed")
    return flint.arb_mat(3, 3, [flint.arb(real(x), defect) for x in numbers])


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
        self.angle = max((abs(real(x)) for x in document["angle"] or ()), default=0.0)  # of the locked joint, largest
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
            self.lengths[k] = math.hypot(*(_above(abs(x)) for x in link.entries())) * UP

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
        slope = [[_above(abs(x)) for x in row] for row in (first * numbers - flint.arb_mat(ones)).tolist()]
        second = [(numbers.transpose() * hessian * numbers).tolist() for hessian in hessians]
        mixed = [
            [[_above(abs(x)) if a < b else 0.0 for b, x in enumerate(row)] for a, row in enumerate(form)] for form in second
        ]
        pure = [[[max(_above(sign * row[a]), 0.0) for a, row in enumerate(form)] for form in second] for sign in (1, -1)]
        return [[_above(x) for x in error], [_above(-x) for x in error], slope, mixed, *pure]

    def excess(self, bounds: list[Array], reach: Array, q: Array, w: Array) -> tuple[Array, Array, Array]:
        """e(S) for half widths of cells and sections, how far joints go, and the angles that they turn by; all rounded up."""
        above, below, slope, mixed, up, down = bounds
        far = (reach @ w[:, :, None])[:, :, 0] * UP
        angle = np.cumsum(far * np.append(~self.slides, [True] * self.turning), axis=1) * UP
        c, slid = angle[:, : self.n], far[:, : self.n] * self.slides
        third = (c**3 * (self.lengths + np.maximum(abs(q), self.angle) * self.slides + slid) + 3 * c**2 * slid).sum(axis=1) / 6
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
            widths = [[_above(flint.arb(w / d)) for w, d in zip(self.width, row, strict=True)] for row in depths]
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

    @property
    def sampled(self) -> bool:
        """Whether leaves were left out."""
        return self.accepted + self.rejected < self.leaves

    @property
    def tolerant(self) -> Fraction:
        """At least this part of the targets is proved, for every locked value and, of a bundle, every lock."""
        return max(Fraction(0), 1 - volume(self.shadow))

    @property
    def sentence(self) -> str:
        """What was found, for people: never rounded up to the whole or down to nothing."""
        text = f"Proved: {per_cent(1 - self.undecided)}, undecided: {per_cent(self.undecided, up=True)}"
        text += " in the worst part" * bool(self.parts)
        if self.document.get("locked") != -1:
            text += f"; wherever the lock, at least {per_cent(self.tolerant)} of the targets"
        text += f". Leaves accepted: {self.accepted}, rejected: {self.rejected}; {self.seconds:.1f} s"
        return text + (f"; of {self.leaves}: sampled, not verified." if self.sampled else ".")


def _reach(document: dict[str, Any], sample: int | None, workers: int, tell: Callable[[int], None]) -> Verdict:
    began, leaves = time.perf_counter(), Leaves(document)
    tree, axes = unpacked(document["tree"], 2 * MOST_LEAVES - 1, "tree"), len(leaves.width)
    undecided = [cell for token, cell in cells(tree, axes) if token != PROVED]
    count, open_part = tree.count(PROVED), volume(undecided)
    packed = unpacked(document["centres"], 4 * leaves.n * count, "centres")
    need(len(packed) == 4 * leaves.n * count, "there are fewer centres than leaves")
    centres = np.frombuffer(packed, "<i4").reshape(count, leaves.n)
    need(leaves.locked < 0 or not centres[:, leaves.locked].any(), "centres of the locked joint must be 0")
    volumes = {"proved": 1 - open_part, "refuted": Fraction(0), "undecided": open_part}
    written = {key: f"{part.numerator}/2^{part.denominator.bit_length() - 1}" for key, part in volumes.items()}
    need(document["volumes"] == written, "volumes are not those of the tree")
    picked = set(range(count) if sample is None else random.SystemRandom().sample(range(count), max(0, min(sample, count))))
    proofs = zip((cell for token, cell in cells(tree, axes) if token == PROVED), centres, strict=True)
    chosen = (proof for index, proof in enumerate(proofs) if index in picked)
    checked, rejected = 0, list[Cell]()
    with ExitStack() as stack:
        spread: Callable[..., Iterable[tuple[int, list[Cell]]]] = map
        if workers > 1:
            spread = stack.enter_context(ProcessPoolExecutor(workers, get_context("spawn"))).map
        for size, bad in spread(leaves.rejected, iter(lambda: list(islice(chosen, CHUNK)), [])):
            checked, rejected = checked + size, rejected + bad
            tell(size)
    return Verdict(
        document=document, leaves=count, accepted=checked - len(rejected), rejected=len(rejected),
        seconds=time.perf_counter() - began, undecided=open_part + volume(rejected),
        shadow=frozenset(cell[: leaves.p] for cell in undecided + rejected),
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
    if document["kind"] == "reach":
        return _reach(document, sample, workers, tell)
    files, ranges = [load(path.parent / part["file"]) for part in document["parts"]], document["working_ranges"]
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
