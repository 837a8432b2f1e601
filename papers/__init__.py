"""The papers' numbers and figures, made again: one package per paper."""
