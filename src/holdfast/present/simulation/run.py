"""One run of the closed loop to look at: a figure, a table, and an HTML page with the arm moving."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path as File

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.caching import cached_property
from holdfast.clearance.contacts import Contact
from holdfast.files.output import made, write_table
from holdfast.notice import says
from holdfast.paths.joint_table import joint_columns
from holdfast.present.arm.view import scene
from holdfast.present.clearance.contacts import contact_table
from holdfast.present.clearance.shape import shape_text
from holdfast.present.results import as_table
from holdfast.present.simulation.errors import error_rows, error_text
from holdfast.present.stick_figure import views_of
from holdfast.present.story import how
from holdfast.report import page
from holdfast.report.figures import save_png, svg
from holdfast.report.motions import Motion, Panel, drawn_motion, motion_figure
from holdfast.report.page import Block, Page, Picture, Section, Table, Text
from holdfast.report.timelines import Line, Timeline, small_multiples
from holdfast.simulation.errors import ErrorHistory, error_history, least_errors
from holdfast.simulation.runs import Outcome, Path, Reason, Runs
from holdfast.words import capitalised, number

Array = NDArray[np.float64]

REPEATED_SPAN = 200.0  # 1/Ke: the part of a motion that repeats itself which is drawn
_SAMPLES, _FRAMES = 1001, 201
_SAMPLE_DENSITY = 5  # samples of a whole run in 1/Ke, or in a cycle
_MOST_SAMPLES = 20_001
_REACHED = 1e-5  # an error below it counts as none
_STILL = 1e-3  # rad (and m) from where a joint ends: nothing more to see


def figures(runs: Runs, k: int = 0) -> dict[str, Figure]:
    """The arm at start and end, the way of its tool, and the error over time, of run k."""
    return {"run": _RunReport(runs, k).figure()}


@says("drawing the motion")
def write(runs: Runs, path: File, k: int = 0, command: str = "", more: Sequence[Section] = ()) -> File:
    """Run k as a page with the arm moving; with more sections, of the same run."""
    return _RunReport(runs, k).write(path, command, more)


def save(runs: Runs, folder: File, k: int = 0, command: str = "", more: Sequence[Section] = ()) -> list[File]:
    """Run k as run.csv, run.png and report.html."""
    folder, report = made(folder), _RunReport(runs, k)
    table, picture = runs.to_csv(folder / "run.csv", k), save_png(report.figure(), folder / "run.png")
    return [table, picture, report.write(folder / "report.html", command, more)]


def to_csv(runs: Runs, file: File, k: int) -> File:
    """The samples of run k as rows."""
    law, path = runs.law, _RunReport(runs, k).path
    time = "time_cycles" if runs.cycles else "time_s"
    header = [time, *joint_columns(law.arm), "tool_x_m", "tool_y_m", "tool_z_m"]
    columns = [path.time, path.q, path.x]
    if law.task.rows[:, :3].any():
        header, columns = [*header, "position_error_mm"], [*columns, 1000 * path.position_error]
    if law.task.angular:
        header, columns = [*header, "angle_error_deg"], [*columns, np.rad2deg(path.angle_error)]
    if runs.clearance is not None:
        header, columns = [*header, "clearance_m"], [*columns, runs.clearance(path.q)]
    return write_table(file, "motion", header, np.column_stack(columns))


class _RunReport:
    """One run and the part of it that is drawn: all, but the rest of a motion that has stopped or repeats itself.

    Args:
        runs: A single run, or many.
        k: Which of them, from 0.
    """

    def __init__(self, runs: Runs, k: int = 0) -> None:
        self.runs, self.k, self.arm = runs, k, runs.law.arm
        self.unit = runs.unit
        self._lock_time = np.atleast_2d(runs.lock_time)[k]

    def _of(self, name: str) -> Array:
        value = np.asarray(getattr(self.runs, name))
        return np.asarray(value[self.k]) if self.runs.code.ndim else value

    @cached_property
    def least(self) -> tuple[float, float]:
        """Least position error, m, and angle error, rad, that the failed arm can have, as far as was found."""
        return least_errors(self.runs, self.k)

    @cached_property
    def errors(self) -> ErrorHistory:
        """The errors over the whole run."""
        return error_history(self.runs, self.k)

    @cached_property
    def path(self) -> Path:
        """The whole run, sampled often enough to show every motion of it."""
        samples = float(self._of("time")) * (1.0 if self.runs.cycles else self.runs.law.gain) * _SAMPLE_DENSITY
        return self._sample_path(int(np.clip(samples, _SAMPLES, _MOST_SAMPLES)), float(self._of("time")))

    def _sample_path(self, samples: int, until: float) -> Path:
        return self.runs._motion.sample_path(self.runs, self.k, self._interpolate, np.linspace(0.0, until, samples))

    @cached_property
    def _interpolate(self) -> Callable[[Array], Array]:
        return self.runs._motion.recorded(self.runs, self.k, float(self._of("time")))[1]

    @cached_property
    def seen(self) -> Path:
        """The part of the run that is drawn, sampled."""
        whole, end = self.path, float(self._of("time"))
        if self._of("code") == Outcome.MOVING:
            end = min(end, REPEATED_SPAN / self.runs.law.gain)
        elif self._of("code") != Outcome.UNDECIDED:
            away = np.flatnonzero((np.abs(whole.q - whole.q[-1]) > _STILL).any(axis=1))
            if away.size:
                end = min(1.03 * float(whole.time[min(away[-1] + 1, len(whole.time) - 1)]), end)
        return self._sample_path(_SAMPLES, end)

    @property
    def omission_note(self) -> str:
        """Sentence about the part of the run that is not drawn; empty where all is drawn."""
        shown, whole = float(self.seen.time[-1]), float(self._of("time"))
        if shown >= 0.99 * whole:
            return ""
        rest = (
            "the arm repeats its motion" if self._of("code") == Outcome.MOVING else "no joint moves by more than 0.001 rad or m"
        )
        return f"Drawn are the first {number(shown)} of {number(whole)} {self.unit}; after them {rest}."

    @property
    def standing(self) -> list[str]:
        """The joints that lock, and when."""
        pairs = zip(self.arm.joint_names, self._lock_time, strict=True)
        return [f"{name} at {t:g} {self.unit}" for name, t in pairs if np.isfinite(t)]

    @property
    def headline(self) -> str:
        """How it ended, and whether joints passed their limits on the way: two facts."""
        code, least, end = Outcome(int(self._of("code"))), self.least, self.errors.end
        far, took = self._text(end.position, end.angle), f"{number(float(self._of('time')))} {self.unit}"
        names = " and ".join(x.replace(f" at 0 {self.unit}", " at the start") for x in self.standing)
        locked = (
            f"With a lock of {names} that its controller does not know of, the arm" if names else "With no joint locked the arm"
        )
        out = max(least) > _REACHED
        told = {
            Outcome.CONVERGED: f"{locked} reaches its target, after {took} (simulated time)",
            Outcome.STUCK: f"{locked} stops {far} off its target",
            Outcome.MOVING: f"{locked} never stops: it repeats its motion, and after {took} it is {far} off its target",
            Outcome.UNDECIDED: f"{locked} {self.runs.ending_sentence(self.k)}, {far} off its target",
        }[code]
        if code == Outcome.UNDECIDED and self._of("reason") != Reason.TIME_LIMIT:
            told = f"{locked} is {far} off its target when the run ends, undecided: {Reason(int(self._of('reason'))).sentence}"
        if code != Outcome.CONVERGED:
            told += f"; with this lock it cannot come closer than {self._text(*least)}, as far as was found" if out else ""
            told += "; it could reach the target with this lock" if not out and self.standing else ""
        return " ".join(x for x in (f"{told}.", self.runs.limits_sentence(self.k), self.runs.contact_sentence(self.k)) if x)

    def _facts(self) -> list[tuple[str, str]]:
        errors, since = self.errors, "after the lock" if self.standing else "after the start"
        measures = [
            (errors.end.position, errors.end.angle, "off the target at the end"),
            (
                errors.largest_position.position,
                errors.largest_angle.angle,
                f"largest distance and angle from the target {since}",
            ),
            (*self.least, "the least error that the failed arm can have, as far as was found"),
        ]
        facts = [(self._text(x, y), words) for x, y, words in measures if max(x, y) > _REACHED]
        numbers = [
            (float(self._of("path_length")), "m", "path of the tool"),
            (float(self._of("time")), self.unit, "simulated time"),
            *[(c.time, self.unit, f"until {c.link} touches {c.object}") for c in self.contacts[:1]],
        ]
        return facts + [(f"{number(value)} {unit}", words) for value, unit, words in numbers if value > _REACHED]

    def _text(self, position: float, angle: float) -> str:
        return error_text(self.runs.law, position, angle)

    @property
    def contacts(self) -> list[Contact]:
        """What it touches."""
        return [c for c in self.runs.contacts or () if c.run == self.k]

    @property
    def few(self) -> NDArray[np.int64]:
        """The samples that are shown one after the other."""
        return np.unique(np.linspace(0, len(self.seen.time) - 1, _FRAMES).astype(int))

    @cached_property
    def goal(self) -> Array:
        """(3,) where the tool should be, m; directions that the task leaves free stay as they are."""
        law, start, target = self.runs.law, self.seen.x[0], self._of("target")
        linear = law.task.rows[:, :3]
        into = linear.T @ linear if law.task.frame == "base" else np.eye(3)
        wanted = target[:3, 3] if target.shape == (4, 4) else target @ linear
        return np.asarray(start + into @ (wanted - start))

    def panels(self) -> list[Panel]:
        """The position error and the angle error over time, as far as the task prescribes them, with the locks."""
        seen, task = self.seen, self.runs.law.task
        position = ("distance from the target, mm", 1000 * seen.position_error, 1000 * self.least[0])
        angle = ("angle from the target, degrees", np.rad2deg(seen.angle_error), float(np.rad2deg(self.least[1])))
        title = f"Ends {self._of('outcome')}" + ", past a joint limit" * bool(self._of("limits_passed").any())
        panels = []
        for label, values, least in [position] * bool(task.rows[:, :3].any()) + [angle] * bool(task.angular):
            moments = tuple(
                (float(t), float(np.interp(t, seen.time, values)), f"{name} locks")
                for name, t in zip(self.arm.joint_names, self._lock_time, strict=True)
                if t <= seen.time[-1]
            )
            level = (least, "least error of the failed arm") if least > 1e-3 else None
            panels.append(Panel(seen.time, values, label, title, level, moments, log=True))
        return panels

    @property
    def caption(self) -> str:
        """What was computed."""
        locked = ", ".join(self.standing) or "none"
        return f"{self.arm.name}, {self.runs.law.label}, locked: {locked}; the controller does not know; one run"

    def figure(self) -> Figure:
        """The arm at start and end, the way of its tool, and the error over time."""
        seen = self.seen
        chain = self.arm.frames(seen.q[self.few])[..., :3, 3]
        square, locked = (np.r_[False, x, False] for x in (self.arm.prismatic, seen.locked[-1]))
        motion = Motion(chain, square, np.array([seen.x[0], self.goal]), locked, self.goal)
        return drawn_motion(motion, views_of(self.arm, chain), self.panels()[0], self.caption, self._xlabel)

    @property
    def _xlabel(self) -> str:
        return "cycle" if self.runs.cycles else "time, s"

    def write(self, file: File, command: str, more: Sequence[Section] = ()) -> File:
        """The page."""
        sections = [
            Section("The motion", [self._view()]),
            Section("The error of the end effector", [self._error()]),
            Section("Joint positions", [self._joints()]),
            *[Section("What it touches", blocks) for blocks in (self._touched(),) if blocks],
            *more,
            Section("In numbers", self._numbers()),
        ]
        title = f"{self.arm.name} after a lock that its controller does not know of"
        law = self.runs.law.describe()
        return page.write(
            Page(
                title,
                self.headline,
                sections,
                subtitle=f"{law}; locked: {', '.join(self.standing) or 'no joint'}",
                facts=self._facts(),
                method=how(self.arm, ("Law", law), ("Drawn", self.omission_note or "The whole run.")),
                again=command,
            ),
            file,
        )

    def _view(self) -> Picture:
        seen, names = self.seen, np.array(self.arm.joint_names)
        readings = []
        for k in self.few:
            locked = names[seen.locked[k]]
            standing = f", locked: {', '.join(locked)}" if locked.size else ""
            error = self._text(float(seen.position_error[k]), float(seen.angle_error[k]))
            readings.append(f"{seen.time[k]:.2f} {self.unit}, error {error}{standing}")
        shown = scene(
            self.arm,
            seen.q[self.few],
            time=np.linspace(seen.time[0], seen.time[-1], len(self.few)),
            locked={name: float(t) for name, t in zip(names, self._lock_time, strict=True) if np.isfinite(t)},
            task=self.runs.law.task,
            path=[seen.x[0], self.goal],
            targets=[self.goal],
            readings=readings,
            cell=None if self.runs.clearance is None else self.runs.clearance.cell,
        )
        caption = "The arm moving; joints turn orange when they lock. Orange line: the straight way to the target."
        return Picture(shown.html("motion", f"{self.arm.name} moving"), f"{caption} {self.omission_note}".strip())

    def _error(self) -> Picture:
        seen = self.seen
        travelled = np.linalg.norm(seen.x - seen.x[0], axis=1)
        panels = [*self.panels(), Panel(seen.time, travelled, "distance of the tool from its start, m", "Tool")]
        figure = motion_figure(panels, self.caption, self._xlabel)
        caption = f"Over time; the error on a log scale. {self.omission_note}".strip()
        return Picture(svg(figure, "error", "Error of the end effector over time"), caption)

    def _joints(self) -> Picture:
        panels = []
        for k, joint in enumerate(self.arm.joints):
            scale, unit = joint.shown
            values = scale * self.seen.q[:, k]
            lines = [Line(values, "position", "first")]
            near = float(np.ptp(values)) + 0.1 * (1.0 if joint.prismatic else 100.0)
            for limit in (joint.lower, joint.upper):
                # A limit far away would only flatten the curve.
                if np.isfinite(limit) and np.abs(values - scale * limit).min() < near:
                    lines.append(Line(np.full(len(values), scale * limit), "limit", "compared"))
            locked = " (locks)" if np.isfinite(self._lock_time[k]) else ""
            panels.append(Timeline(lines, unit, f"{joint.name}{locked}"))
        image = small_multiples(self.seen.time, panels, "Joint positions over time", self._xlabel)
        return Picture(image, f"Joint positions; dashed: a limit, where one is near. {self.omission_note}".strip())

    def _touched(self) -> list[Block]:
        """How far the arm is from what it may touch, and every contact."""
        clearance = self.runs.clearance
        if clearance is None:
            return []
        seen, label = self.seen, "smallest distance, m"
        moments = tuple((c.time, 0.0, f"{c.link} & {c.object}") for c in self.contacts[:1] if c.time <= seen.time[-1])
        panel = Panel(seen.time, clearance(seen.q), label, "The arm and what it may touch", (0.0, "touches"), moments)
        figure = motion_figure([panel], "", self._xlabel)
        about = f"Below 0 the arm touches something. {capitalised(shape_text(clearance, 0.0))}."
        image = svg(figure, "clearance", "Smallest distance of the arm from what it may touch over time")
        table = [as_table(contact_table(self.contacts, self.unit))] if self.contacts else [Text("It touches nothing.")]
        return [Picture(image, about), *table]

    def _numbers(self) -> list[Block]:
        rows = [
            *[(capitalised(what), value) for what, value in error_rows(self.runs, self.errors, self.k)],
            ("Path of the tool", f"{number(float(self._of('path_length')))} m"),
            ("Simulated time", f"{number(float(self._of('time')))} {self.unit}"),
        ]
        return [Table(rows)]
