"""Calls of the command line inside this process."""

from __future__ import annotations

import json
import sys

import pytest

from holdfast.interface.cli.program import main
from holdfast.kernels import set_threads


@pytest.fixture
def cli(monkeypatch, capsys):
    def call(*arguments):
        monkeypatch.setattr(sys, "argv", ["holdfast", *map(str, arguments)])
        with pytest.raises(SystemExit) as end:
            main()
        out, err = capsys.readouterr()
        return end.value.code, out, err

    yield call
    set_threads(None)


@pytest.fixture
def ask(cli):
    """A call that must succeed and print one JSON document without NaN or Infinity."""

    def call(*arguments):
        code, out, err = cli(*arguments, "--json")
        assert code == 0, err
        assert err == ""
        return json.loads(out, parse_constant=lambda x: pytest.fail(f"{x} in JSON"))

    return call


@pytest.fixture
def refused(cli):
    """A call that must fail with exit code 2 and one sentence on stderr."""

    def call(*arguments):
        code, out, err = cli(*arguments)
        assert code == 2, (code, out, err)
        assert out == ""
        assert err.startswith("holdfast: ")
        assert err.count("\n") == 1, err
        assert "Traceback" not in err
        assert len(err) < 600
        return err

    return call
