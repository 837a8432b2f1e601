"""Translation of C99 with loops to JavaScript, so that a search that is written in C runs in a browser as well.

The translation has the forms of ``c/damping_search.c``: enumerations, tables of small integers, structures of ``double``, and
static functions with loops and choices. It does not convert values, so variables of type ``int`` must be assigned whole
numbers, a quotient must have an operand of type ``double``, and a condition must not be NaN.
"""

from __future__ import annotations

import re
from collections.abc import Collection

from holdfast.core.errors import KernelError

_ITEM_PATTERN = re.compile(
    r"enum\{(?P<constants>[^{}]*)\};"
    r"|static const unsigned char (?P<table>\w+)[^=;{}]*=(?P<rows>\{[\d{},]*\});"
    r"|typedef struct\{double (?P<members>[^;{}]*);\}(?P<structure>\w+);"
    r"|static \w+ (?P<function>\w+)\((?P<arguments>[^)]*)\)\{(?P<body>.*?)\}(?=static |enum\{|typedef |$)"
)
_JAVASCRIPT_NAMES = {"fabs": "Math.abs", "sqrt": "Math.sqrt", "exp": "exponential", "log": "logarithm", "copysign": "copySign"}
_JAVASCRIPT_NAMES["HUGE_VAL"] = "Infinity"
_SHARED_KEYWORDS = {"for", "if", "else", "while", "break", "continue", "return", "let"}
_RESERVED_NAMES = """
in new let var this null true false class super function delete typeof instanceof with yield await try catch finally throw
import export debugger arguments eval Array Math Infinity
"""
_ASSIGNMENT_PATTERN = r"(?:[-+*/|]?=(?!=)|\+\+|--)"
_UNKNOWN_OPERATOR = r"""<<|>>|[]]\.\w+[-+*/|]?=(?!=)|->|--|!(?!=)|[%~^#"'\\@$`]|(?<!&)&(?!&)|(?<!\|)\|(?![|=])"""


def translate_c_to_javascript(text: str) -> str:
    """Translate static C99 functions to constants of JavaScript, one line each.

    Pointers and arrays of ``double`` become ``Float64Array``, also a pointer to a single number. Local arrays, and structures
    that contain arrays, are made once and kept, so a function must not call itself. ``exponential``, ``logarithm``, and
    ``copySign`` are those of :func:`holdfast.kernels.javascript.functions.define_functions`.

    Raises:
        KernelError: The text has a form that the translation does not have; the message quotes it.
    """
    text = re.sub(r"\s+", " ", re.sub(r"(?s)/\*.*?\*/", "", text)).strip()
    if signs := re.search(r"- -|\+ \+", text):
        raise _make_refusal(signs[0], "the text")
    text = re.sub(r"(?<!\w) | (?!\w)", "", text)
    names, integers, lines, position = set(_JAVASCRIPT_NAMES), set[str](), list[str](), 0
    structures: dict[str, dict[str, str]] = {}
    while position < len(text):
        item = _ITEM_PATTERN.match(text, position)
        if item is None:
            raise _make_refusal(text[position : position + 40], "the text")
        position = item.end()
        if item["constants"]:
            integers |= {name for name, _, _ in _read_declarators(item["constants"])}
            lines.append(f"const {item['constants']};")
        elif item["table"]:
            names.add(item["table"])
            lines.append(f"const {item['table']}={item['rows'].translate(str.maketrans('{}', '[]'))};")
        elif item["structure"]:
            structures[item["structure"]] = {name: sizes for name, sizes, _ in _read_declarators(item["members"])}
        else:
            names.add(item["function"])
            lines.append(_translate_function(item, structures, names, integers))
    return "\n".join(lines) + "\n"


def _make_refusal(form: str, place: str) -> KernelError:
    return KernelError(
        f"C has '{form}' in {place}, which the translation to JavaScript does not have; write it with the forms of "
        "holdfast/control/laws/c/damping_search.c"
    )


