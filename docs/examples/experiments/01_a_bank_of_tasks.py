"""
Tasks for an experiment
=======================

A person steers an arm with a locked joint, which the controller has not detected. First, the
computer performs 40 random tasks for each joint. The results show how much harder the lock makes
each task, and whether the failure-tolerant inverse helps.
"""

import holdfast as hf
from holdfast import teleop

arm = hf.arms.load("planar-3r")
bank = teleop.make_task_bank(arm, per_joint=40, seed=1)
choice = teleop.choose_tasks(bank, arm, count=12)
for line in choice.describe():
    print(line)

# %%
# Tasks to the right are harder, and tasks further up are worse with failure tolerance. The 12
# chosen tasks come from as many cells as possible.

choice.plot()
