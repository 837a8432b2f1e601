"""W6: one step of a control loop, Panda, single thread: what a call from Python takes, median and 99th percentile."""

from __future__ import annotations

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")  # the thread that controls is the only one
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("MKL_NUM_THREADS", "1")

import argparse
import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

import harness
import panda
from harness import Spread, number

POSTURES = 500
PERIOD = 1e-3  # s
GAIN = 0.1
CAP = 2.0  # rad/s, of the norm of our rates
INSIDE = 0.5  # share of the joint limits' range in which the configurations lie

Step = Callable[[int], np.ndarray]  # number of a configuration -> joint rates (7,)


@dataclass(frozen=True)
class Peer:
    name: str
    make: Callable[[np.ndarray, np.ndarray], Step]  # configurations (P, 7), twists (P, 6)
    note: str


# ---- holdfast --------------------------------------------------------------------------------------------------------


def law(**options):
    from holdfast import susceptibility
    from holdfast.kinematics.path_following import GradientProjection

    arm = panda.ours()
    return GradientProjection(arm, susceptibility.torque(arm, weights="effort"), gain=GAIN, **options)


def holdfast(q: np.ndarray, twist: np.ndarray) -> Step:
    step = law(rate_cap=CAP, period=PERIOD).prepare()
    return lambda i: step(q[i], twist[i])


def holdfast_rates(q: np.ndarray, twist: np.ndarray) -> Step:
    rates = law(rate_cap=CAP, period=PERIOD).rates
    return lambda i: rates(q[i], twist[i]).rates


# ---- Pinocchio and NumPy: null-space projection by hand ----------------------------------------------------------------


def projected(j: np.ndarray, v: np.ndarray, z: np.ndarray) -> np.ndarray:
    """``J^+ v + (I - J^+ J) z``, with one solve."""
    return z + j.T @ np.linalg.solve(j @ j.T, v - j @ z)


def pinocchio_centring(q: np.ndarray, twist: np.ndarray) -> Step:
    import pinocchio as pin

    model, data, tool = panda.pinocchio()
    middle, frame = (model.lowerPositionLimit + model.upperPositionLimit) / 2, pin.LOCAL_WORLD_ALIGNED

    def step(i: int) -> np.ndarray:
        x = q[i]
        return projected(pin.computeFrameJacobian(model, data, x, tool, frame), twist[i], GAIN * (middle - x))

    return step


def pinocchio_torque(q: np.ndarray, twist: np.ndarray) -> Step:
    import pinocchio as pin

    model, data, tool = panda.pinocchio()
    frame, scale = pin.LOCAL_WORLD_ALIGNED, -2 * GAIN * panda.weights()

    def step(i: int) -> np.ndarray:
        x = q[i]
        slopes = pin.computeGeneralizedGravityDerivatives(model, data, x)
        z = (scale * data.g) @ slopes
        return projected(pin.computeFrameJacobian(model, data, x, tool, frame), twist[i], z)

    return step


# ---- Robotics Toolbox --------------------------------------------------------------------------------------------------


def toolbox_centring(q: np.ndarray, twist: np.ndarray) -> Step:
    import roboticstoolbox as rtb

    model, _, tool = panda.pinocchio()
    parts = []
    for placement in list(model.jointPlacements)[1:]:
        parts += [rtb.ET.SE3(placement.homogeneous), rtb.ET.Rz()]
    chain = rtb.ETS([*parts, rtb.ET.SE3(model.frames[tool].placement.homogeneous)])
    middle = (model.lowerPositionLimit + model.upperPositionLimit) / 2

    def step(i: int) -> np.ndarray:
        x = q[i]
        j = chain.jacob0(x)
        inverse, z = np.linalg.pinv(j), GAIN * (middle - x)
        return inverse @ twist[i] + z - inverse @ (j @ z)

    return step


# ---- quadratic programs --------------------------------------------------------------------------------------------------


def targets(q: np.ndarray, twist: np.ndarray) -> Iterator:
    """Poses of the tool one period later, made before the clock runs."""
    import pinocchio as pin

    model, data, tool = panda.pinocchio()
    for x, v in zip(q, twist, strict=True):
        pin.framesForwardKinematics(model, data, x)
        place = data.oMf[tool].copy()
        turn = place.rotation.T
        yield place * pin.exp6(pin.Motion(turn @ v[:3] * PERIOD, turn @ v[3:] * PERIOD))


