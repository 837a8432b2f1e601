"""Compiles the C++ beside this file and calls it."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

import pa10
from harness import Function, MissingError

FLAGS = ["-O3", "-march=native", "-ffast-math", "-fopenmp", "-shared", "-fPIC"]


def worst_relative_manipulability(threads: int) -> Function:
    """The hand-written kernel as a function of (N, 9) configurations.

    Raises:
        MissingError: There is no g++ on this machine.
    """
    compiler = shutil.which("g++")
    if compiler is None:
        raise MissingError("no g++ on the PATH")
    source = Path(__file__).with_name("rho_simd.cpp")
    with tempfile.TemporaryDirectory() as folder:
        built = Path(folder) / "rho_simd.so"
        subprocess.run([compiler, *FLAGS, os.fspath(source), "-o", os.fspath(built)], check=True)
        call = ctypes.CDLL(os.fspath(built)).worst_relative_manipulability  # stays loaded after the file is gone
    doubles = np.ctypeslib.ndpointer(np.float64, flags="C")
    call.argtypes = [doubles, doubles, ctypes.c_size_t, doubles, doubles, doubles, doubles, ctypes.c_int]
    call.restype = None

    def evaluate(q: np.ndarray) -> np.ndarray:
        out = np.empty(len(q))
        call(q, out, len(q), pa10.A, pa10.D, pa10.COS_ALPHA, pa10.SIN_ALPHA, threads)
        return out

    return evaluate
