"""The record book: what is the best that anybody has found, in files that anyone can check again."""
