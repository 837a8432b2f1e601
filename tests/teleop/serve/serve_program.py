"""Serves an experiment for tests: prints its port, and stops with the process. Arguments: folder, static, english, token."""

import sys
from pathlib import Path

from holdfast.teleop.serve.app import ServerOptions, serve_experiment
from holdfast.teleop.serve.guard import Guard

KEY = "the-experimenters-key"

if __name__ == "__main__":
    folder, static, english, *token = sys.argv[1:]
    guard = Guard(token=token[0] if token else None, key=KEY, loopback=not token)
    options = ServerOptions(Path(folder), guard, static=Path(static), english=Path(english))
    serve_experiment(options, port=0, ready=lambda port: print(port, flush=True))
