"""Presentation of the predicted detectability of locks, and of the evaluation of the log of a probing motion."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from holdfast.core.formatting import capitalise_first
from holdfast.interface import report
from holdfast.interface.presentation.presentation import FigureSpec, Header, Presentation, TableSpec
from holdfast.response.diagnosis.detectability.observability import Observability
from holdfast.response.diagnosis.detectability.probe import Identification, ProbingMotion
from holdfast.response.diagnosis.detectability.separation import LOG_LIKELIHOOD_THRESHOLD

_MAX_NAME_LETTERS = 24  # characters of a name
_MIN_VISIBLE_RATE = 1e-6  # fraction of a unit rate
_SEPARATION_CAPTION = (
    "Log-likelihood ratio: natural logarithm of how much more likely the true hypothesis makes the measured tool poses than "
    "the other one. Below 9.2, a factor of 10,000, the motion does not distinguish the two. The colour scale ends at three "
    "times that value. None: no joint is locked."
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
    """Present which locks the motion reveals, or the locked joint that a log of it reveals."""
    if isinstance(result, Identification):
        answer, *lines = _describe_identification(result)
        rows = [[name, "possible"] for name in result.remaining] + [[name, "not locked"] for name in result.cleared]
        columns = ["locked joint", "after the log"]
        return _compose("Identification of a locked joint", answer, lines, TableSpec("Hypotheses", columns, rows))
    is_probe = isinstance(result, ProbingMotion)
    answer, *lines = _describe_probe(result) if isinstance(result, ProbingMotion) else _describe_observability(result)
    return _compose(
        "Self-motion that identifies a locked joint" if is_probe else "Locked joints that a motion reveals",
        answer,
        lines,
        _tabulate_joints(result),
        about=result.arm.title,
        figures={
            "separation": FigureSpec(partial(_draw_separation, result), "Separation of the hypotheses", _SEPARATION_CAPTION)
        },
        arm=result.arm,
    )


def _compose(title: str, answer: str, lines: list[str], table: TableSpec, **parts: Any) -> Presentation:
    sentences = [f"{capitalise_first(line)}." for line in lines]
    return Presentation(title, f"{capitalise_first(answer)}.", lines=sentences, tables=[table], **parts)


def _describe_observability(result: Observability) -> list[str]:
    """Describe which locks the tool's pose and the joint signals detect, and which pairs are not separable."""
    shown = f"{result.arm.n - len(result.unseen)} of {result.arm.n} joints"
    lines = [f"on this motion of {result.duration:.3g} s, the tool pose alone reveals a lock of {shown}"]
    lines += [f"not revealed: {', '.join(result.unseen)}"] if result.unseen else []
    lines += [f"locks of {first} and {second} cannot be distinguished" for first, second in result.inseparable]
    if result.delays is not None and result.strayed is not None:
        for name, delays, errors in zip(result.arm.joint_names, result.delays.T, result.strayed.T, strict=True):
            is_detected = np.isfinite(delays)
            if not is_detected.any():
                lines.append(f"joint sensors and torques do not detect a lock of {name}")
                continue
            lines.append(
                f"a lock of {name} is detected after {1e3 * np.median(delays[is_detected]):.3g} ms, with a tool error of "
                f"{1e3 * np.median(errors[is_detected]):.2g} mm (medians over the {is_detected.mean():.0%} of the lock times "
                "at which it is detected)"
            )
    if result.alike:
        lines.append(
            "a lock cannot be distinguished from a free-swinging joint, because the gravity torque is small: "
            f"{', '.join(result.alike)}"
        )
    return lines


