"""W19: falls of a Panda after a power loss, next to MuJoCo's Python loop and its threaded rollout, with the error of each.

The reference is the tests' event-driven one: DOP853 between located events, Pinocchio's dynamics.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

import harness
import panda
from harness import Array

sys.path.append(str(Path(__file__).parents[1] / "tests"))  # the event-driven reference

TIMES = (0.3, 1.0)
DRY = {"coulomb": [0.5] * 4 + [0.3] * 3, "viscous": 0.1}  # N m; N m s/rad
SMOOTH = {"viscous": 0.5}
THREADS = 2

FrictionNumbers = dict[str, Any]  # of hf.Friction
Fall = Callable[[Array], Array]  # configurations (N, 7) -> tool points (N, times, 3)


def holdfast(friction: FrictionNumbers, stops: bool, step: float, threads: int = THREADS) -> tuple[Fall, Fall]:
    """Tool points at the times, for the error; and the simulation alone to the end, for the time."""
    import holdfast as hf
    from holdfast.control.falls import simulator as falls

    hf.set_threads(threads)
    arm = panda.ours()
    model = hf.Friction(**friction)

    def tools(q: Array) -> Array:
        return hf.power_loss(arm, q, friction=model, stops=stops, duration=TIMES[-1], step=step).tool_at(TIMES)

    zero = np.zeros(panda.N)
    conditions = {**vars(model.of_joints(arm)), "brake_torque": zero, "brake_damping": zero, "brake_time": falls.never()}
    simulator = falls.FallSimulator(arm, stops, {**conditions, "restitution": 0.0, "free": np.ones(panda.N)})

    def run(q: Array) -> Array:
        return simulator.run(q, np.zeros_like(q), np.full(len(q), TIMES[-1]), np.full(len(q), step)).tool

    return tools, run


def mujoco_model(friction: FrictionNumbers, stops: bool, step: float, integrator: str):
    import mujoco

    arm = panda.ours() if stops else panda.ours().without_limits
    joints = tuple(replace(joint, friction=friction["viscous"]) for joint in arm.joints)
    spec = replace(arm, joints=joints).to_mujoco()
    for joint, dry in zip(spec.joints, np.broadcast_to(friction.get("coulomb", 0.0), panda.N), strict=True):
        joint.frictionloss = dry
    model = spec.compile()
    model.opt.timestep, model.opt.integrator = step, getattr(mujoco.mjtIntegrator, f"mjINT_{integrator}")
    return model


def mujoco_loop(friction: FrictionNumbers, stops: bool, step: float, integrator: str) -> Fall:
    """``mj_step`` in a Python loop; dry friction is ``frictionloss``."""
    import mujoco

    model = mujoco_model(friction, stops, step, integrator)
    data, site = mujoco.MjData(model), model.site("tool").id
    counts = [round(time / step) for time in TIMES]

    def run(q: Array) -> Array:
        tools = np.empty((len(q), len(TIMES), 3))
        for row, out in zip(q, tools, strict=True):
            mujoco.mj_resetData(model, data)
            data.qpos[:] = row
            for k in range(1, counts[-1] + 1):
                mujoco.mj_step(model, data)
                if k in counts:
                    mujoco.mj_kinematics(model, data)
                    out[counts.index(k)] = data.site_xpos[site]
        return tools

    return run


def mujoco_rollout(friction: FrictionNumbers, stops: bool, step: float, integrator: str) -> Fall:
    """``mujoco.rollout`` on the same cores; it returns states, of which only the time is measured."""
    import mujoco
    from mujoco import rollout

    model = mujoco_model(friction, stops, step, integrator)
    threads = [mujoco.MjData(model) for _ in range(THREADS)]

    def run(q: Array) -> Array:
        start = np.zeros((len(q), mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS)))
        start[:, 1 : 1 + panda.N] = q
        states, _ = rollout.rollout(model, threads, start, nstep=round(TIMES[-1] / step))
        return states

    return run


def reference(q: Array, friction: FrictionNumbers, stops: bool) -> Array:
    from fall_reference import Reference

    made = Reference(panda.ours(), stops=stops, **friction)
    return np.array([[made.tool_at(end) for end in made.run(row, np.zeros(panda.N), TIMES)[0]] for row in q])


def millimetres(tools: Array, expected: Array) -> str:
    errors = 1e3 * np.linalg.norm(tools - expected, axis=2)
    return " | ".join(f"{np.median(column):.3g} ({np.percentile(column, 95):.3g})" for column in errors.T)


def block(
    title: str, friction: FrictionNumbers, stops: bool, chosen: argparse.Namespace, peers: list[tuple[str, float]]
) -> str:
    """A table of errors and rates. The ratios are those of rounds in which both ran."""
    sample = panda.configurations(20 if chosen.quick else 60, seed=1)
    expected = reference(sample, friction, stops)
    q = panda.configurations(2_000 if chosen.quick else 8_000, seed=2)
    base = 8e-3 if stops else 5e-3
    lines = [
        f"### W19: {title}",
        "",
        f"| contender | falls per second of a core | holdfast {base * 1e3:g} ms is faster by (range) "
        f"| error at {TIMES[0]} s, mm | at {TIMES[1]} s, mm |",
        "| --- | ---: | ---: | ---: | ---: |",
    ]
    _, run = holdfast(friction, stops, base)
    for step in (8e-3, 4e-3, 2e-3) if stops else (5e-3, 2e-3):
        tools, alone = holdfast(friction, stops, step)
        alone(q)
        rates = [len(q) / harness.seconds(lambda alone=alone: alone(q), time.process_time) for _ in range(chosen.rounds)]
        name = f"**holdfast {step * 1e3:g} ms, {THREADS} threads**"
        lines.append(f"| {name} | {harness.number(float(np.median(rates)))} | - | {millimetres(tools(sample), expected)} |")
    for integrator, step in peers:
        loop = mujoco_loop(friction, stops, step, integrator)
        errors = millimetres(loop(sample), expected)
        for kind, make in (("Python loop", mujoco_loop), ("rollout, 2 threads", mujoco_rollout)):
            few = q[: 20 if chosen.quick else 60]
            peer = make(friction, stops, step, integrator)
            ours, theirs = harness.alternate(
                lambda: run(q), lambda peer=peer, few=few: peer(few), chosen.rounds, time.process_time
            )
            ratios = [(b / len(few)) / (a / len(q)) for a, b in zip(ours, theirs, strict=True)]
            rate = len(few) / float(np.median(theirs))
            name = f"MuJoCo {integrator} {step * 1e3:g} ms, {kind}"
            lines.append(f"| {name} | {harness.number(rate)} | {harness.Spread.of(ratios)} | {errors} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    chosen = harness.options(__doc__)
    dry = "Panda, falls of 1 s, dry friction 0.5 (shoulder and elbow) and 0.3 N m (wrist), viscous 0.1 N m s/rad, stops"
    smooth = "Panda, falls of 1 s, viscous friction 0.5 N m s/rad only, no stops"
    print(block(dry, DRY, True, chosen, [("RK4", 5e-3), ("RK4", 2e-3), ("IMPLICITFAST", 2e-3)]))
    print(block(smooth, SMOOTH, False, chosen, [("RK4", 5e-3)]))
    print(
        "Error: distance of the tool point from the event-driven reference, median (95 %) of 60 random poses from rest. "
        "MuJoCo's frictionloss is a soft constraint, so a part of its error is another friction, at any step. "
        "The second simulation with doubled steps, from which `power_loss` estimates its error, is not timed; it adds half."
    )


if __name__ == "__main__":
    main()
