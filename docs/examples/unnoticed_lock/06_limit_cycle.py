"""
A limit cycle
=============

The target is within reach, and only its two solutions are attracting points. Nevertheless, the
end effector does not reach the target, because the motion converges to a limit cycle.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf
from holdfast.control.equilibria import orbit

arm = hf.arms.load("planar-3r")
law = hf.control.pseudoinverse(arm, task="planar")
target, start = [0.9, 0.0], np.deg2rad([-130.0, 168.30, -84.0])  # m, rad
runs = hf.simulate(law, start, target, locked=["joint2"], time_limit=4000)
cycle = orbit(runs)
print(runs.outcome, "|", *cycle.describe(), "| stable:", cycle.stable)

# %%
# The first 300 s from three starts (gain 1/s), in the plane of the joints that still move. All
# three motions converge to the same cycle.

figure, axes = plt.subplots(figsize=(6.4, 4.4))
for shift, style in ((-2, "-"), (1, "--"), (-5, ":")):
    begin = start + np.deg2rad([shift, 0, 0])
    path = hf.simulate(law, begin, target, locked=["joint2"]).path(until=300.0, samples=6000)
    axes.plot(*np.rad2deg(path.q[:, [0, 2]]).T, style, lw=1.5)
    axes.plot(*np.rad2deg(begin[[0, 2]]), "ko")
axes.set(xlabel="joint 1, deg", ylabel="joint 3, deg", title="Joint 2 locked at 168.3°")
