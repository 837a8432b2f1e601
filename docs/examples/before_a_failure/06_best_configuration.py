"""
The best configuration of a pose
================================

A redundant arm reaches a pose in infinitely many configurations. ``hf.optimise`` finds the one
that keeps most whichever joint locks. The tool does not move, the joint limits are respected, and
the arm does not collide with itself.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("pa10-9dof")
index = hf.indices.relative_manipulability(arm)
q = np.deg2rad([0, 30, 0, 90, 0, 18, 0, 36, 0])
pose = arm.forward_kinematics(q)
best = hf.optimise(arm, pose, index, seed=1, clearance=hf.Clearance(arm), margin=0.02)
print("joint angles, deg:", np.rad2deg(best.q).round(1))
print(f"tool moved by {1000 * best.position_error:.1g} mm")

# %%
# Before the optimisation, joint 2 is by far the worst. Afterwards several joints are equally bad.

figure, axes = plt.subplots(figsize=(7, 3.8))
joints = np.arange(1, arm.n + 1)
for shift, where, name, colour in ((-0.2, q, "nominal", "C5"), (0.2, best.q, "best found", "C0")):
    label = f"{name}: worst {index(where):.3f}"
    axes.bar(joints + shift, index.by_joint(where), 0.38, color=colour, label=label)
axes.axhline(index.bound, c="0.3", ls="--", label=f"largest worst case, {index.bound:.3f}")
axes.set(xlabel="joint that locks", ylabel="relative manipulability (no unit)", ylim=(0, 1.15))
axes.set(xticks=joints, title="PA10, 9 joints: one pose, two configurations (32 starts)")
axes.legend(ncols=2, loc="upper left")
