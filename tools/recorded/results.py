"""The results of Python calls, an entry for each; ``tools/record.py`` keeps what every one of them holds.

Small cases: they show that a move of files changed no number, not that the numbers are right. Keys stay when names of
holdfast change, so that records can be compared.
"""

from __future__ import annotations

import hashlib
import inspect
import json
import types
from collections.abc import Callable, Mapping
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np

import holdfast as hf
from holdfast import arms, control, teleop
from holdfast.studies.assessment import structures
from holdfast.teleop.analysis import analyse

INPUTS = Path(__file__).parent
DEEP, LARGE = 3, 60  # levels of objects within objects; numbers of an array that are written out
PANDA, HOME = arms.load("panda"), [0, -0.8, 0, -2.4, 0, 1.6, 0.8]
FLAT = arms.load("planar-3r")
BENCH, VARY = hf.Region.load(INPUTS / "flat.yaml"), {"a1": (0.6, 1.4), "a3": (0.6, 1.4)}
CLEAR = hf.Clearance(PANDA, hf.Capsules.along_links(PANDA, 0.06))
LAW = control.pseudoinverse(FLAT, "planar")
FAR = control.failure_tolerant(PANDA, "position", 0.3)
AT = np.deg2rad([20, 40, 60])

RESULTS: dict[str, Callable[[], Any]] = {
    "arm": lambda: hf.Arm.from_urdf(INPUTS / "arm.urdf", tip="link7"),
    "task": lambda: [control.pseudoinverse(PANDA, rows).task for rows in ("pose", "pointing", ["vx", "vy", "wz"])],
    "index_values": lambda: [
        hf.indices.by_name(label, PANDA).evaluate(HOME) for label in sorted(hf.registry.INDEX_REGISTRY.labels(PANDA))
    ],
    "susceptibilities": lambda: [
        make(PANDA).evaluate(HOME) for make in (hf.susceptibility.torque, hf.susceptibility.swing_angle)
    ],
    "region": lambda: [hf.Region.load(INPUTS / f"{name}.yaml") for name in ("cell", "flat", "list")],
    "assessment": lambda: hf.assess(
        PANDA, hf.Region.load(INPUTS / "cell.yaml"), poses=40, restarts=10, task="position", optimise=True, after_lock=True
    ),
    "comparison": lambda: hf.compare_assessments(
        [hf.assess(FLAT, BENCH, poses=64, seed=seed, task="planar", index="manipulability") for seed in (1, 2)], ["a", "b"]
    ),
    "structures": lambda: structures(PANDA),
    "reach": lambda: hf.solve_ik(PANDA, PANDA.forward_kinematics(HOME), restarts=10),
    "optimum": lambda: hf.optimise(PANDA, PANDA.forward_kinematics(HOME), hf.indices.relative_manipulability(PANDA), starts=8),
    "self_motion": lambda: hf.self_motion(FLAT, [1.5, 1.5], "planar"),
    "joint_bounds": lambda: hf.joint_bounds(FLAT, [1.5, 1.5], "planar"),
    "reachable_after_a_lock": lambda: hf.reachable_when_locked(FLAT, [1.5, 1.5], {1: np.deg2rad([0, 60, 170])}, task="planar"),
    "tolerant_workspace": lambda: hf.tolerant_workspace(FLAT, "planar", optimise=True),
    "workspace": lambda: hf.workspace(LAW, [1.5, 1.5], "grid:5", configurations=4, points=2, method="procedure"),
    "target_measures": lambda: hf.workspace(LAW, "grid:3", 3, over="targets", configurations=2, points=1, time_limit=60),
    "convergence_map": lambda: hf.convergence_map(LAW, [1.0, 1.0], 8, configurations=4, time_limit=60),
    "best_law": lambda: hf.compare_laws(
        {"plain": LAW, "damped": control.damped(FLAT, 0.1, "planar")},
        4,
        [1.0, 1.0],
        best=True,
        configurations=2,
        time_limit=60,
    ),
    "recovery": lambda: hf.recover(
        PANDA, {"panda_joint4": -2.0}, [2, 0.6, 0, -2, 0, 2.5, 0.8], task="position", samples=40, starts=32
    ),
    "rest_points": lambda: hf.stationary_points(LAW, [1.5, 1.5], {1: np.deg2rad(140)}),
    "rest_curves": lambda: hf.stationary_points(LAW, [1.5, 1.5], {1: None}),
    "basins": lambda: hf.basins(LAW, [1.5, 1.5], {1: np.deg2rad(45)}, grid=8),
    "runs": lambda: hf.simulate(LAW, np.array([AT, -AT]), [1.5, 1.5], locked=[1], time=0.5),
    "runs_in_cycles": lambda: hf.simulate(
        control.damped(PANDA, 0.1, "position", gain=0.1), HOME, [0.5, 0.2, 0.4], locked=[3], cycles=True, time=4
    ),
    "physical_run": lambda: hf.simulate_physics(LAW, AT, [1.5, 1.5], locked=[1], time=0.5),
    "power_loss": lambda: hf.power_loss(PANDA, HOME, free=[3], brakes=hf.Brakes(after=0.05, torque=40.0)),
    "physical_fall": lambda: hf.power_loss(PANDA, HOME, duration=0.2).physical(),
    "motions": lambda: hf.point_to_point(PANDA, 5, distance=(0.2, 0.8), task="position", failures="single"),
    "law_comparison": lambda: hf.compare_laws(
        [LAW, control.weighted(FLAT, [1, 2, 3], "planar")], [AT, -AT], [[1.5, 1.5], [1.0, 1.0]]
    ),
    "deviations": lambda: FAR.deviations(HOME, [0.1, 0.2, 0.3]),
    "trade_off": lambda: control.trade_off(PANDA, "position", 60, allowed=[0, 0.2, 0.5]),
    "trajectory": lambda: hf.follow(
        PANDA, hf.paths.TimedPath.load(INPUTS / "line.yaml"), minimise=hf.susceptibility.torque(PANDA), samples=21
    ),
    "designs": lambda: hf.design(
        FLAT, VARY, region=BENCH, task="planar", poses=12, designs=6, local_searches=1, check_poses=40
    ),
    "convergence_designs": lambda: hf.design_for_convergence(LAW, VARY, designs=4, local_searches=1, keep_reach=True),
    "clearance": lambda: [x(HOME) for x in (CLEAR, CLEAR.gradient, CLEAR.by_pair)],
    "task_bank": lambda: teleop.make_task_bank(FLAT, 4, seed=1),
    "analysis": lambda: analyse(
        teleop.trial_table(teleop.simulate_experiment("exp", teleop.read_protocol(INPUTS / "tiny.yaml"), 6, seed=2)),
        missing="complete",
    ),
}


