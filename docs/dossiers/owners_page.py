"""What the dossiers share: the command line of each, and how its answer becomes a page, a picture and a text."""

import argparse
import sys
from pathlib import Path

from markupsafe import Markup

from holdfast.interface import report


def span(value, scale=100, unit=" %", digits=0):
    """A value with its interval, as words."""
    middle, low, high = (f"{scale * x:.{digits}f}".replace("-", "−") for x in (value.value, value.low, value.high))
    return f"{middle}{unit} ({low} to {high}, 95 %)"


def links(*pages):
    """A paragraph with the pages that lie beside this one."""
    return report.Text(Markup(" · ").join(Markup('<a href="{0}">{0}</a>').format(p.name) for p in pages))


def write(out, name, title, answer, sections, *, figure, method, count, more=()):
    """Write index.html, NAME.png and NAME.txt into a folder, and print the text: the answer, and what else there is to say."""
    report.save_png(figure, out / f"{name}.png", dpi=90)
    evidence = [report.Section(head, [block]) for head, block in sections.items()]
    again = f"python docs/dossiers/{name}.py --out FOLDER --count {count}"
    footer = "Written by holdfast. The pages linked lie beside this one."
    report.write(
        report.Page(title, answer, evidence, method=[report.Text(method)], again=again, footer=footer), out / "index.html"
    )
    text = [answer, *more]
    (out / f"{name}.txt").write_text("\n\n".join(text) + "\n", encoding="utf-8")
    print(*text, sep="\n\n")


def run(main, count):
    """Run a dossier's ``main(out, count)`` with what the command line asks for."""
    parser = argparse.ArgumentParser(description=sys.modules[main.__module__].__doc__)
    parser.add_argument("--out", type=Path, required=True, help="folder for the pages")
    parser.add_argument("--count", type=int, default=count, help="poses or motions to draw")
    asked = parser.parse_args()
    asked.out.mkdir(parents=True, exist_ok=True)
    main(asked.out, asked.count)
