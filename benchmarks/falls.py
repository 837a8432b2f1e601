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
    from holdfast.control.falls.simulator import FallSimulator

    hf.set_threads(threads)
    arm = panda.ours()
    model = hf.Friction(**friction)

    def tools(q: Array) -> Array:
        return hf.power_loss(arm, q, friction=model, stops=stops, duration=TIMES[-1], step=step).tool_at(TIMES)

    zero = np.zeros(panda.N)
    conditions = {**vars(model.of_joints(arm)), "brake_torque": zero, "brake_damping": zero, "brake_time": 1e300}
    simulator = FallSimulator(arm, stops, {**conditions, "restitution": 0.0, "free": np.ones(panda.N)})

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


# ---- to the first contact --------------------------------------------------------------------------------------------


def scene():
    """A table under the Panda, the ground, and eight boxes around it."""
    import holdfast as hf
    from holdfast.model.cell import Box, HalfSpace

    def at(x: float, y: float, z: float) -> Array:
        return np.array([[1.0, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]])

    heights, angles = np.linspace(0.1, 0.35, 8), np.deg2rad(np.linspace(-100, 100, 8))
    boxes = [
        Box(f"box {k}", [0.1, 0.12, height], pose=at(0.55 * np.cos(angle), 0.55 * np.sin(angle), height / 2 - 0.01))
        for k, (height, angle) in enumerate(zip(heights, angles, strict=True), 1)
    ]
    table = Box("table", [1.6, 2.0, 0.04], pose=at(0.3, 0, -0.03))
    cell = hf.Cell([HalfSpace("ground", pose=at(0, 0, -0.75)), table, *boxes], may_touch=[("table", "base")])
    return hf.Clearance(panda.ours(), cell=cell)


def moving_states(clearance, count: int) -> tuple[Array, Array]:
    """Configurations and rates along random motions between separated configurations, at most at half the speed limits."""
    rng = np.random.default_rng(5)
    ends = panda.configurations(20_000, seed=6)
    ends = ends[clearance(ends) > 0.01]
    start, end = ends[rng.integers(len(ends), size=(2, 4 * count))]
    phase, limit = rng.uniform(0, np.pi, (4 * count, 1)), np.array([joint.velocity for joint in panda.ours().joints])
    q = start + (end - start) * (1 - np.cos(phase)) / 2
    slowest = (np.abs(end - start) / (limit / 2)).max(axis=1, keepdims=True)  # duration at which the fastest is at its limit
    rates = (end - start) * np.sin(phase) / np.maximum(slowest, 1e-9)
    rows = np.flatnonzero(clearance(q) > 0.01)[:count]
    return q[rows], rates[rows]


def mujoco_contacts(clearance, step: float, duration: float) -> Callable[[Array, Array], Array]:
    """Times (N,) at which ``mj_step`` in a Python loop first sees a contact of the same capsules; infinite if never."""
    import mujoco

    spec, shapes = panda.ours().to_mujoco(), mujoco.mjtGeom
    for joint, dry in zip(spec.joints, DRY["coulomb"], strict=True):
        joint.frictionloss, joint.damping = dry, [DRY["viscous"], 0, 0]
    for number, part in enumerate(clearance.capsules):
        if part.link >= 0:
            shape = {"type": shapes.mjGEOM_CAPSULE, "fromto": [*part.start, *part.end]}
            if part.length == 0:
                shape = {"type": shapes.mjGEOM_SPHERE, "pos": part.start}
            options = {"name": f"part {number}", "size": [part.radius, 0, 0], "mass": 0.0, "contype": 1, "conaffinity": 2}
            spec.bodies[part.link + 1].add_geom(**options, **shape)
    for solid in clearance.cell:
        shape = {"type": shapes.mjGEOM_PLANE, "size": [0, 0, 1]}
        if hasattr(solid, "size"):
            shape = {"type": shapes.mjGEOM_BOX, "size": solid.size / 2}
        spec.worldbody.add_geom(pos=solid.pose[:3, 3], contype=2, conaffinity=1, **shape)
    for first, second in clearance.pairs:
        if min(clearance.capsules.parts[part].link for part in (first, second)) >= 0:
            spec.add_pair(geomname1=f"part {first}", geomname2=f"part {second}")
    model = spec.compile()
    model.opt.timestep, model.opt.integrator = step, mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    data = mujoco.MjData(model)

    def run(q: Array, rates: Array) -> Array:
        times = np.full(len(q), np.inf)
        for k, (row, rate) in enumerate(zip(q, rates, strict=True)):
            mujoco.mj_resetData(model, data)
            data.qpos[:], data.qvel[:] = row, rate
            while data.time < duration:
                mujoco.mj_step(model, data)
                if data.ncon:
                    times[k] = data.time
                    break
        return times

    return run


