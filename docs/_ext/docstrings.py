"""Small repairs to docstrings and references on their way to Sphinx, so that they can be written for people."""

from __future__ import annotations

import re
from functools import cache
from importlib import import_module
from typing import Any

from sphinx.application import Sphinx
from sphinx.ext.napoleon import GoogleDocstring

_VALUES = ("property", "attribute", "data")
_ALIAS = re.compile(r"TypeAliasForwardRef\('(\w+)'\)")
_SETTING = re.compile(r"~?[\w.]+\.Annotated\[(.*?), ~?holdfast\.core\.registry\.Parameter\(.*?\)\]")
_ARRAY = re.compile(r"[~\w.]*_Buffer \| .*?_NestedSequence\[complex \| bytes \| str\]")
_PARAMETERS = re.compile(r'(<span class="sig-paren">\(</span>)\s*<dl>(.*?)</dl>\s*(<span class="sig-paren">\))', re.S)
_THUMBNAIL = re.compile(r'(<a class="reference internal" href="[^"]*")(><span class="doc">)([^<"]*)')
_QUALIFIED = re.compile(r"~(?:\w+\.)+(\w+)")
_NAMES = re.compile(r"^( +)(\w+(?:, \w+)+): (.*)$")


def separate_names(lines: list[str]) -> list[str]:
    """``lower, upper: limits`` becomes two entries with the same text; Sphinx would take the first name for a type."""
    out: list[str] = []
    k = 0
    while k < len(lines):
        match = _NAMES.match(lines[k])
        if match is None:
            out.append(lines[k])
            k += 1
            continue
        indent, names, text = match.groups()
        more = k + 1
        while more < len(lines) and lines[more].startswith(indent + " "):
            more += 1
        for name in names.split(", "):
            out += [f"{indent}{name}: {text}", *lines[k + 1 : more]]
        k = more
    return out


def escape_bars(line: str) -> str:
    """A bare ``|S|`` is a size, not a substitution; what stands between double backquotes stays."""
    parts = line.split("``")
    return "``".join(part.replace("|S|", r"\|S\|") if k % 2 == 0 else part for k, part in enumerate(parts))


def repair(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    lines[:] = [escape_bars(line) for line in separate_names(lines)]


def kind_of(setting: re.Match[str]) -> str:
    """The kind of an annotated argument, without what else is said of it; of arrays by name, which is gone within."""
    if "_SupportsArray" not in setting[1]:
        return setting[1]
    return "ArrayLike | str | None" if "Literal" in setting[1] else "ArrayLike"


def plain_names(
    app: Sphinx, what: str, name: str, obj: Any, options: Any, signature: str | None, returns: str | None
) -> tuple[str | None, str | None]:
    """Sphinx 9 shows an alias as ``TypeAliasForwardRef('ArrayLike')``, and a full name where it cannot parse a default."""
    shown = [x and _ARRAY.sub("ArrayLike", _SETTING.sub(kind_of, _ALIAS.sub(r"\1", x))) for x in (signature, returns)]
    if shown[0] and "<factory>" in shown[0]:
        shown[0] = _QUALIFIED.sub(r"\1", shown[0])
    return shown[0], shown[1]


@cache
def thing(name: str) -> Any:
    """What has this name, from whatever module it is in; None if nothing has."""
    parts = name.split(".")
    for k in range(len(parts), 0, -1):
        try:
            found: Any = import_module(".".join(parts[:k]))
            for part in parts[k:]:
                found = getattr(found, part)
        except (ImportError, AttributeError):
            continue
        return found
    return None


@cache
def described(names: tuple[str, ...]) -> dict[int, str]:
    """The first name under which each thing is described."""
    return {id(found): name for name in reversed(names) if (found := thing(name)) is not None}


def same_thing(app: Sphinx, env: Any, node: Any, shown: Any) -> Any:
    """What is described under another of its names, or in the base class that it comes from."""
    if node.get("refdomain") != "py":
        return None
    before = [x for x in (node.get("py:module"), node.get("py:class")) if x]
    names = [".".join([*before[:k], node["reftarget"]]) for k in range(len(before) + 1)]
    wanted = [found for found in map(thing, names) if found is not None]
    domain = env.get_domain("py")
    known = described(tuple(domain.objects)) if wanted else {}
    for each in wanted:
        if id(each) in known:
            return domain.resolve_xref(env, node["refdoc"], app.builder, "obj", known[id(each)], node, shown)
    return None


def spoken(app: Sphinx, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
    """What screen readers stumble on: definitions without terms, a list without items, links whose text is hidden."""
    if "body" not in context:
        return
    body = _PARAMETERS.sub(_spans, context["body"]).replace(
        '<div role="list" class="citation-list">', '<div class="citation-list">'
    )
    context["body"] = _THUMBNAIL.sub(r'\1 aria-label="\3"\2\3', body) if page.startswith("gallery") else body


def _spans(match: re.Match[str]) -> str:
    inside = match[2].replace("<dd>", '<span class="sig-line">').replace("</dd>", "</span>")
    return f"{match[1]}{inside}{match[3]}"


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("autodoc-process-docstring", repair, priority=400)
    app.connect("autodoc-process-signature", plain_names)
    app.connect("missing-reference", same_thing)
    app.connect("html-page-context", spoken)
    plain = GoogleDocstring.__init__

    # Napoleon takes the words before a colon in the docstring of a property or constant for its type; ours are sentences.
    def init(self: Any, docstring: Any, config: Any = None, app: Any = None, what: str = "", *rest: Any, **named: Any) -> None:
        plain(self, docstring, config, app, "method" if what in _VALUES else what, *rest, **named)

    GoogleDocstring.__init__ = init  # type: ignore[method-assign]
    return {"parallel_read_safe": True, "parallel_write_safe": True}
