"""The experimenter's routes; the guard has seen the key before any of them is asked."""

from __future__ import annotations

from starlette.routing import BaseRoute

from holdfast.teleop.serve.guard import Guard


def routes(guard: Guard) -> list[BaseRoute]:
    """All of them; ``request.app.state.control`` is the :class:`holdfast.teleop.serve.control.Control`."""
    del guard
    return []
