"""Faults in mjlab: what happens to which joint of which environment, written into the rows of its model.

UNTESTED: written from mjlab's documentation; nobody has run it, a test only calls it with stand-ins. What of each kind goes
where is as in ``holdfast.response.faults.FaultInjector``; here are locked joints and friction. MuJoCo Warp makes one row of a
joint's two limits, so they must not overlap as the injector's do: a lock is as soft as one step at full torque.
"""

import holdfast as hf

LOCKED, FRICTION = (hf.faults.KINDS.index(kind) for kind in ("locked", "friction"))
FIELDS = ("dof_frictionloss", "dof_damping", "jnt_range", "jnt_limited", "jnt_solref", "jnt_solimp")


def prepare(env, faults, joints):
    """Once, as the environments are built: rows of their own for every field that faults change."""
    env.sim.expand_model_fields(FIELDS)
    env.faults = faults.batch(joints, episodes=env.num_envs)


def apply(env, ids, time, step):
    """An event term, at every step: what begins in [time, time + step)."""
    batch, model, data = env.faults, env.sim.model, env.sim.data
    begins = (batch.onset >= time) & (batch.onset < time + step)
    for e, j in zip(*begins.nonzero(), strict=True):
        k = ids[j]
        if batch.kind[e, j] == LOCKED:
            q = float(data.qpos[e, model.jnt_qposadr[k]])
            model.jnt_limited[e, k] = 1
            model.jnt_range[e, k, 0], model.jnt_range[e, k, 1] = q - 1e-6, q + 1e-6  # in single precision
            model.jnt_solref[e, k, 0], model.jnt_solref[e, k, 1] = 2 * env.sim.mj_model.opt.timestep, 1.0
            for place, value in enumerate((0.9999, 0.9999, 0.001, 0.5, 2.0)):
                model.jnt_solimp[e, k, place] = value
        elif batch.kind[e, j] == FRICTION:
            coulomb, viscous = batch.parameter[e, j, :2]
            model.dof_frictionloss[e, model.jnt_dofadr[k]] += 0 if coulomb != coulomb else coulomb  # NaN: not given
            model.dof_damping[e, model.jnt_dofadr[k]] += 0 if viscous != viscous else viscous
