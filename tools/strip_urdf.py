"""Strip a URDF or SRDF file to what holdfast reads: links, joints, disabled collisions. Prints the SHA-256 of both files.

Usage: python tools/strip_urdf.py IN.urdf OUT.urdf [--collisions]
       python tools/strip_urdf.py IN.srdf OUT.srdf

Kept word for word: the inertials of links, and with ``--collisions`` their collision shapes, for arms whose meshes are in the
package; origin, parent, child, axis, limit, dynamics and mimic of joints; the pairs of links of an SRDF file that are not
checked; the comments before ``<robot>`` (where licences stand). Dropped: everything else, such as visuals, materials,
transmissions, controllers and simulator tags. No number is rewritten.
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
    "disable_collisions": (),
}
MARK = "<!-- Altered for holdfast: stripped to {}; see provenance.yaml. -->"


def strip(text: str, collisions: bool = False) -> str:
    """The stripped file as text; ``collisions`` keeps the shapes that collide."""
    head = text[: text.index("<robot")]
    notices = re.findall(r"<!--.*?-->", head, flags=re.DOTALL)
    source = ElementTree.fromstring(text)
    robot = ElementTree.Element("robot", {"name": source.get("name", "robot")})
    keep = {**KEEP, "link": ("inertial", "collision")} if collisions else KEEP
    left = "links with inertials and collision shapes and joints" if collisions else "links with inertials and joints"
    for element in source:
        if element.tag not in keep:
            continue
        kept = ElementTree.SubElement(robot, element.tag, element.attrib)
        kept.extend(child for child in element if child.tag in keep[element.tag])
    ElementTree.indent(robot)
    mark = MARK.format("the links whose collisions are disabled" if robot.find("link") is None else left)
    return "\n".join(['<?xml version="1.0"?>', *notices, mark, ElementTree.tostring(robot, encoding="unicode")]) + "\n"


def main(arguments: list[str]) -> int:
    """Command line: IN OUT [--collisions]."""
    collisions = "--collisions" in arguments
    paths = [Path(word) for word in arguments if word != "--collisions"]
    if len(paths) != 2:
        print(__doc__)
        return 2
    source, target = paths
    target.write_text(strip(source.read_text(encoding="utf-8"), collisions), encoding="utf-8")
    for path in (source, target):
        print(hashlib.sha256(path.read_bytes()).hexdigest(), path.name)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
