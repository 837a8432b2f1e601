"""Files of certificates: of the right form, with digests that fit and the claim that their keys make."""

from __future__ import annotations

import json
import math
import re
import zipfile
from pathlib import Path
from typing import Any

from .bounds import SIX
from .forms import FOR_PEOPLE, TASKS, Refused, digest, need, real
from .paths import SEGMENT
from .paths import UNIT as PATH_UNIT
from .targets import UNIT
from .tree import SPLIT
from .words import sentence

NUMBER, TEXT, HASH = r"-?0x[01]\.[0-9a-f]{1,13}p[+-]\d{1,4}", "[^\0]*", "[0-9a-f]{64}"
WHOLE, RATIONAL, SHARE = r"-?\d{1,40}", r"-?\d{1,60}/[1-9]\d{0,60}", r"\d{1,60}/[1-9]\d{0,60}"
LIMITS, FRAME = [f"{NUMBER}|-?inf", 2], {"rotation": [NUMBER, 9], "origin": [NUMBER, 3]}
ARM = {"joints": [{"name": TEXT, "type": "revolute|prismatic", "limits": LIMITS, **FRAME}, ...], "tool": FRAME}
VOLUMES = dict.fromkeys(("proved", "refuted", "undecided"), r"\d{1,100}/2\^\d{1,3}")
KINDS = "reach|bundle|refutation|ceiling|floor|structural-zero|path"
COMMON: dict[str, Any] = {"format": "holdfast-certificate", "version": range(1, 2), "kind": KINDS, "arm": ARM}
COMMON |= {"arm_digest": HASH, "source": ..., "claim": TEXT, "task": TEXT, "volumes": VOLUMES, "digest": HASH, **FOR_PEOPLE}
MOST_BYTES, MOST_JOINTS, MOST_TURNING, MOST_SEGMENTS = 256 << 20, 64, 32, 1 << 14


def load(path: Path | zipfile.Path) -> dict[str, Any]:
    """A certificate of the right form, whose digests fit and whose claim is what its keys say; raises :class:`Refused`.

    Of an archive (``.zip``), in which the parts of a bundle lie beside it, that is its first file.
    """

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        need(len(dict(pairs)) == len(pairs), f"a key is given twice in an object of {path.name}")
        return dict(pairs)

    try:
        need(path.is_file() or not path.exists(), f"{path.name} is a folder, device, or pipe; it must be a regular file")
        path = first_file(path)
        with path.open("rb") as file:
            content = file.read(MOST_BYTES + 1)
        need(len(content) <= MOST_BYTES, f"{path.name} is larger than {MOST_BYTES >> 20} MB")
        document = json.loads(content.decode(), object_pairs_hook=once, parse_constant=lambda x: need(0, f"it contains {x}"))
        _check(document if isinstance(document, dict) else {})
    except Refused:
        raise
    except OSError as error:
        raise Refused(f"cannot read {path.name}: {error.strerror or error}") from None
    except Exception as error:  # of JSON, of numbers, and of the decompressors of an archive, each of which has its own
        raise Refused(f"{path.name} cannot be read as JSON and its numbers: {str(error)[:80]}") from None
    return dict(document)


def first_file(path: Path | zipfile.Path) -> Path | zipfile.Path:
    """The first file of an archive; of another, itself."""
    if not isinstance(path, Path) or path.suffix != ".zip":
        return path
    archive = zipfile.ZipFile(path)
    return zipfile.Path(archive, archive.namelist()[0])


def fit(value: Any, form: Any, what: str) -> None:
    """A form: an object of these keys, a list [form, length], text of a pattern, a range of integers, null; ... is anything."""
    if isinstance(form, dict):
        odd = sorted(form.keys() ^ value.keys() if isinstance(value, dict) else form)[:1]
        need(not odd, f"{what} must be an object with the keys {', '.join(form)}: see {''.join(odd)[:40]!r}")
        for key, inner in form.items():
            fit(value[key], inner, f"{key} of {what}")
    elif isinstance(form, list):
        need(isinstance(value, list) and form[1] in (len(value), ...), f"{what} must be a list of {form[1]}")
        for one in value:
            fit(one, form[0], what)
    elif isinstance(form, str):
        need(isinstance(value, str) and re.fullmatch(form, value), f"{what} is {str(value)[:40]!r}; it must be like {form}")
    elif isinstance(form, range):
        need(type(value) is int and value in form, f"{what} must be a whole number from {form[0]} to {form[-1]}")
    else:
        need(form is ... or value is None, f"{what} must be null here")


def within(pairs: list[Any], outer: list[Any], what: str) -> None:
    """Refuse pairs that are upside down or go beyond others."""
    for (low, high), (least, most) in ([map(real, pair) for pair in both] for both in zip(pairs, outer, strict=True)):
        good = least <= low <= high <= most and low < math.inf and high > -math.inf
        need(good, f"{what}: {low!r} to {high!r} is upside down or goes beyond {least!r} to {most!r}")


def _check(document: dict[str, Any]) -> None:
    for key in ("format", "version", "kind", "arm", "task"):  # what the form of the rest depends on
        fit(document.get(key), COMMON[key], key)
    names = [joint["name"] for joint in document["arm"]["joints"]]
    good = 0 < len(names) <= MOST_JOINTS and len(set(names)) == len(names)
    need(good, f"there must be 1 to {MOST_JOINTS} joints of different names")
    need(all(x.isprintable() and x and len(x) <= 200 for x in names), "joints must have names of 1 to 200 letters to print")
    fit(document, COMMON | _form(document, len(names)), "the certificate")
    _check_values(document)
    for key, value in (("arm_digest", digest(document["arm"])), ("claim", sentence(document)), ("digest", digest(document))):
        need(document[key] == value, f"{key} is not what the rest of the file gives: the file was changed or damaged")


