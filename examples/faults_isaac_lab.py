"""Faults in Isaac Lab: an interval event that locks joints and adds friction by the arrays of ``Faults.batch``.

UNTESTED: written from Isaac Lab's documentation; nobody has run it, a test only calls it with stand-ins. Newer versions name
these writers with ``_index`` or ``_mask`` behind. A weak motor and a dropout belong into an action term, which scales or holds
the joint's action.
"""

import holdfast as hf

LOCKED, FRICTION, SWINGING = (hf.faults.KINDS.index(kind) for kind in ("locked", "friction", "limp"))
FAULTS = hf.faults.load("faults.yaml")


def begin(env, asset_cfg, time, step):
    """What begins in [time, time + step), in every environment."""
    import torch

    robot = env.scene[asset_cfg.name]
    if not hasattr(env, "faults"):
        env.faults = FAULTS.batch(robot.joint_names, episodes=env.num_envs)
    batch = env.faults
    begins = (batch.onset >= time) & (batch.onset < time + step)
    for e, j in zip(*begins.nonzero(), strict=True):
        where = {"joint_ids": [int(j)], "env_ids": torch.tensor([int(e)], device=env.device)}
        if batch.kind[e, j] == LOCKED:
            q = robot.data.joint_pos[e, j]
            robot.write_joint_position_limit_to_sim(torch.stack([q - 1e-6, q + 1e-6]).view(1, 1, 2), **where)
        elif batch.kind[e, j] == SWINGING:
            robot.write_joint_effort_limit_to_sim(0.0, **where)
        elif batch.kind[e, j] == FRICTION:
            robot.write_joint_friction_coefficient_to_sim(float(batch.parameter[e, j, 0]), **where)
