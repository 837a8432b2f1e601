"""
How motions end, joint by joint
===============================

80 random starts of a Panda, 4 configurations each. Each motion is made with every joint locked in
turn from its beginning, and once with none. Orange is the bad luck that a better law could mend:
the target is in reach, and the arm not there.
"""

import holdfast as hf

arm = hf.arms.load("panda")
law = hf.control.pseudoinverse(arm, "position")
found = hf.convergence_map(law, [0.5, 0.2, 0.4], 80, configurations=4, seed=1)
for name, share in found.shares("converged").items():
    print(f"{name:13} converges {share}")

# %%
# The elbow, joint 4, is the joint to worry about, mostly because its lock takes the target out of
# reach.

found.plot("outcomes")
