"""Pushes on every link: how many of those that are noticed are called one, and how many a fault of a joint."""

from __future__ import annotations

from collections import Counter
from functools import partial
from typing import Any

import numpy as np

import holdfast as hf
from measurements.faults.store import Store, of

FORCE, ONSET, LASTS = (15.0, 40.0), (0.8, 1.5), (0.2, 1.0)  # N, s, s
LENGTH = 3.0  # s
RADIUS = 0.05  # m, of a link about the line from its joint to the next
SEEDS = 40_000


def drawn(arm: hf.Arm, seed: int) -> hf.diagnosis.ExternalForce:
    """One, the links in turn."""
    rng, k = np.random.default_rng([9, seed]), seed % arm.n
    ahead = arm.joints[k + 1].origin if k + 1 < arm.n else arm.tool
    direction = rng.normal(size=3)
    force = rng.uniform(*FORCE) * direction / np.linalg.norm(direction)
    point = rng.uniform() * ahead[:3, 3] + rng.uniform(-RADIUS, RADIUS, 3)
    onset = rng.uniform(*ONSET)
    where = tuple(point.tolist())
    return hf.diagnosis.ExternalForce(
        arm.joint_names[k], tuple(force.tolist()), onset, end=onset + rng.uniform(*LASTS), point=where
    )


def judged(arm: hf.Arm, bounds: hf.diagnosis.Bounds, seeds: range) -> list[dict[str, Any]]:
    """What is said of some."""
    pushes = [drawn(arm, seed) for seed in seeds]
    logs = hf.diagnosis.simulate_logs(
        arm, LENGTH, seeds=[SEEDS + seed for seed in seeds], external_forces=[[push] for push in pushes]
    )
    found = []
    for push, log in zip(pushes, logs, strict=True):
        verdict = hf.diagnosis.diagnose(arm, log, bounds).verdict
        found.append(
            {
                "link": arm.joint_index(push.joint) + 1,
                "noticed": bool(verdict.alarm),
                "early": bool(verdict.alarm and verdict.time < push.onset),
                "kind": verdict.kind,
                "joint": verdict.joint,
                "delay": verdict.time - push.onset if verdict.alarm else None,
            }
        )
    return found


def table(store: Store, bounds: hf.diagnosis.Bounds, robots: int, count: int) -> list[str]:
    """A line for each link, and one for all."""
    found = store.some(f"push {robots}", count, partial(judged, store.arm, bounds))
    lines = [
        "## Pushes on every link",
        "",
        f"A force of {FORCE[0]:g} to {FORCE[1]:g} N acts in any direction, anywhere between a joint and the next one, for "
        f"{LASTS[0]:g} to {LASTS[1]:g} s. All other settings are as above. A force on the first link can load only the first "
        "joint, like a fault of that joint.",
        "",
        "| link | detected | not attributed to a joint | delay, ms, median / 90 % | classified as |",
        "|---|---|---|---|---|",
    ]
    for link in (*range(1, store.arm.n + 1), None):
        some = [one for one in found if link in (one["link"], None)]
        seen = [one for one in some if one["noticed"] and not one["early"]]
        well = sum(one["joint"] is None for one in seen)
        delay = [1e3 * one["delay"] for one in seen]
        shown = f"{np.median(delay):.3g} / {np.quantile(delay, 0.9):.3g}" if delay else "-"
        said = Counter(one["kind"] if one["joint"] is None else f"{one['kind']} of {one['joint']}" for one in seen)
        told = ", ".join(f"{name} {times}" for name, times in said.most_common())
        lines.append(f"| {link or 'all'} | {len(seen)} of {len(some)} | {of(well, len(seen))} | {shown} | {told or '-'} |")
    return [*lines, ""]
