"""Writing of the file of a record for submission, with its value as measured by the check."""

from __future__ import annotations

import json
from datetime import date
from textwrap import indent

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.files import yaml
from holdfast.core.labels import TASK_SIZES
from holdfast.core.validation import check_arguments
from holdfast.kinematics.index_bounds.manipulability_bounds import upper_bound
from holdfast.model.arm.model import Arm
from holdfast.model.arms import load, names
from holdfast.model.arms.dh_file import format_dh_file
from holdfast.model.arms.dh_rows import dh_table
from holdfast.studies.designs.record_book.entries import DesignRecord, digest_record_text, parse_record
from holdfast.studies.designs.record_book.measuring import (
    approximate_jacobian,
    compute_jacobian,
    compute_null_space,
    compute_worst_manipulability,
)

# Relative tolerances of the check.
_EXACT_TOLERANCE = "1.0e-9"
_DIFFERENCE_TOLERANCE = "1.0e-7"
_SINGULAR_VALUE_TOLERANCE = 1e-9
_RECORD_TASKS = ("planar", "position", "pose")


@check_arguments
def new_record(
    arm: Arm,
    task: str = "pose",
    failures: int = 1,
    *,
    q: ArrayLike | None = None,
    name: str = "",
    by: str = "anonymous",
    how: str = "",
) -> DesignRecord:
    """Create the record of an arm's relative manipulability at one configuration, ready for the check and for submission.

    Args:
        arm: The arm, with revolute joints only. A built-in arm may have any joints; its record is for that arm alone.
        task: ``planar``, ``position`` or ``pose``.
        failures: Number of joints that lock simultaneously.
        q: (n,) configuration, rad. Default: zeros.
        name: Id of the record. Default: made from the class.
        by: Name of the person or program that found the record.
        how: Description of the method, so that others can repeat it.

    Raises:
        InputError: The task is another one, a joint is not revolute, the configuration is singular, or there are more failures
            than degrees of redundancy.
    """
    if task not in _RECORD_TASKS:
        raise InputError(f"task is '{task}'; for a record it must be {', '.join(_RECORD_TASKS)}")
    bound = upper_bound(n=arm.n, m=TASK_SIZES[task], k=failures)
    configuration = np.zeros(arm.n) if q is None else arm.check_configurations(q)
    is_built_in = arm.name in names() and load(arm.name).fingerprint == arm.fingerprint
    if is_built_in:
        jacobian = approximate_jacobian(arm.forward_kinematics, configuration)
        class_prefix, arm_text, tolerance = f"of: {arm.name}, ", "", _DIFFERENCE_TOLERANCE
    elif arm.prismatic.any():
        raise InputError(f"'{arm.name}' has prismatic joints; records are for arms with revolute joints")
    else:
        parameters = dh_table(arm)
        jacobian = compute_jacobian(
            [(row.a, row.alpha, row.d, row.theta) for row in parameters.rows], parameters.tool[:3, 3], configuration
        )
        class_prefix = ""
        arm_text = f"arm:\n{indent(format_dh_file(parameters, name or arm.name), '  ')}"
        tolerance = _EXACT_TOLERANCE
    if np.linalg.svd(jacobian[: bound.m], compute_uv=False)[-1] < _SINGULAR_VALUE_TOLERANCE:
        raise InputError(f"'{arm.name}' is singular for task {task} at that configuration; give another one")
    name = name or (f"{arm.name}-{task}" if is_built_in else f"{task}-{arm.n}R") + f"-k{failures}-new"
    record_text = (
        f"id: {name}\nclass: {{{class_prefix}task: {task}, rows: {bound.m}, joints: {arm.n}, failures: {failures}, quantity: "
        f"relative-manipulability, conditions: [{'within its limits' if is_built_in else 'revolute'}, one "
        "configuration]}\nvalue: "
        f"{compute_worst_manipulability(compute_null_space(jacobian[: bound.m]), failures)!r}\nproven_bound: {{value: "
        f"{bound.bound!r}, by: {bound.bound_by}}}\nfound: {{by: {json.dumps(by)}, date: "
        f"{json.dumps(date.today().isoformat())}, how: {json.dumps(how)}}}\n{arm_text}at: "
        f"{'home' if q is None else configuration.tolist()}\ncheck: {{command: holdfast record-designs check {name}, "
        f"tolerance: {tolerance}}}\nlicence: CC0-1.0\n"
    )
    record_text += f"digest: {digest_record_text(record_text)}\n"
    return parse_record(yaml.parse_yaml(record_text, ""), record_text, name)
