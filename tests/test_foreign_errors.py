"""No public call answers a wrong argument with an error of another package: good calls, one argument spoilt at a time."""

from __future__ import annotations

import contextlib
import inspect
import signal
import warnings
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import holdfast as hf
from holdfast.model.arms.builtin import DATA_FOLDER

NAN, INF = float("nan"), float("inf")
SPOILT: list[Any] = [
    *(None, True, -1, 0, 1, 10**30, 0.5, -2.5, NAN, INF, -INF, 1e300, 1j, "", "no such thing", "nan", b"bytes", object, print),
    *([], {}, set(), [[]], [1, 2], [1, [2, 3]], ["a"], [None], {"no such joint": 0.1}, {"joint1": "x"}, {7: 1.0}, (1, 2, 3, 4)),
    *(np.zeros(0), np.zeros((0, 3)), np.zeros((2, 2, 2)), np.full(3, NAN), np.full(2, INF), np.ones(3) * 1j, np.eye(4) * 2),
    *(np.array(["a", "b"]), np.array([None, 1.0]), np.array(3), np.full((4, 4), NAN), Path("/proc/none/here"), "\0", range(3)),
]


@cache
def good() -> dict[str, Any]:
    """Things to call with: a planar arm, small tasks, quick runs."""
    arm = hf.arms.load("planar-3r")
    law = hf.control.pseudoinverse(arm, "planar")
    q = np.array([0.3, 0.6, 0.9])
    region = hf.Region.box([1.0, 1.0, 0], [0.5, 0.5, 0])
    index = hf.indices.relative_manipulability(arm, "planar")
    run = hf.assess(arm, region, index, poses=10, after_lock=True)
    place = arm.forward_kinematics(q)[:3, 3]
    line = hf.paths.line([1.5, 1.5, 0], [1.6, 1.5, 0])
    return {
        "arm": arm,
        "panda": hf.arms.load("panda"),
        "law": law,
        "q": q,
        "region": region,
        "index": index,
        "run": run,
        "runs": hf.simulate(law, q, [1.5, 1.5]),
        "path": line,
        "timed": hf.paths.TimedPath(line, hf.paths.Constant(1.0)),
        "tiny": hf.paths.TimedPath(hf.paths.line(place, place + np.full(3, 5e-5)), hf.paths.Constant(1.0)),
        "capsules": hf.Capsules.along_links(arm),
    }


