"""``holdfast simulate``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

import holdfast as hf
from holdfast.cli.groups import Chain, Touched
from holdfast.cli.laws import CyclesOption, GainOption, LawOption, SpeedLimitOption, TimeLimitOption, law_of
from holdfast.cli.options import (
    TARGET_HELP,
    ArmArgument,
    FailureOption,
    JsonOption,
    MotionCsvOption,
    StartDegreesOption,
    TaskOption,
)
from holdfast.cli.values import read_configuration, read_joint, read_locks, read_numbers, read_target
from holdfast.errors import InputError
from holdfast.grammar import measures
from holdfast.present.results import drawn, printed

_LIMIT_UNITS = {"deg": "rad", "rad": "rad", "m": "m"}  # by how a number of --error-limit ends

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.result import Result


def command(
    arm: ArmArgument,
    start: Annotated[str | None, "Joint values at the start, rad and m, by commas or spaces."] = None,
    target: Annotated[str | None, TARGET_HELP] = None,
    motion: Annotated[
        Path | None,
        "Play this motion in MuJoCo, in place of --start and --target: a CSV file of joints over time or the folder that "
        "recover, follow or endure wrote with --out, or a record (.npz).",
    ] = None,
    error_limit: Annotated[
        str | None, "With --motion: largest distance of a joint from the motion, for example 2deg or 2deg,1mm."
    ] = None,
    lock: Annotated[
        list[str] | None,
        "JOINT or JOINT@TIME: it locks at the start, or then (s or cycles); with --notice a fault. May be given again.",
    ] = None,
    failure: FailureOption = None,
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    gain: GainOption = 1.0,
    speed_limit: SpeedLimitOption = None,
    cycles: CyclesOption = False,
    time_limit: TimeLimitOption = None,
    physics: Annotated[bool, "Simulate also in MuJoCo, with bodies and joint servos (needs the extra 'physics')."] = False,
    servo_bandwidth: Annotated[float, "With --physics: bandwidth of the joint servos, Hz."] = 10.0,
    faults: Annotated[Path | None, "Faults file (YAML): what fails when is drawn from it."] = None,
    episode: Annotated[int, "With --faults: which episode is drawn, from 0."] = 0,
    notice: Annotated[
        Path | None,
        "With --physics: bounds that calibrate wrote; a monitor names the joint, and the controller reacts, clear of --cell.",
    ] = None,
    record: Annotated[
        Path | None, "With --physics: write what the sensors told (.npz, .csv or .parquet), for calibrate and diagnose."
    ] = None,
    touched: Touched = Touched(),
    stop_at_contact: Annotated[bool, "With --cell: the run ends where the arm first touches an object."] = False,
    degrees: StartDegreesOption = False,
    chain: Chain = Chain(),
    csv: MotionCsvOption = None,
    plot: Annotated[Path | None, "Draw the motion into this PNG file."] = None,
    out: Annotated[Path | None, "Folder for report.html with the arm moving, run.png and run.csv."] = None,
    json_: JsonOption = False,
) -> None:
    """Simulate the closed loop with locked joints that the controller does not know of.

    With --motion a planned motion is played instead, and the output says when a joint first exceeds --error-limit.

    Example: holdfast simulate planar-3r --start "20 40 60" --degrees --target 1.5,1.5 --lock 2@0.5 --plot run.png
    """
    if motion is not None:
        others = {"--start": start, "--target": target, "--failure": failure, "--task": task, "--speed-limit": speed_limit}
        others |= {"--cycles": cycles, "--time-limit": time_limit, "--faults": faults, "--notice": notice, "--record": record}
        _refuse(others | {"--stop-at-contact": stop_at_contact, "--degrees": degrees}, "--motion")
        played = _play_motion(chain.arm(arm), motion, lock or [], error_limit, hf.Servos(bandwidth=servo_bandwidth), touched)
        printed(played, json_, drawn(played, plot, out) + ([] if csv is None else [played.to_csv(csv)]))
        return
    if error_limit is not None:
        raise InputError("--error-limit is of a motion that is played; add --motion")
    if start is None or target is None:
        raise InputError(f"{'--start' if start is None else '--target'} is missing; give --start and --target, or --motion")
    made = law_of(law, arm, task, chain, gain=gain, speed_limit=speed_limit)
    goal = read_target(made.arm, made.task, target)
    joints, times = zip(*[_lock(made.arm, text) for text in lock or []], strict=True) if lock else ((), ())
    q0 = read_configuration(made.arm, start, degrees, "--start")
    drawn_faults = None if faults is None else hf.faults.load(faults)
    if physics and (drawn_faults is not None or notice is not None or record is not None):
        _refuse({"--failure": failure, "--cycles": cycles, "--stop-at-contact": stop_at_contact})
        if lock and drawn_faults is not None:
            _refuse({"--lock": lock})
        locks = [hf.faults.FaultEvent("locked", made.arm.joint_names[k], t) for k, t in zip(joints, times, strict=True)]
        watch = None if notice is None else hf.diagnosis.Monitor(made.arm, hf.diagnosis.load(notice))
        found = hf.simulate_faults(
            made,
            q0,
            goal,
            faults=locks if drawn_faults is None else drawn_faults,
            episode=episode,
            monitor=watch,
            clearance=touched.read(made.arm),
            time_limit=12.0 if time_limit is None else time_limit,
            servos=hf.Servos(bandwidth=servo_bandwidth, rate=1000.0 if watch is None else watch.bounds.rate),
        )
        records = [] if record is None else [found.log().save(record)]
        printed(found, json_, drawn(found, plot, out) + records + ([] if csv is None else [found.to_csv(csv)]))
        return
    for name, file in {"--notice": notice, "--record": record}.items():
        if file is not None:
            raise InputError(f"{name} is of an arm with bodies, motors and sensors; add --physics")
    if drawn_faults is not None:
        _refuse({"--lock": lock, "--failure": failure})
    happens = None if drawn_faults is None else drawn_faults.draw(made.arm, episode=episode)
    shape = touched.read(made.arm)
    if stop_at_contact and shape is None:
        raise InputError("--stop-at-contact has nothing to stop at; add --cell")
    locked = read_locks(made.arm, lock, degrees, failure=failure) if failure else joints
    alike: dict[str, Any] = {"locked": locked, "time_limit": time_limit, "time": times or 0.0, "clearance": shape}
    runs = hf.simulate(made, q0, goal, cycles=cycles, faults=happens, stop_at_contact=stop_at_contact, **alike)
    result: Result = runs
    if physics:
        if cycles:
            raise InputError("--physics has a control rate of its own; leave out --cycles")
        servos = hf.Servos(bandwidth=servo_bandwidth)
        result = hf.simulate_physics(made, q0, goal, servos=servos, **alike)
    files = drawn(result, plot, out) + ([] if csv is None else [runs.to_csv(csv)])
    printed(result, json_, files)


def _refuse(others: Mapping[str, object], with_: str = "--faults, --notice or --record") -> None:
    given = next((name for name, value in others.items() if value), None)
    if given is not None:
        raise InputError(f"{given} does not go with {with_}; leave it out")


def _play_motion(
    arm: Arm, file: Path, locks: list[str], limit: str | None, servos: hf.Servos, touched: Touched
) -> hf.Execution:
    """Execute the motion of a file with joints that lock during it."""
    from holdfast.diagnosis.foresight.motions import read_motion as read_record
    from holdfast.studio.motions import read_motion as read_table

    if file.suffix in (".npz", ".parquet"):
        q, rate = read_record(arm, file)
        time = np.arange(len(q)) / rate
    else:
        table = read_table(arm, file)
        if table.unit != "s":
            raise InputError(f"motion '{file}' is not timed in seconds; write it with a column time_s")
        q, time = table.q, table.time
    found = [_lock(arm, text) for text in locks]
    return hf.execute(
        arm,
        q,
        time,
        locked=[joint for joint, _ in found],
        lock_time=[when for _, when in found] if found else 0.0,
        servos=servos,
        error_limit=None if limit is None else _error_limit(limit),
        clearance=touched.read(arm),
    )


def _error_limit(text: str) -> tuple[float, float]:
    """--error-limit in rad and m; a unit that is not given has no limit."""
    found = {"rad": np.inf, "m": np.inf}
    for part in text.split(","):
        unit = next((kind for end, kind in _LIMIT_UNITS.items() if part.strip().endswith(end)), None)
        if unit is None:
            raise InputError(f"--error-limit '{text}' has a number without a unit; write it as 2deg, 0.05rad or 2deg,1mm")
        found[unit] = measures("--error-limit", part)[0]
    return found["rad"], found["m"]


def _lock(arm: Arm, text: str) -> tuple[int, float]:
    joint, at, time = text.rpartition("@")
    if not at:
        return read_joint(arm, text), 0.0
    values = read_numbers(f"--lock '{text}'", time, "one number after @")
    if values.size != 1:
        raise InputError(f"--lock '{text}' has {values.size} numbers after @; give one time")
    return read_joint(arm, joint), float(values[0])
