"""Convert an arm to plain data and back, so that a results folder identifies its arm exactly."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.core.errors import ArmError
from holdfast.model.arm.machine import DRY_FRICTION, JOINT_NUMBERS, Chain, Joint, Link
from holdfast.model.arm.model import Arm


def to_dict(arm: Arm) -> dict[str, Any]:
    """Return all data that define the arm, as JSON types; infinite limits become null."""
    return {
        "name": arm.name,
        "source": arm.source,
        "base": arm.base.tolist(),
        "tool": arm.tool.tolist(),
        "flange": arm.flange.tolist(),
        "gravity": arm.gravity.tolist(),
        "joints": [
            {
                "name": joint.name,
                "type": joint.type,
                "origin": joint.origin.tolist(),
                "axis": joint.axis.tolist(),
                **{key: (getattr(joint, key) if np.isfinite(getattr(joint, key)) else None) for key in JOINT_NUMBERS},
                **{key: getattr(joint, key) for key in DRY_FRICTION if getattr(joint, key)},
            }
            for joint in arm.joints
        ],
        "links": [_link_to_dict(link) for link in arm.links],
        "payload": _link_to_dict(arm.payload),
        **({} if arm.chain is None else {"chain": [arm.chain.base, arm.chain.tip, dict(arm.chain.held)]}),
    }


def from_dict(data: dict[str, Any]) -> Arm:
    """Return the arm of :func:`to_dict`.

    Raises:
        ArmError: The data are not such a description.
    """
    try:
        joints = []
        for entry in data["joints"]:
            values = {key: entry[key] for key in JOINT_NUMBERS if entry[key] is not None}
            values |= {key: entry[key] for key in DRY_FRICTION if key in entry}
            joints.append(
                Joint(entry["name"], entry["type"], np.array(entry["origin"]), axis=np.array(entry["axis"]), **values)
            )
        return Arm(
            name=data["name"],
            joints=tuple(joints),
            links=tuple(_link_from_dict(link_data) for link_data in data["links"]),
            base=np.array(data["base"]),
            tool=np.array(data["tool"]),
            gravity=np.array(data["gravity"]),
            payload=_link_from_dict(data["payload"]),
            source=data["source"],
            flange=np.array(data["flange"]),
            chain=_read_chain(data.get("chain")),
        )
    except ArmError:
        raise
    except (KeyError, TypeError, AttributeError, ValueError) as error:
        raise ArmError(f"this is not an arm description written by holdfast: {error!r} is missing or malformed") from error


def _read_chain(data: list[Any] | None) -> Chain | None:
    if data is None:
        return None
    base, tip, held = data
    return Chain(base, tip, tuple(held.items()))


def _link_to_dict(link: Link | None) -> dict[str, Any] | None:
    if link is None:
        return None
    return {"name": link.name, "mass": link.mass, "com": link.com.tolist(), "inertia": link.inertia.tolist()}


def _link_from_dict(data: dict[str, Any] | None) -> Link | None:
    if data is None:
        return None
    return Link(data["mass"], np.array(data["com"]), np.array(data["inertia"]), name=data["name"])
