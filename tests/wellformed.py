"""Is an HTML text well-formed, and does it load nothing?"""

from __future__ import annotations

import re
from html.parser import HTMLParser

VOID = {"meta", "br", "img", "link", "input", "hr", "wbr"}


class Checker(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: set[str] = set()
        self.ids: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_startendtag(tag, attrs)
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.ids += [v or "" for k, v in attrs if k == "id"]

    def handle_endtag(self, tag: str) -> None:
        assert self.open, tag
        assert self.open.pop() == tag


def check(html: str, scripts: int = 0) -> Checker:
    """Well-formed, loads nothing, no id twice, every reference there; so many scripts beside that of every page."""
    checker = Checker()
    checker.feed(html)
    checker.close()
    assert checker.open == []
    found = re.findall(r"<script([^>]*)>(.*?)</script>", html, re.DOTALL)
    assert len(found) == html.count("<script")
    views = '<div class="view3d"' in html  # which share a script
    assert [kind for kind, _ in found].count("") == scripts + views
    assert {kind for kind, _ in found} <= {"", ' id="page"', ' type="application/json"'}
    for _, script in found:
        for reach in ("fetch(", "XMLHttpRequest", "http:", "https:", "eval(", "innerHTML", "import "):
            # The name of SVG loads nothing, and Python's imports are only shown.
            assert reach not in re.sub(r"http://www\.w3\.org/2000/svg|import \w+ as \w+|from [\w.]+ import", "", script), reach
    assert len(checker.ids) == len(set(checker.ids))
    for target in re.findall(r"(?:src|href|srcset|action)\s*=\s*[\"']([^\"']*)", html):
        assert target.startswith(("#", "data:image/png")), target
        assert not target.startswith("#") or target[1:] in checker.ids
    for target in re.findall(r"url\(([^)]*)\)", html):
        assert target[1:] in checker.ids
    assert "@import" not in html
    return checker
