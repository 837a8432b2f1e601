"""``holdfast teleop serve``: server for experiments with participants in a browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.files import reading

_TLS_INSTRUCTIONS = """\
Use TLS between computers, because browsers allow gamepads and passwords only then; for example with Caddy in front:
  caddy reverse-proxy --from {host} --to 127.0.0.1:{port}
(In this case, start this command with --host 127.0.0.1, --behind-proxy, and a token. The proxy must forward the
Host header, as Caddy does.)"""


def serve(
    data: Annotated[Path, typer.Option("--data", metavar="DIR", help="Folder of the experiment; a new folder starts one.")],
    protocol: Annotated[
        str | None, "Protocol of a new folder: goel2003, goel2003-smooth, or a YAML file. Default: goel2003."
    ] = None,
    port: Annotated[int, typer.Option("--port", min=0, max=65535, help="Port of the page; 0 selects a free one.")] = 8000,
    host: Annotated[str, "Address to listen on; any address other than this computer's own needs a token."] = "127.0.0.1",
    token: Annotated[
        str | None,
        typer.Option(
            "--token",
            help="Secret that stations must show: at least 12 random letters, digits, - or _. Anyone who lists processes can "
            "read it here; the environment variable or --token-file is safer.",
            envvar="HOLDFAST_TOKEN",
        ),
    ] = None,
    token_file: Annotated[Path | None, "File whose first line is the token."] = None,
    texts: Annotated[Path | None, "Translation file (YAML) of the page texts. Default: English."] = None,
    tlx: Annotated[bool, "Ask subjects for the NASA task load index."] = False,
    behind_proxy: Annotated[
        bool, "Read addresses and https from the headers X-Forwarded-For and X-Forwarded-Proto of a proxy on this computer."
    ] = False,
) -> None:
    """Serve the web pages of an experiment.

    Ctrl-C ends the server.

    Example: holdfast teleop serve --data experiment
    """
    try:
        from holdfast.core.files.hosts import is_loopback_host
        from holdfast.teleop.serve import app
        from holdfast.teleop.serve.guard import Guard, check_token
    except ModuleNotFoundError as error:
        if error.name not in ("starlette", "uvicorn", "websockets"):
            raise
        raise HoldfastError(f"the server needs {error.name}; pip install 'holdfast-arms[teleop]'") from None
    token = _read_token(token, token_file)
    if token is not None:
        check_token(token)
    loopback = is_loopback_host(host)
    if not loopback and token is None:
        raise InputError(
            f"--host {host} admits other computers; add --token-file, or HOLDFAST_TOKEN, with a random secret of at least 12 "
            "letters and digits"
        )
    guard = Guard(token=token, loopback=loopback and token is None)
    options = app.ServerOptions(data, guard, texts, tlx, protocol=protocol, behind_proxy=behind_proxy)

    def print_addresses(bound_port: int) -> None:
        address_host = "[::1]" if host == "::1" else host
        base_url = f"http://{'127.0.0.1' if host in ('0.0.0.0', '::') else address_host}:{bound_port}"
        typer.echo(f"station:      {base_url}/{'' if token is None else f'?token={token}'}")
        typer.echo(f"experimenter: {base_url}/experimenter?key={guard.key}")
        if not loopback:
            typer.echo(_TLS_INSTRUCTIONS.format(host=host, port=bound_port))
        typer.echo(f"records:      {data}; Ctrl-C ends the server, and acknowledged records are on the disk")

    app.serve_experiment(options, host, port, print_addresses)


def _read_token(option_token: str | None, file: Path | None) -> str | None:
    """Return the token from its option, environment variable, or file."""
    if file is None:
        return option_token
    if option_token is not None:
        raise InputError("--token (or HOLDFAST_TOKEN) and --token-file both give a token; give one of them")
    with reading.guard_reading(f"--token-file: '{file}'"), file.open("rb") as stream:
        first_line = stream.readline(1000)
    try:
        return first_line.decode("ascii").strip()
    except UnicodeDecodeError as error:
        raise InputError(f"--token-file: the first line of '{file}' is not text; write the token there") from error


def texts(write: Annotated[Path | None, "File for a copy of the texts, to be translated."] = None) -> None:
    """Print or copy the page texts for translation.

    'holdfast teleop serve --texts FILE' uses the translation.

    Example: holdfast teleop texts --write de.yaml
    """
    from holdfast.teleop.serve import texts as of_page

    if write is not None:
        typer.echo(f"written: {of_page.copy_english_texts(write)}")
        return
    page_texts = of_page.load_texts()
    forms = ", ".join(str(form["name"]) for form in page_texts.forms)
    typer.echo(f"{len(page_texts.strings)} texts in English; forms: {forms}")
