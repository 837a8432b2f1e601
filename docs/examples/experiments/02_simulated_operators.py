"""
An experiment without people
============================

Six simulated operators do a whole experiment: training, four scenarios of six tasks each, ratings. The records are those of a
real session, marked *simulated*. Six are enough for a picture, not for a result. Needs ``holdfast[stats]``.
"""

import tempfile
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

from holdfast import teleop

whole = teleop.read_protocol("goel2003-smooth")
few = replace(whole.with_tasks(whole.tasks.take(np.array([0, 3, 6, 9, 13, 19])), whole.notes[:6]), subjects=6)
with tempfile.TemporaryDirectory() as folder, teleop.simulate_experiment(folder, few, 6, seed=4) as records:
    table = teleop.trial_table(records)

# %%
# M3 is the largest distance of the tool from the straight way, in m.

groups = dict(list(table.groupby("scenario")["M3"]))
figure, axes = plt.subplots(figsize=(7, 3.6), layout="constrained")
axes.boxplot(groups.values(), tick_labels=groups.keys(), medianprops={"color": "#c8500a", "linewidth": 2.5})
axes.set(xlabel="scenario", ylabel="off the straight way by at most, m")
axes.set_title(f"{len(table)} simulated trials of 6 operators")
axes.spines[["top", "right"]].set_visible(False)
