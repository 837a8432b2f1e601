"""A motion carried out with masses and servos: its numbers, its words and its figure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.physics.execution import hardly
from holdfast.present.clearance.contacts import contact_entries, contact_table
from holdfast.present.printing import Rows, number
from holdfast.present.story import Story
from holdfast.words import capitalised

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.physics.execution import Execution

Array = NDArray[np.float64]

_FRAMES = 201


def to_dict(run: Execution) -> dict[str, Any]:
    """How it ended, what was missed and what was kept."""
    names = run.arm.joint_names
    return {
        **run.arm.entry(),
        "outcome": run.outcome,
        "ok": run.ok,
        "time_s": run.time[-1],
        "q_final": dict(zip(names, run.at, strict=True)),
        "locked": {} if run.degraded is None else dict(run.degraded.locked),
        "lock_time_s": {name: t for name, t in zip(names, run.lock_time, strict=True) if np.isfinite(t)},
        "noticed_s": run.noticed,
        "goal_distance_m": run.goal_distance,
        "goal_turn_rad": run.goal_turn,
        "keep": [one.to_dict() for one in run.keep],
        "kept": [{"off": off, "turned": turned} for off, turned in run.kept],
        "beyond_limits": run.beyond_limits,
        "too_fast": run.too_fast,
        "error_limit": run.error_limit,
        "exceeded": None if run.exceeded is None else {"joint": run.exceeded[0], "time_s": run.exceeded[1]},
        "following_error": dict(zip(names, run.following_error.max(axis=0), strict=True)),
        "tool_error_m": {"most": run.tool_error[0].max(), "end": run.tool_error[0][-1]},
        "tool_error_rad": {"most": run.tool_error[1].max(), "end": run.tool_error[1][-1]},
        "tracking_error": dict(zip(names, run.tracking_error, strict=True)),
        "saturated_fraction": dict(zip(names, run.saturated, strict=True)),
        "stiffness": dict(zip(names, run.stiffness, strict=True)),
        "damping": dict(zip(names, run.damping, strict=True)),
        "control_rate_hz": run.servos.rate,
    } | ({} if run.contacts is None else {"contacts": contact_entries(run.contacts)})


def tables(run: Execution) -> list[Rows]:
    """What was asked for beside what was measured, and what was touched."""
    rows = [["simulated time, s", number(run.time[-1])]]
    if run.goal_distance is not None:
        rows.append(["tool off the goal, mm", hardly(1000 * run.goal_distance)])
    if run.goal_turn is not None:
        rows.append(["turned away from it, deg", hardly(np.rad2deg(run.goal_turn))])
    for one, (off, turned) in zip(run.keep, run.kept, strict=True):
        rows += [[f"{one.name}: off at most, mm", number(1000 * off, 3)]] * bool(len(one.normals))
        if np.isfinite(one.widest):
            most = number(np.rad2deg(one.widest), 3)
            rows.append([f"{one.name}: turned away at most, deg", f"{number(np.rad2deg(turned), 3)} of {most}"])
    rows.append(["joint behind its reference at most", _lag(run)])
    found = [Rows(["", ""], rows)]
    return [*found, contact_table(run.contacts)] if run.contacts else found


def _lag(run: Execution) -> str:
    k = int(run.tracking_error.argmax())
    joint = run.arm.joints[k]
    factor, unit = joint.shown
    return f"{number(factor * run.tracking_error[k], 3)} {unit} ({joint.name})"


def next_steps(run: Execution, name: str) -> list[str]:
    """How an arm that stopped recovers; else the motion as it was measured."""
    if run.outcome == "stopped":
        return [f"hf.recover({name}.arm, {name}.degraded, {name}.at, samples=0)  # what it can still do"]
    return [f'{name}.to_csv("motion.csv")', f'{name}.report("execution.html")']


def story(run: Execution) -> Story:
    """Whether all that was asked for was done; the numbers; the arm moving."""
    first, *others = run.describe()
    done = {"finished": "finished its motion", "stopped": "stopped on the way", "moving": "was still moving at the end"}
    answer = f"{run.arm.name} {done.get(run.outcome, 'became unstable')}"
    faults = run.faults()[run.outcome != "finished" :]
    if faults:
        answer += f", and {'; '.join(faults)}"
    elif run.outcome == "finished":
        asked = [*["the tool is at its goal"] * (run.goal is not None), *["what was to be kept was kept"] * bool(run.keep)]
        answer += f": {' and '.join([*asked, 'the joints kept their limits'])}"
    facts = []
    if run.goal_distance is not None:
        facts.append((f"{hardly(1000 * run.goal_distance)} mm", "from the tool to its goal"))
    facts += [
        (
            f"{number(np.rad2deg(turned), 3)} deg",
            f"is the most that the tool was turned away; {np.rad2deg(one.widest):.3g} allowed",
        )
        for one, (_, turned) in zip(run.keep, run.kept, strict=True)
        if np.isfinite(one.widest)
    ]
    return Story(
        f"{run.arm.name} with masses and servos",
        f"{answer}.",
        about=first,
        facts=[x for x in facts if x[0][:2] != "0 "],
        lines=[f"{line if line.split()[0] in run.arm.joint_names else capitalised(line)}." for line in others],
        views=_moving(run),
        figures={"execution": ("Over time", "What was asked of the tool, and how far the joints lag behind their references.")},
        method=[("Simulated", f"{number(run.time[-1])} s, MuJoCo, {run.servos.describe()}")],
        arm=run.arm,
    )


def _moving(run: Execution) -> list[tuple[str, list[Any]]]:
    from holdfast.present.arm.view import scene
    from holdfast.report.page import Picture

    rows = np.linspace(0, len(run.time) - 1, min(_FRAMES, len(run.time))).astype(int)
    locks = {name: float(t) for name, t in zip(run.arm.joint_names, run.lock_time, strict=True) if np.isfinite(t)}
    words = "The arm as it was measured."
    goals = [] if run.goal is None else [run.goal]
    shown = scene(
        run.arm,
        run.q[rows],
        time=np.linspace(0, run.time[-1], len(rows)),
        readings=[f"{t:.2f} s" for t in run.time[rows]],
        locked=locks,
        targets=goals,
        cell=run.cell,
    )
    return [("The motion", [Picture(shown.html("motion", words), words)])]


def figures(run: Execution) -> dict[str, Figure]:
    """The tool's distance from its goal, how far it is off what is kept, and how far the joints lag, over time."""
    from holdfast.report.motions import Panel, motion_figure

    locks = run.lock_time[np.isfinite(run.lock_time) & (run.lock_time > 0)]

    def panel(values: Array, what: str, title: str, level: tuple[float, str] | None = None) -> Panel:
        moments = tuple((float(t), float(np.interp(t, run.time, values)), "a joint locks") for t in locks[:1])
        return Panel(run.time, values, what, title, level, moments)

    panels = []
    if run.goal is not None:
        wanted = run.goal[:3, 3] if run.goal.ndim == 2 else run.goal
        away = np.linalg.norm(run.poses[:, :3, 3] - wanted, axis=1)
        panels.append(panel(away, "tool off its goal, m", "Goal"))
    for one in run.keep:
        off, turned = one.off(run.poses)
        if np.isfinite(one.widest):
            most = float(np.rad2deg(one.widest))
            panels.append(panel(np.rad2deg(turned), "turned away, deg", one.name.capitalize(), (most, "allowed")))
        else:
            panels.append(panel(1000 * off, "tool off, mm", one.name.capitalize(), (1000 * one.within[0], "allowed")))
    behind = np.where(run.locked, 0.0, np.abs(run.q - run.reference)).max(axis=1)
    unit = "m or rad" if run.arm.prismatic.any() else "rad"
    panels.append(panel(behind, f"largest servo error, {unit}", "Servos"))
    caption = f"{run.arm.name}: {run.outcome}; {run.servos.describe()}, MuJoCo"
    return {"execution": motion_figure(panels, caption)}
