"""
Exact gradients with SciPy
==========================

Any optimiser can use the gradients of indices and susceptibilities. Here SciPy finds trade-offs
between the torques that hold a Panda and the accelerations of free-swinging joints, while the
tool point does not move.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import minimize

import holdfast as hf

arm = hf.arms.load("panda")
torque = hf.susceptibility.torque(arm, "effort")  # each torque over the largest of its motor
fall = hf.susceptibility.acceleration(arm)
start = q = np.deg2rad([0, 20, 0, -120, 10, 110, 45])
place = arm.forward_kinematics(start)[:3, 3]


def cost(q, weight):
    return torque(q) + weight * fall(q), torque.gradient(q) + weight * fall.gradient(q)


stays = {"type": "eq", "fun": lambda q: arm.forward_kinematics(q)[:3, 3] - place}
stays["jac"] = lambda q: arm.jacobian(q)[:3]
limits = np.c_[arm.lower, arm.upper]
front = []
for weight in np.geomspace(1e-6, 1e-1, 16):
    q = minimize(cost, q, weight, jac=True, bounds=limits, constraints=stays).x
    front.append((torque(q), fall(q)))

print(f"at first: torque {torque(start):.3f}, acceleration {fall(start):.0f} rad²/s⁴")
figure, axes = plt.subplots(figsize=(7, 4))
axes.plot(*np.transpose(front), "o-")
axes.set(xlabel="torque susceptibility (no unit)", ylabel="acceleration susceptibility, rad²/s⁴")
axes.set_title("Panda, one tool point: 16 weights between the two")
