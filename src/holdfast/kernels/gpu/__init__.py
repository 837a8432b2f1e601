"""Kernels on NVIDIA GPUs: LLVM writes PTX, and the driver, the only part of CUDA that is needed, loads and launches it."""
