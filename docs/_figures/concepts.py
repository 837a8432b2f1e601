"""Figures of the concepts, each drawn from a computation on a small arm when the documentation is built."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse

import holdfast as hf
from holdfast.interface.report import AMBER, BLUE, GREEN, INK, ORANGE, SKY, SOFT, settle_layout, style

WIDTH_IN = 8.6
TARGET = (1.35, 1.0)  # m
BEST_LIMITS_DEG = (18.0, 111.0, 111.0)  # of the joints, both signs: as `holdfast tolerant-workspace --optimise` finds them


def draw_self_motion() -> Figure:
    """Draw one tool position that a planar arm reaches with many configurations."""
    arm = hf.arms.load("planar-3r")
    motion = hf.self_motion(arm, TARGET, "planar", spacing=0.02)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.7))
        plane, joints = figure.subplots(1, 2, width_ratios=[1, 1.1])
        shown = np.linspace(0, len(motion.q) - 1, 13)[:-1].astype(int)
        for index in shown[1:]:
            draw_arm(plane, arm, motion.q[index], color=SKY, width=1.6)
        draw_arm(plane, arm, motion.q[shown[0]], color=BLUE)
        mark_target(plane, TARGET)
        frame_plane(plane, "One tool position, many configurations", 2.4)
        angles, order = np.degrees(motion.q), ("joint 1", "joint 2", "joint 3")
        for joint, (name, color) in enumerate(zip(order, (BLUE, ORANGE, GREEN), strict=True)):
            joints.plot(np.arange(len(angles)), angles[:, joint], ".", ms=2, color=color, label=name)
        joints.set(xlabel=f"point of the self-motion, {len(angles)} points", ylabel="joint angle, deg", ylim=(-180, 180))
        joints.set_title("The same configurations in joint space")
        joints.legend(loc="lower left", ncols=3, markerscale=5)
        return settle_layout(figure)


def draw_failures() -> Figure:
    """Draw the tool positions that a locked joint leaves, and the fall of a free-swinging joint."""
    arm = hf.arms.load("planar-3r")
    q = np.radians([25.0, 55.0, 45.0])
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.5))
        locked, free = figure.subplots(1, 2)
        rng = np.random.default_rng(1)
        samples = np.column_stack([rng.uniform(-np.pi, np.pi, 4000), np.full(4000, q[1]), rng.uniform(-np.pi, np.pi, 4000)])
        tool = arm.forward_kinematics(samples)[:, :2, 3]
        locked.scatter(*tool.T, s=2, color=SKY, linewidth=0)
        draw_arm(locked, arm, q, color=BLUE, failed=1)
        frame_plane(locked, "Locked joint 2: reachable positions", 3.1)
        for step, angle in enumerate(np.radians([0, -30, -60, -90])):
            draw_arm(
                free,
                arm,
                q + np.array([0, angle, 0]),
                color=BLUE if step == 0 else SKY,
                failed=1,
                width=2.4 if step == 0 else 1.6,
            )
        free.annotate("", (2.25, 0.35), (1.2, 2.1), arrowprops={"arrowstyle": "->", "color": ORANGE, "lw": 1.4})
        free.text(2.05, 1.6, "gravity", color=ORANGE)
        frame_plane(free, "Free-swinging joint 2: it falls", 3.1)
        return settle_layout(figure)


def draw_reduced_jacobian() -> Figure:
    """Draw the velocity ellipses of the healthy arm and of the arm with one locked joint, at two configurations."""
    arm = hf.arms.load("planar-3r")
    motion = hf.self_motion(arm, TARGET, "planar", spacing=0.02)
    index = hf.indices.relative_manipulability(arm, task="planar")
    values = index(motion.q)
    chosen = [int(np.argmin(np.abs(values - np.quantile(values, 0.25)))), int(np.argmax(values))]
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.7))
        for axes, row, name in zip(figure.subplots(1, 2), chosen, ("A poor configuration", "The best one"), strict=True):
            q = motion.q[row]
            draw_arm(axes, arm, q, color=SOFT, width=1.8)
            jacobian = arm.jacobian(q)[:2]
            draw_ellipse(axes, jacobian, BLUE, "healthy")
            worst = int(np.argmin(index.by_joint(q)))
            draw_ellipse(axes, np.delete(jacobian, worst, axis=1), ORANGE, f"joint {worst + 1} locked")
            frame_plane(axes, f"{name}: index {float(values[row]):.2f}", 2.6)
            axes.legend(loc="lower left")
        return settle_layout(figure)


def draw_index_distribution() -> Figure:
    """Draw the distribution of an index over a region, with its band and a threshold."""
    arm = hf.arms.load("panda")
    result = hf.assess(arm, poses=400, seed=1)
    reached = result.distribution
    levels = np.linspace(0.0, 0.4, 161)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.3))
        axes = figure.subplots()
        kept = np.array([result.interval(at_least=float(level)).value for level in levels])
        low = np.array([result.interval(at_least=float(level)).low for level in levels])
        high = np.array([result.interval(at_least=float(level)).high for level in levels])
        axes.fill_between(levels, low, high, color=SKY, linewidth=0, label="95 % interval")
        axes.plot(levels, kept, color=BLUE, label="estimate")
        estimate = result.interval(at_least=0.1)
        axes.axvline(0.1, color=ORANGE, linestyle=(0, (4, 2)))
        axes.plot([0.1], [estimate.value], "o", color=ORANGE)
        value, low_end, high_end = (round(100 * fraction) for fraction in (estimate.value, estimate.low, estimate.high))
        axes.annotate(
            f"{value} % of the poses keep at least 0.1\n({low_end} to {high_end} %)",
            (0.1, estimate.value), (0.16, 0.72), arrowprops={"arrowstyle": "-", "color": SOFT},
        )  # fmt: skip
        axes.set(xlabel="threshold of the relative manipulability after the worst lock", ylabel="fraction of poses above")
        axes.set(xlim=(0, 0.4), ylim=(0, 1.02))
        axes.set_title(f"Panda, {reached.samples} random poses in front of the arm")
        axes.legend(loc="upper right")
        return settle_layout(figure)


def draw_undetected_lock() -> Figure:
    """Draw the tool paths of a planar arm whose controller does not detect that joint 1 is locked."""
    arm = hf.arms.load("planar-3r")
    law = hf.control.pseudoinverse(arm, task="planar")
    start, target = np.radians([-30.0, 70.0, -30.0]), (-0.9, 1.4)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.9))
        plane, errors = figure.subplots(1, 2)
        for locked, color, name in (((), BLUE, "healthy"), ((0,), ORANGE, "joint 1 locked")):
            run = hf.simulate(law, start, target, locked=locked)
            path = run.path(samples=300)
            tool = np.asarray(path.x)
            plane.plot(*tool[:, :2].T, color=color, label=name)
            plane.plot(*tool[-1, :2], "o", color=color, ms=5)
            errors.plot(path.time, path.position_error, color=color, label=f"{name}: {run.outcome}")
        draw_arm(plane, arm, start, color=SKY, failed=0)
        mark_target(plane, target)
        frame_plane(plane, "Tool path", 3.0)
        plane.legend(loc="lower left")
        errors.set(xlabel="time, in units of 1/gain", ylabel="distance to the target, m", xlim=(0, 15), ylim=(0, None))
        errors.set_title("Distance to the target")
        errors.legend()
        return settle_layout(figure)


def draw_joint_ranges() -> Figure:
    """Draw for each joint the angles that occur in the self-motion of one target: a lock there is harmless."""
    arm = hf.arms.load("planar-3r")
    ranges = hf.joint_bounds(arm, TARGET, "planar")
    with style():
        figure = Figure(figsize=(WIDTH_IN, 2.2))
        axes = figure.subplots()
        for joint, intervals in enumerate(ranges):
            axes.barh(joint, 360, left=-180, height=0.5, color="#eceff2")
            for low, high in intervals:
                axes.barh(joint, np.degrees(high - low), left=np.degrees(low), height=0.5, color=BLUE)
        axes.set(yticks=range(arm.n), yticklabels=[f"joint {joint + 1}" for joint in range(arm.n)], xlim=(-180, 180))
        axes.set(xlabel="locked angle, deg", xticks=range(-180, 181, 60))
        axes.invert_yaxis()
        axes.set_title(f"Locked angles (blue) from which the target ({TARGET[0]}, {TARGET[1]}) m stays reachable")
        return settle_layout(figure)


def draw_tolerant_workspace() -> Figure:
    """Draw the points that stay reachable after any single lock, with and without artificial joint limits."""
    arm = hf.arms.load("planar-3r")
    with style():
        figure = Figure(figsize=(WIDTH_IN, 4.0))
        bounds = np.radians(BEST_LIMITS_DEG)
        for axes, limits, title in zip(
            figure.subplots(1, 2),
            (None, dict(enumerate(zip(-bounds, bounds, strict=True)))),
            ("Full ranges", "Limited"),
            strict=True,
        ):
            region = hf.tolerant_workspace(arm, "planar", limits=limits)
            side = round(len(region.points) ** 0.5)
            reached = np.where(np.hypot(*region.points[:, :2].T) <= 3, 1.0, np.nan) + region.inside
            axes.imshow(
                reached.reshape(side, side), origin="lower", extent=(-3, 3, -3, 3), cmap=ListedColormap(["#dfe4e8", BLUE]),
                vmin=1, vmax=2, interpolation="nearest",
            )  # fmt: skip
            frame_plane(axes, f"{title}: {region.size:.1f} of {region.healthy_size:.1f} m²", 3.2)
        return settle_layout(figure)


def draw_reachability_map() -> Figure:
    """Draw the reachability index of an arm, intact and with each joint locked at its value in the home configuration."""
    arm = hf.arms.load("panda")
    return hf.reachability_map(arm, at=hf.arms.about("panda").home, samples=300_000).plot("side")


def draw_timeline() -> Figure:
    """Draw the sequence of a fault: fault, detection, isolation, braking, recovery."""
    events = [
        (0.0, "fault", "joint 4 locks", ORANGE),
        (0.012, "detection", "a residual exceeds its threshold", BLUE),
        (0.032, "isolation", "the joint is known", BLUE),
        (0.05, "braking", "the joint is held,\nthe law excludes it", AMBER),
        (0.132, "fault type", "locked, not free-swinging", BLUE),
        (0.2, "recovery", "the arm follows\na new plan", GREEN),
    ]
    with style():
        figure = Figure(figsize=(WIDTH_IN, 2.3))
        axes = figure.subplots()
        axes.axhline(0, color=SOFT, lw=1)
        for index, (time, name, text, color) in enumerate(events):
            side = 1 if index % 2 == 0 else -1
            axes.plot([index, index], [0, 0.35 * side], color=color, lw=1.2)
            axes.plot(index, 0, "o", color=color, ms=7)
            axes.text(index, 0.42 * side, f"{name}\n{text}", ha="center", va="bottom" if side > 0 else "top", fontsize=8.6)
            axes.text(index, -0.12 * side, f"{1000 * time:.0f} ms", ha="center", va="center", fontsize=8, color=SOFT)
        axes.set(xlim=(-0.7, len(events) - 0.3), ylim=(-1.15, 1.15))
        axes.set_axis_off()
        return settle_layout(figure)


# ---- parts of the figures ------------------------------------------------------------------------------------------------


def draw_arm(axes: Axes, arm: hf.Arm, q: np.ndarray, *, color: str, width: float = 2.4, failed: int | None = None) -> None:
    """Draw a planar arm; a failed joint is orange."""
    cumulative = np.cumsum(q)
    points = np.vstack([[0, 0], np.cumsum(np.column_stack([np.cos(cumulative), np.sin(cumulative)]), axis=0)])
    axes.plot(*points.T, color=color, lw=width, solid_capstyle="round", zorder=3)
    axes.plot(*points[:-1].T, "o", color="white", mec=color, ms=5, zorder=4)
    if failed is not None:
        axes.plot(*points[failed], "s", color=ORANGE, ms=7, zorder=5)


def draw_ellipse(axes: Axes, jacobian: np.ndarray, color: str, label: str) -> None:
    """Draw the tool velocities that joint rates of norm 1 cause, at the tool of the arm that was drawn last."""
    tool = axes.lines[-2].get_xydata()[-1] if len(axes.patches) == 0 else np.array(axes.patches[0].center)
    u, s, _ = np.linalg.svd(jacobian)
    angle = np.degrees(np.arctan2(u[1, 0], u[0, 0]))
    scale = 0.45
    axes.add_patch(Ellipse(tool, 2 * scale * s[0], 2 * scale * s[1], angle=angle, fill=False, ec=color, lw=1.8, label=label))


def mark_target(axes: Axes, target: tuple[float, float]) -> None:
    """Mark the target with a cross in a circle."""
    axes.plot(*target, "o", mfc="none", mec=INK, ms=11, zorder=6)
    axes.plot(*target, "+", color=INK, ms=11, zorder=6)


def frame_plane(axes: Axes, title: str, reach: float) -> None:
    """Set equal axes in metres about the base."""
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal", ylabel="y, m")
    axes.set_xlabel(axes.get_xlabel() or "x, m")
    axes.set_title(title)