def _translate_function(
    item: re.Match[str], structures: dict[str, dict[str, str]], names: Collection[str], integers: Collection[str]
) -> str:
    """Return a function as a constant, for known names of functions and tables, and of integer constants."""
    function, body = item["function"], item["body"]
    arrays, records, whole = set[str](), set[str](), set(integers)
    arguments, kept = list[str](), list[str]()
    types = "|".join(["double", "int", *structures])
    large = [key for key, members in structures.items() if any(members.values())]  # structures with arrays
    for argument in item["arguments"].split(","):
        match = re.fullmatch(rf"(?:const )?({types})(\*(?:restrict )?| )(\w+)", argument)
        if match is None or (match[1] in large and match[2] == " "):
            raise _make_refusal(argument, function)
        arguments.append(match[3])
        group = arrays if match[2] != " " else whole if match[1] == "int" else records if match[1] != "double" else set()
        group.add(match[3])

    def declare(match: re.Match[str]) -> str:
        kind, members, variables, clearing = match[1], structures.get(match[1], {}), list[str](), ""
        for name, sizes, value in _read_declarators(match[2]):
            arguments.append(name)
            if sizes or kind in large:
                if name in arrays or value.strip("{},0") or (value and sizes and members):
                    raise _make_refusal(match[0], function)
                arrays.add(name)
                kept.append(f"{name}={_make_variable(sizes, members)}")
                parts = {name: sizes} if sizes else {f"{name}.{member}": size for member, size in members.items()}
                clearing += "".join(map(_clear_variable, parts, parts.values())) if value else ""
            else:
                (whole if kind == "int" else records if members else set()).add(name)
                variables.append(f"{name}={value or _make_variable('', members)}")
        return clearing + (f"let {','.join(variables)};" if variables else "")

    count = len(arguments)
    for name in set(re.findall(rf"(?<![\w.>])(\w+)\.\w+{_ASSIGNMENT_PATTERN}", body)):
        if name in arguments or re.search(rf"[=(,?:]{name}\b(?!\.)|\b{name}=(?!=)(?!\{{)", body):
            raise _make_refusal(f"{name}.member = ", function)  # JavaScript would change the copies of the structure, too
    body = re.sub(rf"(?:(?<=[;{{}}(])|^)(?:const )?({types}) ([^;]+);", declare, body)
    body = re.sub(r"(?<![\w)\]])\*(\w+)(?![\w\[.-])", lambda m: f"{m[1]}[0]" if m[1] in arrays else m[0], body)
    body = re.sub(r"(?<=[(,])&(\w+)(?=[,)])", lambda m: m[1] if m[1] in arrays else m[0], body).replace("->", ".")
    whole_names, array_names = ("|".join(sorted(group)) or "(?!)" for group in (whole, arrays))
    unknown = re.search(
        rf"{_UNKNOWN_OPERATOR}|(?<![\w)\]])\*|\w*/(?:{whole_names}|\d+)\b(?!\.)|(?<![\w.])(?:{whole_names})/"
        rf"|(?<![\w.])(?:{array_names})\b(?![\[.,)])|[-+=](?:{array_names})\b(?![\[.])",
        re.sub(r"let [^;]*;", lambda m: m[0].replace("{", " ").replace(":", " "), body),
    )
    if unknown:
        raise _make_refusal(unknown[0], function)
    members_known = {member for members in structures.values() for member in members}
    known = {
        *names,
        *arguments,
        *integers,
        *members_known,
        *_SHARED_KEYWORDS,
        "Array",
        "length",
        "new",
        "fill",
        "forEach",
        "row",
    }
    words = re.findall(r"(?<![\w.])[A-Za-z_]\w*", body)
    if refused := [*set(_RESERVED_NAMES.split()).intersection(arguments), *(word for word in words if word not in known)]:
        raise _make_refusal(refused[0], function)
    body = re.sub(r"(?<![\w.])[A-Za-z_]\w*", lambda m: _JAVASCRIPT_NAMES.get(m[0], m[0]), body)
    text = f"({','.join(arguments[:count])})=>{{{body}}}"
    return f"const {function}=" + (f"(()=>{{const {','.join(kept)};return {text};}})();" if kept else f"{text};")


def _read_declarators(text: str) -> list[tuple[str, str, str]]:
    """Return name, sizes in brackets, and value of each declarator, which commas outside of brackets separate."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in "([{") - (letter in ")]}")
        parts = [*parts, ""] if letter == "," and depth == 0 else [*parts[:-1], parts[-1] + letter]
    found = [re.fullmatch(r"(\w+)((?:\[[^]]+\])*)(?:=(.+))?", part) for part in parts]
    if not all(found):
        raise _make_refusal(text, "a declaration")
    return [(match[1], match[2], match[3] or "") for match in found if match]


def _make_variable(sizes: str, members: dict[str, str]) -> str:
    """Return the JavaScript of a new array, structure, or number; an array of structures is empty."""
    if sizes:
        outer, _, inner = sizes[1:-1].rpartition("][")
        row = f"new Float64Array({inner})"
        return "[]" if members else f"Array.from({{length:{outer}}},()=>{row})" if outer else row
    return f"{{{','.join(f'{name}:{_make_variable(size, {})}' for name, size in members.items())}}}" if members else "0"


def _clear_variable(name: str, sizes: str) -> str:
    return f"{name}.forEach(row=>row.fill(0));" if "][" in sizes else f"{name}.fill(0);" if sizes else f"{name}=0;"
