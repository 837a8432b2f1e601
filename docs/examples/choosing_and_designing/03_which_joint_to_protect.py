"""
The joint that most needs a redundant motor
===========================================

If one joint could never fail, for example because it has a second motor, the worst case would
include only the other joints. The script counts how many of 1000 poses this would save. Both
numbers refer to the same poses, so the gain has a paired interval.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("pa10-9dof")
region = hf.Region.box([0.968, 0.0, 0.041], 0.5, np.deg2rad([0.0, 174.0, 0.0]), np.pi / 2)
run = hf.assess(arm, region, poses=1000, seed=1)
upgrades = run.upgrades(threshold=0.2)

figure, axes = plt.subplots(figsize=(7, 3.8))
for place, upgrade in enumerate(upgrades):
    axes.barh(place, 100 * upgrade.gain, color="C0" if place else "C1", height=0.6)
    axes.hlines(place, 100 * upgrade.low, 100 * upgrade.high, color="0.2", lw=2)
axes.set_yticks(range(len(upgrades)), [upgrade.joint for upgrade in upgrades])
axes.set_xlabel("more poses keep at least 0.2 if this joint cannot fail, percentage points")
axes.set_title(f"PA10, 9 joints: now {100 * upgrades[0].before:.0f} % of {run.poses} poses do")
axes.invert_yaxis()
