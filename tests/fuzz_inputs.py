"""Mutated inputs: every kind of file that holdfast reads, damaged at random, must be read or be refused with one sentence.

``python tests/fuzz_inputs.py --cases 40000`` is the whole of it (``make soak``), a seeded part of it is in ``test_inputs.py``.
Case k depends on the seed, on k and on ``--kind`` alone: ``--only K`` runs it again, shows the file, the traceback and the
verdict; ``--first K`` runs K and those after it.

A case fails if anything but a :class:`holdfast.HoldfastError` comes out, a sentence of several lines or without end, a warning,
more than ten seconds of the processor or a minute of waiting, or a write outside the folder of the case.
"""

from __future__ import annotations

import argparse
import csv
import faulthandler
import io
import json
import os
import re
import signal
import socket
import sqlite3
import subprocess
import sys
import tempfile
import time
import traceback
import warnings
import zlib
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import yaml

import holdfast
from flips import change_digits
from holdfast.core.errors import HoldfastError
from sealing import seal

SEED = 20120831
MOST_SECONDS = 10.0  # of the processor: other programs may take theirs
MOST_WAITED = 60.0
MOST_LETTERS = 1500
REFITTED = "a mutation with digests that fit"

# What people and programs write where something else belongs.
NUMBERS = (
    *("0", "-1", "1e308", "-1e308", "1e-320", "1e400", "nan", ".nan", "inf", "-.inf", "2e", "1_0", "0x1F", "017", "190:20:30"),
    *(
        str(2**31),
        str(2**63),
        str(2**70),
        "9" * 30,
        "9" * 5000,
        "9" * 400,
        "0x" + "f" * 5000,
        ":".join(["59"] * 900),
        "1." + "3" * 400,
        "0b",
        "0x",
        "1__2",
        "-0",
        "+",
    ),
)
YAML = (
    *("2026-02-30", "2026-02-30T25:61:61Z", "12:61:99", "!!int x", "!!int ''", "!!float x", "!!bool x", "!!timestamp x"),
    *(
        "!!binary '@'",
        "!!set {a}",
        "!!omap [a]",
        "!!pairs [a]",
        "!!null x",
        "!!python/name:os.system",
        "!<>",
        "!!x",
        "!!str [a]",
    ),
    *(
        "&a",
        "*a",
        "<<: *a",
        "<<",
        "? [a]",
        "? {a: b}",
        "[",
        "]",
        "{",
        "}",
        "- ",
        ": ",
        "|",
        ">",
        "%",
        "@",
        "`",
        "\t",
        "#",
        "---",
    ),
    *("...", "true", "no", "null", "~", "&a [*a]", "!!int 0b", "!!float .", "!!seq {}", "!!map []", "? ", "!", "''"),
)
PLACES = (
    "/dev/zero",
    "/dev/stdin",
    "/proc/self/mem",
    "/etc/passwd",
    ".",
    "..",
    "../../../x",
    "a/b",
    "x" * 300,
    "y" * 5000,
    "CON",
)
SIGNS = (
    *("", "<", ">", "&", "&lt;", "&#0;", "<!--", "]]>", "<![CDATA[", '"', "'", ",", ";", '""', "=1+1", "é", "\u202e", "\x00"),
    *("\U0001f600", "\r", "\n", " " * 300, '"\\ud800"', "/*", "*/", "c" * 200_000),
)
NAMES = (
    *("joint1", "base", "world", "revolute", "fixed", "pose", "deg", "box", "panda", "planar-2r", "default", "single", "arm"),
    *("text", "rows", "file", "name"),
)
GROUPS = (NUMBERS, YAML, PLACES, SIGNS, NAMES)
THINGS = (
    *(
        None,
        True,
        False,
        0,
        1,
        -1,
        2**31,
        2**63,
        2**70,
        10**400,
        -(2**70),
        0.5,
        -0.0,
        1e308,
        1e-320,
        float("inf"),
        float("nan"),
    ),
    *(
        "",
        "x",
        "x" * 300,
        "y" * 5000,
        "/dev/zero",
        "..",
        "a\nb",
        "nan",
        "1e-3",
        "\x00",
        "é",
        "\ud800",
        [],
        {},
        [[]],
        [0],
        [1, 2, 3],
        {"x": 1},
    ),
    *({"": None}, [None], ["a", "a"], [[1e308] * 3] * 3, [0.0] * 1000, {str(k): k for k in range(100)}),
)
TOKEN = re.compile(rb"[+-]?\d+\.?\d*(?:[eE][+-]?\d+)?|[A-Za-z_][\w.-]*|[^\s\w]|\s+")


# ---- mutations ---------------------------------------------------------------------------------------------------


def word(rng: np.random.Generator) -> str:
    """Something that people or programs write."""
    group = GROUPS[rng.integers(len(GROUPS))]
    return group[rng.integers(len(group))]


def of_bytes(data: bytes, rng: np.random.Generator) -> bytes:
    """A few bytes flipped, cut, doubled or put in."""
    out = bytearray(data)
    for _ in range(int(rng.integers(1, 4))):
        at, length = int(rng.integers(len(out) + 1)), int(rng.integers(1, 40))
        match int(rng.integers(6)):
            case 0 if at < len(out):
                out[at] ^= 1 << int(rng.integers(8))
            case 1:
                del out[at : at + length]
            case 2:
                out[at:at] = out[at : at + length] * int(rng.integers(1, 50))
            case 3:
                out[at:at] = rng.bytes(length)
            case 4:
                del out[at:]
            case _:
                out[at:at] = (b"\x00", b"\xff\xfe", b"\xef\xbb\xbf", b"\r", b"\n", b"[" * 400, b"\n" + b" " * 300)[
                    rng.integers(7)
                ]
    return bytes(out)


def of_tokens(data: bytes, rng: np.random.Generator) -> bytes:
    """A few numbers, words or signs replaced, left out, doubled or swapped."""
    tokens = TOKEN.findall(data)
    for _ in range(int(rng.integers(1, 4))):
        if not tokens:
            break
        a, b = (int(x) for x in rng.integers(len(tokens), size=2))
        match int(rng.integers(6)):
            case 0:
                del tokens[a]
            case 1:
                tokens.insert(a, tokens[b])
            case 2:
                tokens[a], tokens[b] = tokens[b], tokens[a]
            case _:
                tokens[a] = word(rng).encode()
    return b"".join(tokens)


def _places(data: object, trail: tuple[object, ...] = ()) -> list[tuple[object, ...]]:
    found = [trail] if trail else []
    entries = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in entries:
        found += _places(value, (*trail, key))
    return found


