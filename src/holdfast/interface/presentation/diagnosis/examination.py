"""Presentation of an examined recording: alarms, the stated rate of false alarms, and what could not be tested."""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.formatting import capitalise_first, format_count, format_number, list_alternatives
from holdfast.interface.presentation.presentation import FigureSpec, Header, Notice, Presentation, TableSpec
from holdfast.response.diagnosis.recordings.examination import Examination, ExaminedEpisode, StatedRate

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MAX_ALARM_FIGURES = 12
_KIND_PHRASES = {
    "stale": "all readings stop and later continue",
    "dropped": "frames are lost: references and positions leap together",
    "spike": "the reading leaps and returns within three frames",
    "stale joint": "the reading stops and later leaps back",
    "slip": "the joint leaps and returns to its reference",
    "offset": "the position is shifted by a constant",
    "limp": "the joint falls in the direction of its weight",
    "standing": "the position does not change",
    "not following": "the position does not follow its reference",
}


def to_dict(examination: Examination) -> dict[str, Any]:
    """Return the recording, the stated rate, and the result for each episode."""
    recording, calibration = examination.recording, examination.calibration
    return {
        "recording": recording.source,
        "format": recording.format,
        "robot": recording.robot,
        "joints": list(recording.joints),
        "unit": recording.unit,
        "fps": recording.fps,
        "notes": list(recording.notes),
        "false_alarms": examination.false_alarms and asdict(examination.false_alarms),
        "threshold": calibration and calibration.threshold,
        "inconclusive": examination.inconclusive or None,
        "alarms": len(examination.alarms),
        "episodes": [asdict(episode) for episode in examination.episodes],
    }


def present(examination: Examination) -> Presentation:
    """Present the alarms, the stated rate, the joints that hardly moved, and the findings."""
    recording, alarms = examination.recording, examination.alarms
    examined = [episode for episode in examination.episodes if episode.role == "examined"]
    notices = (
        [Notice(capitalise_first(examination.inconclusive) + ".", title="Inconclusive")] if examination.inconclusive else []
    )
    figures = {}
    if np.isfinite([episode.held_error for episode in examination.episodes]).any():
        figures["errors"] = FigureSpec(
            partial(_draw_errors, examination),
            "Largest errors",
            "Largest distance of a joint from its reference that was held for 0.5 s, one point per episode. This rule by hand "
            "needs a limit that suits the robot.",
        )
    for alarm in alarms[:_MAX_ALARM_FIGURES]:
        figures[f"episode-{alarm.index}"] = FigureSpec(
            partial(_draw_alarm, examination, alarm), "Alarms", f"Episode {alarm.index}: {_describe_kind(alarm)}."
        )
    return Presentation(
        "Examination of a recording",
        _compose_answer(examination, len(examined)),
        about=recording.title,
        lines=[f"{capitalise_first(line)}." for line in _list_lines(examination, examined)],
        notices=notices,
        tables=[*_tabulate(examination)],
        figures=figures,
        method=_describe_method(examination),
        arm=examination.arm,
    )


def _compose_answer(examination: Examination, examined_count: int) -> str:
    if examination.calibration is None:
        count = sum(bool(episode.findings) for episode in examination.episodes)
        verb = "has" if count == 1 else "have"
        return f"No test was possible; {count} of {format_count(len(examination.episodes), 'episode')} {verb} findings."
    if not examination.alarms:
        return f"No alarm in {format_count(examined_count, 'examined episode')}."
    return f"{len(examination.alarms)} of {format_count(examined_count, 'examined episode')} alarm."


def _list_lines(examination: Examination, examined: list[ExaminedEpisode]) -> list[str]:
    """List the stated rate, the joints without information, the findings, and the limits of the test."""
    lines = [] if examination.false_alarms is None else [describe_rate(examination.false_alarms)]
    quiet = [episode for episode in examined if episode.alarm is None]
    if examination.alarms and quiet:
        lines.append(f"no alarm in {format_count(len(quiet), 'other episode')}")
    unheard = Counter(name for episode in quiet for name in episode.unheard)
    if examination.calibration is not None:
        lines += [
            f"{name} moved by less than 5 deg in {format_count(count, 'episode')}, so nothing can be said of it there"
            for name, count in unheard.items()
        ]
    if count := sum(bool(episode.findings) for episode in examination.episodes):
        lines.append(f"episodes with findings, which need no calibration and have no stated rate: {count}")
    if examination.recording.unit is None:
        lines.append("the unit of the positions is unknown, so limits are not checked and names of kinds assume degrees")
    lines += examination.recording.notes
    if examination.calibration is not None:
        lines.append("an offset inside a servo and a fault of every healthy episode are invisible in references and positions")
    return lines


def describe_rate(stated: StatedRate) -> str:
    """Return the stated rate of false alarms as a sentence."""
    sets = f"{stated.fit_count} healthy episodes fit the model, and {stated.threshold_count} others set the threshold"
    hourly = f"{format_number(stated.per_hour, 2)} false alarms per hour"
    if stated.limit is None:
        return f"{sets}; the threshold is extrapolated to {hourly}, which is not guaranteed"
    return (
        f"{sets}: 1 of {stated.threshold_count + 1} healthy episodes alarms on average ({hourly}), and with 95 % confidence "
        f"fewer than 1 of {int(1 / stated.limit)} for this calibration, if robot, task and operator do not change"
    )


