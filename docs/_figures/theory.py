"""Figures of the theory pages, each drawn from a computation when the documentation is built."""

from __future__ import annotations

import numpy as np
from concepts import WIDTH_IN, draw_arm, frame_plane, mark_target
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import holdfast as hf
from holdfast.interface.report import AMBER, BLUE, GREEN, INK, ORANGE, SKY, SOFT, settle_layout, style

TARGET = (1.35, 1.0)  # m
WORKSPACE_START, WORKSPACE_TARGET = (2.0, -1.4), (1.5, 1.5)  # m
START_ON_SELF_MOTION = 28  # a configuration of the start whose motion is partly inside the range of joint 1
PANDA_BENT_DEG = (0, -45, 0, -135, 0, 90, 45)
EMPTY = "#eceff2"


def draw_relative_manipulability() -> Figure:
    """Draw the relative manipulability of each joint along a self-motion, with the worst case and its bound."""
    arm = hf.arms.load("planar-3r")
    motion = hf.self_motion(arm, TARGET, "planar", spacing=0.02)
    q = motion.q
    values = hf.indices.relative_manipulability(arm, task="planar").by_joint(q)
    distance = np.r_[0, np.cumsum(np.linalg.norm((np.diff(q, axis=0) + np.pi) % (2 * np.pi) - np.pi, axis=1))]
    worst, bound = values.min(axis=1), np.sqrt(1 / 3)
    best = int(worst.argmax())
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.6))
        plane, axes = figure.subplots(1, 2, width_ratios=[1, 1.5])
        draw_arm(plane, arm, q[int(worst.argmin())], color=SKY)
        draw_arm(plane, arm, q[best], color=BLUE)
        mark_target(plane, TARGET)
        frame_plane(plane, "Best (dark) and worst (light)", 2.6)
        for joint, color in enumerate((AMBER, ORANGE, GREEN)):
            axes.plot(distance, values[:, joint], color=color, lw=1.4, label=f"joint {joint + 1}")
        axes.plot(distance, worst, color=BLUE, lw=2.6, label="worst case")
        axes.plot(distance[best], worst[best], "o", color=BLUE)
        axes.axhline(bound, color=INK, linestyle=(0, (4, 2)), lw=1, label=f"bound {bound:.3f}")
        axes.set(xlabel="distance along the self-motion, rad", ylim=(0, 1.25), xlim=(0, distance[-1]))
        axes.set_title("Relative manipulability after one lock")
        axes.legend(loc="upper center", ncols=3, fontsize=8)
        return settle_layout(figure)


def draw_singular_limit() -> Figure:
    """Draw the index on lines that approach a singular configuration from several directions."""
    arm = hf.arms.load("planar-3r")
    index = hf.indices.relative_manipulability(arm, task="planar")
    distance = np.linspace(1e-3, 0.8, 200)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.0))
        axes = figure.subplots()
        for direction in np.linspace(0, np.pi, 8, endpoint=False):
            bend = distance[:, None] * np.array([0.0, np.cos(direction), np.sin(direction)])
            axes.plot(distance, index(bend), color=BLUE, lw=1.3)
            axes.plot(0, index(bend[:1])[0], "o", mfc="white", mec=BLUE, ms=5, clip_on=False, zorder=4)
        axes.set(xlabel="distance from the stretched configuration, rad", ylabel="worst case", xlim=(0, 0.8), ylim=(0, 0.6))
        axes.set_title("Planar arm with three joints")
        return settle_layout(figure)


def draw_susceptibilities() -> Figure:
    """Draw the vectors of the definitions, and a simulated free swing next to two of the formulas."""
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.7))
        sketch, axes = figure.subplots(1, 2, width_ratios=[1, 1.3])
        _draw_definition_of_swing(sketch)
        arm, q = hf.arms.load("panda"), np.radians(PANDA_BENT_DEG)
        friction = hf.Friction(viscous=0.92)  # a tenth of critical, so that the joint swings visibly and comes to rest
        fall = hf.power_loss(arm, q, free=["panda_joint4"], friction=friction, stops=False, duration=6.0)
        acceleration = float(hf.susceptibility.acceleration(arm).by_joint(q)[3])
        rest = float(hf.susceptibility.swing_angle(arm).by_joint(q)[3])
        time = np.linspace(0.0, 6.0, 601)
        axes.plot(time, np.degrees(fall.q_at(time)[:, 3] - q[3]), color=BLUE, label="simulated")
        early = np.linspace(0, 0.36, 60)
        axes.plot(early, np.degrees(acceleration * early**2 / 2), color=ORANGE, lw=1.6, label="from the acceleration")
        axes.axhline(np.degrees(rest), color=GREEN, linestyle=(0, (4, 2)), label="swing angle")
        axes.set(xlabel="time, s", ylabel="angle moved, deg", xlim=(0, 6.0), ylim=(-190, 5))
        axes.set_title("Panda, joint 4 swings free")
        axes.legend(loc="upper right")
        return settle_layout(figure)


