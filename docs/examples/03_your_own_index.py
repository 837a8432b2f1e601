"""
Your own index
==============

An index is one function of the reduced Jacobian. This one asks a plain question: how fast can the end effector still be lifted,
straight up, per unit of joint speed? With the task Jacobian J and the unit vector u (up), that is

.. math:: v = \\frac{1}{\\sqrt{u^\\top (J J^\\top)^{-1} u}}

the half axis of the velocity ellipsoid of J along u. holdfast takes J without the columns of the joints that failed,
finds the worst failure, and differentiates.
"""

import casadi as ca
import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf


def lifting_speed(jacobian):
    up = ca.DM([0, 0, 1])
    return 1 / ca.sqrt(ca.dot(up, ca.solve(jacobian @ jacobian.T, up)))  # m/rad


arm = hf.arms.load("panda")
index = hf.indices.CustomIndex(
    lifting_speed,
    arm,
    task="position",
    name="lifting speed",
    unit="m/rad",
)

# %%
# Trust it only after a check by another route: the same number from NumPy, at the arm's home, and the gradient from
# finite differences.

home = np.array(hf.arms.about("panda").home)


def by_hand(q):
    values = []
    for k in range(arm.n):
        reduced = np.delete(arm.jacobian(q)[:3], k, axis=1)
        values.append(1 / np.sqrt(np.linalg.inv(reduced @ reduced.T)[2, 2]))
    return np.array(values)


steps = 1e-6 * np.eye(arm.n)
differences = np.array([(index(home + s) - index(home - s)) / 2e-6 for s in steps])
off = np.abs(index.by_joint(home) - by_hand(home)).max()
slope_off = np.abs(index.gradient(home) - differences).max()
print("values agree to 1e-12:", off < 1e-12)
print("gradient agrees with finite differences to 1e-7:", slope_off < 1e-7)
assert off < 1e-12
assert slope_off < 1e-7

# %%
# Now bend the elbow (joint 4) through its range and look at every failure. All configurations go into one call.

elbow = np.linspace(arm.lower[3], arm.upper[3], 400)
q = np.repeat(home[None], elbow.size, axis=0)
q[:, 3] = elbow
result = index.evaluate(q)

blue, grey, orange = "#0072B2", "0.65", "#D55E00"
figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
for k in range(arm.n):
    label = "one joint locked" if k == 0 else None
    axes.plot(np.rad2deg(elbow), result.by_failure[:, k], color=grey, linewidth=1, label=label)
axes.plot(np.rad2deg(elbow), result.value, color=blue, linewidth=2.5, label="worst case")
starts = np.flatnonzero(np.diff(result.worst, prepend=-1))  # where another joint becomes the worst
for start, stop in zip(starts, [*starts[1:], elbow.size], strict=True):
    middle = (start + stop) // 2
    rising = result.value[middle + 1] > result.value[middle]
    axes.annotate(
        index.failure_names[result.worst[middle]].removeprefix("panda_"),
        (np.rad2deg(elbow[middle]), result.value[middle]),
        xytext=(10, -10) if rising else (-8, -20),
        ha="left" if rising else "right",
        textcoords="offset points",
        color=blue,
        fontsize=9,
    )
axes.axvline(np.rad2deg(home[3]), color=orange, linestyle=":", label="home")
axes.set(
    xlabel="joint 4, deg (all other joints at home)",
    ylabel="lifting speed per unit joint speed, m/rad",
    ylim=(0, None),
    title=f"Panda, position task: lifting speed after a failure ({elbow.size} configurations)",
)
axes.title.set_size(11)
axes.legend(frameon=False)
axes.spines[["top", "right"]].set_visible(False)