def by_pink(solver: str) -> Callable[[np.ndarray, np.ndarray], Step]:
    def make(q: np.ndarray, twist: np.ndarray) -> Step:
        import pink
        from pink.tasks import FrameTask, PostureTask

        model, data, tool = panda.pinocchio()
        configuration = pink.Configuration(model, data, q[0])
        hand, posture = FrameTask(model.frames[tool].name, 1.0, 1.0), PostureTask(1e-3)
        posture.set_target((model.lowerPositionLimit + model.upperPositionLimit) / 2)
        tasks, goals = [hand, posture], list(targets(q, twist))

        def step(i: int) -> np.ndarray:
            configuration.update(q[i])
            hand.set_target(goals[i])
            return pink.solve_ik(configuration, tasks, PERIOD, solver=solver)

        return step

    return make


def by_mink(q: np.ndarray, twist: np.ndarray) -> Step:
    import mink

    model = mujoco_model()
    configuration = mink.Configuration(model)
    hand, posture = mink.FrameTask("tool", "site", 1.0, 1.0), mink.PostureTask(model, cost=1e-3)
    posture.set_target(model.jnt_range.mean(axis=1))
    fastest = {joint.name: joint.velocity for joint in panda.ours().joints}
    limits = [mink.ConfigurationLimit(model), mink.VelocityLimit(model, fastest)]
    tasks, goals = [hand, posture], [mink.SE3.from_matrix(t.homogeneous) for t in targets(q, twist)]

    def step(i: int) -> np.ndarray:
        configuration.update(q[i])
        hand.set_target(goals[i])
        return mink.solve_ik(configuration, tasks, PERIOD, solver="daqp", limits=limits)

    return step


def mujoco_model():
    """The joints, limits and tool of the Panda in MuJoCo; the masses play no part in a kinematic step."""
    import mujoco
    import pinocchio as pin

    model, _, tool = panda.pinocchio()
    spec = mujoco.MjSpec()
    spec.compiler.degree = False

    def placed(m) -> dict:
        turn = pin.Quaternion(m.rotation)
        return {"pos": m.translation, "quat": [turn.w, turn.x, turn.y, turn.z]}

    body = spec.worldbody
    for k in range(panda.N):
        body = body.add_body(**placed(model.jointPlacements[k + 1]), mass=1.0, inertia=[0.01] * 3, explicitinertial=True)
        limits = [model.lowerPositionLimit[k], model.upperPositionLimit[k]]
        body.add_joint(name=model.names[k + 1], axis=[0, 0, 1], range=limits, limited=True)
    body.add_site(name="tool", **placed(model.frames[tool].placement))
    return spec.compile()


# ---- the race ------------------------------------------------------------------------------------------------------------

PEERS = [
    Peer("holdfast `law.rates`", holdfast_rates, "the same law with checks and a status"),
    Peer("Pinocchio + NumPy, null-space centring", pinocchio_centring, "no limits, no cap"),
    Peer("Pinocchio + NumPy, null-space torque gradient", pinocchio_torque, "no limits, no cap"),
    Peer("Robotics Toolbox jacob0 (C) + pinv, null-space centring", toolbox_centring, "no limits, no cap"),
    Peer("pink, frame + posture + limits, daqp", by_pink("daqp"), "quadratic program"),
    Peer("pink, frame + posture + limits, proxqp", by_pink("proxqp"), "quadratic program"),
    Peer("mink, frame + posture + limits, daqp", by_mink, "quadratic program"),
]


def timed(first: Step, second: Step, calls: int) -> tuple[list[int], list[int]]:
    """Nanoseconds of both, one call after the other."""
    times: tuple[list[int], list[int]] = ([], [])
    clock = time.perf_counter_ns
    for k in range(calls):
        i = k % POSTURES
        start = clock()
        first(i)
        between = clock()
        second(i)
        end = clock()
        times[0].append(between - start)
        times[1].append(end - between)
    return times


