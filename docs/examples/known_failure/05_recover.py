"""
Home with a locked joint
========================

The elbow of a Panda has locked in the middle of the work. What is left of the workspace, can the
home position still be met, and which way there is within the limits and clear of the arm itself?
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
# The motion. ``answer.q`` are the waypoints; ``answer.to_csv("home.csv")`` writes them.

answer.plot("motion")

# %%
# What is left: points of the healthy workspace, and those that the locked arm was found to reach.

answer.plot("left")
