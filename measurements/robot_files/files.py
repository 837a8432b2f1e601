"""Find the robot files below a folder: URDF, xacro files (expanded), and MJCF."""

from __future__ import annotations

import contextlib
import hashlib
import io
import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, Literal
from xml.etree import ElementTree

MIN_JOINTS = 3  # moving joints of a file that is a robot and not a prop
MOVING_JOINTS = {
    "urdf": ("revolute", "continuous", "prismatic", "floating", "planar"),
    "mjcf": ("hinge", "slide", "ball"),
}
MAX_BYTES = 20 << 20  # of a file that is looked at

# Makers by words in the path or in the name of the robot; the first match counts.
MAKERS = {
    "ABB": r"(\b|_)abb|irb_?\d|yumi",
    "Agility Robotics": r"cassie|digit_",
    "AgileX": r"piper",
    "Aldebaran": r"(\b|_)nao|pepper_|romeo",
    "Allegro (Wonik)": r"allegro",
    "ANYbotics": r"anymal",
    "Annin Robotics": r"ar4|mk[123]\.",
    "Apptronik": r"apollo",
    "ARX": r"\barx|/r5|/x5",
    "Aubo": r"aubo",
    "Barrett": r"barrett?|\bwam|bhand",
    "Berkeley Humanoid": r"berkeley",
    "Booster": r"booster|\bt1\b",
    "Boston Dynamics": r"spot|atlas",
    "Bitcraze": r"crazyflie|cf2",
    "Clearpath": r"jackal|husky|ridgeback|clearpath",
    "Comau": r"comau|racer|nj\d",
    "Commonplace Robotics (igus)": r"irc_ros|igus|rebel",
    "Denso": r"denso|cobotta|vs060",
    "Dexmate": r"dexmate|vega",
    "Dobot": r"dobot|\bnova\d|\bcr\d+_robot",
    "Doosan": r"doosan|dsr_|/[aehm]\d{4}",
    "Elephant Robotics": r"mycobot|mypalletizer|mecharm|myarm|ultraarm|elephant|myagv|mybuddy",
    "Elite": r"elite|/ec6",
    "Enactic (OpenArm)": r"openarm",
    "Fanuc": r"fanuc",
    "Fetch": r"fetch|freight",
    "Flexiv": r"flexiv|rizon",
    "Fourier": r"fourier|gr[123]|\bn1\b",
    "Franka": r"franka|panda|fr3|fer\b|fp3",
    "Galaxea": r"galaxea",
    "GELLO": r"gello",
    "Google": r"barkour|google_robot",
    "Halodi (1X)": r"halodi|eve_?r3",
    "HEBI": r"hebi",
    "Hello Robot": r"stretch|hello",
    "Hiwonder": r"hiwonder|tonypi",
    "Honda": r"honda|asimo",
    "i2rt": r"i2rt|yam\b|yam_|yam/",
    "IIT": r"iit|icub|hyq|centauro|ergocub|walkman|coman",
    "INRIA and LAAS": r"solo|bolt|talos_arm_lab|example-robot-data/robots/finger",
    "Interbotix (Trossen)": r"interbotix|trossen|aloha|vx300|wx250|wx200|px100|px150|rx150|rx200|pxpincher|widowx|wxai",
    "JAKA": r"jaka",
    "Kawasaki": r"kawasaki|khi_|rs0\d\d",
    "Kinova": r"kinova|jaco|gen3|kortex|j2[ns]\d|mico|m1n",
    "KUKA": r"kuka|iiwa|lbr|kr\d+|youbot",
    "LEAP Hand": r"leap",
    "Lynxmotion": r"al5d",
    "Mecademic": r"mecademic|meca500",
    "MIT": r"mini_?cheetah|\bmit_",
    "NASA": r"m2020|r2_description|robonaut|valkyrie|val_|perseverance",
    "Neuromeka": r"neuromeka|indy",
    "Niryo": r"niryo|\bned2?\b|ned_ros",
    "Osaka University": r"osaka",
    "PAL Robotics": r"tiago|talos|reemc|\bpal_|pmb",
    "Pollen Robotics": r"reachy",
    "PSYONIC": r"psyonic|ability_hand",
    "Quanser": r"quanser|qarm",
    "Rainbow Robotics": r"rainbow|rbpodo|\brb\d|\brby",
    "RealMan": r"realman|\brm_|\brm\d\d",
    "Rethink Robotics": r"sawyer|baxter|rethink",
    "Robotiq": r"robotiq|2f85",
    "ROBOTIS": r"robotis|open_?manipulator|turtlebot|omx|omy|\bop3\b",
    "RT Corporation": r"crane_x7|sciurus",
    "Schunk": r"schunk|lwa4|powerball",
    "Shadow": r"shadow",
    "Staubli": r"staubli|tx2|rx160|tx\d\d",
    "Techman": r"\btm\d|tmr_|techman",
    "The Robot Studio": r"so-?arm|so_?10[01]|so101|trs_",
    "Toyota": r"hsr|toyota",
    "Ufactory": r"xarm|lite6|uf850|ufactory",
    "Unimation": r"puma",
    "Unitree": r"unitree|\bgo[12]\b|\b[ahgb][12]\b|aliengo|laikago|h1_2|\bz1\b",
    "Universal Robots": r"universal|\bur\d+|ur_",
    "Willow Garage": r"pr2",
    "Wuji": r"wuji",
    "Yaskawa": r"motoman|yaskawa|\bsia\d|\bgp\d",
    "dVRK (Intuitive)": r"dvrk",
}


