"""Verification of the leaves of a reach: near each center, some configuration reaches every target at every locked value.

In a leaf, joints follow the target and the locked value along any matrix, here one that is correct to first order.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import numpy as np

from .balls import Array, BallArray, Flags
from .chain import BallChain, Leaf, LeafVerifier, build_target_chain, enclose_sine_and_cosine, enclose_sines_and_cosines
from .forms import (
    HASH_PATTERN,
    LIMITS_FORM,
    NUMBER_PATTERN,
    TASK_FORMS,
    TEXT_PATTERN,
    decompress_payload,
    format_intervals,
    parse_hex,
    require,
    require_task,
)
from .taylor import InvariantSectionBoxes, TaskErrorEnclosure
from .tree import MAX_LEAVES, PROVED_TOKEN, Cell, iterate_cells

CENTER_UNIT = 2.0**-24  # rad or m: unit of stored centres


class TargetLeafVerifier(LeafVerifier):
    """Verifier of boxes whose last axes belong to a target that the arm must reach."""

    def __init__(self, document: dict[str, Any], leading_axes: list[Any], trailing_axes: list[Any], planar: bool) -> None:
        super().__init__(document, [*leading_axes, *document["target"]["box"], *trailing_axes])
        self.task, self.locked, self.arm = document["task"], document["locked"], BallChain(document["arm"], planar)
        self.goal = BallChain(build_target_chain(document["target"]))
        self.n = self.arm.n
        self.target_size = len(document["target"]["axes"])
        self.limits = np.array([[parse_hex(number) for number in pair] for pair in document["limits"]])
        linear = TASK_FORMS[self.task][0]
        self.targets, self.turning = slice(len(leading_axes), len(leading_axes) + self.target_size), self.target_size - linear
        # The axes of a target in the order of its chain, and in the order of an error, in which they follow the arm's joints.
        self.chain_axes = [*range(linear)][::-1] + [*range(linear, self.target_size)][::-1]
        self.error_axes = [*range(linear, self.target_size), *range(linear)]

    def enclose_error(self, joints: list[Array], target: list[Array]) -> TaskErrorEnclosure:
        """Return the enclosure of the task rows of the error."""
        return TaskErrorEnclosure(self.task, self.arm, joints, self.goal, [target[axis] for axis in self.chain_axes])


class ReachVerifier(TargetLeafVerifier):
    """Verifier of one reach claim; its proofs are joint values at the centers of leaves, in units."""

    def __init__(self, document: dict[str, Any]) -> None:
        locked = document["locked"]
        super().__init__(document, [], [document["angle"]] if locked >= 0 else [], document["task"] == "planar-pose")
        self.fixed = [joint for joint, (low, high) in enumerate(self.limits) if low == high and joint != locked]
        self.free = [joint for joint in range(self.n) if joint != locked and joint not in self.fixed]

    def read_leaves(self, document: dict[str, Any]) -> tuple[int, list[Cell], Callable[[], Iterator[Leaf]]]:
        """Return the number of leaves, the undecided cells, and an iterator of the leaves."""
        tree, axis_count = decompress_payload(document["tree"], 2 * MAX_LEAVES - 1, "tree"), len(self.width)
        undecided = [cell for token, cell in iterate_cells(tree, axis_count) if token != PROVED_TOKEN]
        count, row_bytes = tree.count(PROVED_TOKEN), 4 * self.n
        packed = decompress_payload(document["centres"], row_bytes * count, "centres")
        require(len(packed) == row_bytes * count, "there are fewer centres than leaves")
        centers = np.frombuffer(packed, "<i4").reshape(count, self.n)
        require(not np.delete(centers, self.free, axis=1).any(), "centres of joints that do not move must be 0")

        def iterate_leaves() -> Iterator[Leaf]:
            cells = (cell for token, cell in iterate_cells(tree, axis_count) if token == PROVED_TOKEN)
            return zip(cells, centers, strict=True)

        return count, undecided, iterate_leaves

    def enclose_leaf_centers(self, leaves: list[Leaf]) -> tuple[list[Array], list[Array]]:
        """Return the joints at the centers, and the axes of the cells, as rows of :func:`enclose_sine_and_cosine`."""
        axes = self.enclose_centers(cell for cell, _ in leaves)
        joints = [enclose_sines_and_cosines(values) for values in (np.array([counts for _, counts in leaves]) * CENTER_UNIT).T]
        for joint in self.fixed:
            joints[joint] = np.array([enclose_sine_and_cosine(Fraction(self.limits[joint, 0]))] * len(leaves))
        if self.locked >= 0:
            joints[self.locked] = axes[-1]
        return joints, axes

    def choose_joint_response(self, error: TaskErrorEnclosure) -> Array:
        """Choose matrices D (N, V, axes of cell and section) by which joints follow the solution; any choice is valid."""
        gradients, axis_count = error.slopes.center[:, : error.m], len(self.width)
        inverse = np.linalg.pinv(np.nan_to_num(gradients[:, :, self.free]))
        directions = np.zeros((len(gradients), gradients.shape[2], axis_count + error.m))
        directions[:, self.free, axis_count:] = inverse
        for axis, variable in enumerate(
            [*np.argsort(self.error_axes) + self.n, *[self.locked] * (axis_count - self.target_size)]
        ):
            directions[:, variable, axis] = 1
            directions[:, self.free, axis] = -np.einsum("nfm,nm->nf", inverse, gradients[:, :, variable])
        return np.nan_to_num(directions)

    def enclose_leaves(self, leaves: list[Leaf]) -> tuple[InvariantSectionBoxes, BallArray]:
        """Return the leaves with their sections, and the middles (N, n)."""
        joints, axes = self.enclose_leaf_centers(leaves)
        error, q = self.enclose_error(joints, axes), np.stack([joint[:, :2] for joint in joints], 2)
        half = np.stack([*(axis[:, 2] for axis in axes), *[np.zeros(len(leaves))] * error.m], 1)
        return InvariantSectionBoxes(
            error, BallArray(self.choose_joint_response(error)), np.zeros((error.m, half.shape[1])), half
        ), BallArray(q[:, 0], q[:, 1])

    def leaf_kind(self, leaf: Leaf) -> int:
        """Return 0, because all leaves are of one kind."""
        return 0

    def verify_leaves(self, kind: int, leaves: list[Leaf]) -> Flags:
        """Return a mask of the leaves in which a configuration exists for every target and locked value."""
        inclusion, q = self.enclose_leaves(leaves)
        return inclusion.is_proved & inclusion.is_within_limits(q, self.limits, self.free)


def target_schema(document: dict[str, Any], n: int) -> dict[str, Any]:
    """Return the form of the keys about targets and limits."""
    task, target = require_task(document), document.get("target")
    axes = str(target.get("axes")) if isinstance(target, dict) else ""
    orientation: Any = [NUMBER_PATTERN, 9] if axes == "xyz" and task in ("pose", "pointing") else None
    box = {"axes": TASK_FORMS[task][2], "box": [[NUMBER_PATTERN, 2], len(axes)], "orientation": orientation}
    return {"target": box, "limits": [LIMITS_FORM, n]}


def bundle_claim_schema(document: dict[str, Any], n: int) -> dict[str, Any]:
    """Return the form of the keys that a bundle has in addition to the common ones."""
    form, locks = target_schema(document, n), document.get("locks")
    part = {"file": r"\w[\w.-]*", "digest": HASH_PATTERN, "locked": range(-1, n)}
    parts = [part, len(locks) + 1 if isinstance(locks, list) else 0]
    return form | {"working_ranges": [LIMITS_FORM, n], "locks": [range(n), ...], "parts": parts}


def locked_target_schema(document: dict[str, Any], n: int) -> dict[str, Any]:
    """Return the form of the keys about targets, limits, and a locked joint, with the tree."""
    angle = None if document.get("locked") == -1 else [NUMBER_PATTERN, 2]
    form = target_schema(document, n)
    return form | {"locked": range(-1, n), "angle": angle, "tree": TEXT_PATTERN}


def reach_claim_schema(document: dict[str, Any], n: int) -> dict[str, Any]:
    """Return the form of the keys that a reach has in addition to the common ones."""
    form = locked_target_schema(document, n)
    return form | {"centres": TEXT_PATTERN, "unit": re.escape(CENTER_UNIT.hex()), "refutations": [..., 0]}


def describe_targets(document: dict[str, Any], names: list[str]) -> str:
    """Return a claim about targets as a sentence without its end."""
    target, kind, orientation_note = document["target"], document["kind"], ""
    axes = [{"R": "roll", "P": "pitch", "Y": "yaw", "a": "yaw"}.get(axis, axis) for axis in target["axes"]]
    orientation = [parse_hex(number) for number in target["orientation"] or ()]
    if orientation:
        is_pointing = document["task"] == "pointing"
        orientation_note = f" and the tool's z axis along {orientation[2::3]}"
        orientation_note = orientation_note if is_pointing else f" and the rotation {orientation}"
    orientation_note += " and the rotation Rz(yaw) Ry(pitch) Rx(roll)" * ("R" in target["axes"])
    text = f"For every {document['task']} target with {format_intervals(axes, target['box'])}{orientation_note}"
    configuration = f"configuration within the limits ({format_intervals(names, document['limits'])})"
    if kind == "bundle":
        ranges, locked = format_intervals(names, document["working_ranges"]), [names[lock] for lock in document["locks"]]
        text += f", a configuration within the working ranges ({ranges}) reaches it, and after a lock of any one of "
        text += f"{', '.join(locked)} at any value of its range"
    elif document["locked"] >= 0:
        text += f", and every value {format_intervals(['from'], [document['angle']])} at which "
        text += f"{names[document['locked']]} may be locked"
    configuration += " with that value" * (kind == "bundle" or document["locked"] >= 0)
    text += f" and every {configuration}: the tool is elsewhere" if kind == "refutation" else f", a {configuration} reaches it"
    return f"{text}; lengths in m, angles in rad, base frame,"
