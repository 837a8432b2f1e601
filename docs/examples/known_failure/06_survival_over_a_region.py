"""
Reachable fraction of a region after each lock
==============================================

The script samples 300 random poses around the home position of a Panda. For each joint, it
computes how many of the poses are still reachable if the joint locks at the value that inverse
kinematics found for it.
"""

import matplotlib.pyplot as plt

import holdfast as hf

arm = hf.arms.load("panda")
region = hf.Region.around_tool(arm, hf.arms.about("panda").home)
run = hf.assess(arm, region, poses=300, seed=1, after_lock=True, task="pointing")
survival = run.survival()

# %%
# For pointing, the rotation about the tool axis is free. The bars are 95 % intervals.

figure, axes = plt.subplots(figsize=(7, 3.6))
for k, share in enumerate(survival.values()):
    axes.bar(k + 1, share.value, color="C0", width=0.6)
    axes.vlines(k + 1, share.low, share.high, color="0.2", lw=2)
axes.set(xlabel="joint that locks", ylabel="fraction of poses still in reach", ylim=(0, 1))
axes.set_title(f"Panda, pointing task: {run.poses} random poses, seed {run.seed}")

# %%
# Weighted by the failure rate of each joint (only ratios matter):

rates = dict.fromkeys(arm.joint_names, 1.0) | {"panda_joint4": 4.0}
print(f"expected, the elbow failing four times as often: {run.expected_survival(rates):.3f}")
