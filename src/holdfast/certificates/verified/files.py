"""Files of certificates: of the right form, with digests that fit and the claim that their keys make."""

from __future__ import annotations

import json
import re
import zipfile
import zlib
from pathlib import Path
from typing import Any

from . import paths
from .bounds import SIX
from .forms import (
    COMMON,
    HASH,
    LIMITS,
    MOST_BYTES,
    NUMBER,
    RATIONAL,
    TEXT,
    UNIT,
    WHOLE,
    Refused,
    digest,
    fit,
    need,
    real,
    within,
)
from .rows import TASKS
from .words import sentence

MOST_JOINTS = 64


def load(path: Path | zipfile.Path) -> dict[str, Any]:
    """A certificate of the right form, whose digests fit and whose claim is what its keys say; raises :class:`Refused`.

    Of an archive (``.zip``), in which the parts of a bundle lie beside it, that is its first file.
    """

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        need(len(dict(pairs)) == len(pairs), f"a key is given twice in an object of {path.name}")
        return dict(pairs)

    try:
        path = first_file(path)
        size = path.stat().st_size if isinstance(path, Path) else path.root.getinfo(path.at).file_size  # never is more read
        need(size <= MOST_BYTES, f"{path.name} is larger than {MOST_BYTES >> 20} MB")
        document = json.loads(
            path.read_bytes().decode(), object_pairs_hook=once, parse_constant=lambda x: need(0, f"{x} in it")
        )
        _check(document if isinstance(document, dict) else {})
    except Refused:
        raise
    except OSError as error:
        raise Refused(f"cannot read {path.name}: {error.strerror}") from None
    except (ValueError, OverflowError, RuntimeError, LookupError, EOFError, zipfile.BadZipFile, zlib.error) as error:
        raise Refused(f"{path.name} cannot be read as JSON and its numbers: {str(error)[:80]}") from None
    return dict(document)


def first_file(path: Path | zipfile.Path) -> Path | zipfile.Path:
    """The first file of an archive; of another, itself."""
    if not isinstance(path, Path) or path.suffix != ".zip":
        return path
    archive = zipfile.ZipFile(path)
    return zipfile.Path(archive, archive.namelist()[0])


def _check(document: dict[str, Any]) -> None:
    for key in ("format", "version", "kind", "arm", "task"):  # what the form of the rest depends on
        fit(document.get(key), COMMON[key], key)
    joints, locks, target = document["arm"]["joints"], document.get("locks"), document.get("target")
    n, axes, names = len(joints), str(target.get("axes") if isinstance(target, dict) else ""), [one["name"] for one in joints]
    need(1 <= n <= MOST_JOINTS and len(set(names)) == n, f"there must be 1 to {MOST_JOINTS} joints of different names")
    need(all(x.isprintable() and x and len(x) <= 200 for x in names), "joints must have names of 1 to 200 letters to print")
    turning = all(joint["type"] == "revolute" for joint in joints)
    if document["kind"] == "path":
        paths.check(document)
    elif document["kind"] in ("ceiling", "floor"):
        need(turning and document["task"] in SIX, f"ceilings and floors are of joints that turn, and of {' and '.join(SIX)}")
        fit(document, {"joint_box": [[NUMBER, 2], n], "threshold": NUMBER, "locks": [range(n), ...], "tree": TEXT,
                        "found": [NUMBER, n], **COMMON}, "the certificate")  # fmt: skip
        within(document["joint_box"], [joint["limits"] for joint in joints], "joint_box")
        need(1e-6 <= real(document["threshold"]) < 1, "threshold must be from 1e-6 to 1")
    elif document["kind"] == "structural-zero":
        snapped = [{"rotation": [WHOLE, 4], "origin": [RATIONAL, 3]}, n]
        need(n > 2 and turning, "structural zeros are of joints that turn")
        fit(document, {"locked": range(1, n - 1), "snapped": snapped, "points": [RATIONAL, n], **COMMON}, "the certificate")
        need(document["task"] == "pose", "structural zeros are of the pose")
        need(all(any(int(x) for x in frame["rotation"]) for frame in document["snapped"]), "a quaternion is 0")
    else:
        _check_targets(document, joints, target, locks, axes)
    need(
        document["kind"] not in ("bundle", "ceiling", "floor") or (locks and locks == sorted(set(locks))),
        "locks must be in order, each once",
    )
    for key, value in (("arm_digest", digest(document["arm"])), ("claim", sentence(document)), ("digest", digest(document))):
        need(document[key] == value, f"{key} is not what the rest of the file gives: the file was changed or damaged")


def _check_targets(document: dict[str, Any], joints: list[Any], target: Any, locks: Any, axes: str) -> None:
    n, known = len(joints), f"{document['task']} {axes}"
    need(known in TASKS, f"task and axes of the target must be one of: {', '.join(TASKS)}")
    turned: Any = [NUMBER, 9] if known in ("pose xyz", "pointing xyz") else None
    form = {"target": {"axes": axes, "box": [[NUMBER, 2], len(axes)], "orientation": turned}, "limits": [LIMITS, n], **COMMON}
    if document["kind"] == "bundle":
        part = {"file": r"\w[\w.-]*", "digest": HASH, "locked": range(-1, n)}
        form |= {"working_ranges": [LIMITS, n], "locks": [range(n), ...]}
        form |= {"parts": [part, len(locks) + 1 if isinstance(locks, list) else 0]}
    else:
        form |= {"locked": range(-1, n), "angle": None if document.get("locked") == -1 else [NUMBER, 2], "tree": TEXT}
    if document["kind"] == "reach":
        form |= {"centres": TEXT, "unit": re.escape(UNIT.hex()), "refutations": [..., 0]}
    if document["kind"] == "refutation":
        lemma = {"link": range(n), "point": [NUMBER, 3], "least": NUMBER, "most": NUMBER, "tree": TEXT}
        form |= {"lemmas": [lemma, ...], "witness": [NUMBER, n] if document.get("witness") else None}
    fit(document, form, "the certificate")
    limits = document["limits"]
    within(limits, [joint["limits"] for joint in joints], "limits")
    within(document["target"]["box"], [["-inf", "inf"]] * len(axes), "box of the target")
    within(document.get("working_ranges", limits), limits, "working_ranges")
    if document.get("angle"):
        within([document["angle"]], [limits[document["locked"]]], "angle")
