"""``holdfast certificate``: check, show."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.certify_options import REJECTED
from holdfast.cli.options import JsonOption
from holdfast.errors import InputError
from holdfast.present.results import printed

FileArgument = Annotated[Path, typer.Argument(metavar="FILE", help="Certificate.")]

command = typer.Typer(
    name="certificate",
    help="Check certificates, by code that shares nothing with what made them.",
    no_args_is_help=True,
)


@command.command()
def check(
    file: FileArgument,
    sample: Annotated[int | None, "Only so many cells, drawn at random."] = None,
    workers: Annotated[int, "Processes."] = 1,
    json_: JsonOption = False,
) -> None:
    """Check a certificate: every cell again, in ball arithmetic.

    The exit code is 1 if a cell is rejected.

    Example: holdfast certificate check reach.certificate
    """
    found = hf.check_certificate(file, sample=sample, workers=workers)
    printed(found, json_)
    if found.rejected:
        raise typer.Exit(REJECTED)


@command.command()
def show(file: FileArgument) -> None:
    """Show what a certificate claims, without checking the proof.

    Example: holdfast certificate show reach.certificate
    """
    from holdfast.certificates import verifier

    try:
        document = verifier.load(file)
    except verifier.Refused as error:
        raise InputError(str(error)) from error
    volumes, arm = document["volumes"], document["source"]["name"]
    typer.echo(document["claim"])
    typer.echo(
        f"A {document['kind']} of {arm}, whose file has {len(document['arm']['joints'])} joints; digest {document['digest']}."
    )
    typer.echo(f"Claimed, not checked: proved {volumes['proved']}, undecided {volumes['undecided']}; {document['made_by']}.")