def _describe_kind(episode: ExaminedEpisode) -> str:
    subject = f"{episode.joint}: " if episode.joint else ""
    causes = list_alternatives(list(episode.candidates))
    return f"{subject}{_KIND_PHRASES[episode.kind or '']} ({causes})"


def _tabulate(examination: Examination) -> list[TableSpec]:
    unit = examination.recording.unit or ""
    alarm_columns = [
        Header("episode", "episode"),
        Header("alarm", "alarm", "s", digits=3),
        Header("joint", "joint"),
        Header("kind", "kind"),
        Header("candidates", "possible causes"),
    ]
    rows = [
        [str(alarm.index), alarm.alarm, alarm.joint or "all", alarm.kind, ", ".join(alarm.candidates)]
        for alarm in examination.alarms
    ]
    findings = [[str(episode.index), sentence] for episode in examination.episodes for sentence in episode.findings]
    finding_columns = [Header("episode", "episode"), Header("finding", "finding")]
    columns = [
        Header("episode", "episode"),
        Header("role", "role"),
        Header("alarm", "alarm, s", digits=3, aligned=False),
        Header("kind", "kind"),
        Header("score", "score", digits=3, aligned=False),
        Header("error", f"largest error held for 0.5 s{f', {unit}' * bool(unit)}", digits=3, aligned=False),
        Header("error_joint", "joint of this error"),
        Header("unheard", "joints that hardly moved"),
    ]
    episodes = [
        [
            str(episode.index),
            episode.role,
            "–" if episode.alarm is None else episode.alarm,
            " ".join(filter(None, [episode.joint, episode.kind])) or "–",
            episode.score if np.isfinite(episode.score) else "–",
            episode.held_error if np.isfinite(episode.held_error) else "–",
            episode.held_error_joint or "–",
            ", ".join(episode.unheard) or "–",
        ]
        for episode in examination.episodes
    ]
    calibration = examination.calibration
    title = "All episodes"
    if calibration is not None:
        title += f" (roles fit and threshold: healthy; an examined episode alarms above a score of {calibration.threshold:.3g})"
    return [
        TableSpec("Alarms", alarm_columns, rows, on_page=bool(rows)),
        TableSpec("Findings", finding_columns, findings, on_page=bool(findings)),
        TableSpec(title, columns, episodes, on_console=False),
    ]


def _describe_method(examination: Examination) -> list[tuple[str, Any]]:
    if examination.calibration is None or examination.false_alarms is None:
        return []
    return [
        ("Model", "Each position is predicted from the references of the last half second, fitted to healthy episodes."),
        ("Statistics", "Nine statistics of the residuals, as logarithms relative to those of the healthy episodes."),
        ("False alarms", capitalise_first(describe_rate(examination.false_alarms)) + "."),
    ]


def _draw_errors(examination: Examination) -> Figure:
    """Draw the largest held error of each episode: healthy, examined, and alarmed."""
    from matplotlib.figure import Figure

    from holdfast.interface.report import figures as style

    groups = [
        ("healthy", style.SKY, "o", [each for each in examination.episodes if each.role != "examined"]),
        ("examined, no alarm", style.BLUE, "s", [e for e in examination.episodes if e.role == "examined" and e.alarm is None]),
        ("alarm", style.ORANGE, "^", list(examination.alarms)),
    ]
    with style.style():
        figure = Figure(figsize=(style.WIDTH_IN, 3.2))
        axes = figure.subplots()
        for label, color, marker, episodes in groups:
            if episodes:
                indices, errors = [each.index for each in episodes], [each.held_error for each in episodes]
                axes.plot(indices, errors, marker, color=color, markersize=5, label=f"{label} ({len(episodes)})")
        unit = examination.recording.unit
        axes.set(xlabel="episode", ylabel=f"error held for 0.5 s{f', {unit}' if unit else ''}", ylim=(0, None))
        axes.legend(loc="upper left", ncols=3)
        return style.settle_layout(figure)


def _draw_alarm(examination: Examination, alarm: ExaminedEpisode) -> Figure:
    """Draw reference, prediction, and position of the joint; for the whole arm, of the joint that moved most."""
    from matplotlib.figure import Figure

    from holdfast.interface.report import figures as style

    t, frames, predicted = examination.signals(alarm.index)
    joints = examination.recording.joints
    joint = int(np.ptp(frames.reference, axis=0).argmax()) if alarm.joint is None else joints.index(alarm.joint)
    unit = examination.recording.unit
    with style.style():
        figure = Figure(figsize=(style.WIDTH_IN, 2.8))
        axes = figure.subplots()
        axes.plot(t, frames.reference[:, joint], color=style.SOFT, linewidth=1.0, linestyle="--", label="reference")
        axes.plot(t, predicted[:, joint], color=style.BLUE, linewidth=1.2, label="prediction of the healthy joint")
        axes.plot(t, frames.position[:, joint], color=style.ORANGE, linewidth=1.6, label="position")
        axes.axvline(alarm.alarm or 0.0, color=style.INK, linewidth=1.0)
        label = f" alarm, {alarm.alarm:.2f} s"
        axes.text(alarm.alarm or 0.0, 0.98, label, transform=axes.get_xaxis_transform(), fontsize=8, va="top")
        name = style.format_label(joints[joint])
        axes.set(xlabel="time, s", ylabel=f"{name}{f', {unit}' if unit else ''}", title=f"Episode {alarm.index}")
        axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3)
        return style.settle_layout(figure)
