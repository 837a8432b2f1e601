"""Compare the statements of the papers with our results, and collect them on one page of the documentation.

``python -m papers.claims`` writes ``docs/evidence/claims.md`` from the tables of statements in every
``papers/*/RESULTS.md`` and in ``measurements/certificates/RESULTS.md``. It computes nothing again.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import astuple, dataclass
from enum import StrEnum
from pathlib import Path

HERE = Path(__file__).parent
PAGE = HERE.parent / "docs" / "evidence" / "claims.md"


class Verdict(StrEnum):
    """What we found of a statement that can be true or false; ``NONE`` for settings and for what the paper does not say."""

    NONE = ""
    HOLDS = "holds"
    PARTLY = "holds in part"
    FALSE = "false as written"
    AS_READ = "false as we read it"
    OPEN = "cannot be told"


@dataclass(frozen=True)
class Claim:
    """One row of the comparison."""

    where: str
    paper: str
    ours: str
    why: str
    verdict: Verdict = Verdict.NONE


HEAD = ["| where | paper | ours | difference and why | verdict |", "|---|---|---|---|---|"]


def table(claims: Sequence[Claim]) -> list[str]:
    """The lines of a table in Markdown; no cell may hold a bar."""
    return [*HEAD, *["| " + " | ".join(astuple(c)).rstrip() + " |" for c in claims]]


def read(lines: Sequence[str]) -> list[Claim]:
    """The statements of every table that :func:`table` wrote, in order."""
    found, inside = [], False
    for line in lines:
        inside = line == HEAD[0] or (inside and line.startswith("|"))
        if inside and line not in HEAD:
            where, paper, ours, why, verdict = (x.strip() for x in line.strip("|").split("|"))
            found.append(Claim(where, paper, ours, why, Verdict(verdict)))
    return found


# ---- the page ------------------------------------------------------------------------------------------------------------

PAPERS = {
    "abdi2012": "Abdi, Maciejewski, Nahavandi 2012 {cite}`Abdi2012`",
    "english1998": "English, Maciejewski 1998 {cite}`English1998`",
    "goel2003": "Goel, Maciejewski, Balakrishnan, Proctor 2003 {cite}`Goel2003`",
    "goel2005": "Goel, Maciejewski, Balakrishnan 2005 {cite}`Goel2005`",
    "certificates": "Beliefs and gaps that certificates settle",
}
INTRODUCTION = """\
<!-- Written by `python -m papers.claims` from RESULTS.md in papers and measurements: change those, not this page. -->

# Claims checked

holdfast reproduces the figures, tables and numbers of four papers. This page compares each statement that can be true or
false with our result. Run the command under a heading in a checkout of holdfast to recompute its table. The command writes
the table, with the figures, into a file `RESULTS.md`.

holdfast builds on these papers, and most of their statements hold. If a statement does not hold *as written*, its row gives
a reading under which it does. Some passages are hard to read, because they exist only as scans or have lost their
displays. A row states where a number depends on our reading. The last section compares common beliefs with the papers.
There, each verdict in bold is proved by a [certificate](../theory/certificates.md), because a sample can only
show that no exception was found.

| verdict | meaning |
|---|---|
| holds | our result agrees, exactly or to the printed digits |
| holds in part | true under a condition that the text does not name, or only for some cases |
| false as written | the row contains a counterexample |
| false as we read it | there is a counterexample under our reading of values that are not stated or hard to read |
| cannot be told | the text does not contain enough information for a check |
"""


def find_package(name: str) -> Path:
    """Return the folder of a paper, or of a measurement with the same form."""
    return next(folder / name for folder in (HERE, HERE.parent / "measurements") if (folder / name).is_dir())


def stored(name: str) -> list[Claim]:
    """Read the statements of a paper as its last run wrote them."""
    return read((find_package(name) / "RESULTS.md").read_text(encoding="utf-8").splitlines())


def page() -> str:
    """The text of ``docs/evidence/claims.md``."""
    claims = {name: [c for c in stored(name) if c.verdict] for name in PAPERS}
    every = [c.verdict for of_one in claims.values() for c in of_one]
    counts = ", ".join(f"{v} {every.count(v)}" for v in Verdict if v)
    lines = [*INTRODUCTION.splitlines(), "", f"{len(every)} statements so far: {counts}."]
    for name, title in PAPERS.items():
        lines += ["", f"## {title}", "", "```sh", f"python -m {find_package(name).parent.name}.{name}", "```", ""]
        lines += ["| statement | paper | ours | verdict |", "|---|---|---|---|"]
        lines += [f"| {c.where} | {c.paper} | {c.ours}; {c.why} | **{c.verdict}** |" for c in claims[name]]
    return "\n".join(lines) + "\n"


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")
    print(f"{PAGE}: {page().count('| **')} statements")


if __name__ == "__main__":
    main()
