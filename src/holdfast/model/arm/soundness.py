"""Check an arm's data: findings for people, and errors if an analysis needs missing inertial data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from holdfast.core.errors import ArmError
from holdfast.model.arm.machine import FARTHEST_LIMIT_M, FARTHEST_LIMIT_RAD, ArmData, Joint, Link

MAX_PLAUSIBLE_EFFORT = 20_000.0  # N m or N; larger than for any arm's joint, so a placeholder
MAX_PLAUSIBLE_RANGE_RAD = 4 * np.pi  # rad; two turns, more than cables allow
_MAX_GYRATION_RADIUS_M = 3.0  # radius of gyration; a larger one has other units if the arm itself is shorter
MAX_PLAUSIBLE_LENGTH_M = 100.0  # m, end to end; larger than any arm, so the file is in mm
RELATIVE_MOMENT_TOLERANCE = 1e-9  # relative to the largest moment


@dataclass(frozen=True)
class DataFinding:
    """Missing, implausible, or impossible value in the data of an arm.

    Attributes:
        severity: ``error`` if no analysis with this number can be right; ``warning`` if some analyses lack the number.
        subject: Joint or link, such as ``joint 'elbow'``, or the arm.
        message: One sentence with the problem and the right value.
    """

    severity: Literal["warning", "error"]
    subject: str
    message: str


def check_arm(arm: ArmData) -> list[DataFinding]:
    """Return all findings about an arm, from base to tip, each joint before its link; empty if there are none.

    A rod without inertia about its own axis (moments 0, I, I) is accepted. Reversed limits cannot occur, because joints with
    such limits are rejected.
    """
    findings: list[DataFinding] = []
    if arm.end_to_end > MAX_PLAUSIBLE_LENGTH_M:
        message = f"end to end it is {arm.end_to_end:.4g} m long; lengths are in m: is its file in mm?"
        findings.append(DataFinding("warning", f"arm '{arm.name}'", message))
    for joint, link in zip(arm.joints, arm.links, strict=True):
        findings += _check_joint(joint)
        findings += _check_link(link, joint)
    findings += _implausible_inertias(arm)
    if arm.payload is not None:
        findings += _check_body(arm.payload, "payload")
    return findings


def _implausible_inertias(arm: ArmData) -> list[DataFinding]:
    """Return a warning for each link whose radius of gyration exceeds the length of the arm."""
    findings = []
    for joint, link in zip(arm.joints, arm.links, strict=True):
        if link is None or not link.mass > 0:
            continue
        radius = float(np.sqrt(max(np.linalg.eigvalsh(link.inertia)[-1], 0.0) / link.mass))
        if arm.end_to_end > 0 and radius > max(arm.end_to_end, _MAX_GYRATION_RADIUS_M):
            message = (
                f"its inertia has a radius of gyration of {radius:.3g} m, and the whole arm is {arm.end_to_end:.3g} m long; "
                "moments are in kg m^2: are they in kg mm^2 or g mm^2?"
            )
            findings.append(DataFinding("warning", _link_label(link, joint), message))
    return findings


def require_masses(arm: ArmData) -> None:
    """Raise :class:`ArmError` if a link has no inertial data; massless links pass.

    Raises:
        ArmError: The message names the first such link.
    """
    for joint, link in zip(arm.joints, arm.links, strict=True):
        if link is None:
            raise ArmError(
                f"arm '{arm.name}', link after joint '{joint.name}': it has no inertial data; give its mass, centre of mass "
                "and inertia (mass 0 if it weighs nothing)"
            )


def require_possible_inertia(arm: ArmData) -> None:
    """Raise :class:`ArmError` if a link has no inertial data or an impossible inertia; points and massless links pass.

    Raises:
        ArmError: The message names the first such link and the problem.
    """
    require_masses(arm)
    for joint, link in zip(arm.joints, arm.links, strict=True):
        for finding in [] if link is None else _check_moments(link, _link_label(link, joint)):
            raise ArmError(f"arm '{arm.name}', {finding.subject}: {finding.message}")
    for finding in [] if arm.payload is None else _check_moments(arm.payload, "payload"):
        raise ArmError(f"arm '{arm.name}', {finding.subject}: {finding.message}")


def _check_joint(joint: Joint) -> list[DataFinding]:
    subject = f"joint '{joint.name}'"
    warnings = []
    width = joint.upper - joint.lower
    if not np.isfinite(width):
        kind = "is continuous" if joint.type == "continuous" else _describe_missing_limits(joint)
        warnings.append(f"it {kind}; analyses over the whole joint range need lower and upper, in {joint.unit}")
    elif width == 0:
        warnings.append(f"its lower and upper limit are both {joint.lower:g} {joint.unit}; a joint needs room to move")
    elif not joint.prismatic and width > MAX_PLAUSIBLE_RANGE_RAD * (1 + RELATIVE_MOMENT_TOLERANCE):
        warnings.append(
            f"its range is {width:.4g} rad; more than two turns ({MAX_PLAUSIBLE_RANGE_RAD:.4g} rad) is a placeholder "
            f"on most arms"
        )
    speed_unit, effort_unit = ("m/s", "N") if joint.prismatic else ("rad/s", "N m")
    if not np.isfinite(joint.velocity):
        warnings.append(f"it has no largest velocity; give it in {speed_unit}")
    elif joint.velocity <= 0:
        warnings.append(f"its largest velocity is {joint.velocity:g} {speed_unit}; it must be above 0")
    if not np.isfinite(joint.effort):
        warnings.append(f"it has no largest effort; give it in {effort_unit}")
    elif joint.effort <= 0 or joint.effort > MAX_PLAUSIBLE_EFFORT:
        warnings.append(
            f"its largest effort is {joint.effort:g} {effort_unit}; it should be above 0 and below "
            f"{MAX_PLAUSIBLE_EFFORT:g} {effort_unit}"
        )
    return [DataFinding("warning", subject, message) for message in warnings]


def _describe_missing_limits(joint: Joint) -> str:
    """Describe the limits that a joint lacks although its type has them."""
    lacking = "has no limits" if np.isinf([joint.lower, joint.upper]).all() else "lacks a limit"
    farthest = f"{FARTHEST_LIMIT_M:g} m" if joint.prismatic else f"{FARTHEST_LIMIT_RAD / (2 * np.pi):g} turns"
    return f"{lacking} (one beyond {farthest} counts as none)"


def _check_link(link: Link | None, joint: Joint) -> list[DataFinding]:
    if link is None:
        message = "it has no inertial data; give mass, centre of mass and inertia for analyses with forces"
        return [DataFinding("warning", f"link after joint '{joint.name}'", message)]
    return _check_body(link, _link_label(link, joint))


def _link_label(link: Link, joint: Joint) -> str:
    return f"link '{link.name}'" if link.name else f"link after joint '{joint.name}'"


def _check_body(body: Link, subject: str) -> list[DataFinding]:
    if body.mass == 0:
        return [DataFinding("error", subject, "its mass is 0 kg; a moving link needs a mass above 0")]
    findings = _check_moments(body, subject)
    if not findings and not body.inertia.any():
        message = f"it has a mass of {body.mass:g} kg and no inertia; give its moments in kg m^2"
        return [DataFinding("error", subject, message)]
    return findings


def _check_moments(body: Link, subject: str) -> list[DataFinding]:
    smallest, middle, largest = np.linalg.eigvalsh(body.inertia)
    slack = RELATIVE_MOMENT_TOLERANCE * max(abs(smallest), abs(largest))
    if smallest < -slack:
        message = f"its inertia has the principal moment {smallest:.4g} kg m^2; all three must be 0 or more"
        return [DataFinding("error", subject, message)]
    if largest > smallest + middle + slack:
        message = (
            f"its principal moments {smallest:.4g}, {middle:.4g} and {largest:.4g} kg m^2 break the triangle inequality; "
            "no body has one above the sum of the other two"
        )
        return [DataFinding("error", subject, message)]
    return []
