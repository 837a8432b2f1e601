"""``tools/record.py compare``: what counts as a difference of two records, and what is said of it."""

from __future__ import annotations

import importlib.util
import json
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, PngImagePlugin

_FILE = Path(__file__).parents[1] / "tools" / "recorded" / "records.py"
_spec = importlib.util.spec_from_file_location("tools_records", _FILE)
records = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(records)


@pytest.fixture
def compared(tmp_path, capsys):
    """Exit code and lines for two versions of one file."""

    def call(name, old, new, *keys):
        for place, data in (("old", old), ("new", new)):
            file = tmp_path / place / "case" / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(data if isinstance(data, bytes) else data.encode())
        code = records.compare(tmp_path / "old", tmp_path / "new", list(keys), tmp_path / "page.html")
        return code, capsys.readouterr().out.splitlines()

    return call


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("made 2026-11-22T20:31:42Z", "made 2027-01-01 00:00 UTC"),
        ("12 of 12 trials  2026-11-22\n", "12 of 12 trials  2026-11-23\n"),
        (
            "of one thread  a chunk  size\n40    3       0.89 s         0.3 s   6 kB\n",
            "of one thread  a chunk   size\n40    3       0.021 s        0.0069 s  6 kB\n",
        ),
        (
            '<g id="p2b45f8a14d"/><path clip-path="url(#p2b45f8a14d)"/>',
            '<g id="pfeedc54e41"/><path clip-path="url(#pfeedc54e41)"/>',
        ),
        ("seconds=1.25, kept", "seconds=3e-05, kept"),
        ('"seconds": 1.25', '"seconds": 0'),
        ('"numpy": "2.3.1"', '"numpy": "2.4.0.dev1"'),
        ("http://127.0.0.1:4711/?key=abc", "http://127.0.0.1:80/?key=d-e_f"),
        ("a\nholdfast: compiling 'x', about 2 s\n", "a\n"),
        ("holdfast: assessing poses\nholdfast: assessing poses, about 12 min more\nb\n", "b\n"),
        ("b\n", "holdfast: following the path: solving, so far 1,030 of at most 4,800 starts of each pose\nb\n"),
        ("b\n", "holdfast: drawing the report, so far 7 figures\nb\n"),
    ],
)
def test_what_varies_is_no_difference(old, new, compared):
    assert compared("1.out", old, new)[0] == 0


def test_what_is_said_of_long_work_is_no_difference():
    sources = [file.read_text(encoding="utf-8") for file in (Path(__file__).parents[1] / "src").rglob("*.py")]
    names = {name for text in sources for name in re.findall(r'\b(?:reports_progress|report_work)\(f?"([^"]+)"', text)}
    assert len(names) > 30
    left = {name for name in names if records.settled("1.err", f"holdfast: {name}\n".encode())}
    assert left == {"a chunk"}  # somebody else tells of it


@pytest.mark.parametrize(
    "error",
    [
        "stopped",
        "no parameter of 'panda' is varied",
        "damping is -1; it must be above 0",
        "rating: two of its steps have the same name",
        "missing must be one of complete",
    ],
)
def test_an_error_is_said_of_no_long_work(error, compared):
    assert compared("1.err", f"holdfast: {error}\nexit code 2\n", "exit code 2\n")[0] == 1


def test_a_word_is_shown_where_it_is(compared):
    code, lines = compared("1.out", f"one\n{'x' * 200} poses\nend\n", f"one\n{'x' * 200} points\nend\n")
    assert code == 1
    assert lines[0] == "case/1.out"
    assert [line.strip()[:2] for line in lines[1:3]] == ["-…", "+…"]
    assert (lines[1][-9:], lines[2][-10:]) == ("xxx poses", "xxx points")
    assert "1 of 1 files differ" in lines


def test_json_is_compared_by_keys(compared):
    old, new = {"a": {"b": [1, 2]}, "c": "d"}, {"c": "d", "a": {"b": [1, 3]}, "e": None}
    code, lines = compared("1.json", json.dumps(old), json.dumps(new))
    assert code == 1
    assert {"    -a.b.1: 2", "    +a.b.1: 3", "    +e: null"} <= set(lines)


def test_pictures_are_their_pixels(compared, tmp_path):
    def png(values, text):
        info, file = PngImagePlugin.PngInfo(), tmp_path / "x.png"
        info.add_text("Software", text)
        Image.fromarray(np.array(values, dtype=np.uint8)).save(file, pnginfo=info)
        return file.read_bytes()

    assert compared("a.png", png([[1, 2]], "old"), png([[1, 2]], "new"))[0] == 0
    assert compared("a.png", png([[1, 2]], "old"), png([[1, 3]], "old"))[0] == 1
    assert (tmp_path / "page.html").read_text().count("<img ") == 2


def test_a_file_that_is_gone_or_new_is_a_difference(compared, tmp_path):
    compared("1.out", "a", "a")
    (tmp_path / "old" / "case" / "2.out").write_text("b")
    code, lines = compared("1.out", "a", "a")
    assert code == 1
    assert lines[0] == f"case/2.out: only in {tmp_path / 'old'}"


def test_a_folder_without_a_record_is_refused(compared):
    with pytest.raises(SystemExit, match=r"there is no record in .* of nothing"):
        compared("1.out", "a", "a", "nothing")
