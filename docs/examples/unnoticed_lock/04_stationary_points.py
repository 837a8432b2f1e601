"""
Where it can get stuck, over the locked angle
=============================================

The failed arm stops where the healthy joints are commanded nothing: at the target, or somewhere
else. These stationary points are followed over all angles at which joint 2 may lock. Thick orange
are the sinks: there the arm gets stuck.
"""

import numpy as np

import holdfast as hf

arm = hf.arms.load("planar-3r")
law = hf.control.pseudoinverse(arm, task="planar")
curves = hf.stationary_points(law, [1.5, 1.5], locked={"joint2": None})
arcs = [np.rad2deg(arc).round(1).tolist() for arc in curves.sink_arcs]
print("sinks with joint 2 at", arcs, "deg")

# %%
# Shaded: the target is within reach. For this target an arm that can still reach it is never held
# by a sink.

curves.plot()
