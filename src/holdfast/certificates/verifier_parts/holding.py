"""Verification of the leaves of claims that an arm without motor torque holds, or stays in a box after a nudge.

Let C_k be the derivative of the first moment of all bodies by joint k, and z_k its axis, 0 for a slide. With up the reversed
gravity, the gravity torque is up . C_k, and its derivatives for joints a <= b <= c are up . (z_a x (z_b x C_c)) and so on. In a
leaf of a hold claim, friction and stops bear the gravity torques of all joints, or (refuted) not that of some joint. In a leaf
of a nudge, the potential energy above that of the start, plus the work of friction, exceeds the energy of the nudge in a part
of a face of the box. The arm therefore crosses no face, and limits stop it at the others.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from typing import Any

import numpy as np

from .balls import ROUND_UP, Array, BallArray, bound_length, concatenate, cross_matrix, einsum
from .chain import BallChain, Leaf, LeafVerifier, enclose_configuration, enclose_sine_and_cosine, read_bisection
from .forms import NUMBER_PATTERN, TEXT_PATTERN, compute_digest, format_intervals, parse_hex, require
from .taylor import DerivativeEnclosure
from .tree import REFUTED_TOKEN, Cell


class GravityEnclosure:
    """Enclosure of potential energy and its derivatives by the joints at the centers of boxes, with bounds over the boxes."""

    def __init__(self, document: dict[str, Any], arm: BallChain, joints: list[Array]) -> None:
        count, n, up = len(joints[0]), arm.n, -_read_numbers(document["gravity"])
        moment, columns = BallArray(np.zeros((count, 3))), BallArray(np.zeros((count, n, 3)))
        for index, body in enumerate(document["bodies"], 1):
            point = arm.enclose_point(joints[:index], end=_read_numbers(body["center"]))
            padded = concatenate(1, point.columns, BallArray(np.zeros((count, n - index, 3))))
            mass = np.array(parse_hex(body["mass"]))
            moment, columns = moment + einsum("ni,->ni", point.tip, mass), columns + einsum("nki,->nki", padded, mass)
        spin = cross_matrix(point.spin_axes)
        turned_up = -einsum("nkij,j->nki", spin, up)
        self.energy, self.torque = einsum("ni,i->n", moment, up), einsum("nki,i->nk", columns, up)
        self.second = einsum("nai,nci->nac", turned_up, columns).mirror_upper_triangle()
        third = einsum("nai,nbci->nabc", turned_up, einsum("nbij,ncj->nbci", spin, columns))
        self.third = third[:, *np.sort(np.indices((n, n, n)), axis=0)]
        self.half = half = np.stack([joint[:, 2] for joint in joints], axis=1)
        angles, length = half * ~arm.slides, bound_length(up, 0)
        # Bounds of |up x z_k|, which joints before k change, and of |C_k|, which joints behind k change.
        before = np.pad(np.cumsum(angles[:, :-1], axis=1), ((0, 0), (1, 0)))
        self.first = np.minimum(length, (bound_length(turned_up.magnitude, 2) + length * before) * ROUND_UP)
        self.last = bound_length(columns.magnitude, 2)
        for k in np.flatnonzero(~arm.slides)[::-1]:
            self.last[:, k] = (self.last[:, k] + (half * self.last)[:, k + 1 :].sum(axis=1)) * ROUND_UP
        a, b, c = np.indices((n, n, n))
        between = np.einsum("abc,nc->nab", 1.0 * ((a < c) & (c < b)), angles)
        pairs = 3 * angles[:, :, None] * half[:, None] * (angles[:, :, None] + angles[:, None] + 2 * between)
        # Sums of the products of three joint motions, by the first and the last of the joints.
        self.weights = (np.triu(pairs, 1) + np.eye(n) * (angles**3)[:, None]) / 6 * ROUND_UP

    def enclose_torques(self) -> tuple[Array, Array]:
        """Return lower and upper bounds (N, n) of the gravity torques."""
        order = np.arange(self.half.shape[1])
        indices = ((np.minimum(order, k), np.maximum(order, k)) for k in order)
        remainders = [np.einsum("nab,na,nb->n", self.weights, self.first[:, x], self.last[:, y]) for x, y in indices]
        return self._enclose(DerivativeEnclosure(self.torque, self.second, self.third), np.stack(remainders, axis=1))

    def bound_energies(self, start_energy: BallArray, offsets: BallArray, friction: Array) -> Array:
        """Return lower bounds (N,) of the energy above that of the start, with the work of friction over offsets (N, n).

        The work of friction is at least its product with the offset and any factor from -1 to 1.
        """
        balance = np.nan_to_num(np.clip(-self.torque.center / friction, -1, 1))
        factor = np.where(abs(offsets.center) >= self.half, np.sign(offsets.center), balance)
        forces = einsum("k,nk->nk", friction, factor)
        value = self.energy + -start_energy + einsum("nk,nk->n", forces, offsets)
        form = DerivativeEnclosure(value[:, None], (self.torque + forces)[:, None], self.second[:, None])
        return self._enclose(form, np.einsum("nab,na,nb->n", self.weights, self.first, self.last)[:, None])[0][:, 0]

    def _enclose(self, form: DerivativeEnclosure, remainder: Array) -> tuple[Array, Array]:
        decrease, increase = (change + remainder * ROUND_UP for change in form.bound_decrease_and_increase(self.half))
        upper = -(-form.value).lower
        return np.nextafter(form.value.lower - decrease * ROUND_UP, -np.inf), np.nextafter(upper + increase * ROUND_UP, np.inf)


class HoldVerifier(LeafVerifier):
    """Verifier that an arm holds, or stays in a box; then the last axis of the tree numbers lower and upper faces of joints."""

    def __init__(self, document: dict[str, Any]) -> None:
        super().__init__(document, document["joint_box"])
        self.arm, self.friction = BallChain(document["arm"]), _read_numbers(document["friction"])
        self.box = np.array([_read_numbers(pair) for pair in document["joint_box"]])
        self.is_stop = self.box == [_read_numbers(joint["limits"]) for joint in document["arm"]["joints"]]
        self.is_nudge, start = document["kind"] == "nudge", _read_numbers(document.get("start", []))
        is_inside = not self.is_nudge or ((self.box[:, 0] <= start) & (start <= self.box[:, 1])).all()
        require(is_inside and (self.friction >= 0).all(), "the start is outside of the box, or a friction below 0")

    def read_leaves(self, document: dict[str, Any]) -> tuple[int, list[Cell], Callable[[], Iterator[Leaf]]]:
        """Return the number of leaves, the undecided cells, and an iterator of leaves, not 0 if refuted."""
        return read_bisection(document, self.arm.n + self.is_nudge, (0,) if self.is_nudge else (0, REFUTED_TOKEN))

    def leaf_kind(self, leaf: Leaf) -> Any:
        """Return 0 except for a refuted leaf; for a nudge the number of the face, with the depth."""
        return leaf[0][-1] if self.is_nudge else leaf[1]

    def find_refuted_cells(self, leaves: Callable[[], Iterator[Leaf]]) -> set[Cell]:
        """Return the cells in which some joint moves."""
        return {cell for cell, number in leaves() if number}

    def verify_leaves(self, kind: Any, leaves: list[Leaf]) -> Iterable[Any]:
        """Return flags of the leaves in which all joints hold, one moves, or the energy of a nudge does not suffice."""
        joints, document = self.enclose_centers(cell[: self.arm.n] for cell, _ in leaves), self._document
        if self.is_nudge:
            joint, side = divmod(kind[0], 2)
            is_single = 1 << kind[1] >= 2 * self.arm.n
            if not is_single or joint >= self.arm.n or self.is_stop[joint, side]:
                return [is_single] * len(leaves)
            place = enclose_sine_and_cosine(Fraction(self.box[joint, side]))
            joints[joint] = np.tile(place, (len(leaves), 1))
            start = GravityEnclosure(document, self.arm, enclose_configuration(document["start"])).energy
            values, radii = (np.stack([joint[:, column] for joint in joints], axis=1) for column in (0, 1))
            offsets = BallArray(values, radii) + -_read_numbers(document["start"])
            energies = GravityEnclosure(document, self.arm, joints).bound_energies(start, offsets, self.friction)
            return np.asarray(energies > parse_hex(document["energy"]))
        lower, upper = GravityEnclosure(document, self.arm, joints).enclose_torques()
        carries_up, carries_down = (self.is_stop & (self.box[:, :1] == self.box[:, 1:])).T  # stops of joints that do not move
        most, least = np.where(carries_up, np.inf, self.friction), np.where(carries_down, -np.inf, -self.friction)
        moves = ((lower > most) | (upper < least)).any(axis=1)
        return np.asarray(moves if kind else ((lower >= least) & (upper <= most)).all(axis=1))


def hold_claim_schema(document: dict[str, Any], n: int) -> dict[str, Any]:
    """Return the form of the keys that a hold or nudge claim has in addition to the common ones."""
    vector, values = [NUMBER_PATTERN, 3], [NUMBER_PATTERN, n]
    form: dict[str, Any] = {"joint_box": [[NUMBER_PATTERN, 2], n], "friction": values, "gravity": vector, "tree": TEXT_PATTERN}
    form |= {"start": values, "energy": NUMBER_PATTERN} if document["kind"] == "nudge" else {}
    return form | {"bodies": [{"mass": NUMBER_PATTERN, "center": vector}, n]}


def describe_hold(document: dict[str, Any], names: list[str]) -> str:
    """Return the claim that an arm holds, or stays in a box, as a sentence without its end."""
    box = format_intervals(names, document["joint_box"])
    friction, start = (", ".join(repr(parse_hex(x)) for x in document.get(key, [])) for key in ("friction", "start"))
    text = f"Without motor torque, with dry friction of at least ({friction}) N m or N and with stops at the limits, the arm "
    if document["kind"] == "nudge":
        text += f"stays within {box} after a nudge at ({start}) with at most {parse_hex(document['energy'])!r} J"
    else:
        text += f"stays at rest at every configuration with {box}"
    return f"{text}; rad and m, masses {compute_digest({key: document[key] for key in ('gravity', 'bodies')})[:12]},"


def _read_numbers(texts: list[str]) -> Array:
    return np.array([parse_hex(text) for text in texts])
