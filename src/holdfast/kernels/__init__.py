"""Compilation of expression graphs to functions of batches, with caches, small linear algebra, and array frameworks.

A module belongs here if it turns CasADi expressions into machine code, C, JavaScript, or GPU code, or runs that code. No other
package uses LLVM or the CasADi virtual machine. This package contains nothing about robots.
"""

from holdfast.core._lazy import offer

offer(__name__)
