"""Digests of stored JSON documents, so that a changed character is detected before a number is used."""

from __future__ import annotations

import hashlib
import json
from typing import Any

from holdfast.core.errors import InputError

_DIGEST_KEY = ',\n  "digest": "'


def seal_document(data: dict[str, Any]) -> str:
    """Return the text of a JSON object whose last entry is the SHA-256 digest of the text before it."""
    body = json.dumps(data, indent=2, allow_nan=False).removesuffix("\n}")
    return f'{body}{_DIGEST_KEY}{_text_digest(body)}"\n}}\n'


def check_seal(text: str) -> None:
    """Reject a text that differs from the text that :func:`seal_document` returned.

    Raises:
        InputError: The digest is missing or does not match.
    """
    body, key, _ = text.rpartition(_DIGEST_KEY)
    if not key:
        raise InputError("it has no digest, so it was changed, or an early version wrote it")
    if text != f'{body}{_DIGEST_KEY}{_text_digest(body)}"\n}}\n':
        raise InputError("its digest does not match its content; the file was changed after it was written")


def _text_digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
