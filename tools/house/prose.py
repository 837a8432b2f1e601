"""Foreign patterns in the pages that people read, as rates per 1,000 words of running text."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

# Most hits per 1,000 words over all pages. CONTRIBUTING names the rule behind each pattern.
PATTERNS = {
    "'what' as a noun": (r"\b(what|whatever)\s+(?!is new\b)\w+", 1.0),
    "talking programs": (r"\b(says?|said|tells?|told)\b", 0.5),
    "nameless agents": (r"\b(nobody|somebody|whoever|anybody|everybody)\b", 0.1),
    "literal translations": (
        r"\b(beside|anew|but for|so many|in the mean|of (its|their|your|our) own|as it comes|once more|in all|goes by)\b",
        0.3,
    ),
    "semicolons": (r";", 3.0),
    "colons": (r"\w:\s", 5.0),
    "phrases in front": (r"(?:(?<=[.!?] )|^)(?-i:Of|By which|So many)\b", 0.05),
    "'look at' for 'check'": (
        r"\b(look(s|ed)? (at|out|once)|goes on|go on|went on|left out|given up|told apart|keeps? clear)\b",
        0.5,
    ),
}
PAGE_RATE = 15.0  # most hits of all patterns per 1,000 words of one page
SHORT_PAGE_WORDS = 150  # a page with fewer words has no rate of its own
SENTENCE_WORDS, LONG_SENTENCE_PERCENT = 40, 2.0
CONNECTIVES = r"\b(because|for example|therefore|however|since|so that|which means|although|instead)\b"
CONNECTIVE_RATE = 4.0  # at least
MAX_WORDS = 55_000
GENERATED = {"_build", "gallery", "commands", "classes"}  # folders of pages that the build writes
_CODE = re.compile(r":[\w:+-]+:(?=`)|`+[^`]*`+_*|\$[^$]*\$|\]\([^)]*\)|https?://\S+|\{[\w-]+\}")


@dataclass
class Prose:
    """Counts of one page or of several pages."""

    words: int = 0
    sentences: int = 0
    long_sentences: int = 0
    connectives: int = 0
    hits: Counter[str] = field(default_factory=Counter)

    def add(self, other: Prose) -> None:
        """Add the counts of a page."""
        self.words += other.words
        self.sentences += other.sentences
        self.long_sentences += other.long_sentences
        self.connectives += other.connectives
        self.hits += other.hits


def find_pages(root: Path) -> list[Path]:
    """Find the pages that are written by hand."""
    docs = sorted(path for path in (root / "docs").rglob("*") if path.suffix in (".md", ".rst"))
    written = [path for path in docs if not GENERATED & set(path.relative_to(root).parts)]
    top = [root / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")]
    return [*(path for path in top if path.exists()), *written]


def extract_prose(text: str) -> str:
    """Return the running text of a page, without code, tables, headings and directives."""
    kept: list[str] = []
    fence = ""
    for line in map(str.strip, text.splitlines()):
        if opening := re.match(r"(`{3,}|~{3,}|:{3,})", line):
            fence = "" if fence and line.startswith(fence) else fence or opening.group(1)
        elif not fence and line and not line.startswith(("#", "|", "..", ":", "<", "(", "![", ">")):
            kept.append(_CODE.sub(" ", line))
    return "\n".join(kept)


def measure_prose(text: str) -> Prose:
    """Count the words, sentences and patterns of one page."""
    prose = extract_prose(text)
    lengths = [len(sentence.split()) for sentence in re.split(r"(?<=[.!?])\s+", prose.replace("\n", " "))]
    hits = {name: len(re.findall(pattern, prose, re.IGNORECASE | re.MULTILINE)) for name, (pattern, _) in PATTERNS.items()}
    return Prose(
        words=len(re.findall(r"[A-Za-z][A-Za-z'-]*", prose)),
        sentences=sum(length > 2 for length in lengths),
        long_sentences=sum(length > SENTENCE_WORDS for length in lengths),
        connectives=len(re.findall(CONNECTIVES, prose, re.IGNORECASE)),
        hits=Counter(hits),
    )


def find_excesses(pages: dict[str, str]) -> dict[str, int]:
    """Return each page and pattern above its limit, with the number of hits to remove."""
    total = Prose()
    excesses: dict[str, int] = {}
    for name, text in pages.items():
        page = measure_prose(text)
        total.add(page)
        if page.words > SHORT_PAGE_WORDS:
            excesses[name] = page.hits.total() - int(PAGE_RATE * page.words / 1000)
    excesses |= {f"all pages, {name}": excess for name, excess in _list_total_excesses(total)}
    return {name: excess for name, excess in excesses.items() if excess > 0}


def _list_total_excesses(total: Prose) -> Iterator[tuple[str, int]]:
    thousands = total.words / 1000
    for name, (_, rate) in PATTERNS.items():
        yield name, total.hits[name] - int(rate * thousands)
    yield "long sentences", total.long_sentences - int(LONG_SENTENCE_PERCENT / 100 * total.sentences)
    yield "missing connectives", int(CONNECTIVE_RATE * thousands) - total.connectives
    yield "words", total.words - MAX_WORDS


def read_pages(root: Path) -> dict[str, str]:
    """Read every page that is written by hand, by its path in the repository."""
    return {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in find_pages(root)}
