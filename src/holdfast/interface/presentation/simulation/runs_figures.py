"""Figures of one closed-loop run, and the sections of its report with the moving arm."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from holdfast.control.simulation.errors import ErrorHistory, error_history, least_errors
from holdfast.control.simulation.runs import RunOutcome, RunPath, Runs
from holdfast.core.caching import cached_property
from holdfast.core.formatting import capitalise_first, format_number
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.arm.view import build_view_section, choose_views
from holdfast.interface.presentation.collision.shape import describe_shape
from holdfast.interface.presentation.path_following.trajectory_figures import draw_joint_positions
from holdfast.interface.presentation.simulation.errors import format_errors
from holdfast.interface.report.page import Block, Picture, Section, Text
from holdfast.model.collision.contacts import Contact

REPEATED_SPAN_GAINS = 200.0  # 1/Ke: duration that is drawn of a motion that repeats itself
_MIN_SAMPLES = 1001
_MAX_VIEW_FRAMES = 201
_SAMPLE_DENSITY = 5  # samples of a whole run in 1/Ke, or in a cycle
_MAX_SAMPLES = 20_001
_STILL_DISTANCE = 1e-3  # rad or m from the final position: smaller motion is not visible


class RunDrawing:
    """One run and the part of it that is drawn: all but the end of a motion that has stopped or repeats itself."""

    def __init__(self, runs: Runs, run_index: int = 0) -> None:
        self.runs, self.run_index, self.arm = runs, run_index, runs.law.arm
        self.time_unit = runs.unit
        self.lock_time = np.atleast_2d(runs.lock_time)[run_index]

    def get_run_array(self, name: str) -> FloatArray:
        """Return an array of the runs for this run."""
        values = np.asarray(getattr(self.runs, name))
        return np.asarray(values[self.run_index]) if self.runs.code.ndim else values

    @cached_property
    def smallest_errors(self) -> tuple[float, float]:
        """Smallest position error, m, and angle error, rad, found for the failed arm."""
        return least_errors(self.runs, self.run_index)

    @cached_property
    def error_curve(self) -> ErrorHistory:
        """Errors over the whole run."""
        return error_history(self.runs, self.run_index)

    @cached_property
    def full_path(self) -> RunPath:
        """The whole run, sampled densely enough to show every motion."""
        samples = float(self.get_run_array("time")) * (1.0 if self.runs.cycles else self.runs.law.gain) * _SAMPLE_DENSITY
        return self._sample_path(int(np.clip(samples, _MIN_SAMPLES, _MAX_SAMPLES)), float(self.get_run_array("time")))

    def _sample_path(self, samples: int, end_time: float) -> RunPath:
        return self.runs._simulator.sample_path(
            self.runs, self.run_index, self._interpolate, np.linspace(0.0, end_time, samples)
        )

    @cached_property
    def _interpolate(self) -> Callable[[FloatArray], FloatArray]:
        return self.runs._simulator.replay_run(self.runs, self.run_index, float(self.get_run_array("time")))[1]

    @cached_property
    def drawn_path(self) -> RunPath:
        """Sampled part of the run that is drawn."""
        full_path, end_time = self.full_path, float(self.get_run_array("time"))
        if self.get_run_array("code") == RunOutcome.MOVING:
            end_time = min(end_time, REPEATED_SPAN_GAINS / self.runs.law.gain)
        elif self.get_run_array("code") != RunOutcome.UNDECIDED:
            moving_samples = np.flatnonzero((np.abs(full_path.q - full_path.q[-1]) > _STILL_DISTANCE).any(axis=1))
            if moving_samples.size:
                end_time = min(1.03 * float(full_path.time[min(moving_samples[-1] + 1, len(full_path.time) - 1)]), end_time)
        return self._sample_path(_MIN_SAMPLES, end_time)

    @property
    def omission_note(self) -> str:
        """Sentence about the part of the run that is not drawn; empty if the whole run is drawn."""
        drawn_time, total_time = float(self.drawn_path.time[-1]), float(self.get_run_array("time"))
        if drawn_time >= 0.99 * total_time:
            return ""
        reason_text = (
            "the arm repeats its motion"
            if self.get_run_array("code") == RunOutcome.MOVING
            else "no joint moves by more than 0.001 rad or m"
        )
        return (
            f"The figure ends after {format_number(drawn_time)} of {format_number(total_time)} {self.time_unit}, because then "
            f"{reason_text}."
        )

    @property
    def lock_texts(self) -> list[str]:
        """The joints that lock, with their lock times."""
        pairs = zip(self.arm.joint_names, self.lock_time, strict=True)
        return [f"{name} at {lock_instant:g} {self.time_unit}" for name, lock_instant in pairs if np.isfinite(lock_instant)]

    @property
    def contacts(self) -> list[Contact]:
        """Contacts of this run."""
        return [contact for contact in self.runs.contacts or () if contact.run == self.run_index]

    @property
    def frame_indices(self) -> NDArray[np.int64]:
        """Indices of the samples that are shown as frames."""
        return np.unique(np.linspace(0, len(self.drawn_path.time) - 1, _MAX_VIEW_FRAMES).astype(int))

    @cached_property
    def goal_position(self) -> FloatArray:
        """Target position of the tool (3,), m; directions that the task leaves free keep their values."""
        law, start, target = self.runs.law, self.drawn_path.x[0], self.get_run_array("target")
        linear = law.task.rows[:, :3]
        projection = linear.T @ linear if law.task.frame == "base" else np.eye(3)
        target_position = target[:3, 3] if target.shape == (4, 4) else target @ linear
        return np.asarray(start + projection @ (target_position - start))

    def build_panels(self) -> list[report.motions.TimePanel]:
        """Build the panels of position error and angle error over time, as far as the task prescribes them, with the locks."""
        drawn_path, task = self.drawn_path, self.runs.law.task
        position_series = ("distance from the target, mm", 1000 * drawn_path.position_error, 1000 * self.smallest_errors[0])
        angle_series = (
            "angle from the target, degrees",
            np.rad2deg(drawn_path.angle_error),
            float(np.rad2deg(self.smallest_errors[1])),
        )
        title = f"Outcome: {self.get_run_array('outcome')}" + ", passes a joint limit" * bool(
            self.get_run_array("limits_passed").any()
        )
        panels = []
        for label, values, smallest in [position_series] * bool(task.rows[:, :3].any()) + [angle_series] * bool(task.angular):
            moments = tuple(
                (float(lock_instant), float(np.interp(lock_instant, drawn_path.time, values)), f"{name} locks")
                for name, lock_instant in zip(self.arm.joint_names, self.lock_time, strict=True)
                if lock_instant <= drawn_path.time[-1]
            )
            level = (smallest, "smallest error found") if smallest > 1e-3 else None
            panels.append(report.motions.TimePanel(drawn_path.time, values, label, title, level, moments, log_scale=True))
        return panels

    @property
    def caption(self) -> str:
        """Description of the run for the figures."""
        locks = f"undetected lock of {', '.join(self.lock_texts)}" if self.lock_texts else "no lock"
        return f"{self.arm.name}, {self.runs.law.label}, {locks}; one run"

    def draw_figure(self) -> report.Figure:
        """Draw the arm at start and end, the path of its tool, and the error over time."""
        drawn_path = self.drawn_path
        chain = self.arm.frames(drawn_path.q[self.frame_indices])[..., :3, 3]
        is_slide, locked = (np.r_[False, joint_flags, False] for joint_flags in (self.arm.prismatic, drawn_path.locked[-1]))
        motion = report.motions.StickMotion(
            chain, is_slide, np.array([drawn_path.x[0], self.goal_position]), locked, self.goal_position
        )
        return report.motions.stick_motion_figure(
            motion, choose_views(self.arm, chain), self.build_panels()[0], self.caption, self._time_label
        )

    @property
    def _time_label(self) -> str:
        return "cycle" if self.runs.cycles else "time, s"

    def build_sections(self) -> list[Section]:
        """Build the sections of the report: the moving arm, and its errors, joints, and contacts over time."""
        return [
            self._animate_run(),
            Section("Error of the end effector", [self._draw_errors()]),
            Section("Joint positions", [self._draw_joints()]),
            Section("Contacts", self._report_contacts()),
        ]

    def _animate_run(self) -> Section:
        drawn_path, names = self.drawn_path, np.array(self.arm.joint_names)
        readings = []
        for sample in self.frame_indices:
            locked = names[drawn_path.locked[sample]]
            lock_note = f", locked: {', '.join(locked)}" if locked.size else ""
            error = format_errors(
                self.runs.law, float(drawn_path.position_error[sample]), float(drawn_path.angle_error[sample])
            )
            readings.append(f"{drawn_path.time[sample]:.2f} {self.time_unit}, error {error}{lock_note}")
        caption = "The moving arm. Joints turn orange when they lock; the orange line is the straight path to the target."
        return build_view_section(
            "The motion",
            self.arm,
            drawn_path.q[self.frame_indices],
            f"{caption} {self.omission_note}".strip(),
            label=f"{self.arm.name} moving",
            time=np.linspace(drawn_path.time[0], drawn_path.time[-1], len(self.frame_indices)),
            locked={
                name: float(lock_instant)
                for name, lock_instant in zip(names, self.lock_time, strict=True)
                if np.isfinite(lock_instant)
            },
            task=self.runs.law.task,
            path=[drawn_path.x[0], self.goal_position],
            targets=[self.goal_position],
            readings=readings,
            cell=None if self.runs.clearance is None else self.runs.clearance.cell,
        )

    def _draw_errors(self) -> Picture:
        drawn_path = self.drawn_path
        travelled_distance = np.linalg.norm(drawn_path.x - drawn_path.x[0], axis=1)
        panels = [
            *self.build_panels(),
            report.motions.TimePanel(drawn_path.time, travelled_distance, "distance of the tool from its start, m", "Tool"),
        ]
        figure = report.motions.motion_figure(panels, self.caption, self._time_label)
        caption = f"Errors over time on a log scale, and the distance of the tool from its start. {self.omission_note}".strip()
        return Picture(report.svg(figure, "error", "Error of the end effector over time"), caption)

    def _draw_joints(self) -> Picture:
        path, locks = self.drawn_path, np.isfinite(self.lock_time)
        titles = [f"{name}{' (locks)' * bool(lock)}" for name, lock in zip(self.arm.joint_names, locks, strict=True)]
        return draw_joint_positions(self.arm, path.time, path.q, titles, self._time_label, self.omission_note)

    def _report_contacts(self) -> list[Block]:
        """Draw the smallest distance of the arm from itself and from the objects of its cell."""
        clearance = self.runs.clearance
        if clearance is None:
            return []
        drawn_path, label = self.drawn_path, "smallest distance, m"
        moments = tuple(
            (contact.time, 0.0, f"{contact.link} & {contact.object}")
            for contact in self.contacts[:1]
            if contact.time <= drawn_path.time[-1]
        )
        panel = report.motions.TimePanel(
            drawn_path.time, clearance(drawn_path.q), label, "Smallest distance of the arm", (0.0, "contact"), moments
        )
        figure = report.motions.motion_figure([panel], "", self._time_label)
        caption = f"Below 0 the arm touches something. {capitalise_first(describe_shape(clearance, 0.0))}."
        image = report.svg(figure, "clearance", "Smallest distance of the arm from itself and from objects over time")
        return [Picture(image, caption), *([] if self.contacts else [Text("The arm touches nothing.")])]
