"""
Your own index
==============

An index is one function of the Jacobian J without the failed joints. This index measures how fast
the end effector can still be lifted per unit of joint speed, :math:`v = 1 / \\sqrt{u^\\top (J
J^\\top)^{-1} u}` with u up. holdfast finds the worst failure, compiles the function, and
differentiates it.
"""

import casadi as ca
import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf


def lifting_speed(jacobian):
    up = ca.DM([0, 0, 1])
    return 1 / ca.sqrt(ca.dot(up, ca.solve(jacobian @ jacobian.T, up)))  # m/rad


arm = hf.arms.load("panda")
index = hf.indices.CustomIndex(lifting_speed, arm, "position", name="lifting speed", unit="m/rad")

# %%
# Bend the elbow through its range, with 400 configurations in one call.

elbow = np.linspace(arm.lower[3], arm.upper[3], 400)
q = np.tile(hf.arms.about("panda").home, (400, 1))
q[:, 3] = elbow
result = index.evaluate(q)
figure, axes = plt.subplots(figsize=(7, 4))
axes.plot(np.rad2deg(elbow), result.by_failure, c="0.7", lw=1)
axes.plot(np.rad2deg(elbow), result.value, lw=2.5, label="worst of the seven (grey)")
axes.set(xlabel="joint 4, deg (all others at home)", ylabel="lifting speed, m/rad")
axes.set_title("Panda, position task, one joint locked: 400 configurations")
axes.legend()
