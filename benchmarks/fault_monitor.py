"""W18: what the fault wrapper adds to a step, the monitor and records beside Pinocchio, and law with monitor in C."""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
import statistics
import time

import numpy as np

import harness

STEPS = 20_000
RATE = 1000.0


def per_call(call, count: int) -> float:
    """Processor time of one call, us."""
    start = time.process_time()
    for _ in range(count):
        call()
    return 1e6 * (time.process_time() - start) / count


def wrapper(chosen: argparse.Namespace) -> str:
    """The layer alone: an environment that does nothing, so that its own step does not hide what is added."""
    import gymnasium
    import mujoco

    import holdfast as hf

    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><body><joint name='a'/><geom size='.1'/></body></worldbody>"
        "<actuator><motor joint='a'/></actuator></mujoco>"
    )
    nothing = np.zeros(2)

    class Idle(gymnasium.Env):
        def __init__(self):
            self.model, self.data = model, mujoco.MjData(model)
            self.action_space = self.observation_space = gymnasium.spaces.Box(-1, 1, (1,))

        def reset(self, *, seed=None, options=None):
            return nothing, {}

        def step(self, action):
            return nothing, 0.0, False, False, {}

    faults = hf.faults.FaultModel([hf.faults.locked(onset=0.0), hf.faults.weak(gain=0.5, onset=9.0)])
    bare = gymnasium.Wrapper(Idle())
    faulty = hf.faults.FaultWrapper(Idle(), faults)
    faulty.reset()
    pusher = gymnasium.make("Reacher-v5").unwrapped
    pusher.reset()
    action, push = np.zeros(1), np.zeros(2)
    count = STEPS // 20 if chosen.quick else STEPS
    added, share = [], []
    for _ in range(chosen.rounds):
        more = per_call(lambda: faulty.step(action), count) - per_call(lambda: bare.step(action), count)
        added.append(more)
        share.append(100 * more / per_call(lambda: pusher.step(push), count // 20))
    rows = [
        ["added to a step, us", f"{statistics.median(added):.2f}", f"{min(added):.2f} to {max(added):.2f}", "bar: 1"],
        ["of a step of Reacher-v5, %", f"{statistics.median(share):.2f}", f"{min(share):.2f} to {max(share):.2f}", "bar: 1"],
    ]
    return harness.table("The wrapper, processor time", ["what", "median", "range", "note"], rows)


def vectors(chosen: argparse.Namespace) -> str:
    """Steps of many arms whose joints lock, beside a loop over them with NumPy and Pinocchio's kinematics."""
    import pinocchio as pin

    import holdfast as hf

    arm, count, period, damping = hf.arms.load("panda"), 64 if chosen.quick else 1024, 0.02, 0.05
    law = hf.control.damped(arm, damping, task="position", gain=1.5)
    start = np.array([0.0, -0.4, 0.0, -2.0, 0.0, 1.8, 0.7])
    pose = arm.forward_kinematics(start + 0.2)
    faults = hf.faults.FaultModel([hf.faults.locked(onset=(0.0, 0.2))], seed=18)
    options = {"period": period, "start": start, "tolerance": (0.0, 0.0), "horizon": 1e6}
    env = hf.faults.FaultVectorEnv(law, count, faults, goals=lambda generator, n: np.tile(pose, (n, 1, 1)), **options)
    still = np.zeros(env.action_space.shape)
    model, tool = oracles().to_pinocchio(arm)
    data, most = model.createData(), np.array([joint.velocity for joint in arm.joints])
    events = [faults.draw(arm, episode=k, horizon=1e6)[0] for k in range(count)]
    locks = [(arm.joint_index(event.joint), event.onset) for event in events]

    def looped(q, time):
        for row, (joint, onset) in zip(q, locks, strict=True):
            pin.computeJointJacobians(model, data, row)
            pin.updateFramePlacement(model, data, tool)
            jacobian = pin.getFrameJacobian(model, data, tool, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)[:3]
            wanted = 1.5 * (pose[:3, 3] - data.oMf[tool].translation)
            rates = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + damping**2 * np.eye(3), wanted)
            rates = np.clip(rates, -most, most)
            if onset <= time + 1e-9:
                rates[joint] = 0.0
            row += period * rates
        return q

    env.reset(seed=0)
    q = np.tile(start, (count, 1))
    for k in range(15):
        env.step(still)
        looped(q, k * period)
    far = float(np.abs(env.q - q).max())
    both = [(per_call(lambda: env.step(still), 20), per_call(lambda: looped(q, 1.0), 2)) for _ in range(chosen.rounds)]
    ratio = statistics.median(theirs / ours for ours, theirs in both)
    each = [f"{statistics.median(x) / count:.3g}" for x in zip(*both, strict=True)]
    row = [f"{count} Pandas, locks", *each, f"{ratio:.3g}", f"joints apart after 15 steps by at most {far:.1g} rad"]
    head = ["what", "holdfast", "loop", "holdfast is faster by", "note"]
    return harness.table("FaultVectorEnv, processor time of a step of an arm, us", head, [row])


def oracles():
    """Of the tests, which make a model of Pinocchio."""
    import importlib
    import sys
    from pathlib import Path

    sys.path.append(str(Path(__file__).parents[1] / "tests"))
    return importlib.import_module("oracles")


def with_pinocchio(arm):
    """A momentum observer as one writes it with Pinocchio: a step of it."""
    import pinocchio as pin

    model, _ = oracles().to_pinocchio(arm)
    data, gain, dt = model.createData(), 40.0, 1 / RATE
    state = {"s": np.zeros(arm.n), "r": np.zeros(arm.n)}

    def step(q, v, tau):
        inertia = pin.crba(model, data, q)
        inertia = np.triu(inertia) + np.triu(inertia, 1).T
        coriolis = pin.computeCoriolisMatrix(model, data, q, v)
        gravity = pin.computeGeneralizedGravity(model, data, q)
        state["s"] = state["s"] + dt * (tau + coriolis.T @ v - gravity + state["r"])
        state["r"] = gain * (inertia @ v - state["s"])
        return state["r"]

    return step


def monitor(chosen: argparse.Namespace) -> str:
    """One step, and a record of a minute."""
    import holdfast as hf

    arm, n = hf.arms.load("panda"), 7
    count = 1_000 if chosen.quick else 60_000
    g = np.random.default_rng(0)
    q = 0.3 * np.sin(np.arange(count)[:, None] / RATE * g.uniform(0.5, 1.5, n))
    tau = arm.gravity_torque(q)
    log = hf.faults.Log(t=np.arange(count) / RATE, q_ref=q, q=q + g.normal(0, 2e-5, q.shape), tau=tau)
    watch = hf.diagnosis.Monitor(arm, hf.diagnosis.calibrate(arm, [log, log]))
    peer = with_pinocchio(arm)
    rates = np.gradient(q, 1 / RATE, axis=0)
    few = min(count, 2_000)

    def ours():
        watch.reset()
        for k in range(few):
            watch.step(q[k], q[k], tau[k])

    def theirs():
        for k in range(few):
            peer(q[k], rates[k], tau[k])

    def whole():
        watch.run(log)

    def looped():
        for k in range(count):
            peer(q[k], rates[k], tau[k])

    rows = []
    for what, first, second, size in (
        ("one step: observer, filters and tests of ours, the observer alone of Pinocchio's", ours, theirs, few),
        (
            f"a record of {count / RATE:g} s at 1 kHz, us a sample: all of ours, the observer alone of its",
            whole,
            looped,
            count,
        ),
    ):
        harness.progress(what)
        a, b = harness.alternate(first, second, chosen.rounds)
        ratio = statistics.median(y / x for x, y in zip(a, b, strict=True))
        each = [f"{1e6 * statistics.median(x) / size:.3g}" for x in (a, b)]
        rows.append([what, *each, f"{ratio:.3g}", "in Python both"])
    return harness.table("The monitor, us", ["what", "holdfast", "pinocchio", "holdfast is faster by", "note"], rows)


TIMER = """
#define _POSIX_C_SOURCE 199309L
#include "law.h"
#include "law_monitor.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
enum { N = LAW_JOINTS, CYCLES = %d };
static law_monitor_state state;
static double took[CYCLES];
static int order(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}
int main(void) {
    double q[N], reference[N], torque[N], rates[N], v[LAW_ROWS] = {0.05};
    struct timespec from, to;
    law_monitor_verdict told;
    int k, i;
    law_monitor_init(&state);
    for (k = 0; k < CYCLES; ++k) {
        for (i = 0; i < N; ++i) {
            reference[i] = 0.3 * sin(1e-3 * k * (1 + 0.1 * i)) + (i == 3 ? -1.5 : i == 5 ? 1.5 : 0);
            q[i] = reference[i] - 1e-3;
            torque[i] = 5 * cos(1e-3 * k);
        }
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &from);
        law(q, v, rates%s);
        law_monitor_step(&state, q, reference, torque, 0, &told);
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &to);
        took[k] = 1e6 * (double)(to.tv_sec - from.tv_sec) + 1e-3 * (double)(to.tv_nsec - from.tv_nsec);
    }
    qsort(took, CYCLES, sizeof *took, order);
    printf("%%g %%g %%g\\n", took[CYCLES / 2], took[(int)(0.99 * CYCLES)], took[(int)(0.999 * CYCLES)]);
    return 0;
}
"""


CONTROLLER_TIMER = """
#include "law_controller.hpp"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>
using namespace law_controller;
int main() {
    const int cycles = %d;
    std::vector<double> took(cycles);
    Joints q{}, effort{}, command{};
    std::array<const double *, joints> position{}, torque{};
    std::array<double *, joints> velocity{};
    for (int i = 0; i < joints; ++i) position[i] = &q[i], torque[i] = &effort[i], velocity[i] = &command[i];
    q[3] = -1.5, q[5] = 1.5;
    Options options;
    options.reacts = false;
    TolerantController brain(options);
    brain.on_configure();
    brain.assign(position, &torque, velocity);
    if (brain.on_activate() != Return::ok) return 1;
    for (int k = 0; k < cycles; ++k) {
        for (int i = 0; i < joints; ++i) q[i] += command[i] / rate, effort[i] = 5 * std::cos(1e-3 * k);
        for (int i = 0; i < 6; ++i) brain.references()[i] = 0.05 * std::sin(2e-3 * k + i);
        timespec from, to;
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &from);
        brain.update_and_write_commands(k / rate, 1 / rate);
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &to);
        took[k] = 1e6 * (double)(to.tv_sec - from.tv_sec) + 1e-3 * (double)(to.tv_nsec - from.tv_nsec);
    }
    std::sort(took.begin(), took.end());
    std::printf("%%g %%g %%g\\n", took[cycles / 2], took[(int)(0.99 * cycles)], took[(int)(0.999 * cycles)]);
}
"""


def in_c(chosen: argparse.Namespace) -> str:
    """Law and monitor in C, and the controller in C++: one control cycle, with what two looks at the clock take."""
    import shutil
    import subprocess
    import tempfile
    from pathlib import Path

    import holdfast as hf

    if shutil.which("cc") is None or shutil.which("c++") is None:
        return "No C and C++ compilers here.\n"
    arm, cycles = hf.arms.load("panda"), 10_000 if chosen.quick else 200_000
    t = np.arange(2000) / RATE
    q = 0.3 * np.sin(np.outer(t, np.linspace(0.5, 1.5, 7)))
    log = hf.faults.Log(t=t, q_ref=q, q=q - 1e-4 * t[:, None], tau=arm.gravity_torque(q))
    bounds, rows = hf.diagnosis.calibrate(arm, [log], factor=20.0), []
    for label, law in (
        ("pseudoinverse", hf.control.pseudoinverse(arm)),
        ("failure-tolerant", hf.control.failure_tolerant(arm)),
    ):
        with tempfile.TemporaryDirectory() as folder:
            header = law.export_c(folder, "law").header.read_text(encoding="utf-8")
            hf.diagnosis.export_c(arm, bounds, folder, name="law_monitor")
            hf.supervisor.export_controller(law, bounds, folder, name="law_controller")
            nulls = ", 0" * header[header.index("int law(") :].split(";")[0].count("double *")
            (Path(folder) / "timer.c").write_text(TIMER % (cycles, nulls), encoding="utf-8")
            (Path(folder) / "timer.cpp").write_text(CONTROLLER_TIMER % cycles, encoding="utf-8")
            parts = ("law.c", "law_monitor.c", "law_controller_law.c", "law_controller_monitor.c")
            objects = ("law_controller_law.o", "law_controller_monitor.o")
            for command in (
                ["cc", "-std=c99", "-O3", "-c", *parts],
                ["cc", "-std=c99", "-O3", "timer.c", "law.o", "law_monitor.o", "-lm", "-o", "timer_c"],
                ["c++", "-std=c++17", "-O3", "timer.cpp", "law_controller.cpp", *objects, "-o", "timer_cpp"],
            ):
                subprocess.run(command, cwd=folder, check=True)
            for what in ("c", "cpp"):
                told = [
                    subprocess.run([f"{folder}/timer_{what}"], capture_output=True, text=True, check=True).stdout.split()
                    for _ in range(chosen.rounds)
                ]
                middle = np.median(np.array(told, dtype=float), axis=0)
                name = f"law {label} and monitor, C" if what == "c" else f"TolerantController, {label}, C++"
                rows.append([name, *(f"{x:.3g}" for x in middle), "bars: 5 and 50"])
    head = ["what", "median", "99 %", "99.9 %", "note"]
    return harness.table(f"A cycle in C, processor time of the thread, us, {cycles} cycles", head, rows)


def main() -> None:
    chosen = harness.options(__doc__)
    print("## W18: faults\n")
    print(harness.environment() + "\n")
    print(wrapper(chosen))
    print(vectors(chosen))
    print(monitor(chosen))
    print(in_c(chosen))


if __name__ == "__main__":
    main()
