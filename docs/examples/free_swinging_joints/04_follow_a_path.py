"""
A path with small susceptibility
================================

The tool draws a line in 20 s. The prepared arm uses its self-motion to keep the torques of
gravity small, and the other arm moves its joints as little as it can. Both draw the same line.
"""

import matplotlib.pyplot as plt

import holdfast as hf

arm = hf.arms.load("planar-3r")
torque = hf.susceptibility.torque(arm, "worst-case")
line = hf.paths.line([1.9, -1.9, 0], [-1.9, -1.9, 0])  # m
path = hf.paths.TimedPath(line, hf.paths.Trapezoid(20))  # s
asked = {"task": "planar", "samples": 201}
prepared = hf.follow(arm, path, torque, rate_cap=1.0, **asked)
plain = hf.follow(arm, path, torque, method="none", q=prepared.q[0], **asked)

figure, axes = plt.subplots(figsize=(7, 3.8))
for motion, name, style in ((prepared, "prepared", "-"), (plain, "least motion", "--")):
    label = f"{name}: worst {motion.value.max():.2f}"
    axes.plot(motion.time, motion.value, style, lw=2.2, label=label)
    print(f"{name}: tool off its path by at most {1000 * motion.position_error.max():.1g} mm")
axes.set(xlabel="time, s", ylabel="torque susceptibility\n(no unit; smaller is better)")
axes.set(ylim=(0, None), title="Three links, 201 samples of a line of 3.8 m")
axes.legend()
