"""The short loops of README and documentation: ``python -m tools.loops NAME`` writes ``docs/_static/loops/NAME.webp``."""

# Each is a module of this name; the value is the seed of what it draws at random, if anything.
LOOPS = {
    "page": None,
    "power-loss": None,
    "two-laws": None,
    "self-motion": 0,
    "basins": 0,
    "fail-active": None,
    "tray": None,
    "chain": None,
}
