"""
An experiment without people
============================

Six simulated operators complete a whole experiment with training, four scenarios of four tasks
each, and ratings. The records have the format of a real session and are marked *simulated*. Six
operators are enough for an illustration, but not for a result. Needs ``holdfast-arms[stats]``.
"""

import tempfile
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

from holdfast import teleop

whole = teleop.read_protocol("goel2003-smooth")
some = [0, 6, 13, 19]
few = replace(whole.with_tasks(whole.tasks.take(np.array(some)), whole.notes[:4]), subjects=6)
with (
    tempfile.TemporaryDirectory() as out,
    teleop.simulate_experiment(out, few, 6, seed=4) as done,
):
    table = teleop.trial_table(done)

# %%
# Arm and control law, and the largest distance of the tool from the straight line (M3).

labels = [scenario.label.replace(", ", ",\n") for scenario in few.scenarios]
figure, axes = plt.subplots(figsize=(7, 3.6))
axes.boxplot([rows["M3"] for _, rows in table.groupby("scenario")], tick_labels=labels)
axes.set_ylabel("off the straight way by at most, m")
axes.set_title(f"{len(table)} simulated trials of 6 operators")
