"""Kernels on NVIDIA GPUs: PTX by LLVM, loaded and launched by the driver, the only part of CUDA that is needed."""
