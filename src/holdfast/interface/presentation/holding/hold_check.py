"""Presentation of the check whether an arm holds its configuration."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.core.formatting import format_count, format_number, format_percent
from holdfast.interface.presentation.presentation import Fact, Header, Notice, Presentation, TableSpec, make_headers
from holdfast.kinematics.holding.static_check import HoldCheck
from holdfast.model.arm.machine import Joint

STOP_PHRASES = {-1: "at its lower stop", 1: "at its upper stop", 2: "between two stops", 0: ""}


def to_dict(check: HoldCheck) -> dict[str, Any]:
    """Return the verdict, the numbers behind it, and the balance of every joint; lists for several configurations."""
    names = check.arm.joint_names
    first = [names[k] if k >= 0 else None for k in np.atleast_1d(check.joint)]
    return {
        **check.arm.entry(),
        "q": check.q,
        "free": [names[k] for k in check.free],
        "friction": dict(zip(names, check.friction.stiction, strict=True)),
        "load_friction": dict(zip(names, check.friction.load, strict=True)),
        "effort": check.effort,
        **{key: getattr(check, key) for key in ("holds", "margin", "factor", "least_effort")},
        "joint": first[0] if check.q.ndim == 1 else first,
        "largest_payload_kg": check.largest_payload,
        **{
            key: dict(zip(names, np.moveaxis(getattr(check, key), -1, 0), strict=True))
            for key in ("torque", "need", "available", "stop")
        },
    }


def present(check: HoldCheck) -> Presentation:
    """Present the verdict, its margin, and the balance of every joint or the verdict of every configuration."""
    arm, single = check.arm, check.q.ndim == 1
    free = "all joints" if len(check.free) == arm.n else ", ".join(arm.joint_names[k] for k in check.free)
    motors = f"with {format_percent(check.effort)} of the effort limits" if check.effort else "without motor torque"
    notices = (
        []
        if check.friction.stiction.any()
        else [Notice("No dry friction is given by the arm or the options, so it is 0.", "note")]
    )
    if single and check.holds and check.margin == 0:
        notices.append(Notice(f"{arm.joint_names[check.joint]} has no margin, so any disturbance moves it.", "warn"))
    return Presentation(
        f"Static check of {arm.name}",
        _compose_answer(check) if single else _count_answer(check),
        about=f"Arm {arm.title}, {free} {motors}{'' if len(check.free) == arm.n else ', all others held'}",
        notices=notices,
        facts=_list_facts(check) if single else [],
        tables=[_tabulate_joints(check) if single else _tabulate_rows(check)],
        method=[
            ("Model", "arm at rest; gravity against dry friction at rest, stops, and motors of each joint; closed form"),
            ("Dry friction", ", ".join(_format_torques(check, check.friction.stiction))),
        ],
        arm=arm,
    )


def _format_torques(check: HoldCheck, values: Any) -> list[str]:
    return [
        f"{format_number(value, 4)} {format_torque_unit(joint)}" for value, joint in zip(values, check.arm.joints, strict=True)
    ]


def format_torque_unit(joint: Joint) -> str:
    """Return the unit of the torque or force of a joint."""
    return "N" if joint.prismatic else "N m"


def _compose_answer(check: HoldCheck) -> str:
    if check.joint < 0:
        return "The configuration contains NaN, so there is no verdict."
    joint = check.arm.joints[check.joint]
    need, available = (_format_torques(check, numbers)[check.joint] for numbers in (check.need, check.available))
    if not check.holds:
        return f"The arm falls: {joint.name} needs {need} to stay, and has {available}."
    if np.isinf(check.margin):
        return "The arm holds: the stops carry every free joint."
    margin = _format_torques(check, [float(check.margin)] * check.arm.n)[check.joint]
    return f"The arm holds: {joint.name} has the smallest margin, {margin}."


def _count_answer(check: HoldCheck) -> str:
    answer = f"The arm holds {np.sum(check.holds)} of {format_count(len(check.q), 'configuration')}."
    invalid = int(np.sum(check.joint < 0))
    return (
        f"{answer} {format_count(invalid, 'row')} of NaN {'has' if invalid == 1 else 'have'} no verdict." if invalid else answer
    )


def _list_facts(check: HoldCheck) -> list[Fact]:
    unit = format_torque_unit(check.arm.joints[check.joint])
    effort = "unknown, because an effort limit is missing" if np.isnan(check.least_effort) else float(check.least_effort)
    facts = [
        Fact("margin", float(check.margin), unit, phrase="smallest margin of a free joint"),
        Fact("factor", float(check.factor), phrase="times the needed torque is available, in the worst joint"),
        Fact("least effort that holds the arm", effort, style="percent", phrase="of all effort limits holds the arm"),
        Fact(
            "largest additional payload at the tool point",
            float(check.largest_payload),
            "kg",
            phrase="more at the tool is held",
        ),
    ]
    return [fact for fact in facts if isinstance(fact.value, str) or np.isfinite(fact.value)]


def _tabulate_joints(check: HoldCheck) -> TableSpec:
    units = [format_torque_unit(joint) for joint in check.arm.joints]
    torques = make_headers("gravity torque", "needed", "available", unit=units)
    rows = []
    for k, name in enumerate(check.arm.joint_names):
        gives_way = k in check.free and check.available[k] < check.need[k]
        notes = ["" if k in check.free else "held", STOP_PHRASES[int(check.stop[k])], "gives way" if gives_way else ""]
        rows.append((name, check.torque[k], check.need[k], check.available[k], ", ".join(filter(None, notes))))
    return TableSpec("Balance of each joint", ["joint", *torques, ""], rows)


def _tabulate_rows(check: HoldCheck) -> TableSpec:
    effort = Header("least effort", style="percent")
    names = [*check.arm.joint_names, "none"]  # the index -1 is the last one
    cells = zip(check.holds, check.joint, check.margin, check.least_effort, strict=True)
    rows = [(row, bool(held), names[k], margin, effort) for row, (held, k, margin, effort) in enumerate(cells)]
    return TableSpec("Configurations", ["row", "holds", "joint with the smallest margin", "margin, N m (N)", effort], rows)
