"""What a notebook shows of a thing: read, and what it suggests executed."""

from __future__ import annotations

from html.parser import HTMLParser


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


def check_card(thing, figure=True):
    """It has a table, and a figure or none."""
    card = Card(thing._repr_html_())
    assert "table" in card.seen
    assert bool({"img", "svg"} & set(card.seen)) == figure