def of_entries(data: object, rng: np.random.Generator) -> object:
    """Entries of nested lists and dictionaries replaced, left out, doubled, renamed or nested."""
    for _ in range(int(rng.integers(1, 4))):
        places = _places(data)
        if not places:
            break
        *trail, key = places[rng.integers(len(places))]
        block = data
        for step in trail:
            block = block[step]  # type: ignore[index]
        assert isinstance(block, (dict, list))
        thing = THINGS[rng.integers(len(THINGS))]
        match int(rng.integers(7)):
            case 0:
                del block[key]  # type: ignore[arg-type]
            case 1 if isinstance(block, list):
                block += [block[key]] * int(rng.integers(1, 20))  # type: ignore[call-overload]
            case 1:
                block[word(rng)] = block.pop(key)  # type: ignore[call-overload, index, arg-type]
            case 2:
                for _ in range(int(rng.choice([1, 3, 60, 400]))):
                    block[key] = [block[key]] if rng.random() < 0.5 else {"a": block[key]}  # type: ignore[call-overload, index]
            case 3:
                other = data
                for step in places[rng.integers(len(places))]:
                    other = other[step]  # type: ignore[index]
                block[key] = json.loads(json.dumps(other, default=str))  # type: ignore[call-overload, index]
            case _:
                block[key] = json.loads(json.dumps(thing))  # type: ignore[call-overload, index]
    return data


def of_yaml(data: bytes, rng: np.random.Generator) -> bytes:
    """The structure of a YAML file."""
    flow = (None, True, False)[rng.integers(3)]
    changed = of_entries(yaml.safe_load(data), rng)
    try:
        text: str = yaml.safe_dump(changed, sort_keys=False, default_flow_style=flow)
    except RecursionError:  # nested deeper than can be written by this program
        return b"[" * 1000 + data
    return text.encode("utf-8", "surrogatepass")


def of_json(data: bytes, rng: np.random.Generator) -> bytes:
    """The structure of a JSON file."""
    try:
        return json.dumps(of_entries(json.loads(data), rng)).encode()
    except RecursionError:  # nested deeper than can be written by this program
        return b"[" * 100_000 + data


def of_sealed_json(data: bytes, rng: np.random.Generator) -> bytes:
    """The structure of a JSON file with a digest, which fits the changed content."""
    changed = of_json(json.dumps({key: value for key, value in json.loads(data).items() if key != "digest"}).encode(), rng)
    try:
        found = json.loads(changed)
    except (RecursionError, ValueError):
        return changed
    return seal(found).encode() if isinstance(found, dict) and found else changed


def of_checked_lines(data: bytes, rng: np.random.Generator) -> bytes:
    """The structure of one line of a file of JSON lines, each with its checksum."""
    lines = [line.rpartition(b" ")[0] for line in data.splitlines()]
    k = int(rng.integers(len(lines)))
    lines[k] = of_json(lines[k], rng)
    return b"".join(line + b" %08x\n" % zlib.crc32(line) for line in lines)


def of_xml(data: bytes, rng: np.random.Generator) -> bytes:
    """Elements and attributes of an XML file."""
    root = ElementTree.fromstring(data)
    for _ in range(int(rng.integers(1, 4))):
        inner = [(parent, child) for parent in root.iter() for child in parent]
        if not inner:
            break
        (parent, child), (_, other) = (inner[k] for k in rng.integers(len(inner), size=2))
        match int(rng.integers(7)):
            case 0:
                parent.remove(child)
            case 1:
                for _ in range(int(rng.choice([1, 3, 200]))):
                    parent.append(child)
            case 2:
                child.tag = other.tag
            case 3:
                twin = ElementTree.fromstring(ElementTree.tostring(other))
                for _ in range(int(rng.choice([1, 30, 300]))):
                    shell = ElementTree.Element(other.tag, other.attrib)
                    shell.append(twin)
                    twin = shell
                parent.append(twin)
            case _ if child.attrib:
                key = str(rng.choice(list(child.attrib)))
                values = [e.attrib[k] for e in root.iter() for k in e.attrib]
                new = word(rng) if rng.random() < 0.5 else values[rng.integers(len(values))]
                child.attrib.pop(key) if rng.random() < 0.2 else child.attrib.update({key: new})
    return ElementTree.tostring(root)


def of_table(data: bytes, rng: np.random.Generator) -> bytes:
    """Lines and cells of a CSV file."""
    rows = list(csv.reader(io.StringIO(data.decode())))
    for _ in range(int(rng.integers(1, 4))):
        k = int(rng.integers(len(rows)))
        row = rows[k]
        at = int(rng.integers(len(row))) if row else 0
        match int(rng.integers(6)):
            case 0:
                del row[at : at + 1]
            case 1:
                row.insert(at, word(rng))
            case 2:
                rows.insert(int(rng.integers(len(rows) + 1)), list(row))
            case 3 if len(rows) > 1:
                del rows[k]
            case _ if row:
                row[at] = word(rng)
    out = io.StringIO()
    csv.writer(out, delimiter=",;\t"[int(rng.integers(20)) % 3 if rng.random() < 0.1 else 0]).writerows(rows)
    return out.getvalue().encode("utf-8", "surrogatepass")


def of_numbers(data: bytes, rng: np.random.Generator) -> bytes:
    """One number of a JSON file replaced by null, NaN, a negative or huge one, or another digit; or one list shortened."""
    found = json.loads(data)
    places = [place for place in _places(found) if isinstance(_entry(found, place), (int, float, list))]
    *trail, key = places[rng.integers(len(places))]
    block, value = _entry(found, tuple(trail)), _entry(found, (*trail, key))
    others = (None, float("nan"), float("inf"), -1, 0, -1e308, 1e308, True, "1")
    changed = value[:-1] if isinstance(value, list) else others[rng.integers(len(others))]
    block[key] = changed  # type: ignore[index]
    return seal({key: value for key, value in found.items() if key != "digest"}).encode()


def _entry(data: object, trail: tuple[object, ...]) -> object:
    for step in trail:
        data = data[step]  # type: ignore[index]
    return data


def of_digits(data: bytes, rng: np.random.Generator) -> bytes:
    """One decimal digit changed into another one."""
    out = bytearray(data)
    for place, value in change_digits(data, 1, rng):
        out[place] = value
    return bytes(out)


