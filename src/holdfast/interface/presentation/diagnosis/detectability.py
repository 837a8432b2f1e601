"""Presentation of the predicted detectability of locks, and of the evaluation of a record of a probing motion."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.formatting import capitalise_first
from holdfast.interface.presentation.presentation import FigureSpec, Header, Presentation, TableSpec
from holdfast.response.diagnosis.detectability.observability import Observability
from holdfast.response.diagnosis.detectability.probe import Identification, ProbingMotion
from holdfast.response.diagnosis.detectability.separation import LOG_LIKELIHOOD_THRESHOLD

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MAX_NAME_LETTERS = 24  # letters of a name
_MIN_VISIBLE_RATE = 1e-6  # of a unit rate
_SEPARATION_CAPTION = (
    "Two explanations of the tool's pose, in nats: how much more likely the true one becomes by this motion. Below 9.2, a "
    "factor of 10,000, the two are not told apart; the colour ends at three times that. None: no joint is locked."
)


def to_dict(result: Observability | ProbingMotion | Identification) -> dict[str, Any]:
    """Return for each joint its detectability and the locks that cannot be distinguished; or the decision."""
    if isinstance(result, Identification):
        return {
            "joint": result.joint,
            "remaining": list(result.remaining),
            "cleared": list(result.cleared),
            "time_s": result.time,
            "tool_displacement_m": result.displacement,
        }
    data: dict[str, Any] = {
        **result.arm.entry(),
        "separation_nats": result.separation,
        "together": list(map(list, result.inseparable)),
    }
    if isinstance(result, Observability):
        return {
            **data,
            "duration_s": result.duration,
            "not_shown": list(result.unseen),
            "delays_s": result.delays,
            "locked_or_free_swinging": result.alike,
        }
    return {
        **data,
        "task": result.task.name,
        "duration_s": result.t[-1],
        "suspects": [result.arm.joint_names[joint] for joint in result.suspects],
        "told_apart": list(result.isolable),
        "not_testable": list(result.untestable),
        "largest_rates": result.visible,
        "tool_strays_m": result.tool,
    }


def present(result: Observability | ProbingMotion | Identification) -> Presentation:
    """Present which locks the motion shows, or the locked joint that a record of it shows."""
    if isinstance(result, Identification):
        answer, *lines = _describe_identification(result)
        rows = [[name, "possible"] for name in result.remaining] + [[name, "not locked"] for name in result.cleared]
        columns = [Header("joint", "locked joint"), Header("state", "after the record")]
        return _compose("Which joint is locked", answer, lines, TableSpec("What the tool's pose says", columns, rows))
    is_probe = isinstance(result, ProbingMotion)
    answer, *lines = _describe_probe(result) if isinstance(result, ProbingMotion) else _describe_observability(result)
    return _compose(
        "A self-motion that tells which joint is locked" if is_probe else "What a motion shows of locked joints",
        answer,
        lines,
        _tabulate_joints(result),
        about=result.arm.title,
        figures={
            "separation": FigureSpec(partial(_draw_separation, result), "Which locks can be told apart", _SEPARATION_CAPTION)
        },
        arm=result.arm,
    )


def _compose(title: str, answer: str, lines: list[str], table: TableSpec, **parts: Any) -> Presentation:
    sentences = [f"{capitalise_first(line)}." for line in lines]
    return Presentation(title, f"{capitalise_first(answer)}.", lines=sentences, tables=[table], **parts)


def _describe_observability(result: Observability) -> list[str]:
    """Describe which locks the tool's pose and the joint signals detect, and which pairs are not separable."""
    shown = f"{result.arm.n - len(result.unseen)} of {result.arm.n} joints"
    lines = [f"the tool's pose alone shows the lock of {shown} on this motion of {result.duration:.3g} s"]
    lines += [f"not shown: {', '.join(result.unseen)}"] if result.unseen else []
    lines += [f"locks of {first} and {second} cannot be told apart" for first, second in result.inseparable]
    if result.delays is not None and result.strayed is not None:
        for name, delays, errors in zip(result.arm.joint_names, result.delays.T, result.strayed.T, strict=True):
            is_detected = np.isfinite(delays)
            if not is_detected.any():
                lines.append(f"a lock of {name} would not be noticed by joint sensors or torques")
                continue
            lines.append(
                f"a lock of {name} is noticed after {1e3 * np.median(delays[is_detected]):.3g} ms, with the tool "
                f"{1e3 * np.median(errors[is_detected]):.2g} mm off (medians; {is_detected.mean():.0%} of the times at which "
                f"it may lock)"
            )
    if result.alike:
        lines.append(f"locked and free-swinging look alike, for gravity is small: {', '.join(result.alike)}")
    return lines


