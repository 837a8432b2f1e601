"""
A configuration that falls less
===============================

This script chooses the configuration of a tool pose in which the elbow accelerates as little as
possible when it swings free. The formula chooses, and a simulation of the fall checks the choice.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("panda")
q = np.deg2rad([0, -45, 0, -135, 0, 90, 45])
elbow = hf.susceptibility.acceleration(arm, np.eye(arm.n)[3])  # weights: joint 4 alone
best = hf.optimise(arm, arm.forward_kinematics(q), elbow, seed=1)

figure, axes = plt.subplots(figsize=(7, 4))
for name, where, style in (("after", best.q, "-"), ("before", q, "--")):
    fall = hf.power_loss(arm, where, free=["panda_joint4"], duration=0.25)
    time = np.linspace(0, 0.25, 126)
    label = f"{name}: {1000 * fall.drop_at(0.1):.0f} mm after 100 ms"
    axes.plot(1000 * time, 1000 * fall.drop_at(time), style, lw=2.2, label=label)
axes.set(xlim=(0, 250), xlabel="time since the elbow swings free, ms")
axes.set(ylim=(0, 280), ylabel="tool has fallen, mm", title="Panda, one pose, two configurations")
axes.legend()
