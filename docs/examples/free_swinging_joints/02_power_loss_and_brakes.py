"""
A power loss, and brakes that stop the arm
==========================================

All joints of a Panda lose their torque. The batch engine simulates the fall without brakes and
with brakes that act after 20, 50 and 100 ms. Friction is an assumption, because the file of the
arm states none.
"""

import numpy as np

import holdfast as hf

arm = hf.arms.load("panda")
q = np.deg2rad([0, -45, 0, -135, 0, 90, 45])
friction = hf.Friction(coulomb=0.5, viscous=0.5)
fall = hf.power_loss(arm, q, friction=friction)
print(f"no brakes: {1000 * fall.drop:5.1f} mm down")
for delay in (0.02, 0.05, 0.1):
    brakes = hf.Brakes(after=delay, torque=40)
    caught = hf.power_loss(arm, q, friction=friction, brakes=brakes)
    early, final = 1000 * fall.drop_at(delay), 1000 * caught.drop
    print(f"brakes after {1000 * delay:3.0f} ms: {early:4.1f} mm then, {final:5.1f} mm at most")

# %%
# A brake does not stop the arm at once. The tool drops further until its torque has absorbed the
# motion.

fall.plot()
