"""Capsules: the default ones, what a file means, and the sentence for everything that can be wrong in one."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import Capsules, arms
from holdfast.core.errors import ArmError
from holdfast.model.collision import Clearance, LinkCapsule, capsules


@pytest.fixture
def arm():
    return arms.load("panda")


@pytest.fixture
def file(tmp_path):
    def write(text):
        path = tmp_path / "shape.yaml"
        path.write_text(text)
        return path

    return write


def test_default_capsules_of_the_panda(arm):
    made = Capsules.along_links(arm)
    by_link = {part.link: part for part in made}
    assert set(by_link) == {-1, 1, 2, 3, 5, 6}  # the shoulder's, elbow's and wrist's links of no length have none
    np.testing.assert_allclose(by_link[-1].end, [0, 0, 0.333])
    np.testing.assert_allclose([by_link[k].length for k in (1, 2, 3, 5)], [0.316, 0.0825, np.hypot(0.0825, 0.384), 0.088])
    assert len({part.radius for part in made}) == 1
    assert by_link[1].radius == pytest.approx(sum(part.length for part in made) / 20)
    assert 0.06 < by_link[1].radius < 0.08
    assert {part.radius for part in Capsules.along_links(arm, 0.05)} == {0.05}


def test_default_capsules_join_the_origins_of_the_moving_frames(mixed7, rng):
    q = rng.uniform(-2, 2, (5, 7))
    made = oracles.frames(mixed7, q)
    for part in Capsules.along_links(mixed7):
        here = made[part.link + 1]
        start, end = (here[:, :3, :3] @ np.array(x) + here[:, :3, 3] for x in (part.start, part.end))
        np.testing.assert_allclose(start, here[:, :3, 3])
        if part.link + 1 < 7:
            after = made[part.link + 1] @ mixed7.joints[part.link + 1].origin
            np.testing.assert_allclose(end, after[:, :3, 3], atol=1e-14)
        else:
            np.testing.assert_allclose(end, made[-1][:, :3, 3], atol=1e-14)


def test_a_sliding_link_of_no_length_is_a_sphere():
    gantry = hf.Arm(
        name="gantry",
        joints=tuple(hf.Joint(f"slide{k}", "prismatic", np.eye(4), axis=np.eye(3)[k]) for k in range(3)),
        tool=oracles.pose(None, [0, 0, -0.4]),
    )
    assert [(p.link, p.length) for p in Capsules.along_links(gantry)] == [(0, 0), (1, 0), (2, pytest.approx(0.4))]


def test_an_arm_of_no_length_has_no_default_capsules():
    point = hf.Arm(name="point", joints=(hf.Joint("j", "revolute", np.eye(4), axis=np.array([0, 0, 1.0])),))
    with pytest.raises(ArmError, match="the links of 'point' have no length"):
        Capsules.along_links(point)


def test_the_example_of_the_format(arm, file):
    lines = capsules.__doc__.split("::\n\n", 1)[1].split("\n\n")[0].splitlines()
    made = Capsules.load(file("\n".join(line[4:] for line in lines)), arm)
    default = {part.link: part for part in Capsules.along_links(arm, 0.06)}
    assert [part for part in made if part.link not in (-1, 3)] == [default[k] for k in (1, 2, 6)]
    assert [part for part in made if part.link in (-1, 3)] == [
        LinkCapsule(-1, (0, 0, 0), (0, 0, 0.3), radius=0.1),
        LinkCapsule(3, (0, 0, 0), (-0.08, 0.1, 0), radius=0.06),
        LinkCapsule(3, (-0.08, 0.12, 0), (-0.08, 0.12, 0), radius=0.07),
    ]
    assert made.ignore == ((4, 6),)


def test_links_that_are_not_named_have_none_without_a_radius(arm, file):
    made = Capsules.load(file("links: {base: [{from: [0, 0, 0], to: [0, 0, 1e-1], radius: 1e-1}]}"), arm)
    assert list(made) == [LinkCapsule(-1, (0, 0, 0), (0, 0, 0.1), radius=0.1)]
    assert list(Capsules.load(file("radius: 0.06"), arm)) == list(Capsules.along_links(arm, 0.06))
    assert len(Capsules.load(file("links: {}"), arm)) == 0


def test_there_and_back_through_json(mixed7, rng):
    parts = [
        LinkCapsule(int(k), rng.normal(size=3), rng.normal(size=3), radius=rng.uniform(0.01, 1)) for k in rng.integers(-1, 7, 9)
    ]
    made = Capsules(tuple(sorted(parts, key=lambda part: part.link)), ((5, 2), (-1, 3), (2, 5)))
    assert made.ignore == ((-1, 3), (2, 5))
    data = json.loads(json.dumps(made.to_dict(mixed7)))
    assert Capsules.from_dict(data, mixed7) == made
    assert set(data["links"]) <= {"base", *mixed7.joint_names}


PART = "from: [0, 0, 0], to: [0, 0, 1]"
REFUSED = [
    ("links: [", "this is not valid YAML"),
    ("- 1", "the file must hold keys and values, at least radius or links; see holdfast.model.collision.capsules"),
    ("ignore: []", "it gives neither radius nor links"),
    ("radius: 0", "radius: 0 is wrong; input should be greater than 0"),
    ("radius: true", "radius: True is wrong; it must be a number"),
    ("radius: thick", "radius: 'thick' is wrong; input should be a valid number"),
    ("radius: .inf", "radius: inf is wrong; input should be a finite number"),
    ("radius: 1\nlink: {}", "link: the key 'link' is not known; the keys here are radius, links, ignore"),
    ("radius: 1\nradius: 2", "line 2: the key 'radius' is given twice; give it once"),
    ("links: {hand: []}", "links: 'panda' has no link 'hand'; its links are base, panda_joint1, panda_joint2"),
    (f"links: {{base: [{{{PART}}}]}}", "links.base[0].radius: it is missing; give it here or for the whole file"),
    (f"links: {{base: [{{{PART}, radius: -1}}]}}", "links.base[0].radius: -1 is wrong; input should be greater than 0"),
    ("links: {base: [{to: [0, 0, 1], radius: 1}]}", "links.base[0].from: it is missing; it must be given"),
    ("links: {base: [{from: [0, 0], radius: 1}]}", "links.base[0].from: it has 2 entries; it must have 3"),
    (
        f"links: {{base: [{{{PART}, size: 1}}]}}",
        "links.base[0].size: the key 'size' is not known; the keys here are from, to, radius",
    ),
    (f"links: {{base: {{{PART}}}}}", "links.base: "),
    ("radius: 1\nignore: [[base]]", "ignore[0]: it has 1 entries; it must have 2"),
    ("radius: 1\nignore: [[base, panda_joint9]]", "ignore[0]: 'panda' has no link 'panda_joint9'"),
]


@pytest.mark.parametrize(("text", "sentence"), REFUSED, ids=[case[1][:50] for case in REFUSED])
def test_refusals(text, sentence, arm, file):
    path = file(text)
    with pytest.raises(ArmError) as caught:
        Capsules.load(path, arm)
    assert str(caught.value).startswith(f"capsule file '{path}': ")
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_an_unreadable_file(tmp_path, arm):
    with pytest.raises(ArmError, match=r"none.yaml': the file cannot be read \(No such file"):
        Capsules.load(tmp_path / "none.yaml", arm)


def test_a_joint_called_base_is_not_mistaken_for_the_base(arm, file):
    named = replace(arm, joints=(replace(arm.joints[0], name="base"), *arm.joints[1:]))
    with pytest.raises(ArmError, match="also has a joint 'base'"):
        Capsules.load(file("radius: 1\nignore: [[base, panda_joint5]]"), named)


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ((-2, (0, 0, 0), (0, 0, 1), 1), "sits on link -2"),
        ((0, (0, 0), (0, 0, 1), 1), "start of a capsule is"),
        ((0, (0, 0, 0), (0, 0, np.nan), 1), "end of a capsule is"),
        ((0, (0, 0, 0), (0, 0, 1), 0), "radius of a capsule is 0 m; it must be finite and above 0"),
        ((0, (0, 0, 0), (0, 0, 1), np.inf), "radius of a capsule is inf m"),
    ],
)
def test_a_capsule_that_is_none(values, sentence):
    with pytest.raises(ArmError, match=sentence):
        LinkCapsule(*values[:3], **dict(zip(("radius", "assumed"), values[3:], strict=False)))


def test_a_link_that_the_arm_does_not_have(arm):
    with pytest.raises(ArmError, match=r"a capsule names link 7, but 'panda' has links -1 \(base\) to 6"):
        Clearance(arm, Capsules((LinkCapsule(7, (0, 0, 0), (0, 0, 1), radius=0.1),)))
