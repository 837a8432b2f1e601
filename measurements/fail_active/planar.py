"""Planar arms, whose answers closed forms know: guarantees, and how far a lower bound is from the truth."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from papers.claims import Claim
from papers.part import Part

import holdfast as hf
from measurements.fail_active.lines import line, verdict

sys.path.append(str(Path(__file__).parents[2] / "tests"))
unit_links, four_links = import_module("unit_links"), import_module("four_links")  # the closed forms of the tests

PLANAR, FOUR = 30, 12


def guarantees(quick: bool) -> Part:
    """E4: where is there a motion that survives everything, by closed forms and by the table?"""
    generator, alike, given, count = np.random.default_rng(16), 0, 0, 0
    while count < (5 if quick else PLANAR):
        machine = unit_links.arm(None if count % 2 else unit_links.LIMITS)
        begin, way = generator.uniform(-1.8, 1.8, 2), generator.normal(size=2)
        end = begin + way * generator.uniform(0.2, 1.0) / np.linalg.norm(way)
        path = line(np.append(begin, 0.0), np.append(end, 0.0), 2.0)
        try:
            best = hf.plan_motion(machine, path, samples=21, spacing=0.05)
        except hf.HoldfastError:
            continue
        count += 1
        sure = _guaranteed(machine, unit_links.places(path, 21))
        given += sure
        alike += sure == best.survives_all_locks and (best.survives_all_locks or best.never is not None or best.survival > 0.99)
    why = f"planar arms of three unit links, half with narrow limits; brute force finds a motion that survives all on {given}"
    return Part(
        [Claim("E4 says 1 exactly where brute force does", "asked always", f"{alike} of {count}", why, verdict(alike == count))]
    )


def _guaranteed(machine: hf.Arm, points: np.ndarray) -> bool:
    """Backwards: configurations that survive everything and lead to such."""
    alive = None
    for t in range(len(points) - 1, -1, -1):
        every = [unit_links.configuration(0, v, points[t], s) for v in np.arange(-np.pi, np.pi, 0.05) for s in (-1, 1)]
        q = np.array([[x[0], *unit_links.around(x[1:])] for x in every if x is not None]).reshape(-1, 3)
        q = q[((q >= machine.lower) & (q <= machine.upper)).all(axis=1)]
        q = np.array([x for x in q if all(unit_links.survives(machine, x, k, points[t:]) for k in range(3))]).reshape(-1, 3)
        if alive is not None and len(q) and len(alive):
            q = q[np.abs(unit_links.around(q[:, None] - alive)).max(axis=2).min(axis=1) <= 0.3]
        alive = q
        if not len(q):
            return False
    return True


def more_redundancy(quick: bool) -> Part:
    """Two degrees of redundancy, where the survival is a lower bound: how far below the truth about the same motion?"""
    generator, samples = np.random.default_rng(4), 15
    rows: list[Any] = []
    while len(rows) < (2 if quick else FOUR):
        middle, width = generator.uniform(-0.5, 0.5, 4), generator.uniform(0.6, 1.3, 4)
        low, high = middle - width, middle + width
        machine = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0, lower=a, upper=b) for a, b in zip(low, high, strict=True)], name="4R")
        begin, end = machine.forward_kinematics(generator.uniform(low, high, (2, 4)))[:, :3, 3]
        end = begin + (end - begin) * min(1.0, 1.2 / float(np.linalg.norm(end - begin)))
        path = line(begin, end, 2.0)
        try:
            best = hf.plan_motion(machine, path, task="planar", samples=samples, spacing=0.15, seed=1)
        except hf.HoldfastError:
            continue
        points = path.pose(np.linspace(0, 2.0, 4 * (samples - 1) + 1))[:, :2, 3]
        truth = np.array(
            [[four_links.survives(low, high, q, k, points[4 * t :]) for k in range(4)] for t, q in enumerate(best.q)]
        )
        weights = best.rates.weights(best.time)
        said = best.survives
        rows.append((best.survival, weights @ truth.mean(axis=1) / weights.sum(), (said & ~truth).sum(), (truth & ~said).sum()))
    ours, true, wrong, missed = np.array(rows).T
    count = len(rows) * samples * 4
    why = (
        f"survival {ours.mean():.3f}, of the same motions by reachability over closed forms "
        f"{true.mean():.3f}; {missed.sum():.0f} of {count} verdicts say lost where it is survived"
    )
    return Part(
        [
            Claim(
                "7.2 two degrees of redundancy: said survived, and is not",
                "a lower bound: asked 0",
                f"{wrong.sum():.0f} of {count}",
                why,
                verdict(not wrong.any()),
            )
        ]
    )
