"""What the commands of ``holdfast certify`` do with a claim."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Sequence
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any

import typer

import holdfast as hf
from holdfast.cli.certify_options import REFUTED, REJECTED, Search, Written
from holdfast.cli.larger.study import stopping
from holdfast.cli.options import NOT_MET
from holdfast.cli.progress import progress_bar
from holdfast.errors import InputError
from holdfast.present.printing import print_json
from holdfast.present.results import drawn, printed, said

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.reach import WorkingRanges


def _need_place(out: Path, folder: bool) -> None:
    """Refuse before the search what could not be written after it, or would replace another file."""
    if out.is_dir() and not folder:
        raise InputError(f"--out '{out}' is a folder; give the name of a file")
    if out.is_file() and out.suffix not in ("", ".certificate", ".zip"):
        raise InputError(f"--out '{out}' is there, and no certificate; give another name, such as {out.stem}.certificate")
    if (out.suffix or not folder) and not out.absolute().parent.is_dir():
        raise InputError(f"--out '{out}': there is no folder '{out.parent}'; make it, or give another path")


def _need_place_and_flint(search: Search, written: Written, folder: bool) -> None:
    """Refuse before any search what could not be written or checked after it."""
    from holdfast.certificates.checks import need_flint

    _need_place(written.out, folder)
    if search.check:
        need_flint()


def prove_with_found_ranges(arm: Arm, asked: dict[str, Any], search: Search, written: Written, **how: Any) -> None:
    """Find working ranges for a failure-tolerant box, print them with the command that gives them, and prove the claim."""
    _need_place_and_flint(search, written, folder=True)
    found = hf.find_working_ranges(arm, **asked, seed=how["seed"])
    if not (found.ok and written.json_):
        printed(found, written.json_)
    if not found.ok:
        raise typer.Exit(NOT_MET)
    if not written.json_:
        typer.echo(f"The same claim without the search: {_command_with(found.options)}\n")
    proved(found.claim, search, written, ranges=found, **how)


def _command_with(ranges: Sequence[str]) -> str:
    """The command that runs, with these ranges in degrees in place of those that it was given."""
    kept, words = list[str](), iter(sys.argv[1:])
    for word in words:
        option, equals, _ = word.partition("=")
        if option in ("--range", "--ranges"):
            if not equals:
                next(words, None)
        elif option not in ("--find-ranges", "--degrees"):
            kept.append(word)
    return f"holdfast {shlex.join([*kept, '--degrees', *(word for text in ranges for word in ('--range', text))])}"


def proved(claim: Any, search: Search, written: Written, ranges: WorkingRanges | None = None, **how: Any) -> None:
    """Search, write, check, draw, print; ranges that were found for the claim are on the page and in the JSON."""
    from holdfast.certificates import PathProof, TolerantClaim
    from holdfast.certificates.checks import CheckStopped
    from holdfast.present.certificates.console import state

    _need_place_and_flint(search, written, isinstance(claim, TolerantClaim))
    # Of a limited time half is kept for the check, which gets what the search leaves as well.
    begin, limit = monotonic() - (ranges.seconds if ranges else 0.0), search.time_limit
    if limit is not None:
        limit = max(limit - (ranges.seconds if ranges else 0.0), 1e-3) / (2 if search.check else 1)
    bar = progress_bar(written.json_, "ten-thousandths")
    with stopping("") as stop, bar as progress:
        how |= {"time_limit": limit, "workers": search.workers, "store": search.store}
        proof = hf.certify(claim, **how, progress=progress, state=lambda now: bar.says(state(now)), stop=stop)
    file = proof.write(written.out)
    found = None
    if search.check and not stop():
        left = None if search.time_limit is None else max(0.0, search.time_limit - (monotonic() - begin))
        try:
            found = hf.check_certificate(file, time_limit=left)
        except CheckStopped:
            typer.echo(
                f"The time limit of {search.time_limit:g} s ended the check, so {file} is not verified; "
                f"'holdfast certificate check {file}' verifies it.",
                err=True,
            )
    told = {"ranges": ranges} if ranges else {}
    page = [] if written.report is None else [proof.report(written.report, command=said(), check=found, file=file, **told)]
    files = [file, *drawn(proof, written.plot), *page]
    if written.json_ and ranges:
        print_json((found or proof).to_dict() | {"found_ranges": ranges.to_dict()})
    else:
        printed(found or proof, written.json_, files)
    if stop():
        raise KeyboardInterrupt
    if found is not None and found.rejected:
        raise typer.Exit(REJECTED)
    if isinstance(proof, hf.certificates.Refutation | hf.certificates.ManipulabilityBound | PathProof) and proof.refuted:
        raise typer.Exit(REFUTED)
    if not proof.ok or (search.check and found is None):
        raise typer.Exit(NOT_MET)