def _describe_probe(result: ProbingMotion) -> list[str]:
    """Describe which locks the motion can isolate, before anything moves."""
    isolable = f": {', '.join(result.isolable)}" if result.isolable else ""
    count = f"{len(result.isolable)} of {len(result.suspects)} suspects"
    lines = [f"a self-motion of {result.t[-1]:.3g} s tells {count} apart{isolable}"]
    for name in result.untestable:
        is_invisible = result.visible[result.arm.joint_names.index(name)] < _MIN_VISIBLE_RATE
        reason = ": no self-motion moves it here, and its lock is not tolerable here either" if is_invisible else ""
        lines.append(f"a lock of {name} cannot be tested{reason}")
    lines += [f"locks of {first} and {second} cannot be told apart" for first, second in result.inseparable]
    return [*lines, f"the tool stays within {1e3 * result.tool:.2g} mm of where it is while nothing is locked"]


def _describe_identification(result: Identification) -> list[str]:
    """Describe the locked joint, or the remaining hypotheses."""
    decision_point = f"{result.time:.3g} s, with the tool {1e3 * result.displacement:.2g} mm from its rest"
    if result.joint is not None:
        return [f"{result.joint} is locked: decided after {decision_point}"]
    if result.remaining == ("none",):
        return [f"none of the suspects is locked: decided after {decision_point}"]
    lines = [f"not decided after {decision_point}: what remains possible is {', '.join(result.remaining)}"]
    return lines + ([f"not locked: {', '.join(result.cleared)}"] if result.cleared else [])


def _tabulate_joints(result: Observability | ProbingMotion) -> TableSpec:
    names, unseen = result.arm.joint_names, result.untestable if isinstance(result, ProbingMotion) else result.unseen
    distinguishable = dict.fromkeys(names, "yes") | {name: "not from all" for locks in result.inseparable for name in locks}
    distinguishable |= dict.fromkeys(unseen, "no")
    nearest = [float(np.delete(row, row_index).min()) for row_index, row in enumerate(result.separation)][1:]
    columns = [Header("joint", "joint"), Header("nats", "nats to the nearest", digits=3, aligned=False)]
    columns.append(Header("apart", "told apart by the tool's pose"))
    if not isinstance(result, ProbingMotion):
        return TableSpec("Locks", columns, [[name, nearest[row], distinguishable[name]] for row, name in enumerate(names)])
    columns.insert(1, Header("rate", "largest rate", digits=2, aligned=False))
    rows = [[names[row], result.visible[row], nearest[row], distinguishable[names[row]]] for row in result.suspects]
    return TableSpec("Suspects", columns, rows)


def _draw_separation(result: Observability | ProbingMotion) -> Figure:
    """Draw a square for each pair of explanations."""
    from matplotlib.figure import Figure

    from holdfast.interface.report import figures as style

    joints = result.suspects if isinstance(result, ProbingMotion) else range(result.arm.n)
    hypotheses = [0, *(row + 1 for row in joints)]
    names = ["none", *(style.format_label(result.arm.joint_names[row], _MAX_NAME_LETTERS) for row in joints)]
    separations = result.separation[np.ix_(hypotheses, hypotheses)]
    count = len(hypotheses)
    with style.style():
        figure = Figure(figsize=(2.6 + 0.75 * count, 1.6 + 0.5 * count))
        axes = figure.subplots()
        matrix = np.ma.masked_array(np.minimum(separations, 3 * LOG_LIKELIHOOD_THRESHOLD), np.eye(count, dtype=bool))
        mesh = axes.pcolormesh(
            np.arange(count + 1), np.arange(count + 1), matrix, cmap="Blues", vmin=0, vmax=3 * LOG_LIKELIHOOD_THRESHOLD
        )
        for row, column in zip(*np.nonzero(~np.eye(count, dtype=bool)), strict=True):
            is_weak = not separations[row, column] > LOG_LIKELIHOOD_THRESHOLD
            color = (
                style.ORANGE if is_weak else "white" if separations[row, column] > 2 * LOG_LIKELIHOOD_THRESHOLD else style.INK
            )
            label = (
                "> 999"
                if separations[row, column] >= 1000
                else f"{separations[row, column]:.3g}"
                if separations[row, column] >= 0.01
                else "0"
            )
            axes.text(
                column + 0.5,
                row + 0.5,
                label,
                ha="center",
                va="center",
                color=color,
                fontsize=8,
                weight="bold" if is_weak else None,
            )
        axes.set_xticks(np.arange(count) + 0.5, names, rotation=35, ha="right")
        axes.set_yticks(np.arange(count) + 0.5, names)
        axes.invert_yaxis()
        axes.grid(visible=False)
        axes.set(title="Locked joint against locked joint", xlim=(0, count))
        figure.colorbar(mesh, ax=axes, label="nats")
        return style.settle_layout(figure)
