"""
Return home with a locked joint
===============================

The elbow of a Panda has locked during a task. The script computes the remaining workspace,
whether the home position can still be reached, and a motion to it within the limits and without
self-collision.
"""

import numpy as np

import holdfast as hf

arm = hf.arms.load("panda")
at = np.array([2.0, 0.6, 0.0, -2.0, 0.0, 2.5, 0.8])  # rad
locked = {"panda_joint4": -2.0}
answer = hf.recover(arm, locked, at, goal="home", task="position", samples=400, seed=1)
for line in answer.describe():
    print(line)

# %%
# The motion. ``answer.q`` contains the waypoints, and ``answer.to_csv("home.csv")`` writes them.

answer.plot("motion")

# %%
# The remaining workspace: points of the healthy workspace, and the points that the locked arm was
# found to reach.

answer.plot("left")
