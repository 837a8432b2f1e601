"""What the commands of ``holdfast certify`` do with a claim."""

from __future__ import annotations

from pathlib import Path
from time import monotonic
from typing import Any

import typer

import holdfast as hf
from holdfast.cli.certify_options import REFUTED, REJECTED, Search, Written
from holdfast.cli.larger.study import stopping
from holdfast.cli.options import NOT_MET
from holdfast.cli.progress import progress_bar
from holdfast.errors import InputError
from holdfast.present.results import drawn, printed, said


def _need_place(out: Path, folder: bool) -> None:
    """Refuse before the search what could not be written after it, or would replace another file."""
    if out.is_dir() and not folder:
        raise InputError(f"--out '{out}' is a folder; give the name of a file")
    if out.is_file() and out.suffix not in ("", ".certificate", ".zip"):
        raise InputError(f"--out '{out}' is there, and no certificate; give another name, such as {out.stem}.certificate")
    if (out.suffix or not folder) and not out.absolute().parent.is_dir():
        raise InputError(f"--out '{out}': there is no folder '{out.parent}'; make it, or give another path")


def proved(claim: Any, search: Search, written: Written, **how: Any) -> None:
    """Search, write, check, draw, print."""
    from holdfast.certificates import PathProof, TolerantClaim
    from holdfast.certificates.checks import CheckStopped, need_flint
    from holdfast.present.certificates.console import state

    _need_place(written.out, isinstance(claim, TolerantClaim))
    if search.check:
        need_flint()
    # Of a limited time half is kept for the check, which gets what the search leaves as well.
    begin, limit = monotonic(), search.time_limit
    if limit is not None and search.check:
        limit /= 2
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
    page = [] if written.report is None else [proof.report(written.report, command=said(), check=found, file=file)]
    printed(found or proof, written.json_, [file, *drawn(proof, written.plot), *page])
    if stop():
        raise KeyboardInterrupt
    if found is not None and found.rejected:
        raise typer.Exit(REJECTED)
    if isinstance(proof, hf.certificates.Refutation | hf.certificates.ManipulabilityBound | PathProof) and proof.refuted:
        raise typer.Exit(REFUTED)
    if not proof.ok or (search.check and found is None):
        raise typer.Exit(NOT_MET)
