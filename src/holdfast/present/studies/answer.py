"""The answer of a study in a few sentences: who keeps most, or why nobody does."""

from __future__ import annotations

from collections.abc import Sequence

from holdfast.studies.ranking import Standing, said
from holdfast.words import article, interval, percent


def headline(stand: Sequence[Standing]) -> str:
    """The first index, as found and at its best, and the law and arm that reach the target most often."""
    parts = []
    found = [s for s in stand if not s.law]
    if found:
        s = found[0]
        best = found[1] if found[1:] and found[1].question.startswith(f"{s.question}, ") else None
        parts.append(_nothing(s, best) if s.empty else _leads(s, best))
    driven = [s for s in stand if s.law]
    if driven:
        top = max(driven, key=lambda s: s.ranked[0][1].value)
        reached = interval(top.ranked[0][1])
        parts.append(
            f"With a locked joint that nobody has noticed hardly any motion reaches its target under any law: of {top.about} "
            f"{reached} for {first(top)} under {top.law}."
            if top.empty
            else f"With a locked joint that nobody has noticed, {first(top)} reaches its target most often, under {top.law}: "
            f"{reached} of the motions."
        )
    return " ".join(parts)


def _leads(s: Standing, best: Standing | None) -> str:
    often = " most often" if len(s.entries) > 1 else ""
    text = f"After any failure considered, {first(s)}{often} keeps {article(s.question)} {s.question}{said(s.unit)}: "
    text += f"at {interval(s.ranked[0][1])} of the poses"
    if best is not None:
        text += f"; in the best configuration of each pose, {first(best)}: {interval(best.ranked[0][1])}"
    return f"{text}."


def _nothing(s: Standing, best: Standing | None) -> str:
    """Why no arm keeps what is asked for, and the next figures that say something."""
    text = f"After any failure considered, hardly any pose keeps {article(s.question)} {s.question}{said(s.unit)}: at most "
    text += f"{interval(s.ranked[0][1])} of an arm's poses"
    if best is not None:
        text += f", in the best configuration of each pose {interval(best.ranked[0][1])}"
    parts = [f"{text}."]
    if s.median:
        name, median = s.median
        parts.append(f"{name} has the best median, {median}")
        if best is not None and best.median:
            who = "" if best.median[0] == name else f" ({best.median[0]})"
            parts[-1] += f"; in the best configurations {best.median[1]}{who}"
        parts[-1] += f". Its worst failure is most often a lock of {s.worst}." if s.worst else "."
    parts += [f"{name} keeps nothing: once {joint} locks, it is singular everywhere." for name, joint in s.ended.items()]
    return " ".join(parts)


def first(s: Standing) -> str:
    """Who leads, or shares the lead."""
    first, *others = s.level
    return f"{first} (level with {', '.join(others)})" if others else first


def facts(stand: Sequence[Standing]) -> list[tuple[str, str]]:
    """Who leads in the first questions; the best median where hardly anything is kept."""
    found: list[tuple[str, str]] = []
    for s in stand[:4]:
        (name, p), *_ = s.ranked
        if not s.empty:
            found.append((percent(p.value), f"{name}, {s.question}; {percent(p.low)} to {percent(p.high)}, 95 %"))
        elif s.median:
            found.append((s.median[1], f"{s.median[0]}, the best median; {s.question}: hardly any pose"))
    return found
