"""Entry point of ``python -m holdfast.interface.cli``."""

from holdfast.interface.cli import main

main()
