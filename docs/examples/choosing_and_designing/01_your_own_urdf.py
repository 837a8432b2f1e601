"""
An arm of your own
==================

Three links on a rail, as a URDF file of a few lines. ``hf.Arm.from_urdf`` reads any serial chain of a file; inertial data
are optional and needed only for joints that swing free.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import holdfast as hf

JOINT = """<joint name="{name}" type="{kind}"><origin xyz="{x} 0 0.1"/><axis xyz="{axis}"/>
  <parent link="{before}"/><child link="{name}_link"/><limit lower="-2.5" upper="2.5" effort="80" velocity="2"/></joint>
<link name="{name}_link"/>"""
chain = [("rail", "prismatic", 0, "1 0 0"), ("turn", "revolute", 0, "0 0 1"), ("shoulder", "revolute", 0, "0 1 0")]
chain += [("elbow", "revolute", 0.5, "0 1 0"), ("wrist", "revolute", 0.4, "0 1 0")]
parents = ["base", *(f"{name}_link" for name, *_ in chain)]
joints = [JOINT.format(name=n, kind=k, x=x, axis=a, before=b) for (n, k, x, a), b in zip(chain, parents, strict=False)]
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder, "rail.urdf")
    file.write_text(f'<robot name="rail arm"><link name="base"/>{"".join(joints)}</robot>')
    arm = hf.Arm.from_urdf(file, tip="wrist_link")

q = np.random.default_rng(0).uniform(arm.lower, arm.upper, (2000, arm.n))
left = hf.indices.relative_manipulability(arm, "position").by_joint(q)
figure, axes = plt.subplots(figsize=(7, 3.6), layout="constrained")
axes.boxplot(left, tick_labels=arm.joint_names, showfliers=False, medianprops={"color": "#c8500a", "linewidth": 2.5})
axes.set(xlabel="joint that locks", ylabel="relative manipulability (no unit)")
axes.set_title(f"{arm.name}, position task: {len(q)} random configurations")
axes.spines[["top", "right"]].set_visible(False)