def of_certificate(data: bytes, rng: np.random.Generator) -> bytes:
    """The structure of a certificate, in half of the cases with digests and a sentence that fit."""
    from holdfast.certificates import verifier

    changed = of_json(data, rng)
    if rng.random() < 0.5:
        return changed
    with suppress(Exception):  # a document that has no digests or no sentence
        document = json.loads(changed)
        document["made_by"] = REFITTED
        document["arm_digest"] = verifier.compute_digest(document["arm"])
        document["claim"] = verifier.claim_sentence(document)
        document["digest"] = verifier.compute_digest(document)
        return json.dumps(document).encode()
    return changed


def of_records(data: bytes, rng: np.random.Generator) -> bytes:
    """Some cells of the tables of an SQLite file replaced, or rows deleted."""
    with closing(sqlite3.connect(":memory:", isolation_level=None)) as db:
        db.deserialize(data[:18] + b"\x01\x01" + data[20:])  # a file with a write-ahead log is not opened from memory
        for _ in range(int(rng.integers(1, 4))):
            tables = [row[0] for row in db.execute("SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name")]
            table = tables[rng.integers(len(tables))]
            columns = [row[1] for row in db.execute(f"PRAGMA table_info({table})")]
            column, key, all_rows = columns[rng.integers(len(columns))], columns[0], rng.random() < 0.2
            value = THINGS[rng.integers(len(THINGS))]
            value = value if isinstance(value, (int, float, str)) and abs(hash(value)) < 2**61 else rng.bytes(8)
            with suppress(sqlite3.Error, OverflowError, UnicodeEncodeError):
                keys = [row[0] for row in db.execute(f"SELECT {key} FROM {table} ORDER BY {key}")]
                one = keys[rng.integers(len(keys))] if keys and not all_rows else None
                where = "" if one is None else f" WHERE {key} = ?2"
                if rng.random() < 0.2:
                    db.execute(f"DELETE FROM {table}{where.replace('?2', '?1')}", () if one is None else (one,))
                else:
                    db.execute(f"UPDATE {table} SET {column} = ?1{where}", (value,) if one is None else (value, one))
        out = db.serialize()
    return out[:18] + data[18:20] + out[20:]


