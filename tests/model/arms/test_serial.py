"""An arm as plain data and back: nothing changes, not even the last bit."""

from __future__ import annotations

import json

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import arms
from holdfast.core.errors import ArmError
from holdfast.model.arms.serial import from_dict, to_dict


def through_json(arm):
    return from_dict(json.loads(json.dumps(to_dict(arm), allow_nan=False)))


def same(a: hf.Arm, b: hf.Arm) -> None:
    assert (a.name, a.source, a.joint_names) == (b.name, b.source, b.joint_names)
    for name in ("base", "tool", "gravity"):
        assert getattr(a, name).tobytes() == getattr(b, name).tobytes(), name
    for x, y in zip(a.joints, b.joints, strict=True):
        assert x.origin.tobytes() == y.origin.tobytes()
        assert x.axis.tobytes() == y.axis.tobytes()
        for name in ("type", "lower", "upper", "velocity", "effort", "friction", "armature"):
            assert getattr(x, name) == getattr(y, name), name
    for x, y in zip((*a.links, a.payload), (*b.links, b.payload), strict=True):
        assert (x is None) == (y is None)
        if x is not None:
            assert (x.name, x.mass) == (y.name, y.mass)
            assert x.com.tobytes() == y.com.tobytes()
            assert x.inertia.tobytes() == y.inertia.tobytes()
    assert a.fingerprint == b.fingerprint


@pytest.mark.parametrize("name", arms.names())
def test_built_in_arms(name):
    same(arms.load(name), through_json(arms.load(name)))


def test_random_arms(rng):
    """An axis is a unit vector only up to rounding; it must not be rounded again."""
    for _ in range(20):
        arm = oracles.random_arm(rng, limits=2.0)
        back = through_json(arm)
        same(arm, back)
        assert to_dict(back) == to_dict(arm)


def test_everything_an_arm_can_have(mixed8, rng):
    joints = [
        hf.Joint(
            j.name,
            j.type,
            j.origin,
            axis=j.axis,
            lower=j.lower,
            upper=j.upper,
            velocity=1.5,
            effort=20.0,
            friction=0.1,
            armature=0.02,
        )
        for j in mixed8.joints
    ]
    links = [
        hf.Link(1.0 + k, rng.normal(size=3), np.diag([0.1, 0.2, 0.15 + k]) if k != 3 else np.eye(3), name=f"l{k}")
        for k in range(8)
    ]
    links[5] = None
    arm = hf.Arm(
        name="all",
        joints=tuple(joints),
        links=tuple(links),
        base=mixed8.base,
        tool=mixed8.tool,
        gravity=np.array([0.1, 0, -9.8]),
        payload=hf.Link(2.0, np.array([0, 0, 0.1]), 0.01 * np.eye(3), name="drill"),
        source="made here, µ",
    )
    same(arm, through_json(arm))


def test_infinite_limits_become_null():
    data = to_dict(arms.load("kinova-j2s6s200"))
    text = json.dumps(data, allow_nan=False)
    assert "Infinity" not in text
    assert data["joints"][0]["lower"] is None


@pytest.mark.parametrize("key", ["name", "joints", "links", "base", "tool", "gravity", "payload", "source"])
def test_a_missing_key_is_named(key):
    data = to_dict(arms.load("planar-3r"))
    del data[key]
    with pytest.raises(ArmError, match=key):
        from_dict(data)


@pytest.mark.parametrize(
    "change",
    [
        lambda d: d.update(joints=None),
        lambda d: d.update(joints=[3]),
        lambda d: d["joints"][0].pop("axis"),
        lambda d: d["joints"][0].update(axis="z"),
        lambda d: d["joints"][0].update(axis=[[1], [1, 2]]),
        lambda d: d["joints"][0].update(type="ball"),
        lambda d: d["joints"][0].update(lower="low"),
        lambda d: d["joints"][0].update(lower=5, upper=-5),
        lambda d: d.update(base=[[1], [1, 2]]),
        lambda d: d.update(base=np.zeros((4, 4)).tolist()),
        lambda d: d["links"][0].update(mass=-1),
        lambda d: d["links"][0].update(mass="heavy"),
        lambda d: d["links"][0].pop("com"),
        lambda d: d.update(links=d["links"][:1]),
    ],
)
def test_nonsense_is_refused_with_a_sentence(change):
    data = to_dict(arms.load("planar-3r"))
    change(data)
    with pytest.raises(ArmError) as caught:
        from_dict(data)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("data", [None, 3, [], "arm", {}])
def test_something_else_entirely_is_refused(data):
    with pytest.raises(ArmError, match="not an arm description"):
        from_dict(data)
