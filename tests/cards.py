"""What a notebook shows of a thing: read, and what it suggests executed."""

from __future__ import annotations

import contextlib
import tempfile
from html.parser import HTMLParser

import pytest

import __main__
import holdfast as hf


class Card(HTMLParser):
    """Its tags, each closed, and the code in it; no colour of its own but the ground of its figure."""

    def __init__(self, html):
        super().__init__()
        self.open, self.seen, self.code = [], [], ""
        self.feed(html)
        self.close()
        assert self.open == []
        assert {"script", "style", "b"} & set(self.seen) == set()

    def handle_starttag(self, tag, attrs):
        self.seen.append(tag)
        if tag not in ("img", "br"):
            self.open.append(tag)
        look = dict(attrs).get("style") or ""
        assert "color" not in look
        assert ("background" in look) == (tag == "img")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == "code":
            self.code += data


def check_card(thing, figure=True, **others):
    """It has a table, a figure or none, and what to ask next runs as it is, with ``mine`` for its name."""
    with pytest.MonkeyPatch.context() as patch, tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        for name, value in {"mine": thing, **others}.items():
            patch.setattr(__main__, name, value, raising=False)
        card = Card(thing._repr_html_())
        assert "table" in card.seen
        assert bool({"img", "svg"} & set(card.seen)) == figure
        steps = [line.partition("  #")[0] for line in card.code.splitlines() if not line.startswith("#")]
        assert 1 <= len(steps) <= 3
        assert all("mine" in step for step in steps)
        for step in steps:
            if "report(" not in step:  # reports are tested elsewhere
                exec(step.replace("poses=200", "poses=4"), {"hf": hf, "mine": thing, **others})
