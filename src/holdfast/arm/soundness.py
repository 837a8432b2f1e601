"""Checks of an arm's data: findings to read, and errors where an analysis needs inertial data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from holdfast.arm.machine import FARTHEST_LIMIT_M, FARTHEST_LIMIT_RAD, Joint, Link, Machine
from holdfast.errors import ArmError

LARGEST_EFFORT = 20_000.0  # N m or N; beyond any arm's joint, so a placeholder
WIDEST_RANGE = 4 * np.pi  # rad; two turns, beyond what cables allow
_LARGEST_RADIUS_M = 3.0  # of gyration: larger ones are in other units where the arm itself is shorter
LONGEST = 100.0  # m, end to end; beyond any arm, so a file in mm
ROUNDING = 1e-9  # relative to the largest moment


@dataclass(frozen=True)
class Finding:
    """Something missing, implausible or impossible.

    Attributes:
        severity: ``error``: no analysis that uses the number can be right; ``warning``: some analyses lack it.
        subject: The joint or link, as ``joint 'elbow'``, or the arm.
        message: One sentence: what is wrong and what would be right.
    """

    severity: Literal["warning", "error"]
    subject: str
    message: str


def check(arm: Machine) -> list[Finding]:
    """All findings about an arm, from base to tip, each joint before its link; empty if there are none.

    A rod without inertia about its own axis (moments 0, I, I) is accepted. Upside-down limits cannot occur: they are
    refused when a joint is made.
    """
    findings: list[Finding] = []
    if arm.end_to_end > LONGEST:
        message = f"end to end it is {arm.end_to_end:.4g} m long; lengths are in m: is its file in mm?"
        findings.append(Finding("warning", f"arm '{arm.name}'", message))
    for joint, link in zip(arm.joints, arm.links, strict=True):
        findings += _joint(joint)
        findings += _link(link, joint)
    findings += _implausible_inertias(arm)
    if arm.payload is not None:
        findings += _body(arm.payload, "payload")
    return findings


def _implausible_inertias(arm: Machine) -> list[Finding]:
    """Return a warning for each link whose mass would lie farther from its centre than the arm is long."""
    findings = []
    for joint, link in zip(arm.joints, arm.links, strict=True):
        if link is None or not link.mass > 0:
            continue
        radius = float(np.sqrt(max(np.linalg.eigvalsh(link.inertia)[-1], 0.0) / link.mass))
        if arm.end_to_end > 0 and radius > max(arm.end_to_end, _LARGEST_RADIUS_M):
            message = (
                f"its inertia has a radius of gyration of {radius:.3g} m, and the whole arm is {arm.end_to_end:.3g} m long; "
                "moments are in kg m^2: are they in kg mm^2 or g mm^2?"
            )
            findings.append(Finding("warning", _subject(link, joint), message))
    return findings


def require_masses(arm: Machine) -> None:
    """Raise :class:`ArmError` if nothing is known of a link; massless links pass.

    Raises:
        ArmError: The first such link.
    """
    for joint, link in zip(arm.joints, arm.links, strict=True):
        if link is None:
            raise ArmError(
                f"arm '{arm.name}', link after joint '{joint.name}': it has no inertial data; give its mass, centre of mass "
                "and inertia (mass 0 if it weighs nothing)"
            )


def require_possible_inertia(arm: Machine) -> None:
    """Raise :class:`ArmError` if nothing is known of a link or its inertia is impossible; points and massless links pass.

    Raises:
        ArmError: The first such link, and why.
    """
    require_masses(arm)
    for joint, link in zip(arm.joints, arm.links, strict=True):
        for finding in [] if link is None else _moments(link, _subject(link, joint)):
            raise ArmError(f"arm '{arm.name}', {finding.subject}: {finding.message}")
    for finding in [] if arm.payload is None else _moments(arm.payload, "payload"):
        raise ArmError(f"arm '{arm.name}', {finding.subject}: {finding.message}")


def _joint(joint: Joint) -> list[Finding]:
    subject = f"joint '{joint.name}'"
    warnings = []
    width = joint.upper - joint.lower
    if not np.isfinite(width):
        kind = "is continuous" if joint.type == "continuous" else _limit_count(joint)
        warnings.append(f"it {kind}; analyses over the whole joint range need lower and upper, in {joint.unit}")
    elif width == 0:
        warnings.append(f"its lower and upper limit are both {joint.lower:g} {joint.unit}; a joint needs room to move")
    elif not joint.prismatic and width > WIDEST_RANGE * (1 + ROUNDING):
        warnings.append(
            f"its range is {width:.4g} rad; more than two turns ({WIDEST_RANGE:.4g} rad) is a placeholder on most arms"
        )
    speed, push = ("m/s", "N") if joint.prismatic else ("rad/s", "N m")
    if not np.isfinite(joint.velocity):
        warnings.append(f"it has no largest velocity; give it in {speed}")
    elif joint.velocity <= 0:
        warnings.append(f"its largest velocity is {joint.velocity:g} {speed}; it must be above 0")
    if not np.isfinite(joint.effort):
        warnings.append(f"it has no largest effort; give it in {push}")
    elif joint.effort <= 0 or joint.effort > LARGEST_EFFORT:
        warnings.append(
            f"its largest effort is {joint.effort:g} {push}; it should be above 0 and below {LARGEST_EFFORT:g} {push}"
        )
    return [Finding("warning", subject, message) for message in warnings]


def _limit_count(joint: Joint) -> str:
    """Describe the limits that a joint lacks although its type has them."""
    lacking = "has no limits" if np.isinf([joint.lower, joint.upper]).all() else "lacks a limit"
    farthest = f"{FARTHEST_LIMIT_M:g} m" if joint.prismatic else f"{FARTHEST_LIMIT_RAD / (2 * np.pi):g} turns"
    return f"{lacking} (one beyond {farthest} counts as none)"


def _link(link: Link | None, joint: Joint) -> list[Finding]:
    if link is None:
        message = "it has no inertial data; give mass, centre of mass and inertia for analyses with forces"
        return [Finding("warning", f"link after joint '{joint.name}'", message)]
    return _body(link, _subject(link, joint))


def _subject(link: Link, joint: Joint) -> str:
    return f"link '{link.name}'" if link.name else f"link after joint '{joint.name}'"


def _body(body: Link, subject: str) -> list[Finding]:
    if body.mass == 0:
        return [Finding("error", subject, "its mass is 0 kg; a moving link needs a mass above 0")]
    findings = _moments(body, subject)
    if not findings and not body.inertia.any():
        message = f"it has a mass of {body.mass:g} kg and no inertia; give its moments in kg m^2"
        return [Finding("error", subject, message)]
    return findings


def _moments(body: Link, subject: str) -> list[Finding]:
    small, middle, large = np.linalg.eigvalsh(body.inertia)
    slack = ROUNDING * max(abs(small), abs(large))
    if small < -slack:
        message = f"its inertia has the principal moment {small:.4g} kg m^2; all three must be 0 or more"
        return [Finding("error", subject, message)]
    if large > small + middle + slack:
        message = (
            f"its principal moments {small:.4g}, {middle:.4g} and {large:.4g} kg m^2 break the triangle inequality; "
            "no body has one above the sum of the other two"
        )
        return [Finding("error", subject, message)]
    return []
