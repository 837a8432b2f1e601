"""``holdfast arms`` and ``holdfast describe``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from holdfast.cli.options import ArmArgument, BaseOption, HoldOption, JsonOption, TipOption, read_arm
from holdfast.present.printing import console, number, print_json

if TYPE_CHECKING:
    from holdfast.arm.machine import Joint
    from holdfast.arm.model import Arm


def command(json_: JsonOption = False) -> None:
    """List the built-in arms.

    Example: holdfast arms
    """
    from holdfast import arms as library

    entries = [library.about(name) for name in library.names()]
    if json_:
        print_json(
            [{"name": e.name, "joints": e.n, "summary": e.summary, "source": e.source, "licence": e.licence} for e in entries]
        )
        return
    from rich.table import Table

    table = Table("name", "joints", "what it is", "licence", box=None, pad_edge=False)
    for e in entries:
        table.add_row(e.name, str(e.n), e.summary, e.licence)
    console().print(table)


def describe(
    arm: ArmArgument,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    json_: JsonOption = False,
) -> None:
    """Show an arm, what is wrong with its data, and which joint is a single point of failure by structure.

    Example: holdfast describe pa10-7dof
    """
    from holdfast.arm.soundness import check
    from holdfast.assessment.single_points import explain, structures

    model = read_arm(arm, base, tip, hold)
    findings = check(model)
    found = structures(model)
    if json_:
        print_json(
            {
                "name": model.name,
                **{key: value for key, value in model.entry().items() if key != "arm"},
                "source": model.source,
                "fingerprint": model.fingerprint,
                "gravity_m_s2": model.gravity,
                "joints": [_joint(model, k) for k in range(model.n)],
                "structure": [
                    {
                        "task": s.task,
                        "redundancy": s.redundancy,
                        "single_points_of_failure": [model.joint_names[k] for k in s.fatal],
                        "always_singular": s.never,
                    }
                    for s in found
                ],
                "findings": [{"severity": f.severity, "subject": f.subject, "message": f.message} for f in findings],
            }
        )
        return
    from rich.markup import escape
    from rich.table import Table

    out = console()
    out.print(
        f"[bold]{escape(model.title)}[/]: {model.n} joints" + (f". Source: {escape(model.source)}" if model.source else "")
    )
    table = Table("", "joint", "type", "lower", "upper", "speed", "effort", "link mass", box=None, pad_edge=False)
    for k, joint in enumerate(model.joints):
        link = model.links[k]
        table.add_row(
            str(k + 1),
            escape(joint.name),
            joint.type,
            _position(joint, joint.lower),
            _position(joint, joint.upper),
            f"{number(joint.velocity)} {joint.unit}/s" if joint.velocity < float("inf") else "not given",
            f"{number(joint.effort)} {'N' if joint.prismatic else 'N m'}" if joint.effort < float("inf") else "not given",
            f"{number(link.mass)} kg" if link is not None else "not given",
        )
    out.print(table)
    out.print()
    for s in found:
        style = "green" if s.survives else "yellow"
        label = f"{s.task}: " + (f"{s.redundancy} joint(s) more than needed. " if s.redundancy > 0 else "")
        out.print(f"[{style}]{label}[/]{escape(explain(model, s, found))}", soft_wrap=True)
    if findings:
        out.print()
    # The same remark about every joint is one line.
    subjects: dict[tuple[str, str], list[str]] = {}
    for f in findings:
        subjects.setdefault((f.severity, f.message), []).append(f.subject)
    for (severity, message), names in subjects.items():
        who = names[0] if len(names) == 1 else f"{names[0]} and {len(names) - 1} more like it"
        colour = "red" if severity == "error" else "yellow"
        out.print(f"[{colour}]{severity}[/] {escape(who)}: {escape(message)}", soft_wrap=True)


def _joint(arm: Arm, k: int) -> dict[str, Any]:
    joint, link = arm.joints[k], arm.links[k]
    return {
        "name": joint.name,
        "type": joint.type,
        "unit": joint.unit,
        "lower": joint.lower,
        "upper": joint.upper,
        "velocity": joint.velocity,
        "effort": joint.effort,
        "friction": joint.friction,
        "mass_kg": None if link is None else link.mass,
    }


def _position(joint: Joint, value: float) -> str:
    if abs(value) == float("inf"):
        return "none"
    return f"{value:.4g} m" if joint.prismatic else f"{value * 57.29577951308232:.4g} deg"
