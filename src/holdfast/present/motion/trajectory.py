"""The report of a motion along a path: one HTML file that begins with the answer."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from markupsafe import Markup

from holdfast.errors import ArmError
from holdfast.files.output import made
from holdfast.motion.slowness import SlowMotion
from holdfast.motion.trajectory import ON_PATH, Trajectory, susceptibilities
from holdfast.notice import says
from holdfast.present.arm.view import scene
from holdfast.present.clearance.shape import shape_text
from holdfast.present.printing import number
from holdfast.present.story import how
from holdfast.report import page
from holdfast.report.page import Block, Callout, Page, Picture, Section, Table, Text
from holdfast.report.timelines import Line, Timeline, small_multiples, stacked_panels
from holdfast.words import as_given, capitalised, percent

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_FRAMES = 201
_SAME, _FOLD = 5e-3, 10.0  # changes that are none, and those that a fraction would not tell
SPEEDS = (1.0, 0.5, 0.25)  # shares of the time of the motion, as in Figs. 9 to 12
_SERIOUS = {"end effector slowed", "not at an extremum", "algorithmic singularity", "value not kept", "value jump", "too near"}


def figures(t: Trajectory) -> dict[str, Figure]:
    """The arm at start and end, the way of its tool, and the objective over time."""
    from holdfast.present.stick_figure import views_of
    from holdfast.report.motions import Motion, Panel, drawn_motion

    chain = t.arm.frames(t.q)[..., :3, 3]
    moving = Motion(chain, np.r_[False, t.arm.prismatic, False], t.poses[:, :3, 3])
    unit = "" if t.objective.unit in ("1", "mixed") else f", {t.objective.unit}"
    panel = Panel(t.time, t.value, f"{t.objective.name}{unit}", f"{capitalised(t.objective.better)} is better")
    caption = f"{t.arm.name}, {t.method}, {len(t.time):,} samples"
    return {"motion": drawn_motion(moving, views_of(t.arm, chain), panel, caption, "time, s", wanted="path asked for")}


@says("drawing the report")
def write(t: Trajectory, path: Path, command: str = "") -> Path:
    """The motion as a page."""
    return page.write(build(t, command), path)


def save(t: Trajectory, folder: Path, command: str = "") -> list[Path]:
    """trajectory.csv and report.html."""
    folder = made(folder)
    return [t.to_csv(folder / "trajectory.csv"), t.report(folder / "report.html", command=command)]


def build(t: Trajectory, command: str = "") -> Page:
    """The page as blocks."""
    slowness = None if t.torque_bound is None else t.slowness(t.torque_bound)  # first: it may be refused
    f = _Facts(t)
    alerts = [] if t.on_path else [Callout(f"{t.headline}.", "bad")]
    parts = [
        Section("Key numbers", f.numbers()),
        Section("The motion", f.motion()),
        Section(f"{capitalised(t.objective.name)} along the path", f.criterion()),
        Section("What happened", f.events()),
        Section("Clearance", f.clearance()),
        Section("Joint rates", f.rates()),
        Section("Joint positions", f.joints()),
        Section("Torques, and how slow is slow enough", f.torques(slowness)),
        Section("Curvature along the self-motion", f.curvature()),
        Section("Error of the end effector", f.hand()),
    ]
    return Page(
        f"Motion of {t.arm.name} along a path",
        f.headline,
        parts,
        subtitle=f"{t.method}, {t.objective.name}, {t.objective.better} is better",
        warnings=alerts,
        facts=f.facts(),
        method=f.method(),
        again=command,
    )


class _Facts:
    def __init__(self, t: Trajectory) -> None:
        self.t = t
        self.unit = "" if t.objective.unit in ("1", "mixed") else f" {t.objective.unit}"
        self.singular = [e.start for e in t.events if e.kind == "algorithmic singularity"]

    @property
    def headline(self) -> str:
        """The worst of the objective on the way, and how much the objective changes that."""
        t, name, plain = self.t, self.t.objective.name, self.t.without
        text = f"The worst {name} on the way is {number(t.worst)}{self.unit}"
        if plain is not None:
            change = (t.worst - plain.worst) / abs(plain.worst) if plain.worst else np.inf
            if abs(change) < _SAME:
                text += ", as on the same path without it"
            else:
                much = (
                    f"{percent(abs(change))} {'less' if change < 0 else 'more'} than on"
                    if abs(change) < _FOLD
                    else "against that on"
                )
                text += f", {much} the same path without it ({number(plain.worst)}{self.unit})"
        where = (
            "; the end effector stays on its path."
            if t.on_path
            else f". The end effector leaves its path, by up to {t.tool_error}."
        )
        return f"{text}{where}"

    def facts(self) -> list[tuple[str, str]]:
        """The answer in a few numbers."""
        t, name, plain = self.t, self.t.objective.name, self.t.without
        found = [(f"{number(t.worst)}{self.unit}", f"worst {name} on the way")]
        if plain is not None:
            found.append((f"{number(plain.worst)}{self.unit}", "on the same path without it, with least-norm rates"))
        found.append((f"{number(float(t.value.mean()))}{self.unit}", "mean on the way"))
        found.append((f"{number(t.peak_rate)} rad/s", f"largest norm of the joint rates, at {t.peak_time:.3g} s"))
        return found

    def numbers(self) -> list[Block]:
        """The motion in a few numbers."""
        t, unit = self.t, self.unit
        rows: list[tuple[str, str]] = [
            ("At the start, at the end", f"{t.value[0]:.4g}, {t.value[-1]:.4g}{unit}"),
            ("Mean, smallest, largest", f"{t.value.mean():.4g}, {t.value.min():.4g}, {t.value.max():.4g}{unit}"),
        ]
        if t.best_value is not None:
            rows.append(("Best over the whole self-motion, mean", f"{np.nanmean(t.best_value):.4g}{unit}"))
        rows += [
            ("Largest norm of the joint rates", f"{t.peak_rate:.4g} rad/s at {t.peak_time:.4g} s"),
            ("Median of that norm", f"{np.median(t.rate_norm):.4g} rad/s"),
            ("End effector off its path by at most", t.tool_error),
        ]
        if t.clearance is not None and t.nearest is not None:
            rows.append(("Smallest clearance", f"{1000 * t.clearance[t.nearest[0]]:.4g} mm, {t.nearest[1]}"))
        if t.rate_cap is not None:
            rows.append(
                ("Self-motion slowed by the cap", f"{percent(float(np.mean(t.self_motion < 1 - 1e-9)))} of the samples")
            )
        if (t.task_share < 1 - 1e-9).any():
            rows.append(
                ("End effector slowed by joint limits", f"{percent(float(np.mean(t.task_share < 1 - 1e-9)))} of the samples")
            )
        return [Table(rows)]

    # ---- the arm -----------------------------------------------------------------------------------------------

    def motion(self) -> list[Block]:
        """The arm moving, beside the motion without the objective."""
        t, plain = self.t, self.t.without
        few = np.unique(np.linspace(0, len(t.time) - 1, min(_FRAMES, len(t.time))).astype(int))
        readings = []
        for k in few:
            other = "" if plain is None else f", without it {plain.value[k]:.4g}"
            readings.append(f"{t.time[k]:.2f} s, {t.objective.name} {t.value[k]:.4g}{other}")
        q = t.q[few] if plain is None else np.stack([t.q[few], plain.q[few]])
        shown = scene(
            t.arm,
            q,
            labels=() if plain is None else (t.method, "without the objective"),
            time=np.linspace(t.time[0], t.time[-1], len(few)),
            path=t.poses[few, :3, 3],
            readings=readings,
            cell=None if t.clear_of is None else t.clear_of.cell,
        )
        caption = "The arm on its path (orange)."
        if plain is not None:
            caption += " See-through: the same path from the same configuration without the objective, by least-norm rates."
        return [Picture(shown.html("motion", f"{t.arm.name} moving along its path"), caption)]

    # ---- curves ------------------------------------------------------------------------------------------------

    def _figure(self, panels: list[Timeline], about: str, caption: str) -> Picture:
        return Picture(stacked_panels(self.t.time, panels, about), caption)

    def criterion(self) -> list[Block]:
        """The objective, and each joint's measure."""
        t = self.t
        lines = [Line(t.value, t.method, "first")]
        if t.without is not None:
            lines.append(Line(t.without.value, "without the objective", "third"))
        caption = f"{capitalised(t.objective.name)} at {len(t.time):,} samples; {t.objective.better} is better."
        if t.best_value is not None:
            lines.append(Line(t.best_value, "best of each pose", "compared"))
            caption += (
                " Best of each pose: over the whole self-motion manifold, traced at up to 101 poses, whether a motion leads "
                "there or not."
            )
        if t.best_path is not None:
            ok = np.isfinite(t.best_path).all(axis=1)
            if ok.any():
                value = np.full(len(t.time), np.nan)
                value[ok] = t.objective(t.best_path[ok])
                lines.append(Line(value, "best continuous motion", "second"))
                caption += (
                    " Best continuous motion: dynamic programming over these manifolds, on points between 0.05 rad apart."
                )
            if not ok.all():
                caption += f" No continuous motion was found for {percent(float(np.mean(~ok)))} of the samples."
        unit = "" if t.objective.unit == "1" else f", {t.objective.unit}"
        panels = [Timeline(lines, f"objective{unit}" if len(unit) < 24 else "objective", t.objective.name, self.singular)]
        for measure in susceptibilities(t.objective):
            values = measure.by_joint(t.q)
            units = ", ".join(dict.fromkeys(measure.joint_unit))
            each = [Line(v, j.name) for v, j in zip(values.T, t.arm.joints, strict=True)]
            name = measure.formula.name
            panels.append(Timeline(each, f"{name}, {units}", f"{capitalised(name)} of each joint if it fails"))
        if len(panels) > 1:
            caption += " Below: the signed measure of each joint, without weights."
        return [self._figure(panels, f"{t.objective.name} along the path", caption)]

    def rates(self) -> list[Block]:
        """Norm of the joint rates and each of them."""
        t = self.t
        cap = [] if t.rate_cap is None else [Line(np.full(len(t.time), t.rate_cap), "cap", "compared")]
        mixed = bool(t.arm.prismatic.any())
        unit = "rad/s and m/s" if mixed else "rad/s"
        panels = [
            Timeline([Line(t.rate_norm, "norm", "first"), *cap], unit, "Norm of the joint rates", self.singular),
            Timeline([Line(v, j.name) for v, j in zip(t.qd.T, t.arm.joints, strict=True)], unit, "Joint rates"),
        ]
        caption = f"Rates at the samples; between them the norm reaches {t.peak_rate:.4g} rad/s at {t.peak_time:.4g} s."
        if t.rate_cap is not None:
            caption += " The cap slows only the self-motion, so the norm passes it where the task alone needs more."
        return [self._figure(panels, "Joint rates over time", caption)]

    def joints(self) -> list[Block]:
        """Each joint with its limits."""
        t = self.t
        panels = []
        for k, joint in enumerate(t.arm.joints):
            scale, unit = joint.shown
            lines = [Line(scale * t.q[:, k], "position", "first")]
            reach = np.ptp(scale * t.q[:, k]) + (0.1 if joint.prismatic else 10.0)
            for limit in (joint.lower, joint.upper):
                # A limit far away would only flatten the curve.
                if np.isfinite(limit) and np.abs(scale * (t.q[:, k] - limit)).min() < reach:
                    lines.append(Line(np.full(len(t.time), scale * limit), "limit", "compared"))
            panels.append(Timeline(lines, unit, joint.name))
        image = small_multiples(t.time, panels, "Joint positions over time")
        return [Picture(image, "Joint positions; dashed: a limit, where one is near.")]

    def clearance(self) -> list[Block]:
        """How far the arm was from what it keeps clear of."""
        t = self.t
        if t.clear_of is None or t.clearance is None or t.nearest is None:
            return []
        lines = [Line(1000 * t.clearance, "smallest distance", "first")]
        kept = 1000 * (t.margin + float(t.clear_of.margins.max(initial=0.0)))
        lines.append(Line(np.full(len(t.time), kept), "to be kept", "level"))
        caption = f"Smallest distance of any pair, nearest: {t.nearest[1]}. {capitalised(shape_text(t.clear_of, t.margin))}."
        return [self._figure([Timeline(lines, "mm", "Smallest distance")], "Clearance over time", caption)]

    def torques(self, slowness: list[SlowMotion] | None) -> list[Block]:
        """Torques that hold the arm, and those of the motion at three speeds."""
        t = self.t
        try:
            gravity = t.arm.gravity_torque(t.q)
            fast = {share: t.torques(share) for share in SPEEDS}
        except ArmError as error:
            return [Text(f"No torques: {error}.", quiet=True)]
        looks = ("first", "second", "third")
        panels = []
        for k, joint in enumerate(t.arm.joints):
            lines = [Line(gravity[:, k], "gravity alone", "compared")]
            lines += [
                Line(fast[share][:, k], f"in {share * t.time[-1]:.4g} s", look)  # type: ignore[arg-type]
                for share, look in zip(SPEEDS, looks, strict=True)
            ]
            panels.append(Timeline(lines, "N" if joint.prismatic else "N m", joint.name))
        image = small_multiples(t.time, panels, "Joint torques over time")
        blocks: list[Block] = [
            Picture(
                image,
                f"Torque of each joint, inertia, centrifugal and Coriolis terms and viscous friction included, if the same "
                f"motion takes {', '.join(f'{s * t.time[-1]:.4g}' for s in SPEEDS)} s, drawn over the time of the first; "
                "dashed: at rest. The susceptibilities assume that these hardly differ. English and Maciejewski 1998, eq. "
                "(5), Figs. 9 to 12. Accelerations are differences of the sampled rates.",
            )
        ]
        if slowness is None:
            return blocks
        worst = max(slowness, key=lambda s: s.time_scale)
        rows = [
            [j.name, f"{s.time_scale:.3g}", f"{s.time_scale * t.time[-1]:.4g}", f"{t.time[s.worst_time_index]:.4g}"]
            for j, s in zip(t.arm.joints, slowness, strict=True)
        ]
        verdict = "The motion is slow enough" if worst.time_scale <= 1 else "The motion is too fast for gravity alone to matter"
        blocks.append(
            Table(
                rows,
                ("joint", "time scale", "duration, s", "decided at, s"),
                frozenset({1, 2, 3}),
                caption=f"{verdict}: to stay within {t.torque_bound:g} N m (N) of the gravity torque it must take at least "
                f"{worst.time_scale:.3g} times as long. Eq. (6).",
            )
        )
        return blocks

    def curvature(self) -> list[Block]:
        """Smallest curvature of the objective along the self-motion."""
        t = self.t
        good = np.isfinite(t.curvature)
        if not good.any():
            return []
        typical = float(np.median(np.abs(t.curvature[good])))
        level = Line(np.zeros(len(t.time)), "zero", "compared")
        panel = Timeline(
            [Line(t.curvature, "smallest curvature", "first"), level],
            "per rad^2",
            "Curvature of the objective along the self-motion",
            self.singular,
            "symlog" if typical > 0 and np.abs(t.curvature[good]).max() > 30 * typical else "linear",
            typical or 1.0,
        )
        return [
            self._figure(
                [panel],
                "Curvature along the self-motion over time",
                "Above 0 at a local best. Where it reaches 0 while the arm is not singular the local best ends or splits: an "
                "algorithmic singularity (English and Maciejewski 1998, section VI-B), marked where joint rates show it.",
            )
        ]

    def hand(self) -> list[Block]:
        """How far the end effector was off its path."""
        t = self.t
        panels = [
            Timeline(
                [Line(1000 * t.position_error, "off", "first")], "mm", "Position of the end effector off its path", (), "log"
            )
        ]
        if t.task.angular:
            lines = [Line(1000 * t.rotation_error, "off", "first")]
            panels.append(Timeline(lines, "mrad", "Orientation of the end effector off its path", (), "log"))
        caption = (
            f"Errors in the rows of task '{t.task.name}', log scale; beyond {1000 * ON_PATH:g} mm or mrad the end "
            f"effector is off."
        )
        return [self._figure(panels, "Error of the end effector over time", caption)]

    # ---- words -------------------------------------------------------------------------------------------------

    def events(self) -> list[Block]:
        """A table of events."""
        t = self.t
        if not t.events:
            return [Text("Nothing: no algorithmic singularity, no joint at a limit, no outlying rate.")]
        rows = [
            [
                Markup('<span class="fatal">{}</span>').format(e.kind) if e.kind in _SERIOUS else e.kind,
                f"{e.start:.4g}",
                f"{e.end:.4g}",
                capitalised(e.text.split(": ", 1)[1]),  # the times have columns of their own
            ]
            for e in t.events
        ]
        return [Table(rows, ("what", "from, s", "to, s", ""), frozenset({1, 2}), wide=True)]

    def method(self) -> list[Block]:
        """How it was computed."""
        t = self.t
        return how(
            t.arm,
            ("Law", t.method),
            ("Objective", f"{t.objective.name}, {t.objective.better} is better"),
            ("Task", t.task.describe()),
            ("Gain", as_given(t.gain)),
            ("Kept clear", "nothing" if t.clear_of is None else shape_text(t.clear_of, t.margin)),
            ("Rate cap", "none" if t.rate_cap is None else f"{t.rate_cap:g} rad/s"),
            ("Steps", f"{t.steps:,} of {t.time[-1] / t.steps:.3g} s; {len(t.time):,} samples of them are kept"),
            ("Without the objective", "least-norm rates, from the same configuration; everything else alike"),
            ("Seed", str(t.seed)),
        )
