"""Command line: ``python -m tools.house [--tighten | --picture]``; 1 if lists or picture do not say what there is."""

from __future__ import annotations

import gc
import sys

from tools.house import picture
from tools.house.ratchet import Lists, counted, source


def main(arguments: list[str]) -> int:
    """Print the counts and what is new or gone."""
    if arguments == ["--picture"]:
        picture.write()
        return 0
    if arguments not in ([], ["--tighten"]):
        print(__doc__)
        return 2
    count, lists = counted(), Lists.load()
    page = picture.PAGE.read_text(encoding="utf-8")
    if page != picture.put(page, picture.picture(source())):
        print(f"the picture in {picture.PAGE.name} is not that of the packages: run `python -m tools.house --picture`")
        return 1
    if arguments:
        lists = lists.tightened(count)
        lists.save()
    for rule, sins in count.sins.items():
        print(f"{rule:<22}{sum(sins.values()) if rule == 'retired words' else len(sins):>7,}")
    print(f"{'circles of files':<22}{len(count.circles):>7,}")
    for name, number in count.lines.items():
        print(f"{'lines of ' + name:<22}{number:>7,}   aim {lists.aims[name]:,}")
    broken = lists.broken(count)
    for line in broken:
        print(line)
    if any(" gone, " in line or "is still" in line for line in broken):
        print("`python -m tools.house --tighten` takes from the lists what has gone.")
    return 1 if broken else 0


if __name__ == "__main__":
    gc.disable()  # looking for circles in the trees of all files again and again takes three quarters of the time
    sys.exit(main(sys.argv[1:]))
