"""Region files: what they mean, and the sentence for everything that can be wrong in one."""

from __future__ import annotations

import numpy as np
import pytest

from holdfast import Region
from holdfast.core.errors import InputError

GOOD = """
name: in front of the door
angles: deg
box:
  center: [0.968, 0, 0.041]
  size: 0.5
  rpy_center: [0, 174, -90]
  rpy_size: 90
"""


@pytest.fixture
def file(tmp_path):
    def write(text):
        path = tmp_path / "door.yaml"
        path.write_bytes(text) if isinstance(text, bytes) else path.write_text(text)
        return path

    return write


def test_degrees_and_scalar_sizes(file):
    region = Region.load(file(GOOD))
    assert region.kind == "box"
    assert region.name == "in front of the door"
    np.testing.assert_allclose(region.center, [0.968, 0, 0.041, 0, 3.036872898470133, -np.pi / 2])
    np.testing.assert_allclose(region.size, [0.5] * 3 + [np.pi / 2] * 3)


def test_radians_triples_and_defaults(file):
    region = Region.load(
        file("box: {center: [1, 2, 3], size: [0.1, 0, 1.0e-1], rpy_center: [0.1, 0.2, 0.3], rpy_size: [1, 2, 0]}")
    )
    assert region.center == (1, 2, 3, 0.1, 0.2, 0.3)
    assert region.size == (0.1, 0, 0.1, 1, 2, 0)
    assert region.name == "door"
    bare = Region.load(file("angles: rad\nbox:\n  center: [1, 2, 3]\n  size: 2\n"))
    assert bare.center == (1, 2, 3, 0, 0, 0)
    assert bare.size == (2, 2, 2, 0, 0, 0)


def test_degrees_apply_to_angles_given_as_triples_only(file):
    region = Region.load(file("angles: deg\nbox: {center: [1, 1, 1], size: [1, 1, 1], rpy_size: [180, 90, 45]}"))
    np.testing.assert_allclose(region.center[:3], 1)
    np.testing.assert_allclose(region.size, [1, 1, 1, np.pi, np.pi / 2, np.pi / 4])


def test_joints(file):
    region = Region.load(file("joints: {lower: [-1, 0], upper: [1, 0.5]}"))
    assert region == Region.joints([-1, 0], [1, 0.5], name="door")


def test_numbers_as_yaml_writes_them(file):
    """YAML 1.1 reads 1e-1 as text; people mean a number."""
    assert Region.load(file("box: {center: [0, 1e-1, 0], size: 2e0}")).center[1] == 0.1


BAD = {
    "unknown key at the top": ("boxes: {}", ["'boxes' is not known", "name, angles, box, joints"]),
    "unknown key in the box": (
        "box: {center: [0, 0, 0], size: 1, edge: 3}",
        ["'box.edge' is not known", "center, size, rpy_center, rpy_size"],
    ),
    "unknown key in joints": ("joints: {lower: [0], upper: [1], mid: [2]}", ["'joints.mid' is not known", "lower, upper"]),
    "missing center": ("box: {size: 1}", ["'box.center' is missing"]),
    "missing size": ("box: {center: [0, 0, 0]}", ["'box.size' is missing"]),
    "missing upper": ("joints: {lower: [0]}", ["'joints.upper' is missing"]),
    "center is text": ("box: {center: here, size: 1}", ["box.center", "'here'"]),
    "center of two": ("box: {center: [0, 0], size: 1}", ["box.center"]),
    "center of four": ("box: {center: [0, 0, 0, 0], size: 1}", ["box.center"]),
    "size is text": ("box: {center: [0, 0, 0], size: big}", ["box.size", "'big'"]),
    "size of two": ("box: {center: [0, 0, 0], size: [1, 2]}", ["box.size", "3"]),
    "box is a list": ("box: [1, 2]", ["box"]),
    "nan": ("box: {center: [0, .nan, 0], size: 1}", ["box.center", "finite"]),
    "infinity": ("box: {center: [0, 0, 0], size: .inf}", ["box.size", "finite"]),
    "nan joint": ("joints: {lower: [.nan], upper: [1]}", ["joints.lower", "finite"]),
    "negative size": ("box: {center: [0, 0, 0], size: -1}", ["size", "negative"]),
    "negative angles": ("box: {center: [0, 0, 0], size: 1, rpy_size: [0, -1, 0]}", ["rpy_size", "negative"]),
    "both": ("box: {center: [0, 0, 0], size: 1}\njoints: {lower: [0], upper: [1]}", ["either 'box:' or 'joints:'"]),
    "neither": ("name: nothing", ["either 'box:' or 'joints:'"]),
    "joints in degrees": ("angles: deg\njoints: {lower: [0], upper: [1]}", ["rad"]),
    "bad unit": ("angles: grad\nbox: {center: [0, 0, 0], size: 1}", ["angles", "'deg'", "'rad'", "'grad'"]),
    "upside down": ("joints: {lower: [2], upper: [1]}", ["lower 2 of joint 1 is above upper 1"]),
    "different lengths": ("joints: {lower: [0, 0], upper: [1]}", ["shape"]),
    "name is a list": ("name: [a]\nbox: {center: [0, 0, 0], size: 1}", ["name"]),
    "a list": ("- box", ["keys and values, at least box, joints or poses"]),
    "a word": ("box", ["keys and values, at least box, joints or poses"]),
    "empty": ("", ["keys and values, at least box, joints or poses"]),
    "not YAML": ("box: {center: [0, 0", ["not valid YAML"]),
    "tabs": ("box:\n\tcenter: 1", ["not valid YAML"]),
    "an object": ("!!python/object/apply:os.system ['true']", ["not valid YAML"]),
    "binary": (bytes(range(256)), ["not valid YAML"]),
    "number keys": ("1: 2", ["1"]),
    "a key twice": ("box: {center: [0, 0, 0], size: 1, size: 2}", ["line 1: the key 'size' is given twice"]),
}


@pytest.mark.parametrize("case", BAD)
def test_a_bad_file_is_answered_with_one_sentence_that_names_it(case, file):
    text, parts = BAD[case]
    with pytest.raises(InputError) as caught:
        Region.load(file(text))
    message = str(caught.value)
    assert "door.yaml'" in message
    assert "\n" not in message
    for part in parts:
        assert part in message, message


def test_a_file_that_cannot_be_read(tmp_path):
    with pytest.raises(InputError, match=r"region file '.*missing.yaml': the file cannot be read \(No such file"):
        Region.load(tmp_path / "missing.yaml")
    with pytest.raises(InputError, match=r"region file '.*': the file cannot be read \(it is a folder"):
        Region.load(tmp_path)
