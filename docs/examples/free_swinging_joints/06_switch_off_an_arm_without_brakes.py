"""
Switch off an arm without brakes
================================

A YAM on a table has no brakes. Find a configuration in which it stays without power, and a path
to it on which a power loss at any instant drops the tool little. The friction is an assumption.
"""

import holdfast as hf

arm = hf.arms.load("yam")
park = [0, 1.047, 1.047, 0, 0, 0]  # rad, the park pose of its driver
friction = hf.Friction(coulomb=[0.3, 0.3, 0.3, 0.1, 0.1, 0.1], viscous=0.02)
speeds = [2, 2, 2, 3, 3, 3]  # rad/s
table = hf.cell.HalfSpace("table", pose=[0, 0, -1e-3])
cell = hf.Cell([table], may_touch=[("table", "base"), ("table", "joint1")])
stow = hf.stow(arm, park, friction=friction, speeds=speeds, cell=cell, samples=20_000)
print(stow.q.round(2), stow.holds)

# %%
# The path is searched in a roadmap. The straight line takes less time, but its drops are larger.

path = hf.plan_stow_path(stow, nodes=1000, duration=1.0)
for name, curve in (("path", path.curve), ("straight line", path.straight)):
    print(f"{name}: at most {1000 * curve.drop.max():.0f} mm, {curve.time[-1]:.2f} s")
path.plot()
