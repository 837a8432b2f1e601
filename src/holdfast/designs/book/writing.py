"""A submission to the record book: the file of an arm, with what it keeps as the check measures it."""

from __future__ import annotations

import json
from datetime import date
from textwrap import indent

import numpy as np
from numpy.typing import ArrayLike

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arms import load, names
from holdfast.arms.dh_file import text
from holdfast.arms.dh_rows import dh_table
from holdfast.ceilings.ceiling import look_up
from holdfast.designs.book.entries import Record, digest_of, of_content
from holdfast.designs.book.measuring import jacobian_by_differences, jacobian_of, least_left, null_space_of
from holdfast.errors import InputError
from holdfast.files import yaml
from holdfast.grammar import TASKS

_EXACT, _BY_DIFFERENCES = "1.0e-9", "1.0e-7"  # tolerances of checks, relative
_SINGULAR = 1e-9
_TASKS = ("planar", "position", "pose")


@checked
def new_record(
    arm: Arm,
    task: str = "pose",
    failures: int = 1,
    *,
    q: ArrayLike | None = None,
    name: str = "",
    by: str = "anonymous",
    how: str = "",
) -> Record:
    """The record of an arm's relative manipulability at one configuration, to be checked, kept and submitted.

    Args:
        arm: Of revolute joints; of a built-in arm, whatever its joints, the record is one of that arm alone.
        task: ``planar``, ``position`` or ``pose``.
        failures: Joints that lock at once.
        q: (n,) rad. Default: zeros.
        name: Id of the record. Default: from the class.
        by: Who found it.
        how: How it was found, so that others can follow.

    Raises:
        InputError: Another task, joints that are not revolute, a singular configuration, more failures than redundancy.
    """
    if task not in _TASKS:
        raise InputError(f"records are of tasks {', '.join(_TASKS)}, not of '{task}'")
    bound = look_up(n=arm.n, m=TASKS[task], k=failures)
    at = np.zeros(arm.n) if q is None else arm.check_configurations(q)
    sold = arm.name in names() and load(arm.name).fingerprint == arm.fingerprint
    if sold:
        j = jacobian_by_differences(arm.forward_kinematics, at)
        kind, what, tolerance = f"of: {arm.name}, ", "", _BY_DIFFERENCES
    elif arm.prismatic.any():
        raise InputError(f"'{arm.name}' has prismatic joints; records of arms are of revolute joints")
    else:
        table = dh_table(arm)
        j = jacobian_of([(r.a, r.alpha, r.d, r.theta) for r in table.rows], table.tool[:3, 3], at)
        kind, what, tolerance = "", f"arm:\n{indent(text(table, name or arm.name), '  ')}", _EXACT
    if np.linalg.svd(j[: bound.m], compute_uv=False)[-1] < _SINGULAR:
        raise InputError(f"'{arm.name}' is singular for task {task} at that configuration; give another one")
    name = name or (f"{arm.name}-{task}" if sold else f"{task}-{arm.n}R") + f"-k{failures}-new"
    made = (
        f"id: {name}\n"
        f"class: {{{kind}task: {task}, rows: {bound.m}, joints: {arm.n}, failures: {failures}, "
        "quantity: relative-manipulability, "
        f"conditions: [{'within its limits' if sold else 'revolute'}, one configuration]}}\n"
        f"value: {least_left(null_space_of(j[: bound.m]), failures)!r}\n"
        f"proven_bound: {{value: {bound.bound!r}, by: {bound.bound_by}}}\n"
        f"found: {{by: {json.dumps(by)}, date: {json.dumps(date.today().isoformat())}, how: {json.dumps(how)}}}\n"
        f"{what}at: {'home' if q is None else at.tolist()}\n"
        f"check: {{command: holdfast records check {name}, tolerance: {tolerance}}}\n"
        "licence: CC0-1.0\n"
    )
    made += f"digest: {digest_of(made)}\n"
    return of_content(yaml.parse(made, ""), made, name)