def _draw_definition_of_swing(axes: Axes) -> None:
    """Draw a joint seen along its axis, the centre of the mass it carries, gravity, and the swing angle."""
    angle, radius = np.radians(25.0), 1.0
    centre = radius * np.array([np.cos(angle), np.sin(angle)])
    axes.plot([0, centre[0]], [0, centre[1]], color=SKY, lw=7, solid_capstyle="round")
    axes.plot([0, 0], [0, -radius], color=EMPTY, lw=7, solid_capstyle="round", zorder=0)
    axes.annotate("", centre, (0, 0), arrowprops={"arrowstyle": "->", "color": BLUE, "lw": 1.6})
    axes.text(0.42, 0.33, "$s_i$", color=BLUE, fontsize=12)
    axes.plot(*centre, "o", color=BLUE, ms=9)
    axes.annotate("", centre - [0, 0.62], centre, arrowprops={"arrowstyle": "->", "color": ORANGE, "lw": 1.6})
    axes.text(centre[0] + 0.05, centre[1] - 0.5, "weight", color=ORANGE)
    arc = np.linspace(angle, -np.pi / 2, 60)
    axes.plot(0.55 * np.cos(arc), 0.55 * np.sin(arc), color=GREEN, lw=1.4)
    axes.annotate(
        "", 0.55 * np.array([np.cos(arc[-1]), np.sin(arc[-1])]), 0.55 * np.array([np.cos(arc[-4]), np.sin(arc[-4])]),
        arrowprops={"arrowstyle": "->", "color": GREEN, "lw": 1.4},
    )  # fmt: skip
    axes.text(0.46, -0.48, "swing angle", color=GREEN)
    axes.plot(0, 0, "o", mfc="white", mec=INK, ms=13, zorder=4)
    axes.plot(0, 0, "o", color=INK, ms=4, zorder=5)
    axes.text(-0.1, 0.17, "axis $z_i$", ha="center")
    axes.annotate("", (-0.6, 0.55), (-0.6, 0.0), arrowprops={"arrowstyle": "->", "color": INK, "lw": 1.4})
    axes.text(-0.72, 0.62, "$g$ (up)")
    axes.text(0.07, -1.12, "hangs still", color=SOFT)
    axes.set(xlim=(-0.95, 1.4), ylim=(-1.25, 0.85), aspect="equal")
    axes.set_axis_off()
    axes.set_title("Seen along the axis of joint i")


def draw_susceptibility_choice() -> Figure:
    """Draw the relative holding torques of two configurations of one pose, with the smallest and largest susceptibility."""
    arm = hf.arms.load("panda")
    pose = arm.forward_kinematics(np.array(hf.arms.about("panda").home))
    torque = hf.susceptibility.torque(arm, "effort")
    effort = np.array([joint.effort for joint in arm.joints])
    with style():
        figure = Figure(figsize=(WIDTH_IN, 2.9))
        axes = figure.subplots()
        for shift, color, name, objective in (
            (-0.19, BLUE, "best configuration", torque),
            (0.19, ORANGE, "worst configuration", torque.reversed()),
        ):
            q = hf.optimise(arm, pose, objective, seed=1).q
            axes.bar(np.arange(arm.n) + shift, 100 * np.abs(torque.by_joint(q)) / effort, width=0.36, color=color, label=name)
        axes.set(xticks=range(arm.n), xticklabels=[f"joint {joint + 1}" for joint in range(arm.n)])
        axes.set(ylabel="holding torque, % of the largest")
        axes.set_title("Panda, one tool pose")
        axes.legend()
        return settle_layout(figure)


