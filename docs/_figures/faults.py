"""Figures about injected faults, each drawn from a computation when the documentation is built."""

from __future__ import annotations

import math

import numpy as np
from concepts import WIDTH_IN
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

import holdfast as hf
from holdfast.interface.report import BLUE, GREEN, INK, ORANGE, SOFT, settle_layout, style

EPISODES = 12
HORIZON_S = 10.0
KIND_COLORS = {"locked": ORANGE, "weak": BLUE, "sensor_drift": GREEN}
TWO_JOINTS = """
<mujoco><option timestep="0.002" integrator="implicitfast"/><worldbody>
  <body name="upper"><joint name="joint1" axis="0 1 0" damping="0.3"/><geom type="capsule" size="0.03" fromto="0 0 0 0.4 0 0"/>
    <body name="lower" pos="0.4 0 0"><joint name="joint2" axis="0 1 0" damping="0.3"/>
      <geom type="capsule" size="0.02" fromto="0 0 0 0.3 0 0"/></body></body></worldbody>
  <actuator><position joint="joint1" kp="200" kv="8"/><position joint="joint2" kp="60" kv="2"/></actuator></mujoco>
"""
ONSET_S = 1.0


def draw_events() -> Figure:
    """Draw the faults of some episodes of the fault file of the guide."""
    arm = hf.arms.load("panda")
    entries = [
        hf.faults.locked(onset=(0.3, 1.5), probability=0.5),
        hf.faults.weak(["panda_joint2", "panda_joint4"], gain=(0.2, 0.7), onset={"exponential": 4.0}),
        hf.faults.sensor_drift(rate=0.02, rate_per_hour=120, duration=2.0),
    ]
    faults = hf.faults.FaultModel(entries, seed=7)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 4.2))
        axes = figure.subplots()
        for episode in range(EPISODES):
            events = faults.draw(arm, episode=episode, horizon=HORIZON_S)
            axes.axhline(episode, color=SOFT, lw=0.5, zorder=0)
            for place, event in enumerate(events):
                height = episode + 0.22 * (place - (len(events) - 1) / 2)
                end, color = min(event.end, HORIZON_S), KIND_COLORS[event.kind]
                axes.plot([event.onset, end], [height, height], color=color, lw=4, solid_capstyle="butt")
                axes.plot(event.onset, height, "o", color=color, ms=5)
                if math.isinf(event.end):
                    axes.plot(end, height, ">", color=color, ms=6, clip_on=False)
                axes.text(
                    event.onset - 0.08, height, event.joint.removeprefix("panda_joint"), ha="right", va="center", fontsize=8
                )
        axes.set(xlim=(-0.3, HORIZON_S), ylim=(EPISODES - 0.5, -0.5), xlabel="time, s", ylabel="episode")
        axes.set_title("Drawn faults; the number in front is the joint, and an arrow marks a permanent fault")
        handles = [Line2D([], [], color=color, lw=4, label=kind) for kind, color in KIND_COLORS.items()]
        figure.legend(handles=handles, loc="outside lower center", ncols=3)
        return settle_layout(figure)


def draw_injected() -> Figure:
    """Draw the angle of a joint of a MuJoCo model after different faults."""
    cases = [
        ("healthy", BLUE, []),
        ("locked", ORANGE, [hf.faults.FaultEvent("locked", "joint1", ONSET_S)]),
        ("limp", GREEN, [hf.faults.FaultEvent("limp", "joint1", ONSET_S)]),
        ("weak, gain 0.1", INK, [hf.faults.FaultEvent("weak", "joint1", ONSET_S, parameters={"gain": 0.1})]),
    ]
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.2))
        axes = figure.subplots()
        for name, color, events in cases:
            time, angles = _run_two_joints(events)
            axes.plot(time, np.degrees(angles), color=color, label=name)
        axes.axvline(ONSET_S, color=SOFT, linestyle=(0, (4, 2)))
        axes.set(xlabel="time, s", ylabel="joint 1, deg", xlim=(0, 3), ylim=(-40, 165))
        axes.legend(ncols=4, loc="upper left")
        return settle_layout(figure)


def _run_two_joints(events: list[hf.faults.FaultEvent]) -> tuple[np.ndarray, np.ndarray]:
    """Return times and angles of joint 1 of a simulated arm that follows a sine."""
    import mujoco

    model = mujoco.MjModel.from_xml_string(TWO_JOINTS)
    data = mujoco.MjData(model)
    injector = hf.faults.FaultInjector(model, data, ["joint1", "joint2"], faults=events)
    injector.reset(episode=0)
    times, angles = [], []
    while data.time < 3:
        data.ctrl[:] = 0.5 * np.sin(2 * data.time), 0.4 * np.sin(3 * data.time)
        injector.before_step(data.time)
        mujoco.mj_step(model, data)
        injector.restore()
        times.append(data.time)
        angles.append(data.qpos[0])
    return np.array(times), np.array(angles)
