"""The table of section 6 of the specification: locks found by self-motions, from the tool's pose alone."""

from __future__ import annotations

from functools import partial

import numpy as np

import holdfast as hf
from holdfast.core.probability import Interval
from measurements.faults.store import Store

HEAD = [
    "| task, arm, configurations | testable | found | wrong joint | displacement of the tool, mm, median / 95 % "
    "| time, s, median / 95 % | no lock |",
    "|---|---|---|---|---|---|---|",
]
CASES = (  # arm, task, joints at 0, how many times the asked count of configurations
    ("panda", "pose", (), 1.0),
    ("panda", "pose", (2, 4), 0.4),
    ("iiwa14", "pose", (), 0.4),
    ("panda", "position", (), 0.4),
)
RATE = 1000.0  # Hz


def row(name: str, task: str, zero: tuple[int, ...], count: int, seed: int) -> str:
    """One line: every joint locked before the motion, and none, at random configurations of robots of their own."""
    arm, rng = hf.arms.load(name), np.random.default_rng([6, seed])
    testable = found = wrong = clear = falsely = 0
    strayed, took = [], []
    for k in range(count):
        q = rng.uniform(arm.lower, arm.upper)
        q[list(zero)] = 0.0
        probe = hf.diagnosis.plan_identification(arm, q, task=task, seed=k)
        motion, told = probe.resample(RATE), set(probe.isolable)
        for joint in (None, *arm.joint_names):
            faults = [] if joint is None else [hf.faults.FaultEvent("locked", joint, 0.0)]
            record = hf.diagnosis.simulate_log(arm, motion=motion, faults=faults, seed=60_000 + k)
            said = probe.decide(record)
            if joint is None:
                clear += said.remaining == ("none",)
                falsely += said.joint is not None
                continue
            wrong += said.joint not in (None, joint)
            if joint in told:
                testable += 1
                found += said.joint == joint
                places = arm.forward_kinematics(record.q[[0, int(np.searchsorted(record.t, said.time))]])[:, :3, 3]
                strayed.append(1e3 * float(np.linalg.norm(places[1] - places[0])))
                took.append(said.time)
    of = Interval.from_counts(found, testable)
    where = f", q{' = q'.join(str(i + 1) for i in zero)} = 0" if zero else ""
    both = [f"{np.median(x):.3g} / {np.quantile(x, 0.95):.3g}" for x in (strayed, took)]
    cells = [
        f"{task}, {name}, {count}{where}",
        f"{testable} of {count * arm.n}",
        f"{found} ({100 * of.low:.4g} to {100 * of.high:.4g} %)",
        str(wrong),
        *both,
        f"{clear} of {count} reported as such, {falsely} false locks",
    ]
    return f"| {' | '.join(cells)} |"


def table(store: Store, count: int) -> list[str]:
    """All lines."""
    rows = []
    for k, (name, task, zero, fraction) in enumerate(CASES):
        size = max(2, round(fraction * count))
        rows.append(store.get(f"probe {k} {size}", partial(row, name, task, zero, size, k)))
    return [
        "## Self-motions that find the locked joint",
        "",
        "Only the measured tool pose is used (100 Hz, 0.5 mm, 1 mrad), and the joint is locked before the motion begins. A "
        "lock is testable if the plan can distinguish it from all other locks. The displacement of the tool at the decision is "
        "the true one, from joint sensors that are accurate to 0.02 mrad.",
        "",
        *HEAD,
        *rows,
        "",
    ]
