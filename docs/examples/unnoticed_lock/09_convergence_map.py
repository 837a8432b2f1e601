"""
Outcomes for each locked joint
==============================

The script simulates motions of a Panda from 80 random starts with 4 configurations each. Every
motion runs with each joint locked from its beginning, and once without a lock. Orange shows the
motions that a better control law could save, because the target is within reach and the arm does
not arrive.
"""

import holdfast as hf

arm = hf.arms.load("panda")
law = hf.control.pseudoinverse(arm, "position")
found = hf.convergence_map(law, [0.5, 0.2, 0.4], 80, configurations=4, seed=1)
for name, share in found.shares("converged").items():
    print(f"{name:13} converges {share}")

# %%
# The elbow, joint 4, is the critical joint, mostly because its lock puts the target out of reach.

found.plot("outcomes")
