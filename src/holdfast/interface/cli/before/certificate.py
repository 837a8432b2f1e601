"""``holdfast certificate``: check, show."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.cli.certify_options import REJECTED_EXIT_CODE
from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.options import JsonOption
from holdfast.interface.presentation.results import print_result

FileArgument = Annotated[Path, typer.Argument(metavar="FILE", help="Certificate file, or the folder that contains it.")]

command = typer.Typer(name="certificate", help="Verify or display certificates.", no_args_is_help=True)


@command.command()
def check(
    file: FileArgument,
    sample: Annotated[int | None, "Number of randomly chosen boxes to check. Default: all."] = None,
    workers: Annotated[int, "Number of worker processes."] = 1,
    arm: Annotated[str | None, "Arm that the certificate must be about: built-in name or arm file. Default: any."] = None,
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Verify a certificate with the independent checker (ball arithmetic).

    Exit code: 0 if every box is accepted, 1 if one is rejected, 2 if the file cannot be checked or is about another arm.

    Example: holdfast certificate check reach.certificate
    """
    expected_arm = None if arm is None else chain.resolve_arm(arm)
    verdict = hf.check_certificate(file, arm=expected_arm, sample=sample, workers=workers)
    print_result(verdict, json_)
    if verdict.rejected:
        raise typer.Exit(REJECTED_EXIT_CODE)


def _parse_fraction(text: str) -> Fraction:
    """Parse ``a/b`` or ``a/2^b``."""
    numerator, denominator = text.split("/")
    base, _, power = denominator.partition("^")
    return Fraction(int(numerator), int(base) ** int(power or 1))


@command.command()
def show(file: FileArgument) -> None:
    """Print the claim of a certificate without verifying it.

    Example: holdfast certificate show reach.certificate
    """
    from holdfast.certificates import verifier
    from holdfast.certificates.checks import find_certificate_file

    try:
        document = verifier.load_certificate(find_certificate_file(file))
    except verifier.CertificateRejected as error:
        raise InputError(str(error)) from error
    volumes, arm = {state: _parse_fraction(volume) for state, volume in document["volumes"].items()}, document["source"]["name"]
    scope = "this claim in its worst part" if document["kind"] in ("bundle", "path") else "this claim"
    proved_part = (
        f", proved for only {verifier.format_percent(volumes['proved'])} of {scope}" if 0 < volumes["proved"] < 1 else ""
    )
    typer.echo(f"Not verified{proved_part}: {document['claim']}")
    typer.echo(
        f"A {document['kind']} of {arm}, with {len(document['arm']['joints'])} joints in the file; digest {document['digest']}."
    )
    claimed_parts = [
        f"{state} {verifier.format_percent(volume, up=state == 'undecided')}" for state, volume in volumes.items() if volume
    ]
    typer.echo(f"Claimed fractions, not checked: {', '.join(claimed_parts)}. Made by {document['made_by']}.")
