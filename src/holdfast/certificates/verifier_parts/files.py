"""Certificate files, with checks of their form, their digests and their claim."""

from __future__ import annotations

import json
import math
import re
import zipfile
from pathlib import Path
from typing import Any

from .forms import (
    FOR_PEOPLE,
    HASH_PATTERN,
    LIMITS_FORM,
    NUMBER_PATTERN,
    TEXT_PATTERN,
    VOLUMES_FORM,
    CertificateRejected,
    compute_digest,
    parse_hex,
    require,
)
from .kinds import CERTIFICATE_KINDS, claim_sentence
from .tree import SPLIT_TOKEN

FRAME_FORM = {"rotation": [NUMBER_PATTERN, 9], "origin": [NUMBER_PATTERN, 3]}
JOINT_FORM = {"name": TEXT_PATTERN, "type": "revolute|prismatic", "limits": LIMITS_FORM, **FRAME_FORM}
ARM_FORM = {"joints": [JOINT_FORM, ...], "tool": FRAME_FORM}
KIND_PATTERN = "|".join(CERTIFICATE_KINDS)
COMMON_FORM: dict[str, Any] = {"format": "holdfast-certificate", "version": range(1, 2), "kind": KIND_PATTERN, "arm": ARM_FORM}
COMMON_FORM |= {"arm_digest": HASH_PATTERN, "source": ..., "claim": TEXT_PATTERN, "task": TEXT_PATTERN}
COMMON_FORM |= {"volumes": VOLUMES_FORM, "digest": HASH_PATTERN, **FOR_PEOPLE}
MAX_BYTES = 256 << 20
MAX_JOINTS = 64


def load_certificate(path: Path | zipfile.Path) -> dict[str, Any]:
    """Load a certificate, and check its form, its digests and its claim.

    In an archive (``.zip``), which also contains the parts of a bundle, the certificate is the first file. Raises
    :class:`CertificateRejected` for any other file.
    """

    def reject_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        require(len(dict(pairs)) == len(pairs), f"a key is given twice in an object of {path.name}")
        return dict(pairs)

    try:
        require(path.is_file() or not path.exists(), f"{path.name} is a folder, device, or pipe; it must be a regular file")
        path = find_first_file(path)
        with path.open("rb") as file:
            content = file.read(MAX_BYTES + 1)
        require(len(content) <= MAX_BYTES, f"{path.name} is larger than {MAX_BYTES >> 20} MB")
        document = json.loads(
            content.decode(), object_pairs_hook=reject_duplicates, parse_constant=lambda x: require(0, f"it contains {x}")
        )
        _check_document(document if isinstance(document, dict) else {})
    except CertificateRejected:
        raise
    except OSError as error:
        raise CertificateRejected(f"cannot read {path.name}: {error.strerror or error}") from None
    except Exception as error:  # JSON, numbers, and the decompressors of an archive raise different errors
        raise CertificateRejected(f"{path.name} cannot be read as JSON and its numbers: {str(error)[:80]}") from None
    return dict(document)


def find_first_file(path: Path | zipfile.Path) -> Path | zipfile.Path:
    """Return the first file of an archive; any other file is returned unchanged."""
    if not isinstance(path, Path) or path.suffix != ".zip":
        return path
    archive = zipfile.ZipFile(path)
    return zipfile.Path(archive, archive.namelist()[0])


def require_form(value: Any, form: Any, label: str) -> None:
    """Require a form of a value.

    A form is an object with these keys, a list [form, length], a pattern of a text, a range of integers, or null; ... accepts
    any value.
    """
    if isinstance(form, dict):
        unexpected = sorted(form.keys() ^ value.keys() if isinstance(value, dict) else form)[:1]
        require(not unexpected, f"{label} must be an object with the keys {', '.join(form)}: see {''.join(unexpected)[:40]!r}")
        for key, inner in form.items():
            require_form(value[key], inner, f"{key} of {label}")
    elif isinstance(form, list):
        require(isinstance(value, list) and form[1] in (len(value), ...), f"{label} must be a list of {form[1]}")
        for item in value:
            require_form(item, form[0], label)
    elif isinstance(form, str):
        require(isinstance(value, str) and re.fullmatch(form, value), f"{label} is {str(value)[:40]!r}; it must be like {form}")
    elif isinstance(form, range):
        require(type(value) is int and value in form, f"{label} must be a whole number from {form[0]} to {form[-1]}")
    else:
        require(form is ... or value is None, f"{label} must be null here")


