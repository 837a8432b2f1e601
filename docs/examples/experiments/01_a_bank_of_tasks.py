"""
Tasks for an experiment
=======================

A person steers an arm while one joint is locked; the controller does not know. Random tasks are
driven by the computer first: how much harder does the lock make each of them, and does the
failure-tolerant inverse help? 40 tasks for each joint.
"""

import holdfast as hf
from holdfast import teleop

arm = hf.arms.load("planar-3r")
bank = teleop.make_task_bank(arm, per_joint=40, seed=1)
choice = teleop.choose_tasks(bank, arm, count=12)
for line in choice.describe():
    print(line)

# %%
# To the right harder, upward worse with failure tolerance; 12 tasks are chosen from as many cells
# as there are.

choice.plot()