def twist_error(step: Step, q: np.ndarray, twist: np.ndarray) -> float:
    """Median of the largest entry of ``|J rates - twist|``, m/s and rad/s."""
    import pinocchio as pin

    model, data, tool = panda.pinocchio()
    errors = [
        np.abs(pin.computeFrameJacobian(model, data, x, tool, pin.LOCAL_WORLD_ALIGNED) @ step(i) - v).max()
        for i, (x, v) in enumerate(zip(q, twist, strict=True))
    ]
    return statistics.median(float(e) for e in errors)


def same_numbers(q: np.ndarray, twist: np.ndarray) -> tuple[float, int]:
    """Largest difference between our law and the one by hand where neither limits nor cap nor damping act, rad/s."""
    rates = law(rate_cap=CAP, period=PERIOD).rates(q, twist)
    by_hand = pinocchio_torque(q, twist)
    plain = law(period=None)
    free = (rates.self_motion == 1) & (rates.task == 1) & (rates.damping == 0)
    free &= np.abs(plain.rates(q, twist).rates - rates.rates).max(axis=1) == 0
    return max(np.abs(by_hand(i) - rates.rates[i]).max() for i in np.flatnonzero(free)), int(free.sum())


def main() -> None:
    extra = argparse.ArgumentParser(add_help=False)
    extra.add_argument("--calls", type=int, default=1000, help="calls of both in a round (default %(default)s)")
    chosen = harness.options(__doc__, rounds=10, parents=[extra])
    calls = 100 if chosen.quick else chosen.calls
    q = panda.configurations(POSTURES, share=INSIDE)
    twist = np.random.default_rng(1).normal(size=(POSTURES, 6)) * 0.1
    difference, free = same_numbers(q, twist)
    ours = holdfast(q, twist)
    timed(ours, ours, calls)
    alone = [t for _ in range(chosen.rounds) for t in timed(ours, ours, calls)[1]]
    note = "alone; torque gradient, rate cap, position and velocity limits"
    lines = [["**holdfast `law.step`**", *percentiles(alone), "-", "1", "1", f"{twist_error(ours, q, twist):.0e}", note]]
    for peer in PEERS:
        harness.progress(f"W6: {peer.name}")
        try:
            step = peer.make(q, twist)
            error = twist_error(step, q, twist)
            timed(ours, step, calls // 10)
            rounds = [timed(ours, step, calls) for _ in range(chosen.rounds)]
        except ImportError as missing:
            lines.append([peer.name, *"------", f"not installed: {missing.name}"])
            continue
        except Exception as failure:  # one broken peer must not cost the others their rows
            what = f"failed: {type(failure).__name__}: {str(failure)[:80]}".replace("\n", " ")
            lines.append([peer.name, *"------", what])
            continue
        own, theirs = ([t for both in rounds for t in both[k]] for k in (0, 1))
        medians = Spread.of([statistics.median(second) / statistics.median(first) for first, second in rounds])
        tails = Spread.of([float(np.percentile(second, 99) / np.percentile(first, 99)) for first, second in rounds])
        cells = [*percentiles(theirs), " / ".join(percentiles(own)), str(medians), str(tails), f"{error:.0e}", peer.note]
        lines.append([peer.name, *cells])
    head = [
        "contender",
        "median us",
        "p99 us",
        "holdfast beside it, median / p99 us",
        "holdfast is faster by (range)",
        "at p99",
    ]
    print(harness.table("W6: one control step, 7-joint Panda", [*head, "twist error", "note"], lines))
    print(
        f"{chosen.rounds} rounds of {calls} calls of each, holdfast and the peer by turns, {POSTURES} configurations in the "
        f"middle {INSIDE:.0%} of the joints' ranges; the clock's own time, {clock_time():.2g} us, is inside. Twist error: "
        f"|J rates - twist|, its largest entry, median of the {POSTURES} steps, m/s and rad/s. Where neither limits nor cap "
        f"act ({free} of {POSTURES}), our law and the same by hand in Pinocchio and NumPy differ by {difference:.0e} rad/s."
    )


def percentiles(nanoseconds: list[int]) -> list[str]:
    """Median and 99th percentile, us."""
    return [number(float(np.percentile(nanoseconds, p)) / 1e3) for p in (50, 99)]


def clock_time() -> float:
    """Microseconds between two readings of the clock."""
    clock = time.perf_counter_ns
    return statistics.median(-clock() + clock() for _ in range(1000)) / 1e3


if __name__ == "__main__":
    main()