def calls(folder: Path) -> dict[str, tuple[Callable[..., Any], dict[str, Any]]]:
    """A good call of every public function, as small as it can be."""
    g = good()
    arm, law, q, region, index, run = (g[x] for x in ("arm", "law", "q", "region", "index", "run"))
    target, pose = [1.5, 1.5], arm.forward_kinematics(q)
    at_planar = {"arm": arm, "task": "planar"}
    claim = hf.certificates.reach_claim(arm, (1.2, 0.5), 0.1)
    urdf = str(DATA_FOLDER.joinpath("iiwa14.urdf"))
    found: dict[str, tuple[Callable[..., Any], dict[str, Any]]] = {
        "all_configurations": (
            hf.all_configurations,
            {
                **at_planar,
                "pose": target,
                "limits": None,
                "tolerance": 0.0,
                "time_limit": 5.0,
                "most_boxes": 100,
                "first": True,
            },
        ),
        "assess": (
            hf.assess,
            {"arm": arm, "region": region, "index": index, "poses": 5, "seed": 0, "sampling": "random", "restarts": 2}
            | {"store": folder / "a", "keep": None, "task": "planar", "after_lock": False, "locked": {0: 0.1}, "margin": 0.0},
        ),
        "certify": (
            hf.certify,
            {"claim": claim, "halvings": 2, "time_limit": 5.0, "seed": 0},
        ),
        "check_certificate": (hf.check_certificate, {"file": str(folder / "none.certificate"), "sample": 1, "workers": 1}),
        "basins": (
            hf.basins,
            {"law": law, "target": target, "locked": {1: 0.5}, "starts": 5, "grid": None, "seed": 0}
            | {"time_limit": 5.0, "confidence": 0.95},
        ),
        "compare_laws best": (
            hf.compare_laws,
            {"laws": [law, hf.control.damped(arm, 0.1, "planar")], "q0": 3, "target": 2, "best": True},
        ),
        "check_cell": (hf.check_cell, {"cell": hf.Cell([hf.cell.Sphere("ball", 0.1, pose=[1.0, 1.0, 0.5])]), "arm": arm}),
        "compare_assessments": (hf.compare_assessments, {"assessments": [run, run], "names": ["a", "b"], "threshold": 0.1}),
        "compare_laws": (
            hf.compare_laws,
            {"laws": [law], "q0": q, "target": target, "failures": [1], "cycles": False, "time_limit": 5.0}
            | {"tolerance": 1e-8, "radius": 0.1, "restarts": 2, "seed": 0},
        ),
        "convergence_map": (
            hf.convergence_map,
            {"law": law, "targets": target, "starts": 3, "configurations": 1, "over": "starts"}
            | {"q0": None, "time_limit": 5.0, "tolerance": 1e-8, "seed": 0},
        ),
        "design": (
            hf.design,
            {"arm": arm, "vary": {"a2": (0.5, 1.5)}, "region": region, "task": "planar", "objective": index.slug}
            | {
                "level": 0.9,
                "poses": 4,
                "designs": 4,
                "local_searches": 0,
                "check_poses": 4,
                "seed": 0,
                "failures": "single",
                "length": 1.0,
            },
        ),
        "evaluate_motion": (
            hf.evaluate_motion,
            {"arm": arm, "motion": np.tile(q, (3, 1)), "path": g["tiny"], "rates": None, "mode": "on-path", "task": "planar"}
            | {"per_second": False, "samples": 3, "spacing": 0.3, "seed": 0, "starts": 4, "clearance": None, "margin": 0.0},
        ),
        "plan_motion": (
            hf.plan_motion,
            {"arm": arm, "path": g["timed"], "rates": [1.0, 2.0, 0.0], "mode": "on-path", "task": "planar", "samples": 3}
            | {"per_second": False, "spacing": 0.3, "start": None, "seed": 0, "starts": 4, "clearance": None, "margin": 0.0},
        ),
        "plan_motion_to": (
            hf.plan_motion_to,
            {**at_planar, "start": q, "goal": target, "rates": None, "velocity": 1.0, "spacing": 0.3, "seed": 0, "starts": 4}
            | {"per_second": False},
        ),
        "execute": (
            hf.execute,
            {"arm": arm, "q": [q, q + 0.1], "time": [0.0, 0.1], "locked": ["joint2"], "lock_time": 0.05, "notice": 0.01}
            | {"stop": 0.01, "goal": pose, "keep": None, "settle": 0.0, "clearance": None, "cell": None},
        ),
        "follow": (
            hf.follow,
            {"arm": arm, "path": g["timed"], "maximise": index, "method": "gradient-projection", "q": q, "gain": 0.1}
            | {"wanted": None, "rate_cap": None, "task": "planar", "samples": 3, "damping": 0.05, "seed": 0, "spacing": 0.1},
        ),
        "holds": (hf.holds, {"arm": arm, "q": q, "free": [1], "friction": None, "effort": 0.0, "stops": False}),
        "power_loss": (
            hf.power_loss,
            {"arm": arm, "q": q, "rates": q, "free": [1], "friction": None, "brakes": None, "restitution": 0.0, "stops": False}
            | {"duration": 0.1, "step": 0.01, "accuracy": None},
        ),
        "power_loss_along": (
            hf.power_loss_along,
            {"arm": arm, "q": np.tile(q, (5, 1)), "time": np.arange(5.0), "rates": None, "refine": False, "duration": 0.1},
        ),
        "power_loss_probability": (
            hf.power_loss_probability,
            {"arm": arm, "below": 0.1, "measure": "drop", "where": None, "q": None, "samples": 3, "seed": 0, "cell": None}
            | {"clearance": None, "duration": 0.1},
        ),
        "compare_brakes": (
            hf.compare_brakes,
            {"arm": arm, "q": q, "rates": None, "torque": [3.0], "after": [0.1], "friction": None, "duration": 0.2},
        ),
        "stow": (
            hf.stow,
            {"arm": arm, "at": q, "friction": None, "factor": 1.5, "where": None, "cell": None, "clearance": None}
            | {"margin": 0.0, "speeds": 1.0, "samples": 20, "seed": 0},
        ),
        "plan_stow_path": (
            hf.plan_stow_path,
            {"stow": hf.stow(arm, q, speeds=1.0, samples=20), "monotone": False, "tolerance": 0.1, "nodes": 2}
            | {"duration": 0.1},
        ),
        "joint_bounds": (hf.joint_bounds, {**at_planar, "target": target, "seed": 0, "starts": 4}),
        "load": (hf.load, {"path": folder / "none"}),
        "optimise": (
            hf.optimise,
            {**at_planar, "poses": pose, "objective": index, "seed": 0, "starts": 2, "restarts": 2, "tolerance": 1e-6}
            | {"clearance": None, "margin": 0.0},
        ),
        "point_to_point": (
            hf.point_to_point,
            {**at_planar, "count": 2, "seed": 0, "distance": (0.2, 2.0), "failures": None} | {"restarts": 2},
        ),
        "reachable_when_locked": (
            hf.reachable_when_locked,
            {**at_planar, "target": target, "locked": {1: 0.3}, "seed": 0} | {"restarts": 2, "tolerance": 1e-6},
        ),
        "Degraded": (
            hf.Degraded,
            {"arm": arm, "locked": {"joint2": 0.6}, "ranges": {"joint1": (-1.0, 1.0)}, "speeds": {"joint3": 0.5}},
        ),
        "Degraded.at": (hf.Degraded(arm, locked=[1]).at, {"q": q}),
        "recover": (
            hf.recover,
            {**at_planar, "locked": {"joint2": 0.6}, "at": q, "goal": [0.4, 0.6, 0.8], "clearance": False, "margin": 0.0}
            | {"metric": "travel", "weights": None, "region": None, "samples": 0, "starts": 4, "tries": 0, "seed": 0}
            | {"time_limit": 5.0, "keep": hf.tool_constraints.plane([0.0, 0.0, 1.0])},
        ),
        "keep.upright": (hf.tool_constraints.upright, {"angle": 0.1, "axis": [0.0, 0.0, 1.0], "within": [1e-3, 1e-2]}),
        "keep.rail": (hf.tool_constraints.rail, {"direction": [0.0, 0.0, 1.0], "frame": "tool", "pose": np.eye(4)}),
        "keep.plane": (hf.tool_constraints.plane, {"normal": [0.0, 0.0, 1.0], "angle": 0.1, "pose": np.eye(4)}),
        "keep.by_label": (hf.tool_constraints.by_label, {"label": "upright:0.1"}),
        "self_motion": (hf.self_motion, {**at_planar, "target": target, "spacing": 0.3, "seed": 0, "starts": 4}),
        "simulate": (
            hf.simulate,
            {"law": law, "q0": q, "target": target, "locked": [1], "time": 0.5, "cycles": False, "method": "adaptive"}
            | {"time_limit": 5.0, "tolerance": 1e-8, "step": None, "radius": 0.1},
        ),
        "solve_ik": (hf.solve_ik, {**at_planar, "poses": pose, "seed": 0, "restarts": 2, "tolerance": 1e-6, "start": q}),
        "stationary_points": (hf.stationary_points, {"law": law, "target": target, "locked": {1: 0.5}, "seed": 0}),
        "workspace over targets": (
            hf.workspace,
            {"law": law, "target": [target], "over": "targets", "starts": 3, "configurations": 1, "seed": 0},
        ),
        "find_working_ranges": (
            hf.find_working_ranges,
            {"arm": arm, "centre": (1.2, 0.5), "size": 0.1, "task": "planar", "rotation": None, "rpy": None}
            | {"working_ranges": None, "failures": "single", "targets": 4, "values": 4, "margin": 0.05, "seed": 0},
        ),
        "explain_ik": (
            hf.explain_ik,
            {"arm": arm, "pose": target, "task": "planar", "clearance": False, "margin": 0.0, "starts": 3, "time_limit": 1.0}
            | {"seed": 0},
        ),
        "reachability_map": (
            hf.reachability_map,
            {"arm": arm, "at": q, "cell_size": 0.5, "bands": 2, "lock_values": 2, "samples": 100, "seed": 0},
        ),
        "tolerant_workspace": (
            hf.tolerant_workspace,
            {**at_planar, "limits": None, "rotation": None, "points": 5, "angles": 4, "seed": 0} | {"confidence": 0.95},
        ),
        "workspace": (
            hf.workspace,
            {"law": law, "target": target, "starts": 3, "configurations": 1, "cells": 5, "seed": 0}
            | {"relative_to": "inside", "tolerance": 1e-8, "time_limit": 5.0, "method": None},
        ),
        "arms.about": (hf.arms.about, {"name": "panda"}),
        "arms.load": (hf.arms.load, {"source": urdf, "base": None, "tip": None, "hold": {}}),
        "Arm.from_urdf": (
            hf.Arm.from_urdf,
            {"path": urdf, "base": None, "tip": None, "hold": {}, "name": "x", "gravity": (0, 0, -9.81)},
        ),
        "Arm.from_mjcf": (hf.Arm.from_mjcf, {"path": folder / "none.xml"}),
        "Arm.from_dh": (
            hf.Arm.from_dh,
            {"rows": [hf.DH(1.0, 0.0)], "links": None, "convention": "standard", "base": None, "tool": None}
            | {"gravity": (0, 0, -9.81), "payload": None, "name": "arm", "source": ""},
        ),
        "DH": (
            lambda **row: hf.Arm.from_dh([hf.DH(**row)]),
            {"a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0, "type": "revolute"}
            | {"lower": -1.0, "upper": 1.0, "name": "j", "velocity": 1.0, "effort": 1.0, "friction": 0.0, "armature": 0.0},
        ),
        "Joint": (
            hf.Joint,
            {"name": "j", "type": "revolute", "origin": np.eye(4), "axis": [0, 0, 1], "lower": -1.0, "upper": 1.0}
            | {"velocity": 1.0, "effort": 1.0, "friction": 0.0, "armature": 0.0},
        ),
        "Link": (hf.Link, {"mass": 1.0, "com": [0, 0, 0], "inertia": np.eye(3), "name": "l"}),
        "Arm": (
            hf.Arm,
            {"name": "a", "joints": arm.joints, "links": arm.links, "base": np.eye(4), "tool": np.eye(4), "payload": None}
            | {"gravity": [0, 0, -9.81], "flange": np.eye(4)},
        ),
        "Task": (hf.Task, {"name": "t", "rows": np.eye(6)[:2], "frame": "base", "length": 1.0}),
        "Servos": (
            lambda **o: hf.simulate_physics(law, q, target, locked=(), servos=hf.Servos(**o), time_limit=0.01),
            {"bandwidth": 10.0, "ratio": 1.0, "rate": 500.0}
            | {"compensation": 1.0, "stiffness": None, "damping": None, "step": 0.001},
        ),
        "simulate_faults": (
            hf.simulate_faults,
            {"law": law, "q0": q, "target": target, "faults": (), "episode": 0, "monitor": None, "react": None, "plan": True}
            | {"body": None, "servos": None, "centring": 0.0, "pose": True, "time_limit": 0.01, "seed": 0},
        ),
        "DesignSpace": (lambda vary: hf.design(arm, vary, "no such index"), {"vary": {"a2": (0.5, 1.5)}}),
        "Region.box": (
            hf.Region.box,
            {"center": [1, 1, 0], "size": [1, 1, 0], "rpy_center": [0, 0, 0], "rpy_size": [0, 0, 0], "name": "r"}
            | {"weight": None},
        ),
        "Region.joints": (hf.Region.joints, {"lower": [0, 0, 0], "upper": [1, 1, 1], "name": "r"}),
        "Region.around": (hf.Region.around_tool, {"arm": arm, "q": q, "share": 0.3}),
        "Region.from_poses": (hf.Region.from_poses, {"poses": [pose], "weights": [1.0], "name": "r"}),
        "Region.load": (hf.Region.load, {"path": folder / "none.yaml"}),
        "paths.line": (hf.paths.line, {"start": [0, 0, 0], "end": [1, 0, 0], "name": "l"}),
        "paths.arc": (
            hf.paths.arc,
            {"start": [1, 0, 0], "via": None, "end": None, "center": [0, 0, 0], "axis": [0, 0, 1], "angle": 1.0},
        ),
        "paths.sequence": (hf.paths.sequence, {"poses": [[0, 0, 0], [1, 0, 0]], "name": "s"}),
        "paths.TimedPath": (hf.paths.TimedPath, {"path": g["path"], "timing": hf.paths.Constant(1.0), "stop": False}),
        "paths.Constant": (hf.paths.Constant, {"duration": 1.0}),
        "paths.Trapezoid": (hf.paths.Trapezoid, {"duration": 1.0, "accelerate": 0.2, "decelerate": 0.2}),
        "paths.Path.load": (hf.paths.Path.load, {"file": folder / "none.yaml"}),
        "paths.TimedPath.load": (hf.paths.TimedPath.load, {"file": folder / "none.yaml"}),
        "timed.pose": (g["timed"].pose, {"t": 0.5}),
        "path.pose": (g["path"].pose, {"s": 0.5}),
        "Capsules.along": (hf.Capsules.along_links, {"arm": arm, "radius": 0.1}),
        "Capsules.load": (hf.Capsules.load, {"path": folder / "none.yaml", "arm": arm}),
        "Clearance": (hf.Clearance, {"arm": g["panda"], "capsules": None}),
        "index.evaluate": (index.evaluate, {"q": q}),
        "index.gradient": (index.gradient, {"q": q}),
        "indices.by_name": (hf.indices.by_name, {**at_planar, "name": "manipulability", "failures": "single", "length": 1.0}),
        "indices.CustomIndex": (
            hf.indices.CustomIndex,
            {**at_planar, "formula": lambda j: j[0, 0], "name": "x", "unit": "m", "failures": 1},
        ),
        "indices.WeightedSum": (hf.indices.WeightedSum, {"terms": [(1.0, index)], "name": "x"}),
        "indices.Opposite": (hf.indices.NegatedObjective, {"objective": index}),
        "susceptibility.by_name": (hf.susceptibility.by_name, {"arm": arm, "name": "torque", "weights": None}),
        "control.by_name": (
            hf.control.by_name,
            {"name": "damped", **at_planar, "damping": 0.1, "gain": 1.0, "speed_limit": 1.0},
        ),
        "control.weighted": (hf.control.weighted, {**at_planar, "weights": [1, 1, 1], "gain": 1.0}),
        "control.failure_tolerant": (hf.control.failure_tolerant, {**at_planar, "pre_failure_error": 0.5}),
        "control.GradientProjection": (
            hf.path_following.GradientProjection,
            {**at_planar, "objective": index, "gain": 1.0, "rate_cap": 1.0} | {"period": 0.01},
        ),
        "control.trade_off": (hf.control.trade_off, {**at_planar, "samples": 5, "allowed": [0.0, 0.5], "seed": 0}),
        "control.slow_enough": (
            hf.path_following.slow_enough,
            {"arm": arm, "q": [q] * 3, "qd": [q] * 3, "qdd": [q] * 3, "bound": 100.0},
        ),
        "law.velocity": (law.velocity, {"q": q, "v": [0.1, 0]}),
        "law.deviations": (law.deviations, {"q": q, "v": [0.1, 0]}),
        "law.export_c": (law.export_c, {"folder": folder / "c", "name": "x"}),
        "runs.path": (g["runs"].path, {"k": 0, "samples": 3, "until": None}),
        "runs.least_error": (g["runs"].least_error, {"restarts": 1, "seed": 0}),
        "run.report": (run.report, {"path": folder / "r.html", "threshold": 0.1}),
        "run.save": (run.save, {"folder": folder / "saved"}),
        "run.interval": (run.interval, {"at_least": 0.1, "at_most": None, "optimised": False, "confidence": 0.95}),
        "run.cdf": (run.cdf, {"h": 0.1}),
        "run.survival": (run.survival, {"joint": None, "confidence": 0.95}),
        "run.expected_survival": (run.expected_survival, {"rates": {"joint1": 1.0}}),
        "run.if_never_fails": (run.if_never_fails, {"joint": 0}),
        "run.upgrades": (run.upgrades, {"threshold": 0.1, "confidence": 0.95}),
    }
    for name in (
        "forward_kinematics",
        "jacobian",
        "jacobian_derivative",
        "gravity_torque",
        "inertia_diagonal",
        "check_configurations",
    ):
        found[f"arm.{name}"] = getattr(arm, name), {"q": q}
    found["arm.inverse_dynamics"] = arm.inverse_dynamics, {"q": q, "qd": q, "qdd": q}
    for name, value in (("tool", np.eye(4)), ("base", np.eye(4)), ("payload", None)):
        found[f"arm.with_{name}"] = getattr(arm, f"with_{name}"), {name: value}
    found["arm.joint_index"] = arm.joint_index, {"joint": 1}
    return found


NAMES = sorted(calls(Path("/nowhere")))


class Slow(BaseException):
    """Accepted, and at work."""


@contextlib.contextmanager
def seconds(limit: float) -> Iterator[None]:
    def stop(*_: object) -> None:
        raise Slow

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, limit)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def foreign(function: Callable[..., Any], arguments: dict[str, Any]) -> Exception | None:
    """The error that is none of holdfast's."""
    try:
        with warnings.catch_warnings(), seconds(2.0):
            warnings.simplefilter("ignore")
            function(**arguments)
    except (hf.HoldfastError, Slow):
        pass
    except Exception as error:
        return error
    return None


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")  # the alarm may ring in a destructor
@pytest.mark.parametrize("name", NAMES)
def test_a_spoilt_argument_gets_a_sentence(
    name: str, tmp_path: Path, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)  # MuJoCo writes its log there
    function, arguments = calls(tmp_path)[name]
    with contextlib.suppress(hf.HoldfastError):
        function(**arguments)  # compiled before the clock runs
    wrong = []
    for argument in arguments:
        for k in rng.choice(len(SPOILT), size=3, replace=False):
            error = foreign(function, {**arguments, argument: SPOILT[k]})
            if error is not None:
                wrong.append(f"{argument}={SPOILT[k]!r}: {type(error).__name__}: {error}")
    assert not wrong, "\n".join(wrong)


def test_every_public_function_is_among_them() -> None:
    public = {n for n in hf.__all__ if inspect.isfunction(getattr(hf, n))}
    spared = {"design_for_convergence", "set_threads", "set_backend", "simulate_physics"}  # minutes; numbers; by way of Servos
    assert public - spared <= set(NAMES)


def test_a_call_that_python_refuses_is_refused_by_python() -> None:
    law, q = good()["law"], good()["q"]
    for wrong in (
        lambda: law.velocity(q),
        lambda: law.velocity(q, q[:2], q),
        lambda: law.velocity(q, q[:2], q=q),
        lambda: law.velocity(q, w=q[:2]),
        lambda: hf.solve_ik(good()["arm"], np.eye(4), no_such=None),
    ):
        with pytest.raises(TypeError):
            wrong()
