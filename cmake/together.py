#!/usr/bin/env python3
"""Which sources of a target can be compiled as one: together.py MOST FILE... prints "GROUP FILE" a line.
together.py --program FILE... says what keeps sources from being linked as one (names that two of them give to all).

Sources meet in a group of at most MOST when none of them can see what another keeps for itself: names that one has at the
level of the file (in an anonymous namespace, static, aliases of namespaces) are no word of the others, but for members and
words with a namespace before them, nor a name of the project's headers that others read; and what one opens (using) those
after it open, too: so each source means what it means alone. Sources with macros of their own stay alone, group 0, as do those
that fit nowhere. Sources of a group come in their order.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
HEADERS, NAMES = {}, {}  # read once

NO_CODE = re.compile(r'R"(\w*)\(.*?\)\1"|'
                     r"'(?:[^'\\\n]|\\.)'|"
                     r'"(?:[^"\\\n]|\\.)*"|//[^\n]*|/\*.*?\*/', re.S)
UNQUALIFIED = re.compile(r"(?<![\w.:>])[A-Za-z_]\w*|(?<=[^-]>)[A-Za-z_]\w*")
TYPE = re.compile(r"^(?:template\s*<[^;{}]*?>\s*)?(?:struct|class|enum class|enum|union|concept)\s+(?:alignas\(\w+\)\s*)?(\w+)", re.M)
OTHER = re.compile(r"^(?!struct|class|enum|union|using|namespace|concept|TEST|INSTANTIATE)[A-Za-z_][^(={;]*?\b(\w+)\s*(?:\[[^\]=;]*\]\s*)*[(={;]", re.M)
SEVERAL = re.compile(r"^(?:(?:static|inline|const|constexpr)\s)[^;{]*;", re.M)
ENUMERATORS = re.compile(r"^enum\s+(?!class)[^{;]*\{([^}]*)\}", re.M)
ALIAS = re.compile(r"^(?:namespace|using)\s+(\w+)\s*=([^;]+);", re.M)
STATIC = re.compile(r"^(?:static|constexpr|const|inline)\b[^;{]*[;{=(]", re.M)
NOISE = {"if", "for", "while", "switch", "return", "operator", "static_assert", "noexcept"}


def names_of(text):
    return {name for rule in (TYPE, OTHER) for name in rule.findall(text)} | {
        word for names in ENUMERATORS.findall(text) for word in re.findall(r"\w+", names)} | {
        word for names in SEVERAL.findall(text) for word in re.findall(r"(\w+)(?:\[[^\]]*\])*\s*=[^=]", names)}


BRACE = re.compile(r"[{}]")
TEST = re.compile(r"^TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", re.M)


def parted(text):
    """What is in anonymous namespaces, and what is not."""
    inside, outside, end = [], [], 0
    for found in re.finditer(r"^namespace \{", text, re.M):
        if found.start() < end:
            continue
        outside.append(text[end:found.start()])
        depth, end = 1, found.end()
        while depth and (brace := BRACE.search(text, end)):
            depth += 1 if brace[0] == "{" else -1
            end = brace.end()
        inside.append(text[found.end():end])
    return "".join(inside), "".join(outside) + text[end:]


def code_of(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        text = file.read()
    includes = re.findall(r'^\s*#\s*include\s+"([^"]+)"', text, re.M)
    return NO_CODE.sub(lambda found: '""' if found[0][0] in "\"R'" else " ", text), includes


def names_of_headers(includes, folder, seen):
    """What the project's headers among `includes` and those that they include bring; `seen` are all of them."""
    names = set()
    for include in includes:
        path = next((path for path in (ROOT / include, folder / include) if path.is_file()), None)
        if path and path not in seen:
            seen.add(path)
            text, further = HEADERS.get(path) or HEADERS.setdefault(path, code_of(path))
            names |= NAMES.get(path) or NAMES.setdefault(path, names_of(text))
            names |= names_of_headers(further, path.parent, seen)
    return names


def read(path):
    text, includes = code_of(path)
    brought = names_of_headers(includes, pathlib.Path(path).resolve().parent, set()) - NOISE
    same = dict(ALIAS.findall(text))  # may be said twice
    hidden = set(same)
    inside, rest = parted(text)
    hidden |= names_of(inside)
    for outside in STATIC.findall(rest):
        hidden |= names_of(outside)
    hidden -= NOISE
    given = names_of(rest) - hidden - NOISE | {".".join(test) for test in TEST.findall(text)}
    return {"path": path, "brought": brought, "hidden": hidden, "same": same, "given": given, "words": hidden | set(UNQUALIFIED.findall(text)),
            "opened": set(re.findall(r"^using\s+([\w: ]+);", text, re.M)),
            "alone": bool(re.search(r"^\s*#\s*(define|undef|pragma)\b", text, re.M))}


def fits(file, group, most):
    met = group["hidden"] & file["words"] | file["hidden"] & group["words"]
    met |= (group["brought"] - file["brought"]) & file["hidden"] | (file["brought"] - group["common"]) & group["hidden"]
    # What one opens, those after it see: so each opens at least what those before it do.
    return (len(group["files"]) < most and group["opened"] <= file["opened"]
            and all(name in file["same"] and file["same"][name] == group["same"].get(name) for name in met))


def groups_of(files, most):
    groups = []
    for file in sorted(files, key=lambda file: len(file["opened"])):
        group = next((group for group in groups if not file["alone"] and fits(file, group, most)), None)
        if group is None:
            group = {"files": [], "hidden": set(), "words": set(), "same": {}, "brought": set(), "common": None}
            groups.append(group)
        group["files"].append(file["path"])
        group["hidden"] |= file["hidden"]
        group["words"] |= file["words"]
        group["brought"] |= file["brought"]
        group["common"] = file["brought"] if group["common"] is None else group["common"] & file["brought"]
        group["same"] |= file["same"]
        group["opened"] = file["opened"] if not file["alone"] else {"nothing else"}
    return [group["files"] for group in groups]


def clashes_of(files):
    first = {}
    for file in files:
        for name in sorted(file["given"]):
            if first.setdefault(name, file["path"]) != file["path"]:
                yield f"{name}: {first[name]} and {file['path']} both have it; put it into an anonymous namespace"


def main():
    if sys.argv[1] == "--program":
        clashes = list(clashes_of([read(path) for path in sys.argv[2:]]))
        print(*clashes, sep="\n")
        sys.exit(bool(clashes))
    number = 0
    for files in groups_of([read(path) for path in sys.argv[2:]], int(sys.argv[1])):
        number += len(files) > 1
        for path in files:
            print(number if len(files) > 1 else 0, path)


if __name__ == "__main__":
    main()
