"""``holdfast simulate``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.labels import parse_quantities
from holdfast.interface.cli.declaration import FigurePath
from holdfast.interface.cli.groups import ContactOptions
from holdfast.interface.cli.laws import ClosedLoopOptions, LawOptions, OptionalTargetOption
from holdfast.interface.cli.options import (
    ArmArgument,
    FailureOption,
    JsonOption,
    MotionCsvOption,
    RrdOption,
    StartDegreesOption,
)
from holdfast.interface.cli.values import read_configuration, read_joint, read_locks, read_numbers, read_target
from holdfast.interface.presentation.results import print_result, write_outputs

_LIMIT_UNITS = {"deg": "rad", "rad": "rad", "m": "m"}  # by the ending of a number of --error-limit

if TYPE_CHECKING:
    from holdfast.core.result import Result
    from holdfast.model.arm.model import Arm


def command(
    arm: ArmArgument,
    start: Annotated[str | None, "Start configuration in rad and m. Required without --motion."] = None,
    target: OptionalTargetOption = None,
    motion: Annotated[
        Path | None,
        "Motion to play in MuJoCo, instead of --start and --target: a CSV file of joints over time, the folder that recover, "
        "follow or plan-motion wrote with --out, or a log (.npz).",
    ] = None,
    error_limit: Annotated[str | None, "Largest deviation of a joint from --motion: 2deg or 2deg,1mm. Default: none."] = None,
    lock: Annotated[
        list[str] | None,
        "Joint that locks where it is: JOINT (at the start) or JOINT@TIME in s (cycles with --cycles). Repeatable.",
    ] = None,
    failure: FailureOption = None,
    controlled: LawOptions = LawOptions(),
    loop: ClosedLoopOptions = ClosedLoopOptions(),
    physics: Annotated[bool, "Also simulate in MuJoCo, with bodies and joint servos (needs the extra 'physics')."] = False,
    servo_bandwidth: Annotated[float, "Bandwidth of the joint servos in Hz, with --physics or --motion."] = 10.0,
    faults: Annotated[Path | None, "Fault file (YAML) from which faults are sampled; replaces --lock."] = None,
    episode: Annotated[int, "Episode of --faults, counted from 0."] = 0,
    monitor: Annotated[
        Path | None,
        "Threshold file written by 'holdfast calibrate'. With --physics, a monitor identifies the locked joint, and the "
        "controller brakes it and avoids --cell. Default: no monitor.",
    ] = None,
    record: Annotated[
        Path | None, "File for the sensor log (.npz, .csv or .parquet), with --physics, for calibrate and diagnose."
    ] = None,
    touched: ContactOptions = ContactOptions(),
    stop_at_contact: Annotated[bool, "End the run at the first contact with an object of --cell."] = False,
    degrees: StartDegreesOption = False,
    csv: MotionCsvOption = None,
    rrd: RrdOption = None,
    plot: Annotated[FigurePath, "PNG file for a figure of the motion."] = None,
    out: Annotated[FigurePath, "Folder for report.html with an animation, run.png and run.csv."] = None,
    json_: JsonOption = False,
) -> None:
    """Simulate a control law with joint locks of which the controller is not informed, except by --monitor.

    With --motion, a planned motion is played instead, and the output states when a joint first exceeds --error-limit.

    Example: holdfast simulate planar-3r --start "20 40 60" --degrees --target 1.5,1.5 --lock 2@0.5 --plot run.png
    """
    if motion is not None:
        others: dict[str, Any] = {"--start": start, "--target": target, "--failure": failure, "--task": controlled.task}
        others |= {"--speed-limit": loop.speed_limit, "--cycles": loop.cycles, "--time-limit": loop.time_limit}
        others |= {"--faults": faults, "--monitor": monitor, "--record": record}
        _reject_options(others | {"--stop-at-contact": stop_at_contact, "--degrees": degrees}, "--motion")
        execution = _play_motion(
            controlled.resolve_arm(arm), motion, lock or [], error_limit, hf.Servos(bandwidth=servo_bandwidth), touched
        )
        print_result(execution, json_, write_outputs(execution, plot, out) + _write_motions(execution, csv, rrd))
        return
    if error_limit is not None:
        raise InputError("--error-limit applies to a played motion; add --motion")
    if start is None or target is None:
        raise InputError(f"{'--start' if start is None else '--target'} is missing; give --start and --target, or --motion")
    control_law = controlled.read_law(arm, gain=loop.gain, speed_limit=loop.speed_limit)
    target_value = read_target(control_law.arm, control_law.task, target)
    locked_joints, lock_times = (
        zip(*[_read_timed_lock(control_law.arm, text) for text in lock or []], strict=True) if lock else ((), ())
    )
    q0 = read_configuration(control_law.arm, start, degrees, "--start")
    drawn_faults = None if faults is None else hf.faults.load(faults)
    if physics and (drawn_faults is not None or monitor is not None or record is not None):
        _reject_options({"--failure": failure, "--cycles": loop.cycles, "--stop-at-contact": stop_at_contact})
        if lock and drawn_faults is not None:
            _reject_options({"--lock": lock})
        locks = [
            hf.faults.FaultEvent("locked", control_law.arm.joint_names[joint_index], lock_time)
            for joint_index, lock_time in zip(locked_joints, lock_times, strict=True)
        ]
        fault_monitor = None if monitor is None else hf.diagnosis.Monitor(control_law.arm, hf.diagnosis.load(monitor))
        fault_run = hf.simulate_faults(
            control_law,
            q0,
            target_value,
            faults=locks if drawn_faults is None else drawn_faults,
            episode=episode,
            monitor=fault_monitor,
            clearance=touched.build_contact_clearance(control_law.arm),
            time_limit=12.0 if loop.time_limit is None else loop.time_limit,
            servos=hf.Servos(bandwidth=servo_bandwidth, rate=1000.0 if fault_monitor is None else fault_monitor.bounds.rate),
        )
        records = [] if record is None else [fault_run.log().save(record)]
        print_result(fault_run, json_, write_outputs(fault_run, plot, out) + records + _write_motions(fault_run, csv, rrd))
        return
    for name, file in {"--monitor": monitor, "--record": record}.items():
        if file is not None:
            raise InputError(f"{name} needs bodies, motors and sensors; add --physics")
    if drawn_faults is not None:
        _reject_options({"--lock": lock, "--failure": failure})
    sampled_events = None if drawn_faults is None else drawn_faults.draw(control_law.arm, episode=episode)
    clearance = touched.build_contact_clearance(control_law.arm)
    if stop_at_contact and clearance is None:
        raise InputError("--stop-at-contact needs objects to touch; add --cell")
    locked_spec = read_locks(control_law.arm, lock, degrees, failure=failure) if failure else locked_joints
    common_options: dict[str, Any] = {
        "locked": locked_spec,
        "time_limit": loop.time_limit,
        "time": lock_times or 0.0,
        "clearance": clearance,
    }
    runs = hf.simulate(
        control_law,
        q0,
        target_value,
        cycles=loop.cycles,
        faults=sampled_events,
        stop_at_contact=stop_at_contact,
        **common_options,
    )
    result: Result = runs
    if physics:
        if loop.cycles:
            raise InputError("--physics has its own control rate; leave out --cycles")
        servos = hf.Servos(bandwidth=servo_bandwidth)
        result = hf.simulate_physics(control_law, q0, target_value, servos=servos, **common_options)
    files = write_outputs(result, plot, out) + _write_motions(runs, csv, rrd)
    print_result(result, json_, files)


def _write_motions(result: hf.Runs | hf.FaultRun | hf.Execution, csv: Path | None, rrd: Path | None) -> list[Path]:
    return ([] if csv is None else [result.to_csv(csv)]) + ([] if rrd is None else [result.to_rrd(rrd)])


def _reject_options(options: Mapping[str, object], chosen_option: str = "--faults, --monitor or --record") -> None:
    given_option = next((name for name, value in options.items() if value), None)
    if given_option is not None:
        raise InputError(f"{given_option} does not go with {chosen_option}; leave it out")


def _play_motion(
    arm: Arm, file: Path, locks: list[str], error_limit: str | None, servos: hf.Servos, contact_options: ContactOptions
) -> hf.Execution:
    """Execute the motion of a file with joints that lock during it."""
    from holdfast.interface.studio.motions import read_motion as read_table
    from holdfast.response.diagnosis.detectability.motions import read_motion as read_record

    if file.suffix in (".npz", ".parquet"):
        q, rate = read_record(arm, file)
        time = np.arange(len(q)) / rate
    else:
        table = read_table(arm, file)
        if table.unit != "s":
            raise InputError(f"motion '{file}' is not timed in seconds; write it with a column time_s")
        q, time = table.q, table.time
    timed_locks = [_read_timed_lock(arm, text) for text in locks]
    return hf.execute(
        arm,
        q,
        time,
        locked=[joint for joint, _ in timed_locks],
        lock_time=[lock_time for _, lock_time in timed_locks] if timed_locks else 0.0,
        servos=servos,
        error_limit=None if error_limit is None else _read_error_limit(error_limit),
        clearance=contact_options.build_contact_clearance(arm),
    )


def _read_error_limit(text: str) -> tuple[float, float]:
    """Read ``--error-limit`` as limits in rad and m; infinite for a unit that is not given."""
    limits = {"rad": np.inf, "m": np.inf}
    for part in text.split(","):
        unit = next((unit_kind for suffix, unit_kind in _LIMIT_UNITS.items() if part.strip().endswith(suffix)), None)
        if unit is None:
            raise InputError(f"--error-limit '{text}' has a number without a unit; write it as 2deg, 0.05rad or 2deg,1mm")
        limits[unit] = parse_quantities("--error-limit", part)[0]
    return limits["rad"], limits["m"]


def _read_timed_lock(arm: Arm, text: str) -> tuple[int, float]:
    joint, separator, time = text.rpartition("@")
    if not separator:
        return read_joint(arm, text), 0.0
    values = read_numbers(f"--lock '{text}'", time, "one number after @")
    if values.size != 1:
        raise InputError(f"--lock '{text}' has {values.size} numbers after @; give one time")
    return read_joint(arm, joint), float(values[0])
