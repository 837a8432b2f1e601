"""``holdfast page``: the options reach the page, and bad input gets one sentence."""

from __future__ import annotations

import json
import re

import pytest

import holdfast as hf


def read_data(file):
    html = file.read_text(encoding="utf-8")
    found = re.findall(r'<script type="application/json">(.*?)</script>', html, re.DOTALL)
    scene, data = (json.loads(text) for text in (found[0], found[-1]))
    return scene, data, html


def test_the_options_are_those_of_the_page(cli, tmp_path):
    bench = tmp_path / "bench.yaml"
    hf.Cell([hf.cell.Sphere("ball", 0.1)]).save(bench)
    file = tmp_path / "arm.html"
    options = ["--q", "20,40,60", "--degrees", "--lock", "2", "--law", "damped:0.1", "--law", "pseudoinverse"]
    code, out, error = cli("page", "planar-3r", "--out", file, *options, "--target", "1.5,1.2")
    assert (code, error) == (0, "")
    assert out == f"written: {file}\n"
    scene, data, _ = read_data(file)
    assert scene["arms"][0]["q"][0] == pytest.approx([0.3490659, 0.6981317, 1.047198])
    assert scene["locked"] == [None, 0.0, None]
    assert [law["slug"] for law in data["story"]["laws"]] == ["damped:0.1", "pseudoinverse"]
    assert data["story"]["target"][:2] == [1.5, 1.2]
    assert data["story"]["motions"] == 0  # the target was given
    assert cli("page", "panda", "--out", file, "--plain", "--cell", bench, "--with", "xarm7")[0] == 0
    scene, data, html = read_data(file)
    assert scene["objects"]
    assert "<option>xarm7</option>" in html
    assert "arm-steps" not in re.sub(r"<(style|script).*?</\1>", "", html, flags=re.DOTALL)


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--lock", "9"], "joint"),
        (["--law", "pseudoinverse"], "laws has 1 name"),
        (["--law", "none", "--law", "pseudoinverse"], "none"),
        (["--q", "1,2"], "q for 'planar-3r' has 2 values"),
        (["--with", "no-such-arm"], "no-such-arm"),
        (["--with", "panda"], "'planar-3r' does not fit into a menu; its arms need 6 to 9 revolute joints"),
    ],
)
def test_bad_input_gets_a_sentence_and_writes_nothing(refused, tmp_path, options, sentence):
    file = tmp_path / "arm.html"
    assert sentence in refused("page", "planar-3r", "--out", file, *options)
    assert not file.exists()