def contact_table(chosen: argparse.Namespace) -> str:
    """Rates of falls to their first contact, and how the contacts of both compare."""
    import holdfast as hf

    hf.set_threads(1)  # as MuJoCo's loop
    clearance, duration, step = scene(), 2.0, 2e-3
    q, rates = moving_states(clearance, 2_000 if chosen.quick else 16_532)
    few = slice(0, 60 if chosen.quick else 200)
    friction, peer = hf.Friction(**DRY), mujoco_contacts(clearance, step, duration)

    def run(step: float = step):
        return hf.power_loss(panda.ours(), q, rates, friction=friction, clearance=clearance, duration=duration, step=step)

    lines = [
        f"### W19: {len(q):,} falls of a moving Panda to the first contact with itself or one of 10 objects",
        "",
        f"| contender | processor time of all, s (range) | falls/s of a core | MuJoCo IMPLICITFAST {step * 1e3:g} ms, falls/s "
        "| holdfast is faster by (range) |",
        "| --- | ---: | ---: | ---: | ---: |",
    ]
    for size in (step, 4 * step):
        ours, theirs = harness.alternate(
            lambda size=size: run(size), lambda: peer(q[few], rates[few]), chosen.rounds, time.process_time
        )
        ratios = [(b / len(q[few])) / (a / len(q)) for a, b in zip(ours, theirs, strict=True)]
        speeds = (harness.number(len(x) / float(np.median(y))) for x, y in ((q, ours), (q[few], theirs)))
        name = f"**holdfast {size * 1e3:g} ms, 1 thread**"
        lines.append(f"| {name} | {harness.Spread.of(ours)} | {' | '.join(speeds)} | {harness.Spread.of(ratios)} |")
    fall, seen = run(), peer(q[few], rates[few])
    touched, contact = fall.contacts.pair[few] >= 0, fall.contacts
    later = 1e3 * (seen - contact.time[few])[touched & np.isfinite(seen)]
    medians = [
        float(np.nanmedian(x)) for x in (contact.time, contact.normal_speed, contact.effective_mass, contact.energy_lost)
    ]
    lines += [
        "",
        f"{(contact.pair >= 0).mean():.2%} touch, medians: after {medians[0]:.2f} s, at {medians[1]:.1f} m/s, "
        f"{medians[2]:.1f} kg, {medians[3]:.1f} J lost. Of {len(seen)} falls, MuJoCo sees {np.isfinite(seen).sum()} touch and "
        f"holdfast {touched.sum()}; holdfast misses {(np.isfinite(seen) & ~touched).sum()} of them. MuJoCo sees a contact "
        f"{np.median(later):.1f} ms later (median; earliest {later.min():.1f} ms), because spheres enclose the capsules.",
    ]
    return "\n".join(lines) + "\n"


def main() -> None:
    chosen = harness.options(__doc__)
    dry = "Panda, falls of 1 s, dry friction 0.5 (shoulder and elbow) and 0.3 N m (wrist), viscous 0.1 N m s/rad, stops"
    smooth = "Panda, falls of 1 s, viscous friction 0.5 N m s/rad only, no stops"
    print(block(dry, DRY, True, chosen, [("RK4", 5e-3), ("RK4", 2e-3), ("IMPLICITFAST", 2e-3)]))
    print(block(smooth, SMOOTH, False, chosen, [("RK4", 5e-3)]))
    print(contact_table(chosen))
    print(
        "Error: distance of the tool point from the event-driven reference, median (95 %) of 60 random poses from rest. "
        "MuJoCo's frictionloss is a soft constraint, so a part of its error is another friction, at any step. "
        "The second simulation with doubled steps, from which `power_loss` estimates its error, is not timed; it adds half."
    )


if __name__ == "__main__":
    main()
