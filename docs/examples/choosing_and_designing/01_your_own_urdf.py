"""
Your own URDF
=============

This script describes links on a rail in a URDF file of a few lines. ``hf.Arm.from_urdf`` reads
any serial chain of a file. Inertial data are optional and needed only for free-swinging joints.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

JOINT = """
<joint name="{name}" type="{kind}"><origin xyz="{x} 0 0.1"/><axis xyz="{axis}"/>
  <parent link="{parent}"/><child link="{name}_link"/>
  <limit lower="-2.5" upper="2.5" effort="80" velocity="2"/></joint>
<link name="{name}_link"/>"""
text, parent = '<robot name="rail arm"><link name="base"/>', "base"
for name, kind, x, axis in (
    ("rail", "prismatic", 0, "1 0 0"),
    ("turn", "revolute", 0, "0 0 1"),
    ("shoulder", "revolute", 0, "0 1 0"),
    ("elbow", "revolute", 0.5, "0 1 0"),
    ("wrist", "revolute", 0.4, "0 1 0"),
):
    text += JOINT.format(name=name, kind=kind, x=x, axis=axis, parent=parent)
    parent = f"{name}_link"
with tempfile.TemporaryDirectory() as folder:
    Path(folder, "rail.urdf").write_text(text + "</robot>")
    arm = hf.Arm.from_urdf(Path(folder, "rail.urdf"))
q = np.random.default_rng(0).uniform(arm.lower, arm.upper, (2000, arm.n))
left = hf.indices.relative_manipulability(arm, "position").by_joint(q)
figure, axes = plt.subplots(figsize=(7, 3.6))
axes.boxplot(left, tick_labels=arm.joint_names)
axes.set(xlabel="joint that locks", ylabel="relative manipulability", title="2000 random")
