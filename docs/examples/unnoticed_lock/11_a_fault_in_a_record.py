"""
A fault in a record
===================

A simulated Panda whose third joint locks while it moves: the monitor, calibrated on records of
the healthy arm, names it within 10 ms. Each panel shows residuals in units of their bounds.
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
