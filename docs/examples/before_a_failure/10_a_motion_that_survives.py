"""
A motion that survives a lock
=============================

A Panda moves its tool along a line of one metre. A joint locks on the way: can the rest of the
line still be followed? That depends on the configuration at that moment, and a pose has a whole
curve of them. Of all motions through these the best is found, and a bound for any other.
"""

import numpy as np

import holdfast as hf

arm = hf.arms.load("panda")
begin = np.diag([1.0, -1.0, -1.0, 1.0])  # tool down
begin[:3, 3] = [0.45, -0.5, 0.35]
end = begin.copy()
end[1, 3] = 0.5
path = hf.paths.TimedPath(hf.paths.line(begin, end), hf.paths.Constant(10.0))
index = hf.indices.relative_manipulability(arm)
best = hf.plan_motion(arm, path, samples=51, spacing=0.1, compare=["least-norm", index])
print(f"survived: {best.survival:.3f} of all locks")
print(f"no motion survives more than {best.survival_bound:.3f} of them")
for other in best.comparisons:
    print(f"{other.survival:.3f}  {other.name}")

# %%
# A local measure of fault tolerance does not buy survival over a task. Gradient projection of
# relative manipulability follows the hill it is on, and even its best continuous motion knows
# nothing of what comes later on the path.

best.plot("survival")

# %%
# Where each lock is survivable, over time and the joint that the self-motion moves most; the line
# is the motion. The elbow is set by the pose: no motion survives its lock but near the end.

best.plot("map")
