"""
The best configuration of a pose
================================

A redundant arm takes a pose in many ways. ``hf.optimise`` finds the one that keeps most whichever joint locks: the tool
stays, the joint limits are kept, and the arm is clear of itself.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("pa10-9dof")
index = hf.indices.relative_manipulability(arm)
q = np.deg2rad([0, 30, 0, 90, 0, 18, 0, 36, 0])
best = hf.optimise(arm, arm.forward_kinematics(q), index, seed=1, clearance=hf.Clearance(arm), margin=0.02)
print("joint angles, deg:", np.rad2deg(best.q).round(1))
print(f"tool moved by {1000 * best.position_error:.1g} mm; {best.agreeing:.0%} of the starts agree on the best")

# %%
# Bars of the worst joint: before, joint 2; after, several joints share the worst place.

figure, axes = plt.subplots(figsize=(7, 3.8), layout="constrained")
joints = np.arange(1, arm.n + 1)
for shift, where, name, colour in ((-0.2, q, "nominal", "#a9cbe6"), (0.2, best.q, "best found", "#0a5c9e")):
    axes.bar(joints + shift, index.by_joint(where), 0.38, color=colour, label=f"{name}: worst {index(where):.3f}")
axes.axhline(index.bound, color="0.25", linestyle="--", linewidth=1, label=f"no configuration has more: {index.bound:.3f}")
axes.set(xticks=joints, xlabel="joint that locks", ylabel="relative manipulability (no unit)", ylim=(0, 1.15))
axes.set_title("PA10, 9 joints: one pose, two configurations (32 starts)")
axes.legend(frameon=False, ncols=2, loc="upper left")
axes.spines[["top", "right"]].set_visible(False)
