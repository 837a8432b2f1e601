"""Texts of the page, in any language: one YAML file of short texts, and the forms with their questions.

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

The English file, ``texts/en.yaml``, determines the keys and forms; a laboratory may change the questions.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import Field, ValidationError, model_validator

from holdfast.core.errors import InputError, StoreError
from holdfast.core.files import reading
from holdfast.core.files.output import replace_file
from holdfast.core.files.yaml import Number, Strict, describe_validation_error, read_mapping
from holdfast.teleop.serve.messages import Name

ENGLISH_FILE = Path(__file__).with_name("texts") / "en.yaml"
_EXAMPLE_COMMAND = "'holdfast teleop texts --write FILE'"
_PLACEHOLDER_PATTERN = re.compile(r"\{\w+\}")


@dataclass(frozen=True)
class Texts:
    """Texts of a page.

    Attributes:
        strings: Texts by key.
        forms: Forms in order, in the format of the page.
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
    def _check_consistency(self) -> Self:
        if (self.kind == "choice") != bool(self.options):
            raise ValueError("options belong to a choice, and a choice needs them")
        if self.options and len({option.value for option in self.options}) < len(self.options):
            raise ValueError("two options have the same value; give each another")
        if self.from_ is not None and self.to is not None and not self.from_ < self.to:
            raise ValueError("from must be below to")
        return self


class _QuestionForm(Strict):
    name: Name
    title: str
    text: str
    questions: list[_Question]
    submit: str
    decline: str | None = None

    @model_validator(mode="after")
    def _check_unique_names(self) -> Self:
        if len({question.name for question in self.questions}) < len(self.questions):
            raise ValueError("two questions have the same name; give each another")
        return self


class _TextsFile(Strict):
    forms: list[_QuestionForm]


def load_texts(path: Path | None = None, english: Path = ENGLISH_FILE) -> Texts:
    """Load the texts of a file, or the English ones.

    Args:
        path: File of translated texts. None: English.
        english: File of the English texts, which determines the keys and forms.

    Raises:
        InputError: A file cannot be read, or its keys, its forms, or its words in braces differ from those of the English file.
    """
    english_texts = _load_file(english)
    if path is None:
        return english_texts
    translated = _load_file(path)
    _check_same_names(path, "key", english_texts.strings, translated.strings)
    _check_same_names(path, "form", [form["name"] for form in english_texts.forms], [form["name"] for form in translated.forms])
    for key, text in translated.strings.items():
        expected, actual = (
            sorted(set(_PLACEHOLDER_PATTERN.findall(version))) for version in (english_texts.strings[key], text)
        )
        if expected != actual:
            raise InputError(
                f"texts '{path}': {key}: it has {', '.join(actual) or 'nothing'} in braces; it must have "
                f"{', '.join(expected) or 'nothing'}"
            )
    return translated


def copy_english_texts(path: Path) -> Path:
    """Copy the English texts to a file, to translate.

    Raises:
        StoreError: The file exists already, or cannot be written.
    """
    if reading.path_exists(path):
        raise StoreError(f"'{path}' exists already; choose another name")
    replace_file(path, ENGLISH_FILE.read_bytes())
    return path


def _check_same_names(path: Path, kind: str, expected: Iterable[str], actual: Iterable[str]) -> None:
    for fault, names in (("not known", set(actual) - set(expected)), ("missing", set(expected) - set(actual))):
        if names:
            first, *others = sorted(names)
            remainder = f" (and {', '.join(others)})" if others else ""
            raise InputError(f"texts '{path}': the {kind} '{first}'{remainder} is {fault}; {_EXAMPLE_COMMAND} shows them all")


def _load_file(path: Path) -> Texts:
    try:
        data = read_mapping(path, _EXAMPLE_COMMAND, "forms")
        strings = {key: value for key, value in data.items() if key != "forms"}
        for key, value in strings.items():
            if not isinstance(key, str) or not isinstance(value, str):
                raise InputError(f"{key}: {value!r} is not text; put it in quotes")
        document = _TextsFile.model_validate({"forms": data.get("forms")})
    except ValidationError as error:
        raise InputError(f"texts '{path}': {describe_validation_error(error, _TextsFile)}") from error
    except InputError as error:
        raise InputError(f"texts '{path}': {error}") from error
    names = [form.name for form in document.forms]
    if len(set(names)) < len(names):
        raise InputError(f"texts '{path}': forms: two of them have the same name; give each another")
    return Texts(strings, tuple(form.model_dump(by_alias=True, exclude_none=True) for form in document.forms))
