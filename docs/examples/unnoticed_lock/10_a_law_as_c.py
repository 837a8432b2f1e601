"""
Export a control law to C
=========================

This script exports the failure-tolerant inverse as one C99 function, without memory allocation or
libraries, for the controller of the robot. The folder also contains a header, an example loop,
and a test with numbers that holdfast computed.
"""

import tempfile

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

arm = hf.arms.load("planar-3r")
law = hf.control.failure_tolerant(arm, "planar", pre_failure_error=0.5)
with tempfile.TemporaryDirectory() as folder:
    for file in law.export_c(folder):
        print(f"{file.name}: {len(file.read_text().splitlines())} lines")

# %%
# The function computes a joint velocity for each tool velocity, here of 0.1 m/s in all
# directions. The pseudoinverse follows the command exactly. The failure-tolerant inverse deviates
# by at most half of it, and a lock does less harm in return.

angle = np.linspace(0, 2 * np.pi, 181)
wanted = 0.1 * np.c_[np.cos(angle), np.sin(angle)]
q = np.tile(np.deg2rad([30.0, 45.0, 60.0]), (len(angle), 1))
figure, axes = plt.subplots(figsize=(5.6, 4.4))
for of in (law, hf.control.pseudoinverse(arm, "planar")):
    error = of.deviations(q, wanted).peak_velocity_error
    axes.plot(np.rad2deg(angle), error, lw=2, label=of.name)
axes.set(xlabel="direction of the command, deg", ylabel="error after the worst lock (fraction)")
axes.legend()
