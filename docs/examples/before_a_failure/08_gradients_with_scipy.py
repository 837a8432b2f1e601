"""
Exact gradients with SciPy
==========================

Every index and susceptibility has an exact gradient, so any optimiser can use it. Here SciPy trades relative
manipulability against the torque that gravity asks of the joints: the weight is yours, the tool stays where it is.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import minimize

import holdfast as hf

arm = hf.arms.load("panda")
rho = hf.indices.relative_manipulability(arm, "position")
torque = hf.susceptibility.torque(arm, "effort")  # each torque over the largest of its motor
start = np.deg2rad([0, 20, 0, -120, 10, 150, 45])
point = arm.forward_kinematics(start)[:3, 3]
stays = {"type": "eq", "fun": lambda q: arm.forward_kinematics(q)[:3, 3] - point, "jac": lambda q: arm.jacobian(q)[:3]}


def cost(q, weight):
    return weight * torque(q) - rho(q), weight * torque.gradient(q) - rho.gradient(q)


front, q, bounds = [], start, np.c_[arm.lower, arm.upper]
for weight in np.geomspace(0.02, 20, 12):
    q = minimize(cost, q, weight, jac=True, bounds=bounds, constraints=stays).x
    front.append((torque(q), rho(q)))

figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
axes.plot(*np.transpose(front), "o-", color="#0a5c9e", label="SLSQP, 12 weights")
axes.plot(torque(start), rho(start), "D", color="#c8500a", markersize=9, label="where it starts")
axes.set(xlabel="torque susceptibility (no unit; smaller is better)", ylabel="relative manipulability\n(larger is better)")
axes.set_title("Panda, one tool point: what safety from locks costs in load")
axes.legend(frameon=False)
