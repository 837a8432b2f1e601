"""
Outcomes of an undetected lock
==============================

Joint 2 of three is locked, and the controller, which has not detected the lock, keeps commanding
all joints. From 2000 random starts, the script simulates whether the tool reaches the target,
gets stuck, or keeps moving.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("planar-3r")
law = hf.control.pseudoinverse(arm, task="planar")
q0 = np.random.default_rng(0).uniform(-np.pi, np.pi, (2000, 3))
runs = hf.simulate(law, q0, [1.5, 1.5], locked=["joint2"])
print(runs.counts())

# %%
# The points at which the end effector stops. The angle of the locked joint decides the outcome,
# because an arm that is folded too far cannot reach the target.

figure, axes = plt.subplots(figsize=(6.6, 4.6))
for name, style in (("stuck", "C1v"), ("converged", "C0o")):
    some = runs.outcome == name
    label = f"{name}: {some.sum()}"
    axes.plot(np.rad2deg(q0[some, 1]), runs.error[some], style, ms=4, label=label)
axes.set(xlabel="angle at which joint 2 is locked, deg", ylabel="error at the end, m")
axes.set(xticks=range(-180, 181, 60), title=f"Three links of 1 m: {len(q0)} random starts")
axes.legend()
