"""What the page says, in any language: one YAML file of short texts, and the questions of its forms.

.. code-block:: yaml

    begin.title: Welcome
    begin.button: Continue
    forms:
      - name: consent
        title: Consent

The file that comes with holdfast, ``texts/en.yaml``, is the English one, and says which keys there are.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from holdfast.errors import InputError, StoreError
from holdfast.yaml_file import content

ENGLISH = Path(__file__).with_name("texts") / "en.yaml"
_EXAMPLE = "'holdfast teleop texts --write FILE'"


@dataclass(frozen=True)
class Texts:
    """The texts of a page.

    Attributes:
        strings: By key.
        forms: The forms, in order, as the page takes them.
    """

    strings: Mapping[str, str]
    forms: tuple[Mapping[str, Any], ...]


def read(path: Path | None = None, english: Path = ENGLISH) -> Texts:
    """The texts in a file, or the English ones.

    Args:
        path: A translation; None for English.
        english: Which keys there are.

    Raises:
        InputError: A file that cannot be read, or has not the same keys as the English one.
    """
    own = _read(english)
    if path is None:
        return own
    try:
        given = _read(path)
    except InputError as error:
        raise InputError(f"texts '{path}': {error}") from error
    for fault, keys in (
        ("is not known", given.strings.keys() - own.strings.keys()),
        ("is missing", own.strings.keys() - given.strings.keys()),
    ):
        if keys:
            first, *others = sorted(keys)
            more = f", and so are {', '.join(others)}" if others and fault == "is missing" else ""
            raise InputError(f"texts '{path}': the key '{first}' {fault}{more}; the keys are those of {_EXAMPLE}")
    return given


def copy(path: Path) -> Path:
    """Copy the English texts to a file, to translate.

    Raises:
        StoreError: It is there already, or cannot be written.
    """
    try:
        with path.open("xb") as file:
            file.write(ENGLISH.read_bytes())
    except FileExistsError:
        raise StoreError(f"'{path}' exists already; choose another name") from None
    except OSError as error:
        raise StoreError(f"cannot write '{path}': {error.strerror or error}; choose another path") from error
    return path


def _read(path: Path) -> Texts:
    data = content(path, _EXAMPLE, "forms")
    forms = data.pop("forms", None)
    if not isinstance(forms, list) or not all(isinstance(f, dict) and isinstance(f.get("name"), str) for f in forms):
        raise InputError("forms: it must be a list of forms, each with a name")
    for key, value in data.items():
        if not isinstance(key, str) or not isinstance(value, str):
            raise InputError(f"{key}: {value!r} is not text; put it in quotes")
    return Texts(data, tuple(forms))
