"""
A free swing, and brakes that stop it
=====================================

The elbow of a Panda loses its torque, and all other joints hold. MuJoCo simulates the fall, and
shows how far the tool has fallen when brakes close after 20, 50 or 100 ms. Needs
``holdfast-arms[physics]``.
"""

import numpy as np

import holdfast as hf

arm = hf.arms.load("panda")
q = np.deg2rad([0, -45, 0, -135, 0, 90, 45])
swing = hf.free_swing(arm, q, "panda_joint4", brake_after=(20, 50, 100))
for drop in swing.drops:
    speed = np.rad2deg(drop.speed)
    print(f"{drop.after_ms:3.0f} ms: {1000 * drop.drop:5.1f} mm down, then at {speed:.0f} deg/s")

# %%
# The brakes are assumed to stop the joint at once. The speed shows how optimistic this assumption
# is.

swing.plot()
