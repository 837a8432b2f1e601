"""
A motion that survives a lock
=============================

A Panda moves its tool along a line of one metre, and a joint locks on the way. Whether the arm
can finish the line depends on its configuration then, and each pose has a curve of them. The
script finds the best of all motions through these curves, and an upper bound for the others.
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
# A high local measure of fault tolerance does not make a motion survive more locks. Gradient
# projection of relative manipulability climbs to a local optimum, and even its best continuous
# motion does not take the rest of the path into account.

best.plot("survival")

# %%
# The locks that the arm survives, over time and over the joint that the self-motion moves most.
# The line is the motion. The pose determines the angle of the elbow, so no motion survives a lock
# of the elbow except near the end.

best.plot("map")
