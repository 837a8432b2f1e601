"""A space arm with a locked joint: whether it can still berth a vehicle, step onto a fixture, and reach, and at which angles.

Change the arm, the work and the angles to your own: python docs/dossiers/space_arm.py --out FOLDER
"""

import numpy as np
from matplotlib.figure import Figure
from owners_page import run, span, write

import holdfast as hf
from holdfast.core.probability import Interval
from holdfast.interface import report
from holdfast.model.arm import Joint

# Axis of each joint of the station's arm (SSRMS, Canadarm2), and its position from the previous joint, m, with all joints at 0.
X, Y, Z = np.eye(3)
JOINTS = {
    "shoulder roll": (X, (1.3589, 0, 0)),
    "shoulder yaw": (Z, (0, 0, 0.7026)),
    "shoulder pitch": (Y, (0, -0.5692, 0)),
    "elbow pitch": (Y, (7.11, -0.475, 0)),
    "wrist pitch": (Y, (7.11, 0, 0)),
    "wrist yaw": (Z, (0, -0.5692, 0)),
    "wrist roll": (X, (0, 0, -0.7026)),
}
TOOL, LIMIT = (1.3589, 0, 0), np.radians(270)  # m from the last joint to the end effector; rad, of every joint either way
BACK = np.array([0, np.pi, 0])  # the end effector looks back at the wall (x = 0) that carries the arm, at the origin
WORK = {  # task and region of each kind of work, m and rad
    "berth a vehicle": ("pose", hf.Region.box([3, 6, 0], [2, 3, 3], BACK, np.radians(40))),
    "step onto a fixture": ("pose", hf.Region.box([0, 4, 0], 0.0, BACK, [2 * np.pi, 0, 0])),
    "reach": ("position", hf.Region.box([6, 0, 0], [12, 24, 24])),
}
STEP = 15  # deg
ANGLES = np.arange(-180, 180, STEP)  # at which a joint may have locked


def shift(xyz):
    """(4, 4) of a shift, m."""
    return np.block([[np.eye(3), np.reshape(xyz, (3, 1))], [np.zeros(3), 1]])


def still_done(arm, task, region, count):
    """(poses, joints, angles) whether each drawn pose is reached with each joint locked at each angle."""
    poses = region.poses(region.samples(0, count, count, seed=1, sampling="random", count=count))
    each, at = np.repeat(poses, ANGLES.size, axis=0), np.radians(np.tile(ANGLES, count))
    found = [hf.reachable_when_locked(arm, each, {name: at}, task=task, seed=1, restarts=20).success for name in JOINTS]
    return np.stack(found, axis=1).reshape(count, ANGLES.size, len(JOINTS)).swapaxes(1, 2)


def deg(done, joint):
    """Return the angles at which most of a kind of work remains possible, in words."""
    good = ANGLES[done[:, joint].mean(axis=0) > 0.5]
    return f"{', '.join(f'{a}' for a in good)} degrees" if good.size else "none of the angles tried"


def maps(done):
    """Draw the fraction of each kind of work that remains, by joint and angle."""
    with report.style():
        figure = Figure(figsize=(7.2, 2.6), layout="constrained")
        for axes, (name, left) in zip(figure.subplots(1, len(done), sharey=True), done.items(), strict=True):
            shares, extent = 100 * left.mean(axis=0), (ANGLES[0] - STEP / 2, ANGLES[-1] + STEP / 2, len(JOINTS) - 0.5, -0.5)
            image = axes.imshow(shares, cmap="cividis", vmin=0, vmax=100, aspect="auto", extent=extent)
            axes.set(title=name, xlabel="locked at, deg", xticks=(-180, -90, 0, 90), yticks=range(len(JOINTS)))
            axes.set_yticklabels(JOINTS)
            axes.grid(False)
        figure.colorbar(image, label="remaining, %")
    return figure


def main(out, count=300):
    joints = [Joint(n, "revolute", shift(at), axis=axis, lower=-LIMIT, upper=LIMIT) for n, (axis, at) in JOINTS.items()]
    arm = hf.Arm("space arm", tuple(joints), tool=shift(TOOL), gravity=(0, 0, 0))
    done = {name: still_done(arm, task, region, count) for name, (task, region) in WORK.items()}
    healthy = {name: left.any(axis=(1, 2)).mean() for name, left in done.items()}
    mean = {name: left.mean(axis=(0, 2)) for name, left in done.items()}
    berth, names = "berth a vehicle", list(JOINTS)
    k = int(mean[berth].argmin())
    others, by_angle = np.delete(mean[berth], k), done[berth][:, k].mean(axis=0)
    best, none = ANGLES[by_angle.argmax()], ANGLES[by_angle == 0]
    answer = (
        f"Protect the {names[k]}. Locked at a uniformly random angle, it leaves "
        f"{span(Interval.of_fractions(done[berth][:, k].mean(axis=1)))} of the berthing poses, and any other joint leaves at "
        f"least {100 * others.min():.0f} %. The result depends on the angle. At {best} degrees {by_angle.max():.0%} remain. "
        f"At {none.size} of the {ANGLES.size} angles tried none does. The arm can step onto a fixture at "
        f"{deg(done['step onto a fixture'], k)}."
    )
    rows = [(n, *(f"{share[j]:.0%}" for share in mean.values())) for j, n in enumerate(names)]
    rows += [("no lock", *(f"{share:.0%}" for share in healthy.values()))]
    method = (
        f"{count} poses of each kind of work, with each joint locked at each of {ANGLES.size} angles of equal weight. Inverse "
        "kinematics starts from 20 random configurations, and the joint limits are ±270 degrees. A pose not found counts as "
        "lost, so the fractions are lower bounds. The interval is over the poses. 'No lock' means found with any of the "
        "locks. The model is our own, from dimensions of Nguyen and Hughes 1994 as a URDF file of TraceableRobotModels quotes "
        "them. We did not read the chapter itself. The base, the work and the permitted rotation are our choice. The station, "
        "collisions, flexible links, and the motion between poses are not modelled. A free-swinging joint does not fall in "
        "free fall, because no weight acts on it, so its drift from rest is zero. It can no longer be driven, however."
    )
    figure = maps(done)
    evidence = {
        "Results by joint": report.Table(rows, ("locked", *WORK), wide=True),
        "Results by angle": report.Picture(
            report.svg(figure, "angles", "Three maps"), "Fraction of the work that remains possible."
        ),
    }
    write(out, "space_arm", "A space arm with a locked joint", answer, evidence, figure=figure, method=method, count=count)


if __name__ == "__main__":
    run(main, 300)
