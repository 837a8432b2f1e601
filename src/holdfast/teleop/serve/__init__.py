"""Experiment in a browser: the server that delivers the page and records its messages.

It needs starlette, uvicorn and websockets: the extra ``teleop``. Nothing here is imported with :mod:`holdfast.teleop`.
"""
