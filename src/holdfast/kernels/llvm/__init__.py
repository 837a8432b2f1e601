"""Program -> LLVM: arithmetic, functions, translation, machine code of this processor."""
