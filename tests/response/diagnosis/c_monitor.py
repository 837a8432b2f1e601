"""The monitor in C beside that in Python over random records: compiled with sanitisers, every number of every cycle compared.

python tests/response/diagnosis/c_monitor.py 10000    # as 'make soak' runs it
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import holdfast as hf

COMPILER = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
FLAGS = ("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O1", "-ffp-contract=off")
SANITISED = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all")
KINDS = ("unknown", "locked", "standstill", "limp", "weak", "friction", "sluggish", "sensor", "contact")
CYCLES, REARMED, TOLERANCE = 400, 300, 1e-12
SENSORS = hf.diagnosis.Sensors(latency=0.003)
# Reads records, one cycle after the other in doubles: q, reference, whether there are torques and they, whether there is a pose
# and that; a cycle that begins with a number above 1e300 begins a new record. Writes r, level, excess, verdict, push, suspect.
HARNESS = """
#include "monitor.h"
#include <stdio.h>
enum { N = MONITOR_JOINTS, AGAIN = 300 };
static monitor_state state;
int main(void) {
    double in[3 * N + 18], out[3 * N + 9];
    monitor_verdict told;
    int k, cycle = 0;
    monitor_init(&state);
    while (fread(in, sizeof *in, 3 * N + 18, stdin) == 3 * N + 18) {
        if (in[0] > 1e300) { monitor_init(&state); cycle = 0; continue; }
        if (++cycle == AGAIN) monitor_rearm(&state);
        monitor_step(&state, in, in + N, in[2 * N] > 0 ? in + 2 * N + 1 : 0, in[3 * N + 1] > 0 ? in + 3 * N + 2 : 0, &told);
        for (k = 0; k < N; ++k) { out[k] = state.r[k]; out[N + k] = state.level[k]; out[2 * N + k] = state.over_y[k]; }
        out[3 * N] = state.over_w;
        out[3 * N + 1] = told.alarm; out[3 * N + 2] = told.time; out[3 * N + 3] = told.joint; out[3 * N + 4] = told.kind;
        out[3 * N + 5] = told.loss; out[3 * N + 6] = monitor_stale(&state); out[3 * N + 7] = state.push;
        out[3 * N + 8] = told.suspect;
        fwrite(out, sizeof *out, 3 * N + 9, stdout);
    }
    return 0;
}
"""


def built(arm, bounds, folder, flags=SANITISED):
    """The program."""
    hf.diagnosis.export_c(arm, bounds, folder, sensors=SENSORS)
    (folder / "harness.c").write_text(HARNESS, encoding="utf-8")
    command = [COMPILER, *FLAGS, *flags, "monitor.c", "harness.c", "-lm", "-o", "harness"]
    subprocess.run(command, cwd=folder, check=True, timeout=300)
    return folder / "harness"


def bounds_of(arm):
    """Some."""
    n = arm.n
    return hf.diagnosis.Bounds(
        fingerprint=arm.fingerprint,
        joints=arm.joint_names,
        rate=1000.0,
        torque=np.linspace(4.0, 1.0, n),
        change=np.linspace(2.0, 0.6, n),
        tracking=np.linspace(4e-3, 8e-3, n),
        position=2e-3,
        angle=4e-3,
        coulomb=np.linspace(0.5, 0.3, n),
        viscous=np.full(n, 0.3),
        scales=np.linspace(0.9, 1.1, n) if arm.links[0] else np.ones(n),
        factor=1.5,
        speed=np.ones(n),
        hours=1.0,
        logs=2,
        alarms=0,
    )


def random_record(arm, rng, wrong):
    """A motion with the torques of the model, and something wrong with a joint: q, references, torques, poses (NaN: none)."""
    n, t = arm.n, np.arange(CYCLES) / 1000
    low, high = np.where(np.isfinite([arm.lower, arm.upper]), [arm.lower, arm.upper], [[-2.0], [2.0]])
    middle, pace = rng.uniform(0.7 * low + 0.3 * high, 0.3 * low + 0.7 * high), rng.uniform(1, 4, n)
    begun = t - 0.05 * np.tanh(t / 0.05)  # from rest
    reference = middle + rng.uniform(0.05, 0.3, n) * np.sin(begun[:, None] * pace + rng.uniform(0, 6, n))
    true = reference + rng.normal(0, 3e-4, n)
    i, onset = rng.integers(n), rng.integers(60, 150)
    rates = np.gradient(true, 1e-3, axis=0)
    tau = arm.inverse_dynamics(true, rates, np.gradient(rates, 1e-3, axis=0)) + rng.normal(0, 0.05, true.shape)
    told, after = true + rng.normal(0, 2e-5, true.shape), t[onset:] - t[onset]
    if wrong == 1:  # stands, its servo pushes
        true[onset:, i] = true[onset, i]
        told[onset:, i] = true[onset, i] + rng.normal(0, 2e-5, CYCLES - onset)
        tau[onset:, i] += rng.uniform(300, 900) * (reference[onset:, i] - true[onset:, i])
    elif wrong == 2:  # falls behind, its motor gives less than it is told
        tau[onset:, i] = tau[onset:, i] / rng.uniform(0.05, 0.7) + rng.choice([0, 9.0])
        told[onset:, i] += rng.uniform(0, 2) * after**2
    elif wrong == 3:  # rubs
        tau[onset:, i] += rng.uniform(2, 9) * np.tanh(rates[onset:, i] / 0.02)
    elif wrong == 4:  # its sensor drifts, or jumps
        told[onset:, i] += rng.choice([0.0, 0.02]) + rng.uniform(0, 0.3) * after
    elif wrong in (5, 7, 9):  # a push at the tool, or at the far end of a link; in the third a reference goes on alone
        last = n - 1 if wrong == 5 else int(rng.integers(n))
        frames, jacobian = arm.frames(true[onset:]), arm.jacobian(true[onset:])[:, :, : last + 1]
        arms = (frames[:, last + 2, :3, 3] - frames[:, -1, :3, 3])[:, None]  # from the tool to there
        at = jacobian[:, :3].transpose(0, 2, 1) + np.cross(jacobian[:, 3:].transpose(0, 2, 1), arms)
        tau[onset:, : last + 1] -= at @ rng.normal(0, 30, 3)
        reference[onset:, last] += (wrong == 9) * rng.uniform(0, 6) * after
    elif wrong == 8:  # a push along its motion that the first joint alone feels
        tau[onset:, 0] -= rng.uniform(6, 60) * np.sign(rates[onset:, 0].mean())
    elif wrong == 6:  # samples are missing, some in a row: bridged, then for so long that it begins anew
        told[rng.integers(0, CYCLES, 6)] = np.nan
        told[onset : onset + rng.integers(1, 40)] = np.nan
        told[onset + 60 : onset + 60 + rng.integers(51, 80)] = np.nan
    poses = np.full((CYCLES, 4, 4), np.nan)
    if rng.uniform() < 0.7:
        every = rng.integers(1, 12)
        poses[::every] = arm.forward_kinematics(true[::every])
        poses[::every, :3, 3] += rng.normal(0, 3e-4, (len(poses[::every]), 3))
    return told, reference, tau if rng.uniform() < 0.9 else None, poses


def said_by_python(monitor, record):
    """What the harness writes, by Python."""
    told, reference, tau, poses = record
    monitor.reset()
    rows, names = [], [*monitor.arm.joint_names]
    for k in range(CYCLES):
        if k + 1 == REARMED:
            monitor.rearm()
        pose = poses[k] if np.isfinite(poses[k]).all() else None
        v = monitor.step(told[k], reference[k], None if tau is None else tau[k], pose=pose)
        joint = -1 if v.joint is None else names.index(v.joint)
        loss = -1 if np.isnan(v.loss) else v.loss
        stale = ("joints" in monitor.stale) + 2 * ("tool" in monitor.stale)
        last = [
            v.alarm,
            v.time if v.alarm else 0,
            joint,
            KINDS.index(v.kind),
            loss,
            stale,
            monitor._alarm_decision.force_advantage if v.alarm else 0,
            -1 if v.suspect is None else names.index(v.suspect),
        ]
        rows.append([*monitor._residual, *monitor._residual_level, *monitor._tracking_excess, monitor._tool_excess, *last])
    return np.array(rows, dtype=float)


def as_bytes(arm, record):
    """A record as the harness reads it."""
    told, reference, tau, poses = record
    n = arm.n
    rows = np.zeros((CYCLES + 1, 3 * n + 18))
    rows[0] = 1e301
    rows[1:, :n], rows[1:, n : 2 * n] = told, reference
    if tau is not None:
        rows[1:, 2 * n], rows[1:, 2 * n + 1 : 3 * n + 1] = 1, tau
    rows[1:, 3 * n + 1] = np.isfinite(poses).all(axis=(1, 2))
    rows[1:, 3 * n + 2 :] = poses.reshape(CYCLES, 16)
    return rows.tobytes()


def compared(arm, program, count, rng, bounds):
    """The largest difference in units of what is compared, verdicts that differ, and kinds that were named."""
    monitor, worst, unlike, named = hf.diagnosis.Monitor(arm, bounds, sensors=SENSORS), 0.0, 0, set()
    n = arm.n
    records = [random_record(arm, rng, k % 10) for k in range(count)]  # each of what can be wrong
    ours = [said_by_python(monitor, record) for record in records]
    pairs = []
    for record, one in zip(records, ours, strict=True):
        done = subprocess.run([str(program)], input=as_bytes(arm, record), capture_output=True, check=True)
        pairs.append((one, np.frombuffer(done.stdout).reshape(CYCLES, 3 * n + 9)))
    for one, theirs in pairs:
        large = np.maximum(np.abs(one[:, :n]).max(axis=0), bounds.torque)
        size = np.r_[large, large, np.ones(n + 1)]
        worst = max(worst, float((np.abs(one - theirs)[:, : 3 * n + 1] / size).max()))
        whole = [*range(3 * n + 1, 3 * n + 5), 3 * n + 6, 3 * n + 8]
        same = (one[:, whole] == theirs[:, whole]).all() and np.allclose(
            one[:, [3 * n + 5, 3 * n + 7]], theirs[:, [3 * n + 5, 3 * n + 7]], rtol=1e-7, atol=1e-9
        )
        unlike += not same
        last = theirs[REARMED - 2]
        named.add(KINDS[int(last[3 * n + 4])] if last[3 * n + 1] else "none")
    return worst, unlike, named


def main() -> int:
    """Many of them; 1 if any differs."""
    count, arm = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000, hf.arms.load("panda")
    bounds = bounds_of(arm)
    with tempfile.TemporaryDirectory() as folder:
        worst, unlike, named = compared(arm, built(arm, bounds, Path(folder)), count, np.random.default_rng(0), bounds)
    print(f"{count} records: largest difference {worst:.2g}, {unlike} verdicts differ; named: {', '.join(sorted(named))}")
    return int(unlike > 0 or not worst <= TOLERANCE)


if __name__ == "__main__":
    sys.exit(main())
