"""
Along a path, prepared all the way
==================================

The tool draws a line in 20 s. The arm that is prepared uses its self-motion to keep the torques of gravity small; the other
moves as little as it can. Both draw the same line.
"""

import matplotlib.pyplot as plt

import holdfast as hf

arm = hf.arms.load("planar-3r")
torque = hf.susceptibility.torque(arm, "worst-case")
line = hf.paths.line([1.9, -1.9, 0], [-1.9, -1.9, 0])  # m
path = hf.paths.TimedPath(line, hf.paths.Trapezoid(20))  # s
prepared = hf.follow(arm, path, torque, task="planar", rate_cap=1.0, samples=201)
plain = hf.follow(arm, path, torque, task="planar", method="none", q=prepared.q[0], samples=201)

figure, axes = plt.subplots(figsize=(7, 3.8), layout="constrained")
for motion, name, style in ((plain, "as little motion as possible", "--"), (prepared, "prepared", "-")):
    colour = "#0a5c9e" if style == "-" else "#c8500a"
    axes.plot(motion.time, motion.value, style, color=colour, linewidth=2.2, label=f"{name}: worst {motion.value.max():.2f}")
    print(f"{name}: tool off its path by at most {1000 * motion.position_error.max():.1g} mm")
axes.set(xlabel="time, s", ylabel="torque susceptibility\n(no unit; smaller is better)", ylim=(0, None))
axes.set_title("Three links, 201 samples of a line of 3.8 m")
axes.legend(frameon=False)
axes.spines[["top", "right"]].set_visible(False)