def _form(document: dict[str, Any], n: int) -> dict[str, Any]:
    """What keys an object of its kind has, beside those of all, and what these are."""
    kind, task, target, locks = str(document["kind"]), str(document["task"]), document.get("target"), document.get("locks")
    form: dict[str, Any]
    turning = all(joint["type"] == "revolute" for joint in document["arm"]["joints"])
    need(turning or kind not in ("structural-zero", "ceiling", "floor"), f"a {kind} is of joints that turn")
    if kind in ("ceiling", "floor"):
        need(task in SIX, f"ceilings and floors are of {' and '.join(SIX)}")
        form = {"joint_box": [[NUMBER, 2], n], "threshold": NUMBER, "found": [NUMBER, n]}
        return form | {"locks": [range(n), ...], "tree": TEXT}
    if kind == "structural-zero":
        need(task == "pose" and n > 2, "structural zeros are of the pose, and of 3 joints or more")
        frame = {"rotation": [WHOLE, 4], "origin": [RATIONAL, 3]}
        return {"locked": range(1, n - 1), "snapped": [frame, n], "points": [RATIONAL, n]}
    need(task in TASKS, f"the task must be one of: {', '.join(TASKS)}")
    if kind == "path":
        count, points = (len(x) if isinstance(x, list) else 0 for x in (document.get("knots"), document.get("points")))
        good = n <= MOST_TURNING and 2 <= count <= MOST_SEGMENTS + 1
        need(good, f"a path has from 1 to {MOST_SEGMENTS} segments, and {MOST_TURNING} joints at most")
        instant, follow = range((count - 1) * SEGMENT + 1), [range(n), n - 1 - TASKS[task][0] - TASKS[task][1]]
        never = [dict.fromkeys(("begin", "stop", "at"), instant) | {"tree": TEXT}, ...]
        lock = {"joint": range(n), "followers": follow, "refutations": never}
        lock |= {"cells": TEXT, "centres": TEXT, "proved": SHARE, "refuted": SHARE}
        form = {"knots": [[NUMBER, n], ...], "tube": [NUMBER, 2], "limits": [LIMITS, n], "during": [instant, 2]}
        form |= {"pairs": [[range(points), 2], ...], "points": [{"link": range(n + 1), "place": [NUMBER, 3]}, ...]}
        return form | {"unit": re.escape(PATH_UNIT.hex()), "locks": [lock, ...], "volumes": dict.fromkeys(VOLUMES, SHARE)}
    axes = str(target.get("axes")) if isinstance(target, dict) else ""
    turned: Any = [NUMBER, 9] if axes == "xyz" and task in ("pose", "pointing") else None
    box = {"axes": TASKS[task][2], "box": [[NUMBER, 2], len(axes)], "orientation": turned}
    form = {"target": box, "limits": [LIMITS, n]}
    if kind == "bundle":
        part = {"file": r"\w[\w.-]*", "digest": HASH, "locked": range(-1, n)}
        parts = [part, len(locks) + 1 if isinstance(locks, list) else 0]
        return form | {"working_ranges": [LIMITS, n], "locks": [range(n), ...], "parts": parts}
    form |= {"locked": range(-1, n), "angle": None if document.get("locked") == -1 else [NUMBER, 2], "tree": TEXT}
    if kind == "reach":
        return form | {"centres": TEXT, "unit": re.escape(UNIT.hex()), "refutations": [..., 0]}
    lemma = {"link": range(n), "point": [NUMBER, 3], "least": NUMBER, "most": NUMBER, "tree": TEXT}
    return form | {"lemmas": [lemma, ...], "witness": [NUMBER, n] if document.get("witness") else None}


def _check_values(document: dict[str, Any]) -> None:
    kind, arm, locks = document["kind"], [joint["limits"] for joint in document["arm"]["joints"]], document.get("locks", [0])
    limits = document.get("limits", arm)
    for key, outer in (("limits", arm), ("joint_box", arm), ("working_ranges", limits)):
        within(document.get(key, []), outer[: len(document.get(key, []))], key)
    locked = [lock["joint"] for lock in locks] if kind == "path" else locks
    need(locked and locked == sorted(set(locked)), "locks must be in order, each once")
    if document.get("angle"):
        within([document["angle"]], [limits[document["locked"]]], "angle")
    box = document["target"]["box"] if "target" in document else []
    within(box, [["-inf", "inf"]] * len(box), "box of the target")
    need(1e-6 <= real(document.get("threshold", "0x1p-1")) < 1, "threshold must be from 1e-6 to 1")
    need(all(any(int(x) for x in frame["rotation"]) for frame in document.get("snapped", [])), "a quaternion is 0")
    if kind == "path":
        tube, (first, last) = [real(x) for x in document["tube"]], document["during"]
        for knot in document["knots"]:
            within([[x, x] for x in knot], limits, "a knot")
            need(all(abs(real(x)) < 7 for x in knot), "a joint of a knot is beyond 7 rad or m")
        need(all(0 <= x <= 0.1 for x in tube), "a tube is from 0 to 0.1 m and rad")
        need(document["task"] != "pointing" or not any(tube), "there is no tube around a pointing path")
        need(len(document["pairs"]) <= SPLIT, f"there are more than {SPLIT} pairs of points")
        need(first < last, "during must not be empty")
        still = [{lock["joint"], *lock["followers"]} for lock in locks]
        good = all(len(x) == 1 + len(lock["followers"]) for x, lock in zip(still, locks, strict=True))
        need(good, "a joint that is locked, or follows already, does not follow")
