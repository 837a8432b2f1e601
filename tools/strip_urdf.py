"""Strip a URDF file to what holdfast reads: links with inertials, and joints. Prints the SHA-256 of both files.

Usage: python tools/strip_urdf.py IN.urdf OUT.urdf

Kept word for word: the inertials of links; origin, parent, child, axis, limit, dynamics and mimic of joints; the comments
before ``<robot>`` (where licences stand). Dropped: everything else, such as visuals, collisions, materials, transmissions,
controllers and simulator tags. No number is rewritten.
"""

from __future__ import annotations

import hashlib
import re
import sys
from pathlib import Path
from xml.etree import ElementTree

KEEP = {
    "link": ("inertial",),
    "joint": ("origin", "parent", "child", "axis", "limit", "dynamics", "mimic"),
}
MARK = "<!-- Altered for holdfast: stripped to links with inertials and joints; see provenance.yaml. -->"


def strip(text: str) -> str:
    """The stripped file as text."""
    head = text[: text.index("<robot")]
    notices = re.findall(r"<!--.*?-->", head, flags=re.DOTALL)
    source = ElementTree.fromstring(text)
    robot = ElementTree.Element("robot", {"name": source.get("name", "robot")})
    for element in source:
        if element.tag not in KEEP:
            continue
        kept = ElementTree.SubElement(robot, element.tag, element.attrib)
        kept.extend(child for child in element if child.tag in KEEP[element.tag])
    ElementTree.indent(robot)
    return "\n".join(['<?xml version="1.0"?>', *notices, MARK, ElementTree.tostring(robot, encoding="unicode")]) + "\n"


def main(arguments: list[str]) -> int:
    """Command line: IN OUT."""
    if len(arguments) != 2:
        print(__doc__)
        return 2
    source, target = map(Path, arguments)
    target.write_text(strip(source.read_text(encoding="utf-8")), encoding="utf-8")
    for path in (source, target):
        print(hashlib.sha256(path.read_bytes()).hexdigest(), path.name)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