def draw_failure_tolerant_inverse() -> Figure:
    """Draw the errors of one command over the damping, and the velocities of both laws after a lock."""
    arm = hf.arms.load("planar-3r")
    q, command, allowed = np.radians([30.0, 45.0, 60.0]), np.array([0.0, 1.0]), 0.5
    jacobian = arm.jacobian(q)[:2]
    dampings = np.linspace(0, 2.6, 261)
    rates = np.array([jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + d**2 * np.eye(2), command) for d in dampings])
    healthy = np.linalg.norm(command - rates @ jacobian.T, axis=1)
    locked = np.array([np.linalg.norm(command - (rates * (np.arange(3) != joint)) @ jacobian.T, axis=1) for joint in range(3)])
    plain = hf.control.pseudoinverse(arm, "planar")
    tolerant = hf.control.failure_tolerant(arm, "planar", pre_failure_error=allowed)
    chosen = float(tolerant.damping(q, command))
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.7))
        axes, plane = figure.subplots(1, 2, width_ratios=[1.4, 1])
        feasible = dampings <= float(tolerant.largest_damping(q, command))
        axes.axvspan(0, dampings[feasible][-1], color=EMPTY, lw=0)
        for joint, color in enumerate((AMBER, ORANGE, GREEN)):
            axes.plot(dampings, locked[joint], color=color, lw=1.3, label=f"joint {joint + 1} locked")
        axes.plot(dampings, locked.max(axis=0), color=BLUE, lw=2.6, label="largest (PKE)")
        axes.plot(dampings, healthy, color=INK, linestyle=(0, (4, 2)), lw=1.3, label="healthy")
        axes.plot(chosen, np.interp(chosen, dampings, locked.max(axis=0)), "o", color=BLUE, ms=7)
        axes.set(xlabel="damping $\\lambda$, m", ylabel="velocity error for a unit command", xlim=(0, 2.6), ylim=(0, 1.5))
        axes.set_title(f"Grey: healthy error at most {allowed:g}")
        axes.legend(loc="lower right", fontsize=8)
        worst = int(plain.deviations(q, command).worst_joint)
        _draw_arrow(plane, command, INK, "command")
        for law, color, name in ((plain, ORANGE, "pseudoinverse"), (tolerant, BLUE, "failure-tolerant")):
            all_rates = law.velocity(q, command)
            _draw_arrow(plane, jacobian @ all_rates, color, f"{name}, healthy", alpha=0.4)
            _draw_arrow(plane, jacobian @ (all_rates * (np.arange(3) != worst)), color, f"{name}, joint {worst + 1} locked")
        plane.set(xlim=(-0.9, 1.5), ylim=(-0.35, 1.75), aspect="equal", xlabel="x, m/s", ylabel="y, m/s")
        plane.set_title("Tool velocity")
        plane.legend(loc="upper right", fontsize=7.2)
        return settle_layout(figure)


def _draw_arrow(axes: Axes, tip: np.ndarray, color: str, label: str, *, alpha: float = 1.0) -> None:
    """Draw a velocity as an arrow from the origin."""
    axes.annotate("", tip, (0, 0), arrowprops={"arrowstyle": "-|>", "color": color, "lw": 1.8, "alpha": alpha})
    axes.plot([], [], color=color, lw=2, alpha=alpha, label=label)


