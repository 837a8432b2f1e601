"""The certificate of the documentation, checked as its page says: by one command where nothing else is installed."""

from __future__ import annotations

import subprocess
import sys
import venv
from pathlib import Path

import flint
import numpy as np
import pytest

from holdfast.certificates import documents, verifier

ROOT = Path(__file__).parents[2]
sys.path.append(str(ROOT / "docs" / "_ext"))
from verifier_archive import zipped  # noqa: E402

CUBE = ROOT / "docs" / "panda-cube.zip"


@pytest.fixture(scope="module")
def bare(tmp_path_factory):
    """A Python that has NumPy and python-flint, and nothing else."""
    place = tmp_path_factory.mktemp("bare") / "trust"
    venv.create(place, symlinks=True)
    (packages,) = place.glob("lib/*/site-packages")
    for module in (np, flint):
        home = Path(module.__file__).parent
        for part in home.parent.glob(f"*{home.name}*"):  # and the libraries that its wheel brings
            if part.is_dir():
                (packages / part.name).symlink_to(part)
    return place / "bin" / "python"


def test_one_command_checks_it(bare, tmp_path):
    archive = zipped(tmp_path / "verifier.zip")
    assert subprocess.run([bare, "-E", "-c", "import holdfast"], capture_output=True, check=False).returncode == 1
    done = subprocess.run(
        [bare, "-E", archive, CUBE, "--sample", "10"], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "Leaves accepted: 80, rejected: 0" in done.stdout
    assert "sampled, not verified" in done.stdout


def test_it_is_about_our_panda(panda):
    document = verifier.load_certificate(CUBE)
    arms = document["arm"], documents._encode_arm(panda)
    first, second = (
        [float.fromhex(x) for frame in (*arm["joints"], arm["tool"]) for x in frame["rotation"] + frame["origin"]]
        for arm in arms
    )
    np.testing.assert_allclose(first, second, atol=1e-12)
    box = np.array([[float.fromhex(x) for x in pair] for pair in document["target"]["box"]])
    np.testing.assert_allclose(box, np.add.outer([0.485, 0, 0.53], [-0.15, 0.15]), atol=1e-12)
    assert document["locks"] == list(range(7))
