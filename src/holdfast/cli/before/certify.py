"""``holdfast certify``, with a command for each kind of claim."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

import holdfast as hf
from holdfast.cli.before.certify_path import path
from holdfast.cli.certify_options import (
    AnglesOption,
    AroundOption,
    BoxOption,
    CertificateOption,
    CheckOption,
    HalvingsOption,
    JointHalvingsOption,
    LimitOption,
    LockOption,
    PointingOption,
    ReportOption,
    RotationOption,
    RowsOption,
    SizeOption,
    StoreOption,
    TimeOption,
    TurnsOption,
    WithinOption,
    WorkersOption,
)
from holdfast.cli.certify_search import proved
from holdfast.cli.options import (
    NOT_MET,
    ArmArgument,
    BaseOption,
    FailuresOption,
    HoldOption,
    JsonOption,
    PlotOption,
    SeedOption,
    TipOption,
    read_arm,
    read_by_joint,
    read_numbers,
)
from holdfast.errors import InputError
from holdfast.failures.sets import read_failures
from holdfast.present.results import printed

command = typer.Typer(
    name="certify",
    help="Prove what an arm does for every target, configuration or lock of a box, and write a certificate.",
    no_args_is_help=True,
)


@command.command()
def reach(
    arm: ArmArgument,
    box: BoxOption,
    size: SizeOption,
    rotation: RotationOption = None,
    rotation_size: TurnsOption = None,
    pointing: PointingOption = False,
    lock: LockOption = None,
    limit: LimitOption = None,
    degrees: AnglesOption = False,
    halvings: HalvingsOption = 8,
    time_limit: TimeOption = None,
    workers: WorkersOption = 1,
    store: StoreOption = None,
    check: CheckOption = True,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    seed: SeedOption = 0,
    out: CertificateOption = Path("reach.certificate"),
    plot: PlotOption = None,
    report: ReportOption = None,
    json_: JsonOption = False,
) -> None:
    """Prove that every point of a box is reached, healthy or wherever one joint locks in an interval.

    The exit code is 0 if all is proved, 3 if something is undecided, 1 if the check rejects something. Ctrl-C writes what is
    proved so far; with --store the same command resumes.

    Example: holdfast certify reach planar-3r --box "1.5 0.5" --size 0.4 --lock joint2=0.9..1.1
    """
    model = read_arm(arm, base, tip, hold)
    claim = hf.certificates.reach_claim(
        model,
        read_numbers("--box", box, "two or three numbers, m,"),
        read_numbers("--size", size, "one number, or one for each axis, m,"),
        **_turned(rotation, rotation_size, degrees, pointing),
        locked=None if lock is None else _intervals(model, "--lock", [lock], degrees),
        limits=_intervals(model, "--limit", limit or [], degrees),
    )
    how = {"halvings": halvings, "time_limit": time_limit, "seed": seed, "workers": workers, "store": store}
    proved(claim, out, check, json_, plot, report, **how)


@command.command("out-of-reach")
def out_of_reach(
    arm: ArmArgument,
    box: BoxOption,
    size: SizeOption,
    rotation: RotationOption = None,
    rotation_size: TurnsOption = None,
    pointing: PointingOption = False,
    lock: LockOption = None,
    limit: LimitOption = None,
    degrees: AnglesOption = False,
    halvings: Annotated[int, typer.Option("--halvings", help="Of each joint and axis of the box, at most.")] = 16,
    time_limit: TimeOption = None,
    workers: WorkersOption = 1,
    store: StoreOption = None,
    check: CheckOption = True,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    seed: SeedOption = 0,
    out: CertificateOption = Path("out-of-reach.certificate"),
    plot: PlotOption = None,
    report: ReportOption = None,
    json_: JsonOption = False,
) -> None:
    """Prove that no point of a box is reached, healthy or wherever one joint locks in an interval.

    The exit code is 0 if all is proved, 3 if something is undecided, 4 if a configuration is found whose tool is in the box, 1
    if the check rejects something. Ctrl-C writes what is proved so far; with --store the same command resumes.

    Example: holdfast certify out-of-reach planar-3r --box "2.5 1" --size 0.2 --lock joint2=1.5..1.7
    """
    model = read_arm(arm, base, tip, hold)
    claim = hf.certificates.out_of_reach_claim(
        model,
        read_numbers("--box", box, "two or three numbers, m,"),
        read_numbers("--size", size, "one number, or one for each axis, m,"),
        **_turned(rotation, rotation_size, degrees, pointing),
        locked=None if lock is None else _intervals(model, "--lock", [lock], degrees),
        limits=_intervals(model, "--limit", limit or [], degrees),
    )
    how = {"halvings": halvings, "time_limit": time_limit, "seed": seed, "workers": workers, "store": store}
    proved(claim, out, check, json_, plot, report, **how)


@command.command()
def tolerant(
    arm: ArmArgument,
    box: BoxOption,
    size: SizeOption,
    rotation: RotationOption = None,
    rotation_size: TurnsOption = None,
    pointing: PointingOption = False,
    ranges: Annotated[
        Path | None,
        typer.Option("--ranges", help="Working ranges (YAML file): JOINT: [LOW, HIGH], rad or m.", show_default=False),
    ] = None,
    range_: Annotated[
        list[str] | None,
        typer.Option(
            "--range",
            help="JOINT=LOW..HIGH, rad or m: a working range. May be given again. Default: the joint's limits.",
            show_default=False,
        ),
    ] = None,
    degrees: AnglesOption = False,
    failures: FailuresOption = "single",
    halvings: HalvingsOption = 8,
    time_limit: TimeOption = None,
    workers: WorkersOption = 1,
    store: StoreOption = None,
    check: CheckOption = True,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    seed: SeedOption = 0,
    out: Annotated[Path, typer.Option("--out", help="Folder for the certificate and those of its parts; or FILE.zip.")] = Path(
        "certificates"
    ),
    plot: PlotOption = None,
    report: ReportOption = None,
    json_: JsonOption = False,
) -> None:
    """Prove that a box is failure-tolerant: reached within working ranges, and after any one joint locks in its own.

    The exit code is 0 if all is proved, 3 if something is undecided, 1 if the check rejects something. Ctrl-C writes what is
    proved so far; with --store the same command resumes.

    Example: holdfast certify tolerant planar-3r --box "1.5 0.5" --size 0.1 --range 1=-1..0.5 --range 2=0..1.4 --range 3=0..1.4
    """
    model = read_arm(arm, base, tip, hold)
    texts = [*(_ranges_of(ranges) if ranges is not None else []), *(range_ or [])]
    claim = hf.certificates.tolerant_claim(
        model,
        read_numbers("--box", box, "two or three numbers, m,"),
        read_numbers("--size", size, "one number, or one for each axis, m,"),
        **_turned(rotation, rotation_size, degrees, pointing),
        working_ranges=_intervals(model, "--range", texts, degrees),
        failures=read_failures(model, failures),
    )
    how = {"halvings": halvings, "time_limit": time_limit, "seed": seed, "workers": workers, "store": store}
    proved(claim, out, check, json_, plot, report, **how)


@command.command()
def ceiling(
    arm: ArmArgument,
    below: Annotated[float, typer.Option("--below", help="Threshold, between 0 and 1.", show_default=False)],
    around: AroundOption = None,
    within: WithinOption = None,
    limit: LimitOption = None,
    task: RowsOption = "pose",
    degrees: AnglesOption = False,
    failures: FailuresOption = "single",
    halvings: JointHalvingsOption = 16,
    time_limit: TimeOption = None,
    workers: WorkersOption = 1,
    store: StoreOption = None,
    check: CheckOption = True,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    seed: SeedOption = 0,
    out: CertificateOption = Path("ceiling.certificate"),
    plot: PlotOption = None,
    report: ReportOption = None,
    json_: JsonOption = False,
) -> None:
    """Prove that relative manipulability is nowhere in a box of configurations above a threshold.

    The best configuration that is found in the box is printed beside it. The exit code is 0 if all is proved, 3 if something is
    undecided, 4 if that configuration is above the threshold, 1 if the check rejects something. Ctrl-C writes what is proved
    so far; with --store the same command resumes.

    Example: holdfast certify ceiling panda --around "-35 -45 51 -111 -46 84 -3" --within 5 --degrees --below 0.0735
    """
    model = read_arm(arm, base, tip, hold)
    claim = hf.certificates.ceiling_claim(
        model,
        _box_of(model, around, within, limit, degrees),
        below,
        failures=read_failures(model, failures),
        task=task,
    )
    how = {"halvings": halvings, "time_limit": time_limit, "seed": seed, "workers": workers, "store": store}
    proved(claim, out, check, json_, plot, report, **how)


@command.command()
def floor(
    arm: ArmArgument,
    above: Annotated[float, typer.Option("--above", help="Threshold, between 0 and 1.", show_default=False)],
    around: AroundOption = None,
    within: WithinOption = None,
    limit: LimitOption = None,
    task: RowsOption = "pose",
    degrees: AnglesOption = False,
    failures: FailuresOption = "single",
    halvings: JointHalvingsOption = 16,
    time_limit: TimeOption = None,
    workers: WorkersOption = 1,
    store: StoreOption = None,
    check: CheckOption = True,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    seed: SeedOption = 0,
    out: CertificateOption = Path("floor.certificate"),
    plot: PlotOption = None,
    report: ReportOption = None,
    json_: JsonOption = False,
) -> None:
    """Prove that relative manipulability is nowhere in a box of configurations below a threshold, and that none is singular.

    The worst configuration that is found in the box is printed beside it. The exit code is 0 if all is proved, 3 if something
    is undecided, 4 if that configuration is below the threshold, 1 if the check rejects something. Ctrl-C writes what is
    proved so far; with --store the same command resumes.

    Example: holdfast certify floor panda --around "40 20 -30 -90 30 120 0" --within 2 --degrees --above 0.02
    """
    model = read_arm(arm, base, tip, hold)
    claim = hf.certificates.floor_claim(
        model,
        _box_of(model, around, within, limit, degrees),
        above,
        failures=read_failures(model, failures),
        task=task,
    )
    how = {"halvings": halvings, "time_limit": time_limit, "seed": seed, "workers": workers, "store": store}
    proved(claim, out, check, json_, plot, report, **how)


command.command()(path)


def _box_of(
    arm: hf.Arm, around: str | None, within: str | None, limit: list[str] | None, degrees: bool
) -> dict[str | int, tuple[float, float]]:
    """A box of configurations: some angles around a middle, or within limits."""
    box: dict[str | int, tuple[float, float]] = {}
    if (around is None) != (within is None):
        raise InputError("--around and --within go together: the middle of the box and its half widths")
    if around is not None and within is not None:
        middle = read_numbers("--around", around, f"{arm.n} numbers,")
        half = read_numbers("--within", within, f"one number, or {arm.n},")
        if len(middle) != arm.n or len(half) not in (1, arm.n):
            raise InputError(f"--around needs {arm.n} numbers, and --within one or {arm.n}")
        if (half < 0).any():
            raise InputError("--within must not be negative: it is half widths")
        pairs = zip(arm.joint_names, middle, [*half] * (arm.n // len(half)), strict=True)
        texts = [f"{name}={x - h}..{x + h}" for name, x, h in pairs]
        box = _intervals(arm, "--around", texts, degrees)
    return box | _intervals(arm, "--limit", limit or [], degrees)


@command.command("structural-zero")
def structural_zero(
    arm: ArmArgument,
    joint: Annotated[str, typer.Argument(metavar="JOINT", help="Between a shoulder and a wrist.", show_default=False)],
    check: CheckOption = True,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    out: CertificateOption = Path("structural-zero.certificate"),
    json_: JsonOption = False,
) -> None:
    """Prove that a lock of a joint between a spherical shoulder and a spherical wrist costs everything, wherever the arm is.

    Proved exactly, of an arm whose geometry is that of the file but for rounded digits, and by how much it differs is
    printed. The exit code is 0 if it is proved, 3 if axes do not meet.

    Example: holdfast certify structural-zero iiwa14 lbr_iiwa_joint_4
    """
    model = read_arm(arm, base, tip, hold)
    proof = hf.certify(hf.certificates.structural_zero_claim(model, joint))
    if not proof.ok:
        printed(proof, json_)
        raise typer.Exit(NOT_MET)
    file = proof.write(out)
    printed(hf.check_certificate(file) if check else proof, json_, [file])


def _turned(rotation: str | None, size: str | None, degrees: bool, pointing: bool) -> dict[str, Any]:
    """--rotation, --rotation-size and --pointing, as a claim takes them."""
    from holdfast.arm.urdf import rpy_rotation

    if rotation is None:
        if size is not None or pointing:
            raise InputError(
                "--rotation-size is a box around --rotation, and --pointing about its z axis; give --rotation as well"
            )
        return {}
    angles = read_numbers("--rotation", rotation, "roll, pitch and yaw")
    edges = read_numbers("--rotation-size", size or "0", "one number, or three,")
    if angles.size not in (1, 3) or edges.size not in (1, angles.size) or not (edges >= 0).all():
        raise InputError(
            "--rotation takes roll, pitch and yaw, or in a plane yaw; --rotation-size one number or as many, not negative"
        )
    turn, task = np.pi / 180 if degrees else 1.0, {"task": "pointing"} if pointing else {}
    if angles.size == 3 and not edges.any():
        return {"rotation": rpy_rotation((turn * angles).tolist()), **task}
    ends = turn * np.column_stack([angles - edges / 2, angles + edges / 2])
    return {"rpy": ends if angles.size == 3 else ends[0], **task}


def _ranges_of(file: Path) -> list[str]:
    """A file of working ranges, as options give them."""
    from holdfast.files.yaml import content

    try:
        found = content(file, "holdfast certify tolerant --help", "a joint with its range, such as joint1: [-0.5, 0.5]")
    except InputError as error:
        raise InputError(f"ranges file '{file}': {error}") from error
    for joint, pair in found.items():
        if not isinstance(pair, list) or len(pair) != 2:
            raise InputError(f"ranges file '{file}': {joint} has {str(pair)[:40]!r}; give [LOW, HIGH]")
    return [f"{joint}={low}..{high}" for joint, (low, high) in found.items()]


def _intervals(arm: hf.Arm, option: str, texts: list[str], degrees: bool) -> dict[str | int, tuple[float, float]]:
    """``JOINT=LOW..HIGH`` as numbers, rad."""
    ends: tuple[list[str], list[str]] = [], []
    for text in texts:
        joint, _, span = text.rpartition("=")
        low, dots, high = span.partition("..")
        if not (dots and low and high):
            raise InputError(
                f"{option} '{text}' is no interval; write JOINT=LOW..HIGH, for example {arm.joint_names[0]}=-0.5..0.5"
            )
        for end, value in zip(ends, (low, high), strict=True):
            end.append(f"{joint}={value}")
    lows, highs = (read_by_joint(arm, end, option, degrees) for end in ends)
    return {name: (lows[name], highs[name]) for name in lows}
