"""
Detection, braking and continuation of a task
=============================================

The shoulder of a simulated Panda loses its torque on the way. A monitor identifies the joint, and
the controller brakes the joint, excludes it from the control law, and continues the task.
"""

import holdfast as hf
from holdfast.response.faults import FaultEvent

panda = hf.arms.load("panda")
law = hf.control.damped(panda, 0.02, task="position", gain=2.0, speed_limit=0.25)
start, goal, body = [-0.9, 0.1, 0, -2.0, 0, 2.1, 0.785], [0.42, 0.42, 0.45], hf.Body(3)
targets = [goal, [0.47, 0.22, 0.55], [0.42, -0.08, 0.45], [0.52, -0.38, 0.55]]
runs = [hf.simulate_faults(law, start, target, body=body) for target in targets]
friction = {"coulomb": [body.coulomb] * 7, "viscous": [body.viscous] * 7}
bounds = hf.diagnosis.calibrate(panda, [run.log() for run in runs], **friction)
monitor = hf.diagnosis.Monitor(panda, bounds)

# %%
# The same fault, first without a monitor and then with one:

fault = [FaultEvent("limp", "panda_joint2", 0.7)]
blind = hf.simulate_faults(law, start, goal, faults=fault, body=body, seed=9, time_limit=4)
chain = hf.simulate_faults(law, start, goal, faults=fault, body=body, seed=9, monitor=monitor)
print("\n".join([*blind.describe(), "", *chain.describe()]))
chain.plot()
