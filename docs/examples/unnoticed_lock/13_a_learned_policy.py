"""
A learned policy when a joint locks
===================================

A small network pushes an object to its goal in Gymnasium's Pusher. Then a joint locks after a
second; nobody tells the policy. Simulated, of course. How it was trained, and how often it
finishes under each kind of fault, is in `papers/faults/POLICY.md` of the repository.
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from holdfast import faults

repository = Path.cwd().parents[2]
sys.path.insert(0, str(repository))
from papers.faults.policy import network, task

policy = network.load(repository / "papers" / "faults" / "policy" / "healthy.npz")


def way(fault, episode):
    """Where the object and the fork are, (T, 2) each, m, and whether the task is done."""
    env = task.environment(fault, seed=0)
    observation, _ = env.reset(seed=episode, options={"episode": episode})
    seen = [observation]
    for _ in range(task.STEPS):
        seen.append(env.step(policy(seen[-1]))[0])
    return np.array(seen)[:, 17:19], np.array(seen)[:, 14:16], task.off(env) <= task.NEAR


# %%
# The same twelve episodes, seen from above: without a fault, and with a joint that locks.

cases = {
    "healthy": None,
    "the shoulder's lift locks after 1 s": faults.locked("r_shoulder_lift_joint", onset=1.0),
    "the wrist's roll locks after 1 s": faults.locked("r_wrist_roll_joint", onset=1.0),
}
figure, panels = plt.subplots(1, 3, figsize=(10, 4.2), sharex=True, sharey=True)
for axes, (words, fault) in zip(panels, cases.items(), strict=True):
    done = 0
    for episode in range(12):
        thing, fork, there = way(fault, episode)
        done += there
        axes.plot(*fork.T, color="0.8", linewidth=0.8)
        axes.plot(*thing.T, color="tab:blue" if there else "tab:orange", linewidth=1.8)
        axes.plot(*thing[-1], "o", color="tab:blue" if there else "tab:orange", markersize=4)
    axes.add_patch(plt.Circle((0.45, -0.05), task.NEAR, fill=False))
    axes.set(
        title=f"{words}: {done} of 12",
        xlabel="x, m",
        aspect="equal",
        xlim=(0.1, 0.85),
        ylim=(-0.65, 0.1),
    )
    axes.title.set_fontsize(9)
panels[0].set_ylabel("y, m")
figure.suptitle(
    "Ways of the object (blue: to the goal, orange: not) and of the fork (grey)", fontsize=10
)
figure.tight_layout()