def require_nested_intervals(pairs: list[Any], outer: list[Any], label: str) -> None:
    """Require intervals to be in order and inside other intervals."""
    for (lower, upper), (lower_limit, upper_limit) in (
        [map(parse_hex, pair) for pair in both] for both in zip(pairs, outer, strict=True)
    ):
        is_inside = lower_limit <= lower <= upper <= upper_limit and lower < math.inf and upper > -math.inf
        require(is_inside, f"{label}: {lower!r} to {upper!r} is upside down or exceeds {lower_limit!r} to {upper_limit!r}")


def _check_document(document: dict[str, Any]) -> None:
    for key in ("format", "version", "kind", "arm", "task"):  # the form of the other keys depends on these
        require_form(document.get(key), COMMON_FORM[key], key)
    names = [joint["name"] for joint in document["arm"]["joints"]]
    is_valid = 0 < len(names) <= MAX_JOINTS and len(set(names)) == len(names)
    require(is_valid, f"there must be 1 to {MAX_JOINTS} joints of different names")
    is_valid = all(name.isprintable() and name and len(name) <= 200 for name in names)
    require(is_valid, "joints must have names of 1 to 200 letters to print")
    form = CERTIFICATE_KINDS[document["kind"]].form(document, len(names))
    require_form(document, COMMON_FORM | form, "the certificate")
    _check_values(document)
    for key, value in (
        ("arm_digest", compute_digest(document["arm"])),
        ("claim", claim_sentence(document)),
        ("digest", compute_digest(document)),
    ):
        require(document[key] == value, f"{key} does not match the rest of the file, which was changed or damaged")


def _check_values(document: dict[str, Any]) -> None:
    kind = document["kind"]
    arm_limits = [joint["limits"] for joint in document["arm"]["joints"]]
    locks = document.get("locks", [0])
    limits = document.get("limits", arm_limits)
    for key, outer in (("limits", arm_limits), ("joint_box", arm_limits), ("working_ranges", limits)):
        require_nested_intervals(document.get(key, []), outer[: len(document.get(key, []))], key)
    locked = [lock["joint"] for lock in locks] if kind == "path" else locks
    require(locked and locked == sorted(set(locked)), "locks must be in order, each once")
    if document.get("angle"):
        require_nested_intervals([document["angle"]], [limits[document["locked"]]], "angle")
    box = document["target"]["box"] if "target" in document else []
    require_nested_intervals(box, [["-inf", "inf"]] * len(box), "box of the target")
    require(1e-6 <= parse_hex(document.get("threshold", "0x1p-1")) < 1, "threshold must be from 1e-6 to 1")
    require(all(any(int(number) for number in frame["rotation"]) for frame in document.get("snapped", [])), "a quaternion is 0")
    if kind == "path":
        tube, (first, last) = [parse_hex(number) for number in document["tube"]], document["during"]
        for knot in document["knots"]:
            require_nested_intervals([[number, number] for number in knot], limits, "a knot")
            require(all(abs(parse_hex(number)) < 7 for number in knot), "a joint of a knot is beyond 7 rad or m")
        require(all(0 <= number <= 0.1 for number in tube), "a tube is from 0 to 0.1 m and rad")
        require(document["task"] != "pointing" or not any(tube), "a pointing path must not have a tube")
        require(len(document["pairs"]) <= SPLIT_TOKEN, f"there are more than {SPLIT_TOKEN} pairs of points")
        require(first < last, "during must not be empty")
        fixed_joints = [{lock["joint"], *lock["followers"]} for lock in locks]
        is_valid = all(len(number) == 1 + len(lock["followers"]) for number, lock in zip(fixed_joints, locks, strict=True))
        require(is_valid, "a joint that follows is locked, or listed twice")
