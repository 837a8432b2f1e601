"""
A learned policy when a joint locks
===================================

A small network pushes an object to its goal in the simulated environment Pusher of Gymnasium. A
joint locks after a second, and the policy receives no information about the lock. The training,
and success rates under each kind of fault, are in `measurements/faults/POLICY.md`.
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt

from holdfast import faults

repository = Path.cwd().parents[2]
sys.path.insert(0, str(repository))
from measurements.faults.policy import network, task

policy = network.load(repository / "measurements" / "faults" / "policy" / "healthy.npz")
figure, panels = plt.subplots(1, 3, figsize=(10, 4.2), sharex=True, sharey=True)
joints = [None, "r_shoulder_lift_joint", "r_wrist_roll_joint"]
for axes, joint in zip(panels, joints, strict=True):
    env = task.environment(None if joint is None else faults.locked(joint, onset=1.0), seed=0)
    done = 0
    for episode in range(12):
        seen, there = task.seen(env, policy, seed=episode, episode=episode)
        done += there
        color = "tab:blue" if there else "tab:orange"  # to the goal, or not
        axes.plot(*seen[:, 14:16].T, color="0.8", linewidth=0.8)  # the fork
        axes.plot(*seen[:, 17:19].T, color=color, linewidth=1.8)  # the object
        axes.plot(*seen[-1, 17:19], "o", color=color, markersize=4)
    axes.add_patch(plt.Circle((0.45, -0.05), task.NEAR, fill=False))
    axes.set(xlabel="x, m", aspect="equal", xlim=(0.1, 0.85), ylim=(-0.65, 0.1))
    axes.set_title(f"{joint or 'no joint'} locks: {done} of 12", fontsize=9)
panels[0].set_ylabel("y, m")
figure.suptitle("Ways of the object (blue: to the goal, orange: not) and of the fork (grey)")
figure.tight_layout()