def _describe_probe(result: ProbingMotion) -> list[str]:
    """Describe which locks the motion can identify, before the arm moves."""
    isolable = f": {', '.join(result.isolable)}" if result.isolable else ""
    count = f"{len(result.isolable)} of {len(result.suspects)} candidate joints"
    lines = [f"a self-motion of {result.t[-1]:.3g} s can identify a lock of {count}{isolable}"]
    for name in result.untestable:
        is_invisible = result.visible[result.arm.joint_names.index(name)] < _MIN_VISIBLE_RATE
        reason = ", because no self-motion moves it here; its lock is not tolerable here either" if is_invisible else ""
        lines.append(f"a lock of {name} cannot be tested{reason}")
    lines += [f"locks of {first} and {second} cannot be distinguished" for first, second in result.inseparable]
    return [*lines, f"if no joint is locked, the tool stays within {1e3 * result.tool:.2g} mm of its position"]


def _describe_identification(result: Identification) -> list[str]:
    """Describe the locked joint, or the remaining hypotheses."""
    decision_point = f"{result.time:.3g} s, with the tool {1e3 * result.displacement:.2g} mm from its initial position"
    if result.joint is not None:
        return [f"{result.joint} is locked; decided after {decision_point}"]
    if result.remaining == ("none",):
        return [f"none of the candidate joints is locked; decided after {decision_point}"]
    lines = [f"not decided after {decision_point}; the remaining hypotheses are {', '.join(result.remaining)}"]
    return lines + ([f"not locked: {', '.join(result.cleared)}"] if result.cleared else [])


def _tabulate_joints(result: Observability | ProbingMotion) -> TableSpec:
    names, unseen = result.arm.joint_names, result.untestable if isinstance(result, ProbingMotion) else result.unseen
    distinguishable = dict.fromkeys(names, "yes") | {name: "not from all" for locks in result.inseparable for name in locks}
    distinguishable |= dict.fromkeys(unseen, "no")
    nearest = [float(np.delete(row, row_index).min()) for row_index, row in enumerate(result.separation)][1:]
    ratio, apart = Header("log-likelihood ratio", digits=3, aligned=False), "distinguished by the tool pose"
    remark = f"with the log-likelihood ratio to the closest hypothesis, above {LOG_LIKELIHOOD_THRESHOLD:.2g} if distinguished"
    if not isinstance(result, ProbingMotion):
        rows = [[name, nearest[row], distinguishable[name]] for row, name in enumerate(names)]
        return TableSpec(f"Locks, {remark}", ["joint", ratio, apart], rows)
    rate = Header("largest rate in a unit self-motion", digits=2, aligned=False)
    rows = [[names[row], result.visible[row], nearest[row], distinguishable[names[row]]] for row in result.suspects]
    return TableSpec(f"Candidate joints, {remark}", ["joint", rate, ratio, apart], rows)


def _draw_separation(result: Observability | ProbingMotion) -> report.Figure:
    """Draw a square for each pair of hypotheses."""
    joints = result.suspects if isinstance(result, ProbingMotion) else range(result.arm.n)
    hypotheses = [0, *(row + 1 for row in joints)]
    names = ["none", *(report.format_label(result.arm.joint_names[row], _MAX_NAME_LETTERS) for row in joints)]
    separations = result.separation[np.ix_(hypotheses, hypotheses)]
    count = len(hypotheses)
    with report.styled_figure(2.6 + 0.75 * count, 1.6 + 0.5 * count) as figure:
        axes = figure.subplots()
        matrix = np.ma.masked_array(np.minimum(separations, 3 * LOG_LIKELIHOOD_THRESHOLD), np.eye(count, dtype=bool))
        mesh = axes.pcolormesh(
            np.arange(count + 1), np.arange(count + 1), matrix, cmap="Blues", vmin=0, vmax=3 * LOG_LIKELIHOOD_THRESHOLD
        )
        for row, column in zip(*np.nonzero(~np.eye(count, dtype=bool)), strict=True):
            is_weak = not separations[row, column] > LOG_LIKELIHOOD_THRESHOLD
            color = (
                report.ORANGE if is_weak else "white" if separations[row, column] > 2 * LOG_LIKELIHOOD_THRESHOLD else report.INK
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
        axes.set(title="Separation of the hypotheses", xlim=(0, count))
        figure.colorbar(mesh, ax=axes, label="log-likelihood ratio")
    return figure
