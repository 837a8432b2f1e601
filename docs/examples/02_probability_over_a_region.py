"""
Probability over a region, with its band
========================================

One configuration says little about a job that needs many poses. Here 2000 poses are drawn in the region of section V of
[Abdi2012]_: a cube of 0.5 m and a cube of 90 degrees. Each is solved by inverse kinematics within the joint limits and
evaluated as found.
"""

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("pa10-9dof")
region = hf.Region.box(
    center=[0.968, 0.0, 0.041],
    size=0.5,
    rpy_center=np.deg2rad([0.0, 174.0, 0.0]),
    rpy_size=np.pi / 2,
    name="in front of the arm",
)
run = hf.assess(arm, region, poses=2000, seed=1)
found = run.distribution
print(f"{found.reached} of {found.samples} poses reached within the limits")
print(f"probability of at least 0.2: {run.interval(at_least=0.2)}")

# %%
# The curve answers: with which probability is at least this much left, whichever joint locks? The shaded band holds the
# *whole* true curve with 95 % confidence (Dvoretzky, Kiefer, Wolfowitz). A pose that was not reached counts as failed;
# the thin curve leaves those poses out.

h = np.linspace(0, 0.5, 501)
kept = 1 - run.cdf(h)
band = found.band()

blue, orange = "#0072B2", "#D55E00"
figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
axes.fill_between(h, np.clip(kept - band, 0, 1), np.clip(kept + band, 0, 1), color=blue, alpha=0.25, linewidth=0)
axes.plot(h, kept, color=blue, linewidth=2, label=f"all {found.samples} poses, with 95 % band (±{band:.3f})")
axes.plot(
    h,
    1 - run.cdf(h, reachable_only=True),
    color=orange,
    linestyle="--",
    label=f"only the {found.reached} poses that were reached",
)
axes.set(
    xlabel="worst-case relative manipulability h (no unit)",
    ylabel="probability of at least h",
    xlim=(0, 0.5),
    ylim=(0, 1.02),
    title=f"PA10, 9 joints, pose task, any one joint locked ({found.samples} random poses, seed {run.seed})",
)
axes.title.set_size(11)
axes.legend(frameon=False)
axes.grid(color="0.9")
axes.set_axisbelow(True)
axes.spines[["top", "right"]].set_visible(False)

# %%
# Which joint is the worst one, and how often? The counts leave out poses that were not reached.

for name, count in zip(run.index.failure_names, run.worst_counts, strict=True):
    print(f"{name}: worst in {count / found.reached:6.1%} of the reached poses")
