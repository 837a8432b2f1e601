"""
Detect a fault in a log
=======================

The third joint of a simulated Panda locks while the arm moves. The monitor, which is calibrated
on logs of the healthy arm, identifies the joint within 10 ms. Each panel shows residuals divided
by their thresholds.
"""

import holdfast as hf

panda = hf.arms.load("panda")
friction = {"coulomb": [0.5] * 7, "viscous": [0.3] * 7}
healthy = [hf.diagnosis.simulate_log(panda, 3, seed=k, robot=0) for k in range(4)]
bounds = hf.diagnosis.calibrate(panda, healthy, **friction)

# %%
# The same robot with a lock after 1.5 s:

fault = hf.faults.FaultEvent("locked", "panda_joint3", 1.5)
record = hf.diagnosis.simulate_log(panda, 3, seed=9, robot=0, faults=[fault])
found = hf.diagnosis.diagnose(panda, record, bounds)
print("\n".join(found.describe()))
found.plot()
