"""Kernels on NVIDIA GPUs: PTX by LLVM, loaded and launched by the driver, which is all of CUDA that is needed."""
