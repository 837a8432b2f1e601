"""``holdfast certify``, with a command for each kind of claim."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.formatting import format_count
from holdfast.interface.cli.certify_options import (
    AnglesOption,
    CertificateOption,
    CheckOption,
    ConfigurationBoxOptions,
    HalvingsOption,
    JointBoxOptions,
    JointHalvingsOption,
    LimitOption,
    LockedTargetBoxOptions,
    ProofOptions,
    TargetBoxOptions,
    UnseededProofOptions,
    read_joint_intervals,
)
from holdfast.interface.cli.certify_search import prove_claim, prove_with_found_ranges
from holdfast.interface.cli.groups import ArmSourceOptions, FrictionOptions, MountingOptions
from holdfast.interface.cli.options import NOT_MET_EXIT_CODE, ArmArgument, FailuresOption, JsonOption
from holdfast.interface.cli.values import read_joint, read_numbers
from holdfast.interface.presentation.results import print_result
from holdfast.model.failure_modes.sets import read_failures

command = typer.Typer(
    name="certify", help="Prove a property for every point of a box and write a certificate.", no_args_is_help=True
)


@dataclass(frozen=True)
class _BundleOptions(ProofOptions):
    out: Annotated[Path, "Folder, or FILE.zip, for the certificate and those of its parts."] = Path()


@command.command()
def reach(
    arm: ArmArgument,
    targets: LockedTargetBoxOptions,
    halvings: HalvingsOption = 8,
    options: ProofOptions = ProofOptions(out=Path("reach.certificate")),
) -> None:
    """Prove that every target in a box is reachable, with or without a locked joint.

    Exit code: 0 if everything is proved, 3 if a part is undecided, 1 if the check rejects a part. Ctrl-C stops and writes
    the proved part; with --store, the same command resumes the search.

    Example: holdfast certify reach planar-3r --box "1.5 0.5" --size 0.4 --lock joint2=0.9..1.1
    """
    model = options.resolve_arm(arm)
    claim = hf.certificates.reach_claim(model, **targets.read_claim_arguments(model))
    prove_claim(claim, options, halvings=halvings, seed=options.seed)


@command.command("out-of-reach")
def out_of_reach(
    arm: ArmArgument,
    targets: LockedTargetBoxOptions,
    halvings: Annotated[int, "Largest number of bisections of each joint interval and each axis of the target box."] = 16,
    options: ProofOptions = ProofOptions(out=Path("out-of-reach.certificate")),
) -> None:
    """Prove that no target in a box is reachable, with or without a locked joint.

    Exit code: 0 if everything is proved, 3 if a part is undecided, 4 if a configuration is found whose tool is in the box, 1 if
    the check rejects a part. Ctrl-C stops and writes the proved part; with --store, the same command resumes the search.

    Example: holdfast certify out-of-reach planar-3r --box "2.5 1" --size 0.2 --lock joint2=1.5..1.7
    """
    model = options.resolve_arm(arm)
    claim = hf.certificates.out_of_reach_claim(model, **targets.read_claim_arguments(model))
    prove_claim(claim, options, halvings=halvings, seed=options.seed)


@command.command()
def tolerant(
    arm: ArmArgument,
    targets: TargetBoxOptions,
    ranges: Annotated[Path | None, "YAML file with the working ranges: JOINT: [LOW, HIGH] in rad or m."] = None,
    range_: LimitOption = None,
    degrees: AnglesOption = False,
    find_ranges: Annotated[
        bool, "Search for wide working ranges by sampling, within the given ones, and prove the claim with them."
    ] = False,
    failures: FailuresOption = "single",
    halvings: HalvingsOption = 8,
    options: _BundleOptions = _BundleOptions(out=Path("certificates")),
) -> None:
    """Prove that every target in a box stays reachable after any single lock.

    Exit code: 0 if everything is proved, 3 if a part is undecided or no ranges are found, 1 if the check rejects a part.
    Ctrl-C stops and writes the proved part; with --store, the same command resumes the search.

    Example: holdfast certify tolerant planar-3r --box "1.5 0.5" --size 0.1 --range 1=-1..0.5 --range 2=0..1.4 --range 3=0..1.4
    """
    model = options.resolve_arm(arm)
    texts = [*(_read_range_options(ranges) if ranges is not None else []), *(range_ or [])]
    claim_arguments = targets.claim_arguments() | {
        "working_ranges": read_joint_intervals(model, "--range", texts, degrees),
        "failures": read_failures(model, failures),
    }
    if find_ranges:
        prove_with_found_ranges(model, claim_arguments, options, halvings=halvings, seed=options.seed)
    else:
        claim = hf.certificates.tolerant_claim(model, **claim_arguments)
        prove_claim(claim, options, halvings=halvings, seed=options.seed)


@command.command()
def ceiling(
    arm: ArmArgument,
    below: Annotated[float, "Upper bound to prove, between 0 and 1."],
    configurations: ConfigurationBoxOptions = ConfigurationBoxOptions(),
    halvings: JointHalvingsOption = 16,
    options: ProofOptions = ProofOptions(out=Path("ceiling.certificate")),
) -> None:
    """Prove an upper bound on relative manipulability over a box of configurations.

    The command also prints the best configuration that it finds in the box. Exit code: 0 if everything is proved, 3 if a part
    is undecided, 4 if that configuration is above the bound, 1 if the check rejects a part. Ctrl-C stops and writes the
    proved part; with --store, the same command resumes the search.

    Example: holdfast certify ceiling panda --around "-35 -45 51 -111 -46 84 -3" --within 5 --degrees --below 0.0735
    """
    model = options.resolve_arm(arm)
    claim = hf.certificates.ceiling_claim(model, threshold=below, **configurations.read_claim_arguments(model))
    prove_claim(claim, options, halvings=halvings, seed=options.seed)


@command.command()
def floor(
    arm: ArmArgument,
    above: Annotated[float, "Lower bound to prove, between 0 and 1."],
    configurations: ConfigurationBoxOptions = ConfigurationBoxOptions(),
    halvings: JointHalvingsOption = 16,
    options: ProofOptions = ProofOptions(out=Path("floor.certificate")),
) -> None:
    """Prove a lower bound on relative manipulability over a box of configurations.

    The command also prints the worst configuration that it finds in the box. Exit code: 0 if everything is proved, 3 if a part
    is undecided, 4 if that configuration is below the bound, 1 if the check rejects a part. Ctrl-C stops and writes the
    proved part; with --store, the same command resumes the search.

    Example: holdfast certify floor panda --around "40 20 -30 -90 30 120 0" --within 2 --degrees --above 0.02
    """
    model = options.resolve_arm(arm)
    claim = hf.certificates.floor_claim(model, threshold=above, **configurations.read_claim_arguments(model))
    prove_claim(claim, options, halvings=halvings, seed=options.seed)


@command.command()
def hold(
    arm: ArmArgument,
    configurations: JointBoxOptions = JointBoxOptions(),
    friction: FrictionOptions = FrictionOptions(),
    placement: MountingOptions = MountingOptions(),
    halvings: JointHalvingsOption = 6,
    options: ProofOptions = ProofOptions(out=Path("hold.certificate")),
) -> None:
    """Prove that an arm without motor torque stays at rest in a box of configurations.

    Joints without a given interval have their whole range. A joint whose interval is one of its limits lies against its stop.
    Exit code: 0 if everything is proved, 3 if a part is undecided, 4 if the arm moves in a part, 1 if the check rejects a part.
    Ctrl-C stops and writes the decided parts; with --store, the same command resumes the search.

    Example: holdfast certify hold yam --around "0 60 60 0 0 0" --within 2 --degrees --coulomb 10
    """
    model = placement.mount_arm(options.resolve_arm(arm))
    ranges = configurations.read_box(model)
    box = [ranges.get(joint.name, (joint.lower, joint.upper)) for joint in model.joints]
    claim = hf.certificates.hold_claim(model, *zip(*box, strict=True), friction=friction.read_friction(model))
    prove_claim(claim, options, halvings=halvings, seed=options.seed)


@command.command()
def path(
    arm: ArmArgument,
    motion: Annotated[Path, typer.Argument(metavar="MOTION", help="CSV file with a column JOINT_rad or JOINT_m per joint.")],
    failures: FailuresOption = "single",
    during: Annotated[str, "Two fractions of the motion (0 to 1) between which a joint may lock: '0.2 0.8'."] = "0 1",
    tube: Annotated[str, "Allowed deviation from the path in m and rad: 'M RAD', or one number for both."] = "0",
    task: Annotated[str, "Tool components that follow the path: pose, position, pointing, planar or planar-pose."] = "pose",
    segments: Annotated[int | None, "Number of equal segments of MOTION, up to 256. Default: one per step."] = None,
    halvings: Annotated[int, "Largest number of bisections of each lock-time interval."] = 6,
    options: UnseededProofOptions = UnseededProofOptions(out=Path("path.certificate")),
) -> None:
    """Prove that a tool path can be completed after any single lock at any time.

    MOTION is a table of configurations of the healthy arm, such as 'holdfast follow' writes. Between them, joints move along
    straight lines. Exit code: 0 if everything is proved, 3 if a part is undecided, 4 if a part is refuted, 1 if the check
    rejects a part. Ctrl-C stops and writes the decided parts; with --store, the same command resumes the search.

    Example: holdfast certify path planar-3r motion.csv --task planar --tube 0.0005
    """
    from holdfast.kinematics.paths.joint_table import joint_columns, read_joint_table

    model, failure_times = options.resolve_arm(arm), read_numbers("--during", during, "two numbers from 0 to 1").tolist()
    if len(failure_times) != 2:
        raise InputError(f"--during has {format_count(len(failure_times), 'number')}; give two fractions, such as '0 0.5'")
    claim = hf.certificates.path_claim(
        model,
        read_joint_table(model, motion, "motion", "time_s").select_columns(joint_columns(model)),
        failures=read_failures(model, failures),
        during=tuple(failure_times),
        tube=read_numbers("--tube", tube, "one number or two, m and rad,"),
        task=task,
        segments=segments,
    )
    prove_claim(claim, options, halvings=halvings)


@command.command("structural-zero")
def structural_zero(
    arm: ArmArgument,
    joint: Annotated[str, typer.Argument(metavar="JOINT", help="Joint except the first and last, by name or number from 1.")],
    check: CheckOption = True,
    chain: ArmSourceOptions = ArmSourceOptions(),
    out: CertificateOption = Path("structural-zero.certificate"),
    json_: JsonOption = False,
) -> None:
    """Prove that locking one joint removes all relative manipulability in every configuration.

    The proof is exact for an arm whose geometry is that of the file up to rounding; the command prints the difference. Exit
    code: 0 if the claim is proved, 3 if the axes do not meet.

    Example: holdfast certify structural-zero iiwa14 lbr_iiwa_joint_4
    """
    from holdfast.certificates.checks import require_flint

    model = chain.resolve_arm(arm)
    if check:
        require_flint()
    proof = hf.certify(hf.certificates.structural_zero_claim(model, read_joint(model, joint)))
    if not proof.ok:
        print_result(proof, json_)
        raise typer.Exit(NOT_MET_EXIT_CODE)
    file = proof.write(out)
    print_result(hf.check_certificate(file) if check else proof, json_, [file])


def _read_range_options(file: Path) -> list[str]:
    """Read a file of working ranges, and return them in the form of ``--range``."""
    from holdfast.core.files.yaml import read_mapping

    try:
        ranges = read_mapping(file, "holdfast certify tolerant --help", "a joint with its range, such as joint1: [-0.5, 0.5]")
    except InputError as error:
        raise InputError(f"ranges file '{file}': {error}") from error
    for joint, pair in ranges.items():
        if not isinstance(pair, list) or len(pair) != 2:
            raise InputError(f"ranges file '{file}': {joint} has {str(pair)[:40]!r}; give [LOW, HIGH]")
    return [f"{joint}={lower}..{upper}" for joint, (lower, upper) in ranges.items()]
