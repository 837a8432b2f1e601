"""Text, tables, and JSON of the same run in MuJoCo and in the kinematic simulation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from holdfast.control.simulation.errors import error_history
from holdfast.interface.presentation.collision.contacts import list_contacts, tabulate_contacts
from holdfast.interface.presentation.printing import TextTable, format_significant, print_table
from holdfast.interface.presentation.simulation import console as simulation
from holdfast.interface.presentation.simulation.errors import format_errors

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.control.physics.run import PhysicalRun
    from holdfast.model.collision.contacts import Contact


def to_dict(run: PhysicalRun) -> dict[str, Any]:
    """Return the kinematic run, and under "physics" the differences."""
    names = run.law.arm.joint_names
    physics = {
        "outcome": run.outcome,
        "reason": run.reason,
        "agrees": run.agrees,
        "time_s": float(run.time[-1]),
        "error": float(run.error[-1]),
        "x_final": run.x[-1].tolist(),
        "q_final": dict(zip(names, run.q[-1].tolist(), strict=True)),
        "path_distance_m": run.path_distance,
        "terminal_distance_m": run.terminal_distance,
        "terminal_turn_rad": run.terminal_turn,
        "tracking_error": dict(zip(names, run.tracking_error.tolist(), strict=True)),
        "saturated_fraction": dict(zip(names, run.saturated_fraction.tolist(), strict=True)),
        "stiffness": dict(zip(names, run.stiffness.tolist(), strict=True)),
        "damping": dict(zip(names, run.damping.tolist(), strict=True)),
        "control_rate_hz": run.servos.rate,
    } | ({} if run.contacts is None else {"contacts": list_contacts(run.contacts)})
    return run.kinematic.to_dict() | {"physics": physics}


def _final_errors(run: PhysicalRun) -> tuple[str, str]:
    """Return the last errors, kinematic and in MuJoCo."""
    history, (position, angle) = error_history(run.kinematic), run.errors_apart
    law, end = run.law, history.end
    return format_errors(law, end.position, end.angle), format_errors(law, float(position[-1]), float(angle[-1]))


def key_table(run: PhysicalRun) -> TextTable:
    """Tabulate both outcomes side by side."""
    kinematic_run = run.kinematic
    rows = [
        ["outcome", str(kinematic_run.outcome), run.ending],
        ["error at the end", *_final_errors(run)],
        ["simulated time, s", format_significant(float(kinematic_run.time)), format_significant(run.time[-1])],
        ["tool paths apart, at most, mm", "", format_significant(1000 * run.path_distance, 3)],
    ]
    if run.contacts is not None:
        rows.append(
            ["first contact", *[_format_first_contact(contacts) for contacts in (kinematic_run.contacts, run.contacts)]]
        )
    return TextTable(["", "kinematic", "in MuJoCo"], rows)


def _format_first_contact(contacts: Sequence[Contact] | None) -> str:
    return f"{contacts[0].link} & {contacts[0].object}, {format_significant(contacts[0].time)} s" if contacts else "none"


def show(run: PhysicalRun, out: Console) -> None:
    """Print the kinematic run, then both outcomes side by side."""
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    kinematic_run = run.kinematic
    simulation.show(kinematic_run, out)
    out.print(f"\nThe same in MuJoCo, {escape(run.servos.describe())}", soft_wrap=True)
    table = BandedTable("", "kinematic", "in MuJoCo", "")
    table.add_row("outcome", str(kinematic_run.outcome), f"[bold]{run.ending}[/]", "")
    table.add_row("error at the end", *_final_errors(run), "")
    table.add_row("simulated time", format_significant(float(kinematic_run.time)), format_significant(run.time[-1]), "s")
    out.print(table)
    facts = BandedTable()
    facts.add_row("tool paths apart, at most", f"[bold]{format_significant(1000 * run.path_distance, 3)}[/] mm")
    if run.contacts:
        print_table(out, tabulate_contacts(run.contacts))
    facts.add_row("tools apart at the end", f"{format_significant(1000 * run.terminal_distance, 3)} mm")
    saturated_joints = [
        f"{joint_name} {fraction:.1%}"
        for joint_name, fraction in zip(run.law.arm.joint_names, run.saturated_fraction, strict=True)
        if fraction > 0
    ]
    facts.add_row(
        "motors at their effort", f"{escape(', '.join(saturated_joints))} of the time" if saturated_joints else "none"
    )
    out.print(facts)
