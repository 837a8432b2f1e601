"""A holdfast control law in place of pink's ``solve_ik`` for one frame task.

    law = hf.control.failure_tolerant(hf.arms.load("arm.urdf"), task="pose")
    velocity = law_velocity(law, configuration, frame_task)
    configuration.integrate_inplace(velocity, dt)

The arm's hand must be the task's frame, and its joints those of the Pinocchio model, in order and each with one
coordinate (no continuous joints). Needs pin and pin-pink; the pose error is that of holdfast: (p_d - p; log(R_d R')).
"""

import numpy as np
from scipy.spatial.transform import Rotation


def pose_error(target, now):
    """(6,) from two 4x4 poses, world axes, m and rad."""
    turn = Rotation.from_matrix(target[:3, :3] @ now[:3, :3].T).as_rotvec()
    return np.concatenate([target[:3, 3] - now[:3, 3], turn])


def limited(law, error):
    """Velocity (6,) for an error: the law's gain, within its speed limit."""
    velocity = law.gain * error
    speed = np.linalg.norm(velocity[:3])
    slow = law.speed_limit is not None and speed > law.speed_limit
    return velocity * (law.speed_limit / speed) if slow else velocity


def law_velocity(law, configuration, task):
    """Joint velocities (n,) towards a ``pink.tasks.FrameTask``'s target."""
    target = task.transform_target_to_world.homogeneous
    now = configuration.get_transform_frame_to_world(task.frame).homogeneous
    return law.velocity(configuration.q, limited(law, pose_error(target, now)))
