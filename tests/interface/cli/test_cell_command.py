"""``holdfast cell check`` on the command line."""

import json

import numpy as np

import holdfast as hf
from holdfast.model.cell import Box, Points, Sphere


def test_the_command_writes_what_the_function_finds(tmp_path, cli, refused):
    high = np.eye(4)
    high[2, 3] = 0.6
    cell = hf.Cell([Box("table", [1, 1, 0.1]), Sphere("hood", 0.6, pose=high), Points("scan", [[0.6, 0.5, 0.5]], radius=0.02)])
    file = cell.save(tmp_path / "bench.yaml")[0]
    code, out, _ = cli("cell", "check", file, "--arm", "panda", "--json", "--out", tmp_path / "out")
    told = json.loads(out)
    assert code == 3
    assert told["base_touches"] == ["table", "hood"]
    assert told["sha256"] == cell.digest
    assert list(told["objects"]) == ["table", "hood", "scan"]
    page = (tmp_path / "out" / "report.html").read_text()
    assert "Check of a cell" in page
    assert "largest distance error" in page
    code, out, _ = cli("cell", "check", file)
    assert code == 0
    assert "point cloud of 1 point" in out
    assert "cell file" in refused("cell", "check", tmp_path / "none.yaml")
