"""Every sound file that :mod:`fuzz_inputs` mutates is read, so that its mutations test more than one refusal."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

READ_SEEDS = """
import fuzz_inputs
with fuzz_inputs.place(None) as (kinds, _):
    kinds.pop("pipe or device")  # which are refused
    for kind in kinds.values():
        for seed in kind.seeds:
            kind.file.write_bytes(seed)
            kind.read(kind.file)
    print(sum(len(kind.seeds) for kind in kinds.values()), "seeds were read")
"""


def test_every_unmutated_seed_is_read():
    path = os.pathsep.join([str(Path(__file__).parent), os.environ.get("PYTHONPATH", "")])
    done = subprocess.run(
        [sys.executable, "-c", READ_SEEDS], env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr[-2000:]
    assert "seeds were read" in done.stdout
