"""
All configurations of one pose
==============================

A Panda holds its tool in place and moves its joints. This self-motion is traced from many starts
until it closes or a joint reaches its limit. Everything except the pose changes along it,
including the dexterity that remains after a lock.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("panda")
pose = arm.forward_kinematics(np.deg2rad([0, -45, 0, -135, 0, 90, 45]))
motion = hf.self_motion(arm, pose)
for line in motion.describe():
    print(line)

# %%
# The index along each curve. Where it is 0, some locked joint removes a direction of motion.

index = hf.indices.relative_manipulability(arm)
figure, axes = plt.subplots(figsize=(7, 3.8))
for k, (curve, style) in enumerate(zip(motion.components, ("-", "--", ":"), strict=False)):
    along = np.r_[0, np.cumsum(np.linalg.norm(np.diff(curve.q, axis=0), axis=1))]
    axes.plot(along, index(curve.q), style, lw=2.2, label=f"curve {k + 1}")
axes.set(xlabel="along the self-motion, rad", ylabel="worst-case relative manipulability")
axes.set(ylim=(0, None), title="Panda, one tool pose, any one joint locked")
axes.legend()
