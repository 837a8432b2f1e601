"""The loops of README and documentation are there and say what made them; the examples are short."""

from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from tools.loops import LOOPS
from tools.loops.film import OUT, SIZE, write
from tools.loops.solid import box
from tools.loops.two_laws import shots

from holdfast.model.cell.nodes import split_triangles


@pytest.mark.parametrize("name", LOOPS)
def test_a_loop_is_there_and_small(name):
    file = OUT / f"{name}.webp"
    made = file.with_suffix(".txt").read_text(encoding="utf-8")
    assert made.startswith(f"python -m tools.loops {name}, holdfast ")
    with Image.open(file) as picture:
        assert picture.size == SIZE
        assert picture.n_frames > 20
    assert file.stat().st_size < (1_000_000 if name == "page" else 620_000)


def test_every_file_is_a_loop_that_a_script_writes():
    assert {file.stem for file in OUT.iterdir()} == set(LOOPS)


def test_a_loop_is_drawn_and_begins_with_what_is_shown_longest(tmp_path, monkeypatch):
    monkeypatch.setattr("tools.loops.film.OUT", tmp_path)
    taken = list(islice(shots(2), 2))
    with Image.open(write("two-laws", taken)) as picture:
        assert picture.n_frames == 2
        picture.load()  # Pillow knows how long a picture is shown once it has read it
        assert picture.info["duration"] == max(ms for _, ms in taken)


def test_triangles_are_halved_until_they_are_small_and_cover_what_they_did():
    whole = box([0.7, 0.5, 0.04], [0.6, 0, 0])
    pieces = split_triangles(whole, 0.12)

    def area(triangles):
        return np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1).sum() / 2

    assert area(whole) == pytest.approx(2 * (0.7 * 0.5 + 0.7 * 0.04 + 0.5 * 0.04))
    assert area(pieces) == pytest.approx(area(whole))
    assert np.linalg.norm(pieces - np.roll(pieces, 1, axis=1), axis=2).max() <= 0.12
    np.testing.assert_allclose(pieces.reshape(-1, 3).min(axis=0), [0.25, -0.25, -0.02])


EXAMPLES = sorted((Path(__file__).parents[1] / "docs" / "examples").glob("*/[0-9][0-9]_*.py"))


def test_there_are_examples_of_everything():
    assert len(EXAMPLES) >= 24


@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: f"{file.parent.name}/{file.stem}")
def test_an_example_is_short_and_in_a_group_of_the_gallery(file):
    assert len(file.read_text(encoding="utf-8").splitlines()) < 40
    conf = (file.parents[2] / "conf.py").read_text(encoding="utf-8")
    assert f'"{file.parent.name}"' in conf
    assert (file.parent / "GALLERY_HEADER.rst").is_file()
