"""The experiment in a browser: the server that hands out the page and records what it sends.

It needs starlette, uvicorn and websockets: the extra ``teleop``. Nothing here is imported with :mod:`holdfast.teleop`.
"""
