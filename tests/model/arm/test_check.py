"""Every finding, on an arm that has just that fault; and none on a sound one."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from holdfast import arms
from holdfast.core.errors import ArmError
from holdfast.model.arm.machine import Joint, Link
from holdfast.model.arm.model import Arm
from holdfast.model.arm.soundness import check_arm, require_possible_inertia

JOINT = Joint("elbow", "revolute", np.eye(4), axis=np.array([0, 0, 1.0]), lower=-1, upper=1, velocity=2, effort=3)
LINK = Link(1.0, np.zeros(3), np.diag([1.0, 1.0, 1.5]), name="forearm")


def arm(joint: Joint = JOINT, link: Link | None = LINK, payload: Link | None = None) -> Arm:
    return Arm(name="bot", joints=(joint,), links=(link,), payload=payload)


def messages(a: Arm) -> list[str]:
    return [f"{x.severity}: {x.subject}: {x.message}" for x in check_arm(a)]


def test_a_sound_arm_has_no_findings() -> None:
    assert check_arm(arm()) == []
    require_possible_inertia(arm())


def test_an_arm_in_millimetres() -> None:
    tool = np.eye(4)
    tool[0, 3] = 900.0
    (message,) = messages(arm().with_tool(tool))
    assert message == "warning: arm 'bot': end to end it is 900 m long; lengths are in m: is its file in mm?"


JOINTS: list[tuple[dict[str, Any], str]] = [
    ({"type": "continuous", "lower": -np.inf, "upper": np.inf}, "it is continuous; analyses over the whole joint range need"),
    (
        {"upper": np.inf},
        "it lacks a limit (one beyond 100 turns counts as none); analyses over the whole joint range need lower and upper, in "
        "rad",
    ),
    (
        {"type": "prismatic", "lower": -np.inf},
        "it lacks a limit (one beyond 1000 m counts as none); analyses over the whole joint range need lower and upper, in m",
    ),
    ({"lower": 1}, "its lower and upper limit are both 1 rad; a joint needs room to move"),
    ({"lower": -7, "upper": 7}, "its range is 14 rad; more than two turns (12.57 rad) is a placeholder on most arms"),
    ({"velocity": np.inf}, "it has no largest velocity; give it in rad/s"),
    ({"velocity": 0}, "its largest velocity is 0 rad/s; it must be above 0"),
    ({"effort": np.inf}, "it has no largest effort; give it in N m"),
    ({"effort": 0}, "its largest effort is 0 N m; it should be above 0 and below 20000 N m"),
    ({"effort": 50_000, "type": "prismatic"}, "its largest effort is 50000 N; it should be above 0 and below 20000 N"),
]


@pytest.mark.parametrize(("change", "sentence"), JOINTS, ids=[case[1][:40] for case in JOINTS])
def test_joints(change: dict[str, Any], sentence: str) -> None:
    (message,) = messages(arm(replace(JOINT, **change)))
    assert message.startswith(f"warning: joint 'elbow': {sentence}")
    require_possible_inertia(arm(replace(JOINT, **change)))


def turned(moments: tuple[float, float, float]) -> np.ndarray:
    rotation = Rotation.random(rng=np.random.default_rng(0)).as_matrix()
    return rotation @ np.diag(moments) @ rotation.T


LINKS: list[tuple[Link | None, str]] = [
    (None, "warning: link after joint 'elbow': it has no inertial data; give mass, centre of mass and inertia"),
    (
        Link(0.0, np.zeros(3), np.eye(3), name="forearm"),
        "error: link 'forearm': its mass is 0 kg; a moving link needs a mass above 0",
    ),
    (
        Link(1.0, np.zeros(3), turned((-0.5, 1, 1))),
        "error: link after joint 'elbow': its inertia has the principal moment -0.5 kg m^2; all three must be 0 or more",
    ),
    (
        Link(1.0, np.zeros(3), turned((1, 1, 2.1)), name="forearm"),
        "error: link 'forearm': its principal moments 1, 1 and 2.1 kg m^2 break the triangle inequality",
    ),
    (
        Link(1.0, np.zeros(3), np.zeros((3, 3)), name="forearm"),
        "error: link 'forearm': it has a mass of 1 kg and no inertia; give its moments in kg m^2",
    ),
]


@pytest.mark.parametrize(("link", "sentence"), LINKS, ids=[case[1][:60] for case in LINKS])
def test_links(link: Link | None, sentence: str) -> None:
    (message,) = messages(arm(link=link))
    assert message.startswith(sentence)
    if "principal moment" in message:
        with pytest.raises(ArmError) as caught:
            require_possible_inertia(arm(link=link))
        assert str(caught.value).startswith(f"arm 'bot', {sentence.split(': ', 1)[1]}")


def test_a_link_of_which_nothing_is_known_is_no_point_and_no_massless_link() -> None:
    with pytest.raises(ArmError, match="arm 'bot', link after joint 'elbow': it has no inertial data; give its mass"):
        require_possible_inertia(arm(link=None))
    require_possible_inertia(arm(link=Link(1.0, np.zeros(3), np.zeros((3, 3)))))
    require_possible_inertia(arm(link=Link(0.0, np.zeros(3), np.zeros((3, 3)))))


def test_thin_rods_and_flat_plates_are_sound() -> None:
    assert check_arm(arm(link=Link(1.0, np.zeros(3), turned((0, 1, 1))))) == []
    assert check_arm(arm(link=Link(1.0, np.zeros(3), turned((1, 1, 2))))) == []


def test_the_payload_is_checked_too() -> None:
    bad = Link(1.0, np.zeros(3), np.diag([1.0, 1.0, 3.0]), name="box")
    assert messages(arm(payload=bad))[0].startswith("error: payload: its principal moments")
    with pytest.raises(ArmError, match="arm 'bot', payload: its principal moments"):
        require_possible_inertia(arm(payload=bad))


def test_two_full_turns_are_plausible() -> None:
    """Some files round 2 pi up in the last digit."""
    assert check_arm(arm(replace(JOINT, lower=-6.28318530718, upper=6.28318530718))) == []


SOUND = [each for each in arms.names() if not each.startswith("pa10")]


@pytest.mark.parametrize("name", arms.names())
def test_builtin_arms(name: str) -> None:
    found = check_arm(arms.load(name))
    assert not [x for x in found if x.severity == "error"]
    if name in SOUND:
        require_possible_inertia(arms.load(name))
    else:
        with pytest.raises(ArmError, match=f"arm '{name}', link after joint 'joint1': it has no inertial data"):
            require_possible_inertia(arms.load(name))
    # The arms in code and two files leave speeds or efforts open; only the Kinova has joints without limits.
    if name == "kinova-j2s6s200":
        assert [x.subject for x in found] == [f"joint 'j2s6s200_joint_{k}'" for k in (1, 4, 6)]
    elif not name.startswith(("planar", "pa10", "so101", "openarm")):
        assert found == []


@pytest.mark.parametrize(("unit", "named"), [(1.0, False), (1e4, True), (1e6, True), (1e9, True)])
def test_inertias_in_other_units_are_named(unit: float, named: bool) -> None:
    """Of the Panda's links in kg m^2, kg cm^2, kg mm^2 and g mm^2."""
    panda = arms.load("panda")
    links = tuple(replace(x, inertia=x.inertia * unit) for x in panda.links)
    found = [x.message for x in check_arm(replace(panda, links=links)) if "radius of gyration" in x.message]
    assert bool(found) is named