@dataclass(frozen=True)
class RobotFile:
    """One robot file.

    Attributes:
        label: Path below the folder.
        readable: File that is read; for a xacro file, its expansion.
        kind: Format.
        maker: Maker of the robot, as far as its path or name tells; else "other".
        licence: Licence that the nearest package or the repository states.
        problem: Message of xacro if the file could not be expanded.
    """

    label: str
    readable: Path
    kind: Literal["urdf", "mjcf"]
    maker: str
    licence: str
    problem: str = ""


def find_robot_files(folder: Path, expanded: Path) -> Iterator[RobotFile]:
    """Yield every distinct robot file below ``folder``; expansions of xacro files are written to ``expanded``.

    Files with the same links and joints, or the same MJCF text, count once.
    """
    seen: set[str] = set()
    packages = find_packages(folder)
    for directory, subfolders, names in os.walk(folder):
        subfolders[:] = sorted(name for name in subfolders if not name.startswith("."))
        for name in sorted(names):
            path = Path(directory) / name
            ending = path.suffix.lower()
            if ending not in (".urdf", ".xacro", ".xml", ".mjcf") or path.is_symlink() or path.stat().st_size > MAX_BYTES:
                continue
            text = path.read_text(encoding="utf-8", errors="replace")
            readable, problem = path, ""
            if ending == ".xacro":
                if not re.search(r"<robot[^>]*\sname=", text):
                    continue  # a part that other files include
                text, problem = expand_xacro(path, packages)
                readable = expanded / path.relative_to(folder).with_suffix("" if path.stem.endswith(".urdf") else ".urdf")
                readable.parent.mkdir(parents=True, exist_ok=True)
                readable.write_text(text)
            robot = describe_robot(text)
            if not problem and (robot is None or robot.digest in seen):
                continue
            if robot is not None:
                seen.add(robot.digest)
            label = path.relative_to(folder).as_posix()
            yield RobotFile(
                label,
                readable,
                robot.kind if robot else "urdf",
                name_maker(f"{label} {robot.name if robot else ''}"),
                find_licence(path, folder),
                problem,
            )


@dataclass(frozen=True)
class RobotText:
    """Format and name of a robot file, with a digest of what determines its mechanics."""

    kind: Literal["urdf", "mjcf"]
    name: str
    digest: str


def describe_robot(text: str) -> RobotText | None:
    """Return the format and name of a text; None if it describes no robot with at least ``MIN_JOINTS`` moving joints."""
    tag = re.search(r"<(robot|mujoco)\b[^>]*>", text)
    if tag is None:
        return None
    name = re.search(r"\s(?:name|model)=[\"']([^\"']*)", tag.group())
    kind: Literal["urdf", "mjcf"] = "urdf" if tag.group(1) == "robot" else "mjcf"
    if kind == "urdf":
        joints = re.findall(r"<joint\b[^>]*\btype=[\"'](\w+)", text)
        is_robot = sum(joint in MOVING_JOINTS[kind] for joint in joints) >= MIN_JOINTS
    else:
        has_robot_in_it = len(re.findall(r"<joint\b", text)) >= MIN_JOINTS and "<worldbody" in text
        is_robot = has_robot_in_it or ("<include" in text and "<worldbody" in text)
    return RobotText(kind, name.group(1) if name else "", digest_mechanics(text, kind)) if is_robot else None


