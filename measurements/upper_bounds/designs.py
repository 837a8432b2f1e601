"""Designs by what has no slope: planar workspaces, and self-motions on which every joint turns all the way."""

from __future__ import annotations

from time import process_time

import numpy as np

import holdfast as hf
from measurements.record_designs.self_motions import design_for_self_motion
from measurements.record_designs.workspaces import design_for_workspace

SEEDS = (0, 1, 2)


def table() -> list[str]:
    """What is found, each measured again by what shares nothing with the search."""
    lines = ["| searched | seed | found | measured again | bound | processor, s |", "|---|---|---|---|---|---|"]
    three = hf.arms.load("planar-3r")
    four = hf.Arm.from_dh([hf.DH(0.75, 0.0, 0.0)] * 4, name="planar-4r")
    for arm, least, what in ((three, 0.05, "planar 3R, free links of 3 m"), (four, 0.3, "planar 4R, least link 10 %")):
        for seed in SEEDS:
            start = process_time()
            bounds = {f"a{k + 1}": (least, 3 - (arm.n - 1) * least) for k in range(arm.n)}
            found = design_for_workspace(arm, bounds, seed=seed)
            took = process_time() - start
            region = hf.tolerant_workspace(found.arm(), "planar", found.limits)
            again = f"{region.size:.4g} m² ({region.size_interval[0]:.4g} to {region.size_interval[1]:.4g})"
            lines.append(f"| {what} | {seed} | {found.value:.5f} m² | {again} | {found.bound:.5f} | {took:.0f} |")
    for task, name in (("position", "self-motion-position-4R-001"), ("pose", "self-motion-pose-7R-001")):
        recorded = hf.designs.record_design(name).arm
        assert recorded is not None
        arm = recorded
        bounds = {f"{kind}{k + 1}": (-w, w) for k in range(arm.n) for kind, w in (("a", 1.2), ("alpha", 5.0), ("d", 1.0))}
        for seed in SEEDS:
            start = process_time()
            found = design_for_self_motion(arm, bounds, task=task, seed=seed)
            took = process_time() - start
            assert found.q is not None
            assert found.winding is not None
            made = found.arm()
            turned = hf.self_motion(made, made.forward_kinematics(found.q), task, spacing=0.01, starts=32).size / (2 * np.pi)
            turns = " ".join(f"{x:+d}" for x in found.winding)
            said = f"{found.value:.4f} turns ({turns})"
            lines.append(f"| {arm.n}R, {task} | {seed} | {said} | {turned:.4f} turns | {found.bound:.0f} | {took:.0f} |")
    return lines
