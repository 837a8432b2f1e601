"""``holdfast certificate``: check, show."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.certify_options import REJECTED
from holdfast.cli.groups import Chain
from holdfast.cli.options import JsonOption
from holdfast.errors import InputError
from holdfast.present.results import printed

FileArgument = Annotated[Path, typer.Argument(metavar="FILE", help="Certificate, or the folder that holds it.")]

command = typer.Typer(
    name="certificate",
    help="Verify or display certificates.",
    no_args_is_help=True,
)


@command.command()
def check(
    file: FileArgument,
    sample: Annotated[int | None, "Only so many cells, drawn at random."] = None,
    workers: Annotated[int, "Processes."] = 1,
    arm: Annotated[str | None, "The arm that it must be about, as ARM elsewhere."] = None,
    chain: Chain = Chain(),
    json_: JsonOption = False,
) -> None:
    """Verify a certificate with the independent checker (ball arithmetic).

    The exit code is 1 if a cell is rejected, 2 if the file cannot be checked or is about another arm.

    Example: holdfast certificate check reach.certificate
    """
    meant = None if arm is None else chain.arm(arm)
    found = hf.check_certificate(file, arm=meant, sample=sample, workers=workers)
    printed(found, json_)
    if found.rejected:
        raise typer.Exit(REJECTED)


def _share(text: str) -> Fraction:
    """``a/b`` or ``a/2^b``."""
    above, below = text.split("/")
    base, _, power = below.partition("^")
    return Fraction(int(above), int(base) ** int(power or 1))


@command.command()
def show(file: FileArgument) -> None:
    """Print the claim of a certificate without verifying it.

    Example: holdfast certificate show reach.certificate
    """
    from holdfast.certificates import verifier
    from holdfast.certificates.checks import find_in_folder

    try:
        document = verifier.load(find_in_folder(file))
    except verifier.Refused as error:
        raise InputError(str(error)) from error
    volumes, arm = {key: _share(part) for key, part in document["volumes"].items()}, document["source"]["name"]
    of = "this claim in its worst part" if document["kind"] in ("bundle", "path") else "this claim"
    only = f", proved for only {verifier.per_cent(volumes['proved'])} of {of}" if 0 < volumes["proved"] < 1 else ""
    typer.echo(f"Not verified{only}: {document['claim']}")
    typer.echo(
        f"A {document['kind']} of {arm}, whose file has {len(document['arm']['joints'])} joints; digest {document['digest']}."
    )
    shares = [f"{key} {verifier.per_cent(part, up=key == 'undecided')}" for key, part in volumes.items() if part]
    typer.echo(f"Claimed, not checked: {', '.join(shares)}; {document['made_by']}.")
