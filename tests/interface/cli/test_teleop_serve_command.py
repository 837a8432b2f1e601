"""``holdfast teleop serve``: what it begins, opens and refuses, and what it prints."""

import builtins
import socket

import pytest

from holdfast.teleop.protocol.protocol import read_protocol
from holdfast.teleop.records.records import Records
from holdfast.teleop.serve import app, texts


@pytest.fixture
def served(monkeypatch):
    """The calls of the server, which does not start."""
    calls = []

    def serve(options, host, port, ready):
        app.open_or_create(options.folder, options.protocol)
        calls.append((options, host, port))
        ready(port or 4711)

    monkeypatch.setattr(app, "serve_experiment", serve)
    return calls


def test_a_new_folder_begins_an_experiment(cli, served, tmp_path):
    code, text, err = cli("teleop", "serve", "--data", tmp_path / "experiment", "--port", "0", "--tlx")
    assert (code, err) == (0, "")
    ((options, host, port),) = served
    assert (host, port, options.tlx, options.guard.token, options.guard.loopback) == ("127.0.0.1", 0, True, None, True)
    assert "station:      http://127.0.0.1:4711/\n" in text
    assert f"experimenter: http://127.0.0.1:4711/experimenter?key={options.guard.key}\n" in text
    with Records.open(tmp_path / "experiment") as records:
        assert records.protocol.to_yaml() == read_protocol().to_yaml()
    again = cli("teleop", "serve", "--data", tmp_path / "experiment", "--protocol", "goel2003")
    assert again[0] == 0
    assert served[1][0].guard.key != options.guard.key


def test_other_computers_need_the_token(cli, served, tmp_path):
    call = ["teleop", "serve", "--data", tmp_path / "experiment", "--host", "0.0.0.0", "--token", "k3vR-9fQzT1m"]
    code, text, _ = cli(*call)
    assert code == 0
    assert "/?token=k3vR-9fQzT1m\n" in text
    assert "caddy reverse-proxy" in text
    assert served[0][0].guard.loopback is False


def test_the_token_need_not_stand_in_the_list_of_processes(cli, served, tmp_path, monkeypatch):
    (tmp_path / "token").write_text("k3vR-9fQzT1m\n# of the laboratory\n")
    assert cli("teleop", "serve", "--data", tmp_path / "experiment", "--token-file", tmp_path / "token")[0] == 0
    monkeypatch.setenv("HOLDFAST_TOKEN", "x7Pq-2LmWb8c")
    assert cli("teleop", "serve", "--data", tmp_path / "experiment")[0] == 0
    assert [options.guard.token for options, _, _ in served] == ["k3vR-9fQzT1m", "x7Pq-2LmWb8c"]


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (["--host", "0.0.0.0"], "add --token-file"),
        (["--host", "192.168.1.4"], "add --token-file"),
        (["--token", "short"], "12 to 128"),
        (["--token", "aaaaaaaaaaaa"], "easily guessed"),
        (["--token-file", "none"], "'none' cannot be read"),
        (["--token-file", "none", "--token", "k3vR-9fQzT1m"], "give one of them"),
        (["--protocol", "none.yaml"], "none.yaml"),
        (["--port", "70000"], "port"),
        ([], "--data"),
    ],
)
def test_bad_calls_get_one_sentence(refused, served, tmp_path, monkeypatch, call, sentence):
    monkeypatch.chdir(tmp_path)
    data = ["--data", "experiment"] if call else []
    assert sentence in refused("teleop", "serve", *data, *call)
    assert not list(tmp_path.iterdir())
    assert not served


def test_another_protocol_is_refused(refused, served, tmp_path):
    Records.create(tmp_path / "experiment", read_protocol()).close()
    call = ["teleop", "serve", "--data", tmp_path / "experiment", "--protocol", "goel2003-smooth"]
    assert "another protocol" in refused(*call)
    (tmp_path / "used").mkdir()
    (tmp_path / "used" / "x").touch()
    assert "not an empty folder" in refused("teleop", "serve", "--data", tmp_path / "used")


def test_a_port_in_use_is_one_sentence(refused, tmp_path):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        assert "choose another port" in refused("teleop", "serve", "--data", tmp_path / "experiment", "--port", port)


def test_without_the_extra_it_says_what_to_install(refused, tmp_path, monkeypatch):
    import sys

    real = builtins.__import__

    def missing(name, *rest):
        if name.split(".")[0] in ("starlette", "uvicorn"):
            raise ModuleNotFoundError(f"No module named '{name}'", name=name.split(".")[0])
        return real(name, *rest)

    for name in [n for n in sys.modules if n.startswith("holdfast.teleop.serve")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setattr(builtins, "__import__", missing)
    assert "pip install 'holdfast-arms[teleop]'" in refused("teleop", "serve", "--data", tmp_path / "experiment")
    assert not list(tmp_path.iterdir())


def test_texts_are_copied_to_translate(cli, refused, tmp_path, monkeypatch):
    english = tmp_path / "en.yaml"
    english.write_text("title: x\nforms:\n- {name: consent, title: x, text: x, submit: x, questions: []}\n")
    monkeypatch.setattr(texts, "ENGLISH_FILE", english)
    monkeypatch.setattr(texts.load_texts, "__defaults__", (None, english))
    code, text, _ = cli("teleop", "texts")
    assert (code, text) == (0, "1 texts in English; forms: consent\n")
    assert cli("teleop", "texts", "--write", tmp_path / "de.yaml")[0] == 0
    assert (tmp_path / "de.yaml").read_text() == english.read_text()
    assert "exists already" in refused("teleop", "texts", "--write", tmp_path / "de.yaml")


def test_run_without_simulated_people_says_where_people_go(refused, tmp_path):
    assert "holdfast teleop serve" in refused("teleop", "run", "--out", tmp_path / "x")
