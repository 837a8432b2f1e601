"""What a page asks the studio, asked without a browser."""

from __future__ import annotations

import http.client
import json
import re
from urllib.parse import urlsplit


class Page:
    """The page at an address of a studio."""

    def __init__(self, url: str) -> None:
        self.host, self.path = urlsplit(url).netloc, urlsplit(url).path or "/"
        status, self.headers, content = self.request("GET", self.path)
        assert status == 200, content
        self.html = content.decode()
        section = self.html.partition('class="arm-data" hidden>')[2]
        self.data = json.loads(re.search(r'<script type="application/json">(.*?)</script>', section, re.DOTALL)[1])
        self.state, self.token = self.data["studio"]["state"], self.data["studio"]["token"]

    def request(self, method: str, path: str, content: bytes | None = None, **headers: str) -> tuple[int, dict, bytes]:
        connection = http.client.HTTPConnection(self.host, timeout=120)
        connection.request(method, path, content, {name.replace("_", "-"): text for name, text in headers.items()})
        answer = connection.getresponse()
        found = answer.status, dict(answer.headers), answer.read()
        connection.close()
        return found

    def post(self, question: str, body: object, **headers: str) -> tuple[int, list]:
        """Status and messages that answer a question."""
        content = body if isinstance(body, bytes) else json.dumps(body).encode()
        status, _, answer = self.request(
            "POST", f"{self.path}answer/{question}", content, **({"X_Token": self.token} | headers)
        )
        return status, [json.loads(line) for line in answer.splitlines()]

    def ask(self, question: str, file: dict | None = None, ghosts=(), **changes: object):
        """The answer to a question about the first view of the page with these changes, or its error."""
        _, messages = self.post(question, {"state": self.state | changes, "file": file, "ghosts": list(ghosts)})
        return messages[-1].get("answer", messages[-1].get("error"))
