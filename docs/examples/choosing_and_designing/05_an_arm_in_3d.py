"""
A 3-D view of an arm
====================

``arm.show()`` is a small 3-D view without a server or a network. A notebook shows it directly,
and ``save`` writes it to one file. Rotate the view with the mouse or the arrow keys. This view
contains a Panda, its best configuration of the same pose, and a locked joint.
"""

# sphinx_gallery_capture_repr = ('_repr_html_',)
# sphinx_gallery_thumbnail_path = '_static/arm-show.png'

import numpy as np

import holdfast as hf

arm = hf.arms.load("panda")
q = np.deg2rad([0, 20, 0, -120, 0, 150, 45])
index = hf.indices.relative_manipulability(arm, "position")
best = hf.optimise(arm, arm.forward_kinematics(q), index, seed=1)
print(f"the worst lock leaves {index(q):.2f}, in the best configuration {best.value:.2f}")

arm.show([q, best.q], labels=["as it is", "best found"], locked=["panda_joint2"])
