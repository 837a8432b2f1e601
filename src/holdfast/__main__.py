"""``python -m holdfast``."""

from holdfast.interface.cli import main

main()
