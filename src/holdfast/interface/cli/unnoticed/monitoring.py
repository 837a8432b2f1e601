"""``holdfast simulate-logs``, ``calibrate``, ``diagnose`` and ``predict-detection``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.files.output import make_folder
from holdfast.interface.cli.groups import ArmSourceOptions, OutputOptions
from holdfast.interface.cli.options import NOT_MET_EXIT_CODE, ArmArgument, ArmOption, JsonOption, SeedOption
from holdfast.interface.cli.values import read_episode_numbers
from holdfast.interface.presentation.printing import make_console, print_written_files
from holdfast.interface.presentation.results import print_result

ColumnsOption = Annotated[Path | None, "Column file (YAML): names and units of the log. Default: holdfast's, in SI units."]
LatencyOption = Annotated[float, "Latency of the tool-pose measurement in s."]


def diagnose(
    log: Annotated[
        Path,
        typer.Argument(metavar="RECORDING", help="Log, LeRobot data set, ROS 2 bag, MCAP file, or folder of logs or bags."),
    ],
    arm: Annotated[str | None, "Arm: built-in name or file. Required for --bounds, and to name falls and check limits."] = None,
    bounds: Annotated[Path | None, "Threshold file (JSON) of 'holdfast calibrate', for one log of at least 40 Hz."] = None,
    healthy: Annotated[str | None, "Numbers of healthy episodes, at least 20, such as 0:50 (0 to 49) or 0:40,45."] = None,
    rate: Annotated[float | None, "False alarms per hour (extrapolated). Default: the rate that --healthy guarantees."] = None,
    unit: Annotated[str | None, "Unit of a data set: deg, rad, or a calibration file of LeRobot. Default: unknown."] = None,
    joints: Annotated[str | None, "Joints to examine, with commas, in the order of the arm. Default: all but grippers."] = None,
    state: Annotated[str | None, "Vector or topic of the positions. Default: observation.state, or the only topic."] = None,
    reference: Annotated[str | None, "Vector or topic of the references. Default: action, or the only topic."] = None,
    columns: ColumnsOption = None,
    latency: LatencyOption = 0.0,
    chain: ArmSourceOptions = ArmSourceOptions(),
    output: OutputOptions = OutputOptions(),
) -> None:
    """Detect and identify joint faults in a log, or in the episodes of a recording.

    A log is compared with thresholds (--bounds), and a recording with its healthy episodes (--healthy).

    Exit code: 0 if no fault is detected, 3 if there is an alarm.

    Example: holdfast diagnose faulty/000000.npz --arm panda --bounds bounds.json --out diagnosis

    Example: holdfast diagnose dataset --healthy 0:50 --unit deg --out examination
    """
    model = None if arm is None else chain.resolve_arm(arm)
    if bounds is not None:
        if model is None or healthy is not None:
            raise InputError("--bounds needs --arm and excludes --healthy; give --arm and --bounds for a log")
        diagnosis = hf.diagnosis.diagnose(
            model, hf.faults.Log.load(log, columns=columns, latency=latency), hf.diagnosis.load(bounds)
        )
        output.print_result(diagnosis)
        has_alarm = diagnosis.verdict.alarm
    else:
        recording = hf.diagnosis.read_recording(
            log,
            state=state,
            reference=reference,
            joints=None if joints is None else joints.replace(" ", "").split(","),
            unit=unit,
            columns=columns,
        )
        episodes = [] if healthy is None else read_episode_numbers("--healthy", healthy, len(recording.episodes))
        examination = hf.diagnosis.examine(recording, healthy=episodes, arm=model, rate=rate)
        output.print_result(examination)
        has_alarm = bool(examination.alarms)
    if has_alarm:
        raise typer.Exit(NOT_MET_EXIT_CODE)


def calibrate(
    logs: Annotated[list[Path], typer.Argument(metavar="LOG", help="Logs of the healthy arm (.npz, .csv or .parquet).")],
    arm: ArmOption,
    out: Annotated[Path, "File for the thresholds (JSON)."],
    factor: Annotated[float | None, "Threshold / largest healthy residual. Default: 1.5, or 2.5 without torques."] = None,
    coulomb: Annotated[float, "Coulomb friction of each joint in N m (N)."] = 0.0,
    viscous: Annotated[float | None, "Viscous friction in N m s/rad (N s/m). Default: that of the arm."] = None,
    fit: Annotated[bool, "Fit the masses and friction of the arm model to the logs first."] = False,
    columns: ColumnsOption = None,
    latency: LatencyOption = 0.0,
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Set the detection thresholds of the monitor from logs of a healthy arm.

    Example: holdfast calibrate healthy/000000.npz healthy/000001.npz --arm panda --out bounds.json
    """
    model = chain.resolve_arm(arm)
    records = [hf.faults.Log.load(log, columns=columns, latency=latency) for log in logs]
    bounds = hf.diagnosis.calibrate(model, records, factor=factor, coulomb=coulomb, viscous=viscous, fit=fit)
    print_result(bounds, json_, [bounds.to_json(out)])


def predict_detection(
    motion: Annotated[Path, typer.Argument(metavar="MOTION", help="Log (.npz, .csv), or motion that 'holdfast follow' wrote.")],
    arm: ArmOption,
    bounds: Annotated[Path | None, "Threshold file written by 'holdfast calibrate'; adds the detection time."] = None,
    chain: ArmSourceOptions = ArmSourceOptions(),
    output: OutputOptions = OutputOptions(),
) -> None:
    """Predict which locks a motion would reveal, and how soon.

    Example: holdfast predict-detection healthy/000000.npz --arm panda --bounds bounds.json
    """
    model = chain.resolve_arm(arm)
    q, rate = hf.diagnosis.read_motion(model, motion)
    thresholds = None if bounds is None else hf.diagnosis.load(bounds)
    detectability = hf.diagnosis.predict_detection(model, q, rate=rate, bounds=thresholds)
    output.print_result(detectability)


def simulate_logs(
    arm: ArmArgument,
    out: Annotated[Path, "Folder for the logs."],
    records: Annotated[int, typer.Option("--records", min=1, help="Number of logs, each with a different motion.")] = 1,
    duration: Annotated[float, "Duration of each log in s."] = 6.0,
    faults: Annotated[Path | None, "Fault file (YAML); log k is its episode k, from 0. Default: no faults."] = None,
    robot: Annotated[int, "Seed of the simulated robot. Use one value for all logs of the same robot."] = 0,
    seed: SeedOption = 0,
    chain: ArmSourceOptions = ArmSourceOptions(),
) -> None:
    """Simulate sensor logs of an arm, with or without faults.

    Masses and friction of the simulated robot differ by up to 20 % from the arm model. Needs the extra 'physics'.

    Example: holdfast simulate-logs panda --records 2 --out healthy
    """
    model = chain.resolve_arm(arm)
    fault_model = None if faults is None else hf.faults.load(faults)
    events = (
        None
        if fault_model is None
        else [fault_model.draw(model, episode=number, horizon=duration) for number in range(records)]
    )
    seeds, folder = range(seed, seed + records), make_folder(out)
    logs = hf.diagnosis.simulate_logs(model, duration, seeds=seeds, faults=events, robots=[robot] * records)
    files = [log.save(folder / f"{number:06d}.npz") for number, log in enumerate(logs)]
    print_written_files(make_console(), files)
