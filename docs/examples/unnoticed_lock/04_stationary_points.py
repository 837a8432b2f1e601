"""
Stationary points over the locked angle
=======================================

The failed arm stops where the law commands no velocity of the healthy joints. This happens at the
target or at other stationary points. The script follows these points over all angles at which
joint 2 may lock. Thick orange lines are sinks, where the arm gets stuck.
"""

import numpy as np

import holdfast as hf

arm = hf.arms.load("planar-3r")
law = hf.control.pseudoinverse(arm, task="planar")
curves = hf.stationary_points(law, [1.5, 1.5], locked={"joint2": None})
arcs = [np.rad2deg(arc).round(1).tolist() for arc in curves.sink_arcs]
print("sinks with joint 2 at", arcs, "deg")

# %%
# In the shaded angles the target is within reach. For this target, an arm that can still reach it
# never ends at a sink.

curves.plot()
