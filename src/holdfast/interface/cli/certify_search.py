"""Search, check, and output of the commands of ``holdfast certify``."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Sequence
from fractions import Fraction
from time import monotonic
from typing import TYPE_CHECKING, Any

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.cli.certify_options import REFUTED_EXIT_CODE, REJECTED_EXIT_CODE, ProofOptions, UnseededProofOptions
from holdfast.interface.cli.larger.study import stop_on_signal
from holdfast.interface.cli.options import NOT_MET_EXIT_CODE
from holdfast.interface.cli.progress import ProgressBar
from holdfast.interface.presentation.printing import print_json
from holdfast.interface.presentation.results import current_command, print_result, write_outputs

Options = UnseededProofOptions | ProofOptions
if TYPE_CHECKING:
    from holdfast.certificates import WorkingRanges
    from holdfast.certificates.tree import SearchState
    from holdfast.model.arm.model import Arm


def _check_output_and_flint(options: Options, folder: bool) -> None:
    """Raise before the search if its certificate cannot be written or checked, or would replace another file."""
    from holdfast.certificates.checks import require_flint

    out = options.out
    if out.is_dir() and not folder:
        raise InputError(f"--out '{out}' is a folder; give the name of a file")
    if out.is_file() and out.suffix not in ("", ".certificate", ".zip"):
        raise InputError(f"--out '{out}' exists and is not a certificate; give another name, such as {out.stem}.certificate")
    if (out.suffix or not folder) and not out.absolute().parent.is_dir():
        raise InputError(f"--out '{out}': there is no folder '{out.parent}'; create it, or give another path")
    if options.check:
        require_flint()


def prove_with_found_ranges(arm: Arm, claim_arguments: dict[str, Any], options: Options, **certify_options: Any) -> None:
    """Find working ranges for a failure-tolerant box, print them with the command that sets them, and prove the claim."""
    _check_output_and_flint(options, folder=True)
    working_ranges = hf.find_working_ranges(arm, **claim_arguments, seed=certify_options["seed"])
    if not (working_ranges.ok and options.json_):
        print_result(working_ranges, options.json_)
    if not working_ranges.ok:
        raise typer.Exit(NOT_MET_EXIT_CODE)
    if not options.json_:
        typer.echo(f"To prove the claim without the search: {_command_with_ranges(working_ranges.options)}\n")
    prove_claim(working_ranges.claim, options, ranges=working_ranges, **certify_options)


def _command_with_ranges(ranges: Sequence[str]) -> str:
    """Return the current command with these ranges, in degrees, instead of its own."""
    retained, words = list[str](), iter(sys.argv[1:])
    for word in words:
        option, equals, _ = word.partition("=")
        if option in ("--range", "--ranges"):
            if not equals:
                next(words, None)
        elif option not in ("--find-ranges", "--degrees"):
            retained.append(word)
    return f"holdfast {shlex.join([*retained, '--degrees', *(word for interval in ranges for word in ('--range', interval))])}"


def format_state(search_state: SearchState) -> str:
    """Format the progress of a search as one line; fractions are never rounded up to the whole or down to nothing."""
    from holdfast.certificates.verifier import format_percent

    shares = [f"{key} {format_percent(Fraction(min(getattr(search_state, key), 1.0)))}" for key in ("proved", "refuted")]
    open_fractions = [
        f"{name} {format_percent(Fraction(max(fraction, 0.0)), up=True)}"
        for name, fraction in (("undecided", search_state.undecided), ("open", search_state.open))
    ]
    return f"{', '.join([*shares, *open_fractions])}; {search_state.nodes:,} boxes"


def prove_claim(claim: Any, options: Options, ranges: WorkingRanges | None = None, **certify_options: Any) -> None:
    """Prove a claim, write, check and plot the certificate, and print the result; report and JSON contain the ranges found."""
    from holdfast.certificates.checks import CheckStopped

    _check_output_and_flint(options, len(claim.parts) > 1)
    # Half of the time limit is reserved for the check, which also receives the time that the search does not use.
    start_time, search_limit = monotonic() - (ranges.seconds if ranges else 0.0), options.time_limit
    if search_limit is not None:
        search_limit = max(search_limit - (ranges.seconds if ranges else 0.0), 1e-3) / (2 if options.check else 1)
    bar = ProgressBar(options.json_, "searching")
    certify_options |= {"time_limit": search_limit, "workers": options.workers, "store": options.store}
    with stop_on_signal("") as stop, bar as progress:
        proof = hf.certify(
            claim, **certify_options, progress=progress, state=lambda state: bar.set_text(format_state(state)), stop=stop
        )
    file = proof.write(options.out)
    verdict = None
    if options.check and not stop():
        remaining_time = None if options.time_limit is None else max(0.0, options.time_limit - (monotonic() - start_time))
        try:
            verdict = hf.check_certificate(file, time_limit=remaining_time)
        except CheckStopped:
            typer.echo(
                f"The time limit of {options.time_limit:g} s ended the check, so {file} is not verified; "
                f"'holdfast certificate check {file}' verifies it.",
                err=True,
            )
    files = [file, *write_outputs(proof, options.plot)]
    if options.report is not None:
        report_options = {"ranges": ranges} if ranges else {}
        files.append(proof.report(options.report, command=current_command(), check=verdict, file=file, **report_options))
    if options.json_ and ranges:
        print_json((verdict or proof).to_dict() | {"found_ranges": ranges.to_dict()})
    else:
        print_result(verdict or proof, options.json_, files)
    if stop():
        raise KeyboardInterrupt
    if verdict is not None and verdict.rejected:
        raise typer.Exit(REJECTED_EXIT_CODE)
    if getattr(proof, "refuted", False):
        raise typer.Exit(REFUTED_EXIT_CODE)
    if not proof.ok or (options.check and verdict is None):
        raise typer.Exit(NOT_MET_EXIT_CODE)
