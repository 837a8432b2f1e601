"""The same run in MuJoCo beside the kinematic one, in numbers and words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from holdfast.present.clearance.contacts import contact_entries, contact_table
from holdfast.present.printing import Rows, number, print_rows
from holdfast.present.simulation import console as simulation
from holdfast.present.simulation.errors import error_text
from holdfast.simulation.errors import error_history

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.clearance.contacts import Contact
    from holdfast.physics.run import PhysicalRun


def to_dict(run: PhysicalRun) -> dict[str, Any]:
    """The kinematic run, and under "physics" what differs."""
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
        "saturated_fraction": dict(zip(names, run.saturated.tolist(), strict=True)),
        "stiffness": dict(zip(names, run.stiffness.tolist(), strict=True)),
        "damping": dict(zip(names, run.damping.tolist(), strict=True)),
        "control_rate_hz": run.servos.rate,
    } | ({} if run.contacts is None else {"contacts": contact_entries(run.contacts)})
    return run.kinematic.to_dict() | {"physics": physics}


def _last_errors(run: PhysicalRun) -> tuple[str, str]:
    """Return the last errors, kinematic and in MuJoCo."""
    history, (position, angle) = error_history(run.kinematic), run.errors_apart
    law, end = run.law, history.end
    return error_text(law, end.position, end.angle), error_text(law, float(position[-1]), float(angle[-1]))


def key_table(run: PhysicalRun) -> Rows:
    """Both outcomes beside each other."""
    told = run.kinematic
    rows = [
        ["outcome", str(told.outcome), run.ending],
        ["error at the end", *_last_errors(run)],
        ["simulated time, s", number(float(told.time)), number(run.time[-1])],
        ["tool paths apart, at most, mm", "", number(1000 * run.path_distance, 3)],
    ]
    if run.contacts is not None:
        rows.append(["first contact", *[_first(contacts) for contacts in (told.contacts, run.contacts)]])
    return Rows(["", "kinematic", "in MuJoCo"], rows)


def _first(contacts: Sequence[Contact] | None) -> str:
    return f"{contacts[0].link} & {contacts[0].object}, {number(contacts[0].time)} s" if contacts else "none"


def next_steps(run: PhysicalRun, name: str) -> list[str]:
    """The kinematic run alone."""
    del run
    return [f"{name}.kinematic.plot()", f'{name}.report("run.html")']


def show(run: PhysicalRun, out: Console) -> None:
    """The kinematic run, and both outcomes beside each other."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    told = run.kinematic
    simulation.show(told, out)
    out.print(f"\nThe same in MuJoCo, {escape(run.servos.describe())}", soft_wrap=True)
    table = Grid("", "kinematic", "in MuJoCo", "")
    table.add_row("outcome", str(told.outcome), f"[bold]{run.ending}[/]", "")
    table.add_row("error at the end", *_last_errors(run), "")
    table.add_row("simulated time", number(float(told.time)), number(run.time[-1]), "s")
    out.print(table)
    facts = Grid()
    facts.add_row("tool paths apart, at most", f"[bold]{number(1000 * run.path_distance, 3)}[/] mm")
    if run.contacts:
        print_rows(out, contact_table(run.contacts))
    facts.add_row("tools apart at the end", f"{number(1000 * run.terminal_distance, 3)} mm")
    full = [f"{n} {s:.1%}" for n, s in zip(run.law.arm.joint_names, run.saturated, strict=True) if s > 0]
    facts.add_row("motors at their effort", f"{escape(', '.join(full))} of the time" if full else "none")
    out.print(facts)