def draw_workspace_measures() -> Figure:
    """Draw the definitions of R and F for one motion and a lock of joint 1."""
    arm = hf.arms.load("planar-3r")
    law = hf.control.pseudoinverse(arm, "planar")
    q0 = hf.self_motion(arm, WORKSPACE_START, "planar", spacing=0.1).q[START_ON_SELF_MOTION]
    low, high = np.degrees(hf.joint_bounds(arm, WORKSPACE_TARGET, "planar")[0][0])
    path = hf.simulate(law, q0, WORKSPACE_TARGET).path(samples=2000)
    tool, angle = np.asarray(path.x)[:, :2], np.degrees(np.asarray(path.q)[:, 0])
    length = np.r_[0, np.cumsum(np.linalg.norm(np.diff(tool, axis=0), axis=1))]
    fraction = np.linspace(0, 1, 1001)
    angle = np.interp(fraction, length / length[-1], angle)
    tool = np.column_stack([np.interp(fraction, length / length[-1], coordinate) for coordinate in tool.T])
    inside = (angle >= low) & (angle <= high)
    reached_fraction = 100 * (1 - fraction[np.argmax(inside)])
    instants = np.linspace(fraction[np.argmax(inside)], 1, 6)[:-1] + (1 - fraction[np.argmax(inside)]) / 10
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.9))
        plane, axes = figure.subplots(1, 2, width_ratios=[1, 1.35])
        draw_arm(plane, arm, q0, color=SKY)
        plane.plot(*np.where(inside[:, None], np.nan, tool).T, color=ORANGE, lw=2.4, label="outside the range")
        plane.plot(*np.where(inside[:, None], tool, np.nan).T, color=BLUE, lw=2.4, label="inside the range")
        for instant in instants:
            plane.plot(*tool[np.searchsorted(fraction, instant)], "o", mfc="white", mec=BLUE, ms=6, zorder=5)
        mark_target(plane, WORKSPACE_TARGET)
        frame_plane(plane, "Motion of the healthy arm", 2.6)
        plane.legend(loc="lower left", fontsize=8)
        axes.axhspan(low, high, color=EMPTY, lw=0)
        axes.plot(100 * fraction, np.where(inside, np.nan, angle), color=ORANGE, lw=2.4)
        axes.plot(100 * fraction, np.where(inside, angle, np.nan), color=BLUE, lw=2.4)
        axes.plot(100 * instants, np.interp(instants, fraction, angle), "o", mfc="white", mec=BLUE, ms=6)
        axes.axvline(100 * fraction[np.argmax(inside)], color=SOFT, lw=1, linestyle=(0, (4, 2)))
        axes.text(2, high - 4, "range of joint 1 over\nthe self-motion\nof the target", color=SOFT, va="top")
        axes.annotate("", (100, low - 12), (100 - reached_fraction, low - 12), arrowprops={"arrowstyle": "<->", "color": BLUE})
        axes.text(100 - reached_fraction / 2, low - 15, f"R = {reached_fraction:.0f} %", color=BLUE, ha="center", va="top")
        axes.text(97, 35, "F: fraction of these locks from\nwhich the failed arm arrives", color=BLUE, ha="right")
        axes.set(xlabel="distance along the tool path, %", ylabel="angle of joint 1, deg", xlim=(0, 100), ylim=(-60, 120))
        axes.set_title("Angle at which joint 1 would lock")
        return settle_layout(figure)


def draw_outcomes_of_undetected_locks() -> Figure:
    """Draw how the joints of a failed arm move in three cases: solution, sink, and limit cycle."""
    arm = hf.arms.load("planar-3r")
    law = hf.control.pseudoinverse(arm, "planar")
    cases = (
        ("Solution", 45.0, (1.5, 1.5), None),
        ("Sink: the arm stops elsewhere", 140.0, (1.5, 1.5), None),
        ("Limit cycle", 168.30, (0.9, 0.0), 4000.0),
    )
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.4))
        for axes, (name, locked_deg, target, limit) in zip(figure.subplots(1, 3), cases, strict=True):
            if limit is None:
                rng = np.random.default_rng(4)
                starts = np.radians(rng.uniform(-180, 180, (24, 3)))
                starts[:, 1] = np.radians(locked_deg)
            else:
                starts = np.radians([[-130.0, locked_deg, -84.0], [-121.0, locked_deg, -84.0]])
            runs = hf.simulate(law, starts, target, locked=["joint2"], time_limit=limit)
            for row in range(len(starts)):
                q = np.degrees(np.asarray(runs.path(row, until=None if limit is None else 1200.0, samples=1500).q))
                if limit is None:
                    q = (q + 180) % 360 - 180
                    jumps = np.any(np.abs(np.diff(q, axis=0)) > 180, axis=1)
                    q[1:][jumps] = np.nan
                axes.plot(q[:, 0], q[:, 2], color=BLUE if limit is None or row == 0 else SKY, lw=0.9)
                if limit is None:
                    color = GREEN if runs.outcome[row] == "converged" else ORANGE
                    axes.plot(q[-1, 0], q[-1, 2], "o", color=color, ms=6, zorder=4)
            axes.set(xlabel="joint 1, deg", ylabel="joint 3, deg")
            if limit is None:
                axes.set(xlim=(-180, 180), ylim=(-180, 180), xticks=range(-180, 181, 90), yticks=range(-180, 181, 90))
            axes.set_title(name)
        return settle_layout(figure)
