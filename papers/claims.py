"""A paper's statements beside ours, and the page of the docs that gathers them.

``python -m papers.claims`` writes ``docs/evidence/claims.md`` from the tables of statements in every ``papers/*/RESULTS.md`` and in
``measurements/certificates/RESULTS.md``, which the papers' own runs write; nothing is computed again.
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

holdfast makes the figures, tables and numbers of four papers again. This page lists their statements that can be true or
false, beside what we computed. The command under each heading, run in a checkout of holdfast, computes everything in its
table again and writes it, with the figures, into a file `RESULTS.md`.

These papers are the ground of holdfast, and most of what they say holds. Where a statement does not hold *as it
is written*, the row says how it can be read so that it does. Scans and lost displays make some places hard to read;
where a number depends on our reading, the row says so. The last section has popular beliefs beside the papers' statements:
there each word in bold is proved by a [certificate](../theory/certificates.md), where a sample can only say that it found no exception.

| verdict | it means |
|---|---|
| holds | we get the same, or the same to the digits that are printed |
| holds in part | true with a condition that the text does not name, or of some cases only |
| false as written | there is a counterexample; the row has it |
| false as we read it | there is a counterexample under our reading of values that are not stated or hard to read |
| cannot be told | the text does not give what it takes to check it |
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