def of_archive(data: bytes, rng: np.random.Generator) -> bytes:
    """A file cut off, emptied, or with damaged bytes, as archives and Parquet files get damaged."""
    if rng.random() < 0.2:
        return data[: int(rng.choice([0, 1, len(data) // 2, len(data) - 1]))]
    return of_bytes(data, rng)


# ---- what is read ------------------------------------------------------------------------------------------------


@dataclass
class Kind:
    """A kind of file: sound ones, how its structure is mutated, and who reads it."""

    seeds: list[bytes]
    structure: Callable[[bytes, np.random.Generator], bytes]
    read: Callable[[Path], object]
    file: Path


DH = b"""name: my arm
convention: standard
angles: deg
rows:
  - {a: 0, alpha: -90, d: 0.3, lower: -170, upper: 170, name: shoulder, velocity: 90, effort: 120}
  - {a: 0.5, alpha: 0, theta: 90, friction: 0.1, armature: 0.02}
  - {a: 0, alpha: 0, type: prismatic, lower: 0, upper: 0.4}
base: {xyz: [0, 0, 0.8], urdf_rpy: [0, 0, 180]}
tool: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.1], [0, 0, 0, 1]]
gravity: [0, 0, -9.81]
links:
  - {name: upper arm, mass: 4, com: [0, 0.1, 0], inertia: [0.02, 0.01, 0.02, 0, 0, 0]}
  - {mass: 2, com: [-0.25, 0, 0], inertia: [[0.01, 0, 0], [0, 0.05, 0], [0, 0, 0.05]]}
  - null
payload: {mass: 1, com: [0, 0, 0.1], inertia: [0.001, 0.001, 0.001, 0, 0, 0]}
"""
REGIONS = [
    b"name: door\nangles: deg\nbox: {center: [0.9, 0, 0.04], size: 0.5, rpy_center: [0, 174, 0], rpy_size: [1, 2, 3],\n"
    b"  density: {z: [[0.0, 1], [0.5, 3]]}}\n",
    b"joints: {lower: [-1, 0], upper: [1, 0.5]}\n",
    b"poses: poses.csv\n",
]
PATHS = [
    b"name: along\nangles: deg\nline:\n  from: {xyz: [0.4, -0.3, 0.5], urdf_rpy: [180, 0, 0]}\n"
    b"  to: {xyz: [0.4, 0.3, 0.5], quaternion: [1, 0, 0, 0]}\n"
    b"timing: {duration: 10, accelerate: 0.2, decelerate: 0.2, stop: false}\n",
    b"arc: {from: {xyz: [1, 0, 0]}, center: [0, 0, 0], axis: [0, 0, 1], angle: 1.5, turning: false}\n",
    b"poses: [{xyz: [0, 0, 1]}, {xyz: [0.5, 0, 1]}, {xyz: [0.5, 0.5, 1]}]\ntiming: {duration: 3}\n",
    b"poses: poses.csv\n",
]
CAPSULES = [
    b"radius: 0.05\nlinks:\n  base: [{from: [0, 0, 0], to: [0, 0, 0.1]}]\n  shoulder: [{from: [0, 0, 0], radius: 0.1}]\n"
    b"ignore: [[base, joint2]]\n"
]
CELLS = [
    b"name: bench\nmargin: 0.01\nobjects:\n  table: {box: [0.8, 1.2, 0.04], pose: {xyz: [0.5, 0, -0.02]}}\n"
    b"  post: {cylinder: {radius: 0.05, length: 1.0}, pose: {xyz: [0.2, 0.55, 0.5], rpy: [0, 0.1, 0]}}\n"
    b"  pipe: {capsule: {radius: 0.04, length: 0.6}, pose: {quaternion: [0, 0.6, 0, 0.8]}}\n"
    b"  ball: {sphere: 0.12, margin: 0.03}\n  ground: {half_space: [0, 0, 1]}\n"
    b"held: [{capsule: {radius: 0.02, length: 0.15}, pose: {xyz: [0, 0, 0.08]}}]\n"
    b"may_touch: [[table, base], [ball, joint2]]\narm: {shape: meshes, spheres_to: 0.01, hold: {finger: 0.04}}\n",
    b"objects:\n  jig: {mesh: jig.stl, scale: 0.001, solid: exact}\n  block: {mesh: block.ply, solid: hull}\n"
    b"  scan: {points: scan.npy, radius: 0.005, pose: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.1], [0, 0, 0, 1]]}\n"
    b"  few: {points: [[0, 0, 1], [0, 1, 1]], radius: 0.1}\n"
    b"  wedge: {mesh: {vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],"
    b" faces: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]}}\n",
]
FAULTS = b"""seed: 7
faults:
  - {kind: locked, onset: {uniform: [0.3, 1.5]}, probability: 0.5}
  - {kind: weak, joints: [joint2], gain: {uniform: [0.2, 0.7]}, onset: {exponential: 4.0}}
  - {kind: friction, joints: [joint1], coulomb: 3.0, rate_per_hour: 0.5}
"""
FAILURE = b"locked: {joint2: 0.2}\nrange: {joint3: [0, 0.2]}\nspeed: {shoulder: 0.5}\n"
RATES = b"rates: {joint1: 1.0e-5, joint2: 2.0e-5, joint3: 1.0e-5}\n"
RECORD = sorted((Path(holdfast.__file__).parent / "studies" / "designs" / "record_book" / "data").rglob("*.yaml"))[0]
STUDIES = [
    b"name: two arms\nseed: 1\nposes: 200\nchunk: 50\narms: [planar-3r, {file: arm.yaml}]\n"
    b"assess: {indices: [relative-manipulability, manipulability], tasks: ['base:vx,vy'], regions: [default, region.yaml],"
    b" optimise: true, keep: rows, thresholds: {manipulability: 0.1}}\n",
    b"poses: 20\nchunk: 5\narms: [planar-3r]\n"
    b"convergence: {laws: [pseudoinverse, 'failure-tolerant:0.3'], motions: 20, chunk: 10, time_limit: 100}\n",
    b"poses: 20\nchunk: 5\narms: [{arm: planar-3r, vary: {a3: [0.2, 1.2], alpha2: -90..90deg}, designs: 64}]\nassess: {}\n",
    b"poses: 20\nchunk: 5\narms: [planar-3r]\nworkspace: {laws: [pseudoinverse], targets: [[1, 1]], starts: 4}\n"
    b"bank: {laws: ['damped:0.05'], sets: 3, distance: 0.5}\n",
]
URDF = b"""<?xml version="1.0"?>
<robot name="toy">
  <link name="base"/>
  <link name="upper"><inertial><origin xyz="0 0 0.1" rpy="0 0 0.1"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="lower"/><link name="tip"/><link name="finger"/>
  <joint name="j1" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.3" rpy="0 1.5707963 0"/>
    <axis xyz="0 0 1"/><limit lower="-2" upper="2" velocity="1" effort="10"/><dynamics damping="0.1"/></joint>
  <joint name="j2" type="prismatic"><parent link="upper"/><child link="lower"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.5" velocity="1" effort="10"/></joint>
  <joint name="j3" type="continuous"><parent link="lower"/><child link="tip"/><origin xyz="0.2 0 0"/><axis xyz="0 1 0"/></joint>
  <joint name="j4" type="prismatic"><parent link="upper"/><child link="finger"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.04" velocity="1" effort="10"/><mimic joint="j5" multiplier="2" offset="0.01"/></joint>
  <link name="finger2"/>
  <joint name="j5" type="prismatic"><parent link="upper"/><child link="finger2"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.04" velocity="1" effort="10"/></joint>
</robot>
"""
MJCF = b"""<mujoco model="toy">
  <compiler angle="degree" autolimits="true"/>
  <option gravity="0 0 -9.81" timestep="0.002"/>
  <size memory="1M"/>
  <default><joint armature="0.01" damping="0.1"/><geom type="capsule" size="0.05"/></default>
  <asset><hfield name="h" nrow="3" ncol="4" size="1 1 0.1 0.1"/><texture name="t" type="2d" builtin="checker" width="8"
    height="8" rgb1="0 0 0" rgb2="1 1 1"/><material name="m" texture="t"/></asset>
  <worldbody>
    <geom type="hfield" hfield="h"/>
    <replicate count="2" offset="1 0 0"><geom type="sphere" size="0.1" pos="0 3 0" material="m"/></replicate>
    <body name="one" pos="0 0 0.3" euler="0 90 0">
      <joint name="a" type="hinge" axis="0 0 1" range="-120 120" actuatorfrcrange="-5 5"/>
      <geom fromto="0 0 0 0.3 0 0"/>
      <body name="two" pos="0.3 0 0"><joint name="b" type="slide" axis="1 0 0" range="0 0.4" ref="0.1"/>
        <geom fromto="0 0 0 0.2 0 0"/>
        <body name="three" pos="0.2 0 0" quat="1 0 0 0"><joint name="c" axis="0 1 0"/>
          <inertial pos="0 0 0" mass="1" diaginertia="0.1 0.1 0.1"/><site name="tool" pos="0 0 0.1"/></body></body></body>
  </worldbody>
  <equality><joint joint1="c" polycoef="0 1 0 0 0" active="false"/></equality>
  <actuator><motor joint="b" gear="2" ctrlrange="-1 1" ctrllimited="true"/></actuator>
</mujoco>
"""
SCENE = b"""<robot name="bench">
  <link name="table"><collision><origin xyz="0.5 0 0" rpy="0 0 1"/><geometry><box size="1 2 0.1"/></geometry></collision></link>
  <link name="jig"><collision><geometry><mesh filename="jig.stl" scale="0.001 0.001 0.001"/></geometry></collision></link>
  <link name="foot"/><link name="post"><collision><geometry><cylinder radius="0.1" length="1"/></geometry></collision></link>
  <joint name="j" type="fixed"><parent link="table"/><child link="jig"/><origin xyz="0.4 -0.3 0.2" rpy="0 1 0"/></joint>
  <joint name="f" type="fixed"><parent link="table"/><child link="foot"/></joint>
  <joint name="m" type="revolute"><parent link="foot"/><child link="post"/><limit lower="-1" upper="1"/></joint>
</robot>
"""
POSES = b"x,y,z,qx,qy,qz,qw,weight\n0,0,1,0,0,0,1,1\n0.5,0,1,0,0,0,1,2\n0.5,0.5,1,0,0,0,1,0.5\n"
TURNED = b"x,y,z,qx,qy,qz,qw\n0,0,1,0,0,0,1\n0.5,0,1,0,0,0,1\n0.5,0.5,1,0,0,0,1\n"
PLAIN = b"x,y,z\n0,0,1\n0.5,0,1\n0.5,0.5,1\n"
MOTION = b"time_s,joint1_rad,joint2_rad,joint3_rad\n0,0.1,0.2,0.3\n0.5,0.2,0.3,0.4\n1,0.3,0.4,0.5\n"


def of_triangles(data: bytes, rng: np.random.Generator) -> bytes:
    """What is wrong with meshes: cut off, without a triangle, with numbers that none can have."""
    match int(rng.integers(4)):
        case 0:
            return data[: int(rng.integers(len(data) + 1))]
        case 1:
            return of_tokens(data, rng)
        case 2:  # numbers of binary formats: NaN, infinity, huge, another count
            out, at = bytearray(data), int(rng.integers(max(len(data) - 4, 1)))
            values = (b"\x00\x00\xc0\x7f", b"\x00\x00\x80\x7f", b"\xff\xff\x7f\x7f", b"\xff\xff\xff\xff", b"\x00\x00\x00\x00")
            out[at : at + 4] = values[rng.integers(len(values))]
            return bytes(out)
        case _:
            return of_bytes(data, rng)


def of_cloud(data: bytes, rng: np.random.Generator) -> bytes:
    """Arrays that are no clouds."""
    shape = [(0, 3), (3,), (4, 2), (2, 3, 3), (5, 3), ()][rng.integers(6)]
    values = np.full(shape, [0.0, np.nan, np.inf, 1e308, -1e9, 40.0][rng.integers(6)])
    kind = ["f8", "f4", "i8", "c16", "U3", "?", "M8[s]"][rng.integers(7)]
    out = io.BytesIO()
    with np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        np.save(out, values.astype("f8" if kind == "M8[s]" else kind).astype(kind))
    return out.getvalue() if rng.random() < 0.7 else of_triangles(data, rng)


def solids(root: Path) -> dict[str, list[bytes]]:
    """Files of a ring in millimetres in every format, written into a folder beside a block and a cloud."""
    import trimesh

    ring = trimesh.creation.torus(200, 50, major_sections=8, minor_sections=6)
    ring.export(root / "jig.stl")
    trimesh.creation.box((0.1, 0.2, 0.3)).export(root / "block.ply")
    np.save(root / "scan.npy", np.random.default_rng(1).uniform(-1, 1, (20, 3)))
    found = {kind: [ring.export(file_type=kind)] for kind in ("stl", "obj", "ply", "glb")}
    found["stl"].append(ring.export(file_type="stl_ascii"))
    found["ply"].append(ring.export(file_type="ply", encoding="ascii"))
    return {kind: [x.encode() if isinstance(x, str) else x for x in all_] for kind, all_ in found.items()}


COLUMNS = [
    b"t: stamp\nq_ref: {column: 'want_*', unit: deg}\nq: {column: [have_1, have_2, have_3], unit: deg}\ntau: 'torque_*'\n",
    b"t: {column: stamp, unit: ms}\nq_ref: {column: 'want_*'}\nq: 'have_*'\n",
]
LISTS = b"q_ref: {column: 'want[*]'}\nq: {column: 'have[*]', unit: rad}\n"


def special_files(folder: Path, endings: set[str]) -> list[Path]:
    """Everything with a name that is not a regular file that can be read, with each of the endings."""
    found = []
    folder.mkdir()
    for ending in sorted(endings):
        for name in ("pipe", "socket", "folder", "loop", "nowhere", "zero", "null", "full", "memory"):
            path = folder / f"{name}{ending}"
            match name:
                case "pipe":
                    os.mkfifo(path)
                case "socket":
                    with closing(socket.socket(socket.AF_UNIX)) as listener:
                        listener.bind(str(path))
                case "folder":
                    path.mkdir()
                case "loop":
                    path.symlink_to(path)
                case "nowhere":
                    path.symlink_to(folder / "none")
                case "memory":
                    path.symlink_to("/proc/self/mem")
                case device:
                    path.symlink_to(f"/dev/{device}")
            found.append(path)
    return found


def kinds(root: Path) -> dict[str, Kind]:
    """Everything that is read, set up in a folder."""
    import flips
    import holdfast as hf
    from holdfast import arms, teleop
    from holdfast import sweeps as study
    from holdfast.certificates import verifier
    from holdfast.core.sweeps import ThreadRunner
    from holdfast.core.sweeps.memory import MEMORY_FILE, SearchMemory
    from holdfast.interface.cli.values import read_weights
    from holdfast.interface.studio.motions import read_motion
    from holdfast.kinematics.paths.path import load_path_file as read_path
    from holdfast.kinematics.paths.path_file import read_pose_table
    from holdfast.kinematics.regions.pose_list import PoseList
    from holdfast.model.arms.serial import to_dict
    from holdfast.model.cell import Mesh, Points
    from holdfast.model.collision import Capsules
    from holdfast.response.lock_survival.rates import FailureRates
    from holdfast.response.recovery.waypoints import read_waypoints
    from holdfast.studies import read_study_file as read_study
    from holdfast.studies.assessment import load
    from holdfast.studies.designs.record_book.entries import load_record_file as read_record
    from holdfast.studies.study_files.results import read_assessment
    from holdfast.teleop.records.verification import open_undamaged_records
    from holdfast.teleop.serve import texts

    def arm_of(path: Path) -> object:
        arm = arms.load(str(path))
        return arm.fingerprint, json.dumps(to_dict(arm)), arm.forward_kinematics(np.zeros(arm.n))

    def cell_of(path: Path) -> object:
        read = hf.Cell.load(path)
        again = hf.Cell.from_dict(read.to_dict(), path.parent)
        return read.digest == again.digest, str(read), [solid.surface for solid in read if isinstance(solid, Mesh)]

    def mesh_of(path: Path) -> object:
        return [Mesh("jig", path, scale=0.001, solid=solid).surface.volume for solid in ("hull", "exact")]

    meshes = solids(root)
    (root / "arm.yaml").write_bytes(DH)
    (root / "region.yaml").write_bytes(REGIONS[0])
    (root / "poses.csv").write_bytes(PLAIN)
    (root / "weighted").mkdir()
    (root / "weighted" / "poses.csv").write_bytes(POSES)
    toy, planar = arms.load(str(root / "arm.yaml")), arms.load("planar-3r")
    run = root / "run"
    hf.assess(planar, hf.Region.around_tool(planar), poses=8, seed=1, store=run, task="planar")
    (root / "study.yaml").write_bytes(b"poses: 8\nchunk: 4\narms: [planar-3r]\nassess: {}\n")
    asked = read_study(root / "study.yaml")
    whole = study.Study.create(root / "study", asked.name, asked.seed, cells=asked.cells, source=asked.text)
    whole.run(asked.cells, ThreadRunner(1))
    plan = {"seed": 1, "vary": ["a1"]}
    (root / "before").mkdir()
    for name in ("search", "before"):
        SearchMemory(root / name, plan).recall_or_compute("one", lambda: {"x": np.arange(6.0).reshape(2, 3)})

    def study_of(_: Path) -> object:
        s = study.Study.open(root / "study")
        return s.status(), s.is_complete, s.makers, s.runs, s.source, [read_assessment(s, k) for k in range(len(s.cells))]

    def run_of(_: Path) -> object:
        found = load(run)
        return found.distribution, found.default_threshold(), found.store.missing_chunks, found.store.dataset()  # type: ignore[union-attr]

    def result_of(_: Path) -> tuple[Any, ...]:
        found = load(run)
        return found.plan.to_dict(), found.store.missing_chunks, found.default_threshold(), found.store.dataset()  # type: ignore[union-attr]

    stored, original = (run / "run.json").read_bytes(), result_of(run)

    def sealed_run_of(path: Path) -> object:
        *entries, rows = result_of(path)
        assert entries == list(original[:-1]), "accepted another plan"
        assert rows.equals(original[-1]), "accepted other rows"
        return run_of(path)

    certificate = root / "a.certificate"
    proofs = [
        hf.certify(hf.certificates.reach_claim(planar, (1.5, 0.8), 0.1, locked={"joint1": (0.2, 0.6)})),
        hf.certify(hf.certificates.out_of_reach_claim(planar, (9.5, 0.5), 0.1)),
    ]
    certificates = [proof.write(certificate).read_bytes() for proof in proofs]
    digests = {verifier.compute_digest(json.loads(data)) for data in certificates}

    def certificate_of(path: Path) -> object:
        found = hf.certificates.check_certificate(path)
        document = json.loads(path.read_bytes())
        if document.get("made_by") != REFITTED:
            assert verifier.compute_digest(document) in digests, "accepted another certificate"
        return found

    flips.experiment(root / "experiment")
    flips.experiment(root / "older")
    flips.older(root / "older")

    def records_of(path: Path) -> tuple[Any, ...]:
        for left in path.parent.glob("records.sqlite-*"):
            left.unlink()
        with open_undamaged_records(path.parent) as records, np.errstate(all="ignore"):
            return teleop.trial_table(records), teleop.cycle_table(records), records.events(), records.subjects()

    sound_records = records_of(root / "experiment" / "records.sqlite")

    def sound_records_of(path: Path) -> object:
        *tables, events, subjects = records_of(path)
        same = all(table.equals(other) for table, other in zip(tables, sound_records[:2], strict=True))
        assert same, "accepted another table"
        assert [events, subjects] == list(sound_records[2:]), "accepted other events or subjects"
        return tables

    still = np.full((200, 3), 0.01)
    torques = planar.gravity_torque(still) + 0.1 * np.sin(np.arange(200))[:, None]
    record = hf.faults.Log(t=np.arange(200) / 100, q_ref=still + 0.001 * np.sin(np.arange(200))[:, None], q=still, tau=torques)
    logs = {ending: record.save(root / f"log.{ending}").read_bytes() for ending in ("csv", "npz", "parquet")}
    bounds = root / "bounds.json"
    hf.diagnosis.calibrate(planar, [record]).to_json(bounds)

    def table(ending: str) -> Callable[[bytes, np.random.Generator], bytes]:
        return of_table if ending == "csv" else of_archive

    def bounds_of(path: Path) -> object:
        found = hf.diagnosis.load(path)
        for name in ("torque", "change", "tracking", "scales", "speed"):
            values = np.asarray(getattr(found, name), dtype=np.float64)
            assert values.shape == (len(found.joints),), f"accepted {name} of {values.shape}"
            assert (values >= 0).all(), f"accepted {name} of {values}"  # NaN is not
        return found

    def one(file: Path, structure: Callable[[bytes, np.random.Generator], bytes], read: Callable[[Path], object]) -> Kind:
        return Kind([file.read_bytes()], structure, read, file)

    import pyarrow
    from pyarrow import parquet

    names = ["stamp", *(f"{x}_{k}" for x in ("want", "have", "torque") for k in (1, 2, 3))]
    table_of_log = np.column_stack([record.t, np.rad2deg(record.q_ref), np.rad2deg(record.q), record.tau])
    np.savetxt(root / "named.csv", table_of_log, delimiter=",", header=",".join(names), comments="")
    (root / "lists.yaml").write_bytes(LISTS)
    rows = pyarrow.table({"t": record.t, "want": record.q_ref.tolist(), "have": record.q.astype("f4").tolist()})
    parquet.write_table(rows, root / "lists.parquet")

    cell = next((root / "study" / "cells").iterdir())
    found = {
        "DH table": Kind([DH], of_yaml, arm_of, root / "in.yaml"),
        "region": Kind(REGIONS, of_yaml, hf.Region.load, root / "weighted" / "in.yaml"),
        "path": Kind(PATHS, of_yaml, read_path, root / "in.yaml"),
        "capsules": Kind(CAPSULES, of_yaml, lambda path: Capsules.load(path, toy), root / "in.yaml"),
        "cell": Kind(CELLS, of_yaml, cell_of, root / "in.yaml"),
        "cell in URDF": Kind([SCENE], of_xml, hf.Cell.load, root / "in.urdf"),
        **{f"mesh in {kind}": Kind(all_, of_triangles, mesh_of, root / f"in.{kind}") for kind, all_ in meshes.items()},
        "cloud": Kind(
            [(root / "scan.npy").read_bytes()],
            of_cloud,
            lambda path: Points("scan", path, radius=0.01).centres.sum(),
            root / "in.npy",
        ),
        "fault model": Kind([FAULTS], of_yaml, hf.faults.load, root / "in.yaml"),
        "failure": Kind([FAILURE], of_yaml, lambda path: hf.Degraded.load(path, toy), root / "in.yaml"),
        "failure rates": Kind([RATES], of_yaml, lambda path: FailureRates.load(planar, path), root / "in.yaml"),
        "design record": Kind([RECORD.read_bytes()], of_yaml, read_record, root / "in.yaml"),
        **{f"log in {x}": Kind([data], table(x), hf.faults.Log.load, root / f"in.{x}") for x, data in logs.items()},
        "bounds": Kind([bounds.read_bytes()], of_numbers, bounds_of, root / "in.json"),
        "study": Kind(STUDIES, of_yaml, read_study, root / "in.yaml"),
        "protocol": Kind([teleop.read_protocol().to_yaml().encode()], of_yaml, teleop.read_protocol, root / "in.yaml"),
        "texts": Kind([texts.ENGLISH_FILE.read_bytes()], of_yaml, texts.load_texts, root / "in.yaml"),
        "URDF": Kind([URDF], of_xml, arm_of, root / "in.urdf"),
        "MJCF": Kind([MJCF], of_xml, arm_of, root / "in.mjcf"),
        "poses": Kind([POSES], of_table, PoseList.read_csv, root / "in.csv"),
        "waypoints of a path": Kind([PLAIN, TURNED], of_table, read_pose_table, root / "in.csv"),
        "waypoints": Kind([MOTION], of_table, lambda path: read_waypoints(planar, path), root / "in.csv"),
        "motion": Kind([MOTION], of_table, lambda path: read_motion(planar, path), root / "in.csv"),
        "weights": Kind([b"1,2,3\n4,5,6\n7,8,9\n"], of_table, lambda path: read_weights("--w", str(path)), root / "in.csv"),
        "columns": Kind(COLUMNS, of_yaml, lambda path: hf.faults.Log.load(root / "named.csv", columns=path), root / "in.yaml"),
        "lists in parquet": Kind(
            [(root / "lists.parquet").read_bytes()],
            of_archive,
            lambda path: hf.faults.Log.load(path, columns=root / "lists.yaml"),
            root / "in.parquet",
        ),
        "certificate": Kind(certificates, of_certificate, certificate_of, root / "in.certificate"),
        "records": one(root / "experiment" / "records.sqlite", of_records, sound_records_of),
        "records without digests": one(root / "older" / "records.sqlite", of_records, records_of),
        "digits of run.json": Kind([stored], of_digits, sealed_run_of, run / "run.json"),
        "run.json": one(run / "run.json", of_sealed_json, run_of),
        "attributes of a group": one(run / "samples.zarr" / "zarr.json", of_json, run_of),
        "attributes of an array": one(run / "samples.zarr" / "index" / "zarr.json", of_json, run_of),
        "chunk of an array": one(next((run / "samples.zarr" / "index" / "c").iterdir()), lambda x, r: of_bytes(x, r), run_of),
        "study.json": one(root / "study" / "study.json", of_sealed_json, study_of),
        "made.json": one(root / "study" / "made.json", of_sealed_json, study_of),
        "run.json of a cell": one(cell / "run.json", of_sealed_json, study_of),
        "journal of a cell": one(cell / "done.journal", lambda x, r: of_bytes(x, r), study_of),
        "lines of a search": one(root / "before" / MEMORY_FILE, of_checked_lines, lambda path: SearchMemory(path.parent, plan)),
        MEMORY_FILE: one(
            root / "search" / MEMORY_FILE, lambda x, r: of_bytes(x, r), lambda path: SearchMemory(path.parent, plan)
        ),
    }
    readers = [kind for kind in found.values() if kind.file.stem == "in"]
    places = special_files(root / "special", {kind.file.suffix for kind in readers})

    def special_of(path: Path) -> object:
        rng = np.random.default_rng(list(path.read_bytes()[:64]))
        reader = readers[rng.integers(len(readers))]
        special = [place for place in places if place.suffix == reader.file.suffix]
        file = special[rng.integers(len(special))]
        value = reader.read(file)
        raise AssertionError(f"read {file.name} as {value!r:.80}")

    return {**found, "pipe or device": Kind([b"any bytes choose one"], of_bytes, special_of, root / "in.txt")}


# ---- running -----------------------------------------------------------------------------------------------------


class TooLong(BaseException):
    """Raised by the alarm."""


@contextmanager
def alarmed() -> Iterator[None]:
    """Let the alarm raise :class:`TooLong`."""

    def alarm(*_: object) -> None:
        raise TooLong

    before = signal.signal(signal.SIGPROF, alarm)
    try:
        yield
    finally:
        signal.signal(signal.SIGPROF, before)


class Watch:
    """Files written outside a folder, as Python's audit events say."""

    def __init__(self, root: Path) -> None:
        self.root, self.found, self.on = str(root), [], False  # type: ignore[var-annotated]
        sys.addaudithook(self._hook)

    def _hook(self, event: str, given: tuple[object, ...]) -> None:
        if not self.on or not event.startswith(("open", "os.", "shutil.")):
            return
        if event == "open":
            path, _, flags = given
            written = isinstance(flags, int) and flags & (os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND)
            paths = [path] if written else []
        elif event in ("os.mkdir", "os.remove", "os.rename", "os.rmdir", "os.symlink", "os.link", "os.truncate", "os.chmod"):
            paths = [x for x in given if isinstance(x, (str, bytes, os.PathLike))]
        else:
            return
        for path in paths:
            if isinstance(path, (str, bytes, os.PathLike)):
                place = os.path.realpath(os.fsdecode(path))
                own = f"{os.sep}__pycache__{os.sep}" in place  # a module that is imported for the first time
                if not own and not place.startswith(self.root + os.sep):
                    self.found.append(f"{event} {place}")


def kind_of(k: int, some: dict[str, Kind]) -> str:
    """The kind of case k."""
    return list(some)[k % len(some)]


def mutated(k: int, seed: int, some: dict[str, Kind]) -> bytes:
    """Content of case k."""
    rng = np.random.default_rng([seed, k])
    kind = some[kind_of(k, some)]
    data = kind.seeds[rng.integers(len(kind.seeds))]
    for change in (of_bytes, of_tokens, kind.structure, kind.structure)[(k // len(some)) % 4 :][:1]:
        data = change(data, rng)
        if rng.random() < 0.1:
            data = of_bytes(data, rng)
    return data


def run(k: int, seed: int, some: dict[str, Kind], watch: Watch, show: bool = False) -> tuple[str, float]:
    """Run case k: what was wrong ('' if nothing), and seconds."""
    kind = some[kind_of(k, some)]
    kind.file.write_bytes(mutated(k, seed, some))
    problem, begin = "", time.monotonic()
    watch.found, watch.on = [], True
    signal.setitimer(signal.ITIMER_PROF, MOST_SECONDS)
    faulthandler.dump_traceback_later(MOST_WAITED, exit=True)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            value = kind.read(kind.file)
        if show:
            print(value)
    except HoldfastError as error:
        text = str(error)
        if show:
            print(text)
        if "\n" in text or not 10 < len(text) < MOST_LETTERS:
            problem = f"no sentence ({len(text)} letters): {text[:200]!r}"
    except TooLong:
        problem = f"more than {MOST_SECONDS:g} s of the processor"
    except BaseException as error:  # what a person would see as a traceback
        if show:
            traceback.print_exc()
        last = traceback.extract_tb(error.__traceback__)[-1]
        inner = [f for f in traceback.extract_tb(error.__traceback__) if "/holdfast/" in f.filename]
        ours = inner[-1] if inner else last
        where = f"{Path(ours.filename).name}:{ours.lineno}"
        problem = f"{type(error).__name__} at {where}: {' '.join(str(error).split())[:100]}"
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        faulthandler.cancel_dump_traceback_later()
        watch.on = False
    if watch.found:
        problem = f"written outside: {watch.found[0]}"
    for left in Path.cwd().iterdir():
        problem = f"left in the working folder: {left.name}"
        left.unlink()
    kind.file.write_bytes(kind.seeds[0])
    return problem, time.monotonic() - begin


@contextmanager
def place(only: str | None) -> Iterator[tuple[dict[str, Kind], Watch]]:
    """The kinds, or the ``only`` one of them, in a folder of their own, and the watch over it; the working folder is empty."""
    with alarmed(), tempfile.TemporaryDirectory(prefix="holdfast-fuzz-") as folder:
        root = Path(folder).resolve()
        for name in ("work", "cache"):
            (root / name).mkdir()
        os.environ |= {"HOLDFAST_CACHE": str(root / "cache"), "HOLDFAST_BACKEND": "casadi"}
        os.chdir(root / "work")
        some = kinds(root)
        if only is not None and only not in some:
            raise SystemExit(f"fuzz_inputs.py: there is no kind '{only}'; there are: {', '.join(some)}")
        yield {k: v for k, v in some.items() if only is None or k == only}, Watch(root)
        os.chdir("/")


def worker(first: int, stop: int, step: int, seed: int, only: str | None) -> int:
    """Run every ``step``-th case from ``first``: lines of JSON for what begins, the longest so far, what failed."""
    slowest = -1.0
    with place(only) as (some, watch):
        for k in range(first, stop, step):
            print(json.dumps({"at": k, "kind": kind_of(k, some)}), flush=True)
            problem, seconds = run(k, seed, some, watch)
            if seconds > slowest:
                slowest = seconds
                print(json.dumps({"case": k, "seconds": seconds}), flush=True)
            if problem:
                print(json.dumps({"case": k, "kind": kind_of(k, some), "problem": problem}), flush=True)
    print(json.dumps({"ended": True}), flush=True)
    return 0


@dataclass
class Found:
    """What came of it: cases by kind, the failed ones, and the longest, s, and which it was."""

    counts: Counter[str]
    failed: list[dict[str, object]]
    slowest: float
    slowest_case: int

    def causes(self) -> list[str]:
        """A line for each cause of failures, the most frequent first."""
        causes: dict[str, list[dict[str, object]]] = {}
        for f in self.failed:
            causes.setdefault(re.sub(r"\d{3,}|'[^']*'", "*", f"{f['kind']}: {f['problem']}")[:170], []).append(f)
        ordered = sorted(causes.values(), key=len, reverse=True)
        return [f"{len(c):>5} times, as --only {c[0]['case']}: {c[0]['kind']}: {c[0]['problem']}" for c in ordered]


def fuzz(cases: int, seed: int, workers: int = 1, only: str | None = None, start: int = 0) -> Found:
    """Run cases ``start`` to ``cases``, in processes of their own, as a damaged file may bring down a process."""
    found = Found(Counter(), [], 0.0, start)
    command = [sys.executable, str(Path(__file__).resolve()), "--cases", str(cases), "--seed", str(seed)]
    command += ["--kind", only] if only else []
    first = list(range(start, min(start + workers, cases)))
    while first:
        pending = []
        for f in first:
            # Not a pipe, which would fill up while another worker is read.
            out = tempfile.TemporaryFile("w+")  # noqa: SIM115
            whole = [*command, "--worker", f"{f}:{workers}"]
            pending.append((subprocess.Popen(whole, stdout=out, stderr=subprocess.STDOUT), out))
        first = []
        for process, out in pending:
            process.wait()
            out.seek(0)
            lines = out.read().splitlines()
            out.close()
            at, kind, ended = None, "?", False
            for line in lines:
                data = json.loads(line) if line.startswith("{") else {}
                ended = "ended" in data
                if "at" in data:
                    at, kind = data["at"], data["kind"]
                    found.counts[kind] += 1
                elif "problem" in data:
                    found.failed.append(data)
                elif data.get("seconds", 0.0) > found.slowest:
                    found.slowest, found.slowest_case = data["seconds"], data["case"]
            if not ended:
                died = f"the process died ({process.returncode}): {' '.join(lines[-8:])[-300:]}"
                found.failed.append({"case": at, "kind": kind, "problem": died})
                if at is not None and at + workers < cases:
                    first.append(at + workers)
    return found


def main() -> int:
    """The command line; 1 if a case failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=40_000, help="up to this number")
    parser.add_argument("--first", type=int, default=0, help="from this number on")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--kind", default=None, help="of this kind only")
    parser.add_argument("--only", type=int, default=None, help="this case alone, and all about it")
    parser.add_argument("--worker", default=None, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.worker:
        first, step = map(int, given.worker.split(":"))
        return worker(first, given.cases, step, given.seed, given.kind)
    if given.only is not None:
        with place(given.kind) as (some, watch):
            sys.stdout.buffer.write(f"{kind_of(given.only, some)}:\n".encode() + mutated(given.only, given.seed, some) + b"\n")
            sys.stdout.flush()
            problem, seconds = run(given.only, given.seed, some, watch, show=True)
        print(f"{seconds:.1f} s; {'failed: ' + problem if problem else 'as it should be'}")
        return int(bool(problem))
    begin = time.monotonic()
    found = fuzz(given.cases, given.seed, given.workers, given.kind, given.first)
    for name, count in sorted(found.counts.items()):
        print(f"  {name:<25} {count:>6}")
    print(*(f"  {line}" for line in found.causes()), sep="\n", end="\n" if found.failed else "")
    print(f"{found.counts.total()} mutated inputs, {len(found.failed)} failed, ", end="")
    print(f"slowest {found.slowest:.1f} s (case {found.slowest_case}), {time.monotonic() - begin:.0f} s in all")
    return int(bool(found.failed))


if __name__ == "__main__":
    sys.exit(main())
