"""``holdfast describe --view``."""

from __future__ import annotations


def test_a_page_with_the_arm_is_written(cli, ask, tmp_path):
    file = tmp_path / "arm.html"
    code, out, err = cli("describe", "planar-3r", "--view", str(file), "--q", "10,20,30", "--degrees", "--lock", "2")
    assert (code, err) == (0, "")
    assert out.endswith(f"written: {file}\n")
    assert "Locked: joint2." in file.read_text()
    assert ask("describe", "planar-3r", "--view", str(file))["files"] == [str(file)]
    code, _, err = cli("describe", "planar-3r", "--lock", "2")
    assert (code, err) == (2, "holdfast: --q and --lock need --view FILE, the page that shows them; add it\n")
