"""What the page says, in any language: one YAML file of short texts, and the forms with their questions.

.. code-block:: yaml

    go_on: Continue
    subject: "Code {code}"      # the page puts a value where the braces are
    forms:
      - name: demographics
        title: About you
        text: A few questions, without names.
        questions:
          - {name: hand, kind: choice, label: Which hand?, options: [{value: right, label: right}, {value: left, label: left}]}
        submit: Continue

The English file, ``texts/en.yaml``, says which keys and forms there are; a laboratory may change the questions.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import Field, ValidationError, model_validator

from holdfast.errors import InputError, StoreError
from holdfast.files import reading
from holdfast.files.output import replaced
from holdfast.files.yaml import Number, Strict, content, sentence
from holdfast.teleop.serve.messages import Name

ENGLISH = Path(__file__).with_name("texts") / "en.yaml"
_EXAMPLE = "'holdfast teleop texts --write FILE'"
_PLACE = re.compile(r"\{\w+\}")


@dataclass(frozen=True)
class Texts:
    """The texts of a page.

    Attributes:
        strings: By key.
        forms: The forms, in order, as the page takes them.
    """

    strings: Mapping[str, str]
    forms: tuple[Mapping[str, Any], ...]


class _Option(Strict):
    value: Annotated[str, Field(min_length=1, max_length=200)]
    label: str


class _Question(Strict):
    name: Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]{0,63}$")]
    kind: Literal["choice", "check", "scale", "number", "text"]
    label: str
    help: str | None = None
    optional: bool | None = None
    options: list[_Option] | None = None
    from_: Number | None = Field(None, alias="from")
    to: Number | None = None
    step: Number | None = Field(None, gt=0)
    low: str | None = None
    high: str | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.kind == "choice") != bool(self.options):
            raise ValueError("options belong to a choice, and a choice needs them")
        if self.options and len({o.value for o in self.options}) < len(self.options):
            raise ValueError("two options have the same value; give each another")
        if self.from_ is not None and self.to is not None and not self.from_ < self.to:
            raise ValueError("from must be below to")
        return self


class _Form(Strict):
    name: Name
    title: str
    text: str
    questions: list[_Question]
    submit: str
    decline: str | None = None

    @model_validator(mode="after")
    def _each_once(self) -> Self:
        if len({q.name for q in self.questions}) < len(self.questions):
            raise ValueError("two questions have the same name; give each another")
        return self


class _File(Strict):
    forms: list[_Form]


def read(path: Path | None = None, english: Path = ENGLISH) -> Texts:
    """The texts in a file, or the English ones.

    Args:
        path: A translation; None for English.
        english: Which keys and forms there are.

    Raises:
        InputError: A file that cannot be read, has not the same keys and forms as the English one, or not the same words in
            braces.
    """
    own = _read(english)
    if path is None:
        return own
    given = _read(path)
    _same(path, "key", own.strings, given.strings)
    _same(path, "form", [f["name"] for f in own.forms], [f["name"] for f in given.forms])
    for key, text in given.strings.items():
        wanted, found = (sorted(set(_PLACE.findall(t))) for t in (own.strings[key], text))
        if wanted != found:
            raise InputError(
                f"texts '{path}': {key}: it has {', '.join(found) or 'nothing'} in braces; it must have "
                f"{', '.join(wanted) or 'nothing'}"
            )
    return given


def copy(path: Path) -> Path:
    """Copy the English texts to a file, to translate.

    Raises:
        StoreError: It is there already, or cannot be written.
    """
    if reading.exists(path):
        raise StoreError(f"'{path}' exists already; choose another name")
    replaced(path, ENGLISH.read_bytes())
    return path


def _same(path: Path, what: str, wanted: Iterable[str], given: Iterable[str]) -> None:
    for fault, names in (("not known", set(given) - set(wanted)), ("missing", set(wanted) - set(given))):
        if names:
            first, *others = sorted(names)
            more = f" (and {', '.join(others)})" if others else ""
            raise InputError(f"texts '{path}': the {what} '{first}'{more} is {fault}; {_EXAMPLE} shows them all")


def _read(path: Path) -> Texts:
    try:
        data = content(path, _EXAMPLE, "forms")
        strings = {key: value for key, value in data.items() if key != "forms"}
        for key, value in strings.items():
            if not isinstance(key, str) or not isinstance(value, str):
                raise InputError(f"{key}: {value!r} is not text; put it in quotes")
        model = _File.model_validate({"forms": data.get("forms")})
    except ValidationError as error:
        raise InputError(f"texts '{path}': {sentence(error, _File)}") from error
    except InputError as error:
        raise InputError(f"texts '{path}': {error}") from error
    names = [form.name for form in model.forms]
    if len(set(names)) < len(names):
        raise InputError(f"texts '{path}': forms: two of them have the same name; give each another")
    return Texts(strings, tuple(form.model_dump(by_alias=True, exclude_none=True) for form in model.forms))
