"""Presentation of an examined recording: alarms, the stated rate of false alarms, and what could not be tested."""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict
from functools import partial
from typing import Any

import numpy as np

from holdfast.core.formatting import capitalise_first, format_count, format_number
from holdfast.interface import report
from holdfast.interface.presentation.presentation import FigureSpec, Header, Notice, Presentation, TableSpec
from holdfast.response.diagnosis.recordings.examination import Examination, ExaminedEpisode, examined_frames, frame_stride

_MAX_ALARM_FIGURES = 12
_KIND_PHRASES = {
    "stale": "all readings stop and later continue",
    "dropped": "frames are lost, so references and positions leap together",
    "spike": "the reading leaps and returns within three frames",
    "stale joint": "the reading stops and later leaps back",
    "slip": "the joint leaps and returns to its reference",
    "offset": "the position is shifted",
    "limp": "the joint falls in the direction of its weight",
    "standing": "the position does not change",
    "not following": "the position does not follow its reference",
}


def to_dict(examination: Examination) -> dict[str, Any]:
    """Return the recording, the stated rate, and the result for each episode."""
    recording = examination.recording
    names = ("source", "format", "robot", "joints", "unit", "fps", "notes")
    return {
        **{name: getattr(recording, name) for name in names},
        "false_alarms": examination.false_alarms and asdict(examination.false_alarms),
        "threshold": examination.threshold,
        "inconclusive": examination.inconclusive or None,
        "alarms": len(examination.alarms),
        "episodes": [asdict(episode) for episode in examination.episodes],
    }


def present(examination: Examination) -> Presentation:
    """Present the alarms, the stated rate, the joints that hardly moved, and the findings."""
    count = sum(episode.role == "examined" for episode in examination.episodes)
    answer = f"{len(examination.alarms) or 'No'} of {format_count(count, 'examined episode')} raised an alarm."
    if examination.inconclusive:
        answer = f"No test for faults was possible in {format_count(count, 'episode')}."
    notice = Notice(f"{capitalise_first(examination.inconclusive)}.", title="Inconclusive")
    return Presentation(
        "Examination of a recording",
        answer,
        about=examination.recording.title,
        lines=[f"{capitalise_first(line)}." for line in _list_lines(examination)],
        notices=[notice] if examination.inconclusive else [],
        tables=_tabulate(examination),
        figures={
            f"episode-{alarm.index}": FigureSpec(
                partial(_draw_alarm, examination, alarm),
                "Alarms",
                f"Episode {alarm.index}: {_KIND_PHRASES[alarm.kind or '']}. Possible causes: {', '.join(alarm.candidates)}.",
            )
            for alarm in examination.alarms[:_MAX_ALARM_FIGURES]
        },
        arm=examination.arm,
    )


def _list_lines(examination: Examination) -> list[str]:
    """List the stated rate, the largest errors, the joints without information, and the limits of the test."""
    unit, lines = examination.recording.unit or "", []
    if examination.false_alarms is not None:
        lines = [_describe_rate(examination), *_list_unheard(examination)]
        lines.append("an offset inside a servo, and a fault of every healthy episode, do not show in references and positions")
    for is_examined, name in ((False, "healthy"), (True, "examined")):
        errors = [each.held_error for each in examination.episodes if (each.role == "examined") == is_examined]
        if known := [error for error in errors if error is not None]:
            largest = f"{format_number(max(known), 3)} {unit}".strip()
            lines.append(f"the largest error that was held for 0.5 s is {largest} in {len(known)} {name} episodes")
    if not unit:
        lines.append("the unit of the positions is unknown, so limits are not checked and names of kinds assume degrees")
    return lines + list(examination.recording.notes)


def _describe_rate(examination: Examination) -> str:
    stated = examination.false_alarms
    assert stated is not None
    sets = f"{stated.fit_count} healthy episodes fit the model, and {stated.threshold_count} others set the threshold"
    hourly = f"{format_number(stated.per_hour, 2)} false alarms per hour"
    if stated.limit is None:
        return f"{sets}, which is extrapolated to {hourly} and not guaranteed"
    return (
        f"{sets}: 1 of {stated.threshold_count + 1} healthy episodes alarms on average ({hourly}), and with 95 % confidence "
        f"fewer than 1 of {int(1 / stated.limit)} for this calibration, if robot, task and operator do not change"
    )


def _list_unheard(examination: Examination) -> list[str]:
    quiet = [episode for episode in examination.episodes if episode.role == "examined" and episode.alarm is None]
    return [
        f"{name} moved by less than 5 deg in {format_count(count, 'episode')} without an alarm, where nothing can be said of it"
        for name, count in Counter(name for episode in quiet for name in episode.unheard).items()
    ]


def _tabulate(examination: Examination) -> list[TableSpec]:
    alarms = [
        [str(alarm.index), alarm.alarm, alarm.joint or "all", alarm.kind, ", ".join(alarm.candidates)]
        for alarm in examination.alarms
    ]
    findings = [[str(episode.index), sentence] for episode in examination.episodes for sentence in episode.findings]
    episodes = [
        [
            str(episode.index),
            episode.role,
            "–" if episode.alarm is None else f"{episode.alarm:.2f} s",
            "–" if episode.score is None else f"{episode.score:.2f}",
            "–" if episode.held_error is None else f"{episode.held_error:.3g} {examination.recording.unit or ''}",
            ", ".join(episode.unheard) or "–",
        ]
        for episode in examination.episodes
    ]
    tables: dict[str, tuple[list[str], list[list[Any]]]] = {
        "Alarms": (["episode", "alarm", "joint", "kind", "possible causes"], alarms),
        "Findings, which need no calibration and have no stated rate": (["episode", "finding"], findings),
        f"All episodes (fit and threshold are healthy; an examined one alarms above a score of {examination.threshold:.3g})": (
            ["episode", "role", "alarm", "score", "largest error held for 0.5 s", "joints that hardly moved"],
            episodes,
        ),
    }
    return [
        TableSpec(
            title,
            [Header(name, "s" if rows is alarms and name == "alarm" else "", digits=3) for name in names],
            rows,
            on_console=rows is not episodes,
            on_page=bool(rows),
        )
        for title, (names, rows) in tables.items()
    ]


def _draw_alarm(examination: Examination, alarm: ExaminedEpisode) -> report.Figure:
    """Draw reference, prediction, and position of the joint; for the whole arm, of the joint that moved most."""
    recording, healthy = examination.recording, examination.healthy
    assert healthy is not None
    assert alarm.alarm is not None
    episode = next(episode for episode in recording.episodes if episode.index == alarm.index)
    frames, t = examined_frames(recording, episode), episode.t[:: frame_stride(recording.fps)]
    joint = int(np.ptp(frames.reference, axis=0).argmax())
    joint = joint if alarm.joint is None else recording.joints.index(alarm.joint)
    with report.styled_figure(report.WIDTH_IN, 2.8) as figure:
        axes = figure.subplots()
        for values, label, color, width in (
            (frames.reference, "reference", report.SKY, 1.0),
            (healthy.predict(frames.reference), "prediction of the healthy joint", report.BLUE, 1.2),
            (frames.position, "position", report.ORANGE, 1.6),
        ):
            axes.plot(t - t[0], values[:, joint], color=color, linewidth=width, label=label)
        axes.axvline(alarm.alarm, color=report.INK, linewidth=1.0)
        label = report.format_label(recording.joints[joint]) + (f", {recording.unit}" if recording.unit else "")
        axes.set(xlabel="time, s", ylabel=label, title=f"Episode {alarm.index}, alarm at {alarm.alarm:.2f} s")
        axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3)
    return figure