# ---- what a result holds -------------------------------------------------------------------------------------------------


def write(name: str) -> None:
    """Write what the result of an entry holds into this folder."""
    result = RESULTS[name]()
    found = result if isinstance(result, list) else [result]
    for k, one in enumerate(found):
        label = f"{name}-{k}" if len(found) > 1 else name
        Path(f"{label}.json").write_text(json.dumps(plain(one, DEEP), indent=1), encoding="utf-8")
        for figure, drawn in figures(one).items():
            drawn.savefig(f"{label}-{figure}.svg", metadata={"Date": None, "Creator": None})


def figures(result: Any) -> dict[str, Any]:
    """The figures that a result makes of itself."""
    import matplotlib as mpl

    mpl.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "record"})
    if callable(getattr(result, "figures", None)):
        return dict(result.figures())
    return {"figure": result.figure()} if callable(getattr(result, "figure", None)) else {}


def plain(x: Any, deep: int) -> Any:
    """Numbers, texts and containers of them: for an object its public attributes, and what it says of itself."""
    if x is None or (isinstance(x, bool | int | str) and not isinstance(x, Enum)):
        return x
    if isinstance(x, float | np.floating):
        return float(x) if np.isfinite(x) else str(x)
    if isinstance(x, Enum):
        return str(x.name)
    if isinstance(x, np.generic):
        return plain(x.item(), deep)
    if isinstance(x, np.ndarray):
        if x.dtype == object:
            return [plain(item, deep - 1) for item in x.ravel()]
        told = [repr(item) for item in x.ravel().tolist()] if x.size <= LARGE else hashlib.sha256(x.tobytes()).hexdigest()
        return {f"{x.dtype}{x.shape}": told}
    if isinstance(x, Mapping):
        return {str(key): plain(item, deep - 1) for key, item in x.items()}
    if isinstance(x, list | tuple | set | frozenset):
        return [plain(item, deep - 1) for item in (sorted(x, key=repr) if isinstance(x, set | frozenset) else x)]
    if isinstance(x, hf.Arm):
        return f"arm {x.fingerprint}"
    if type(x).__module__.startswith("pandas"):
        return x.to_csv(index=False)
    if not type(x).__module__.startswith("holdfast") or deep <= 0:
        return type(x).__name__
    return attributes(x, deep)


def attributes(x: Any, deep: int) -> dict[str, Any]:
    """Of an object of holdfast."""
    told: dict[str, Any] = {"": type(x).__name__}
    if type(x).__repr__ is not object.__repr__:
        told["repr"] = repr(x)
    for name in sorted(n for n in dir(x) if not n.startswith("_")):
        try:
            value = getattr(x, name)
            if name in ("describe", "to_dict", "to_code"):
                value = value() if all(p.default is not p.empty for p in inspect.signature(value).parameters.values()) else ""
        except Exception as error:  # a value that this result does not have
            told[name] = f"{type(error).__name__}: {error}"
            continue
        if not isinstance(value, type | types.ModuleType) and not (callable(value) and not hasattr(value, "fingerprint")):
            told[name] = plain(value, deep - 1)
    return told