def digest_mechanics(text: str, kind: str) -> str:
    """Return a digest of the links and joints of a URDF without its shapes, or of the text of an MJCF file."""
    if kind == "urdf":
        try:
            root = ElementTree.fromstring(text)
        except ElementTree.ParseError:
            return hashlib.sha256(text.encode()).hexdigest()
        parts = []
        for element in (*root.findall("link"), *root.findall("joint")):
            for shape in (*element.findall("visual"), *element.findall("collision")):
                element.remove(shape)
            element.tail = None
            parts.append(ElementTree.canonicalize(ElementTree.tostring(element, encoding="unicode"), strip_text=True))
        text = "\n".join(parts)
    return hashlib.sha256(text.encode()).hexdigest()


def name_maker(text: str) -> str:
    """Return the maker whose words occur in a path or name; "other" if there is none."""
    return next((maker for maker, words in MAKERS.items() if re.search(words, text, re.IGNORECASE)), "other")


def find_licence(path: Path, folder: Path) -> str:
    """Return the licence that the nearest package.xml or licence file above a file states."""
    for above in path.parents:
        if above == folder:
            break
        package = above / "package.xml"
        if package.is_file():
            licence = re.search(r"<license[^>]*>\s*([^<]+?)\s*</license>", package.read_text(errors="replace"))
            if licence:
                return licence.group(1)
        for candidate in sorted((*above.glob("LICEN[SC]E*"), *above.glob("*.dist-info/licenses/LICEN[SC]E*"))):
            if candidate.is_file():
                return name_licence(candidate.read_text(errors="replace"))
        for metadata in above.glob("*.dist-info/METADATA"):
            licence = re.search(r"^License(?:-Expression)?: (.+)$", metadata.read_text(errors="replace"), re.MULTILINE)
            if licence:
                return licence.group(1)
    return "not stated"


def name_licence(text: str) -> str:
    """Return the usual name of a licence text, or its first line."""
    beginning = " ".join(text.split())[:3000]
    for words, name in (
        ("Apache License", "Apache-2.0"),
        ("MIT License", "MIT"),
        ("Permission is hereby granted, free of charge", "MIT"),
        ("Redistribution and use in source and binary forms", "BSD"),
        ("GNU LESSER GENERAL PUBLIC", "LGPL"),
        ("GNU GENERAL PUBLIC", "GPL"),
        ("Creative Commons", "Creative Commons"),
    ):
        if words.lower() in beginning.lower():
            return name
    return beginning[:60] or "not stated"


# ---- xacro -------------------------------------------------------------------------------------------------------


def find_packages(folder: Path) -> dict[str, list[Path]]:
    """Return the folders of all ROS packages below a folder by the name of the package."""
    packages: dict[str, list[Path]] = {}
    for package in sorted(folder.rglob("package.xml")):
        name = re.search(r"<name>\s*([^<\s]+)\s*</name>", package.read_text(errors="replace"))
        if name:
            packages.setdefault(name.group(1), []).append(package.parent)
    return packages


def expand_xacro(path: Path, packages: dict[str, list[Path]]) -> tuple[str, str]:
    """Return the text of an expanded xacro file, and the message of xacro if that failed.

    ``$(find PACKAGE)`` is the package that shares the longest path with the file.
    """
    xacro, substitution_args = import_module("xacro"), import_module("xacro.substitution_args")

    def find_package(name: str) -> str:
        if name not in packages:
            raise LookupError(f"package '{name}' is not here")
        return str(max(packages[name], key=lambda place: len(os.path.commonpath([place, path]))))

    substitution_args.__dict__["_eval_find"] = find_package
    try:
        with contextlib.redirect_stderr(io.StringIO()), contextlib.redirect_stdout(io.StringIO()):
            document: Any = xacro.process_file(str(path))
            return str(document.toxml()), ""
    except Exception as error:
        return "", " ".join(f"{type(error).__name__}: {error}".split())[:300]
