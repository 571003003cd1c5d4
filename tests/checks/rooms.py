#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The include direction: a room of engine/ or bindings/ sees itself and the rooms listed for it, and no other.

Reads the #include lines of every source and header, nothing cleverer. Complains about a room that includes one it does not
see, about a circle (of rooms in the list, of folders, of files, or of sources with their headers), about Lua in the engine, and about
an include by anything but its path from the project's folder. docs/contributor.md has the table of the rooms, as they include each other.

usage: rooms.py [FOLDER]          check the project in FOLDER (default: the one this file stands in)
       rooms.py --draw [FOLDER]   write the table into docs/contributor.md
"""
import pathlib
import re
import sys

NUMERICS = "engine/core engine/statistics engine/surface"
MECHANICS = NUMERICS + " engine/contact engine/friction engine/accuracy engine/specimen"
ENGINE = MECHANICS + " engine/metrology engine/plot engine/recording engine/run engine/study"
# Each sees those before it; the list of modules and the root of the language, bindings/lua itself, sees all.
LUA_ROOMS = ("registry", "runtime", "run", "surface", "metrology", "contact", "friction", "specimen", "study", "ensemble",
             "spread", "editor")
IN_LUA = " ".join([ENGINE, *(f"bindings/lua/{room}" for room in LUA_ROOMS)])

# Each room, with the rooms it sees.
SEES = {
    "engine/core": "",
    "engine/statistics": "engine/core",
    "engine/surface": "engine/core engine/statistics",
    "engine/metrology": NUMERICS,
    "engine/contact": NUMERICS,
    "engine/plot": NUMERICS,
    "engine/accuracy": NUMERICS + " engine/contact",
    "engine/friction": NUMERICS + " engine/contact",
    "engine/specimen": NUMERICS + " engine/contact engine/friction engine/accuracy",
    "engine/recording": MECHANICS + " engine/plot",
    "engine/run": NUMERICS + " engine/plot engine/contact/scene/known_effects.hpp",
    "engine/study": ENGINE.removesuffix(" engine/study"),
} | {f"bindings/lua/{room}": " ".join([ENGINE, *(f"bindings/lua/{below}" for below in LUA_ROOMS[:k])])
     for k, room in enumerate(LUA_ROOMS)} | {
    "bindings/lua": IN_LUA,
    "bindings/cli": IN_LUA + " bindings/lua",
    "bindings/web": IN_LUA + " bindings/lua bindings/cli",
    "bindings": IN_LUA + " bindings/lua bindings/cli bindings/web",  # main.cpp, the list of commands
}
# Circles of sources with their headers that may stay: names without .hpp and .cpp.
KNOTS = ("engine/study/calibrate engine/study/calibration_problem",
         "bindings/lua/study/asked_function bindings/lua/study/study",
         "bindings/lua/registry/dry_run bindings/lua/registry/guard")
LUA = re.compile(r"(^|/)(lua|luaconf|lualib|lauxlib)\.(h|hpp)$")
INCLUDE = re.compile(r"^[ \t]*#[ \t]*include\s*(?:\"([^\"]*)\"|<([^>]*)>|(.*))", re.M)
BEGIN, END = "<!-- rooms: tests/checks/rooms.py --draw -->\n", "<!-- /rooms -->\n"


def room_of(path):
    """The longest room that the path lies in; empty where there is none."""
    return max((room for room in SEES if path.startswith(room + "/")), key=len, default="")


def sees(room, target):
    return room_of(target) == room or any(
        room_of(target) == seen or target == seen for seen in SEES[room].split())


def includes(text):
    """(line, target in quotes or None, target in angles or None) of each #include."""
    return [(text.count("\n", 0, found.start()) + 1, found[1], found[2]) for found in INCLUDE.finditer(text)]


def complaints_of(path, text):
    room = room_of(path)
    if not room:
        yield f"{path}: lies in no room that this check knows"
        return
    for line, quoted, angled in includes(text):
        target = quoted or angled
        place = f"{path}:{line}: "
        if target is None:
            yield place + "this check cannot read the name included here"
        elif room.startswith("engine/") and LUA.search(target):
            yield place + f"the engine does not know Lua, and this includes {target}"
        elif quoted is None:
            if re.match(r"(engine|bindings|tests|bench)/", target):
                yield place + f"include {target} in quotes"
        elif not room_of(target):
            yield place + f"include {target} by its path from the project folder, below engine/ or bindings/"
        elif not sees(room, target):
            yield place + f"{room} does not see {room_of(target)}, and this includes {target}"


def circle(graph):
    """The nodes of a circle in order, the first again at the end; empty where there is none."""
    state, trail = {}, []

    def visit(node):
        state[node] = 1
        trail.append(node)
        for target in graph.get(node, ()):
            if state.get(target) == 1:
                return trail[trail.index(target):] + [target]
            if target not in state and (found := visit(target)):
                return found
        state[node] = 2
        trail.pop()
        return []

    for node in graph:
        if node not in state and (found := visit(node)):
            return found
    return []


def knot(headers):
    """A circle of sources with their headers that KNOTS does not name; empty where there is none."""
    stems = {}
    for path, targets in headers.items():
        here = path.rpartition(".")[0]
        stems.setdefault(here, set()).update({target.rpartition(".")[0] for target in targets} - {here})
    for allowed in (set(names.split()) for names in KNOTS):
        for stem in allowed & stems.keys():
            stems[stem] -= allowed
    return circle({stem: sorted(targets) for stem, targets in stems.items()})


def drawn(sources):
    """A table of the rooms, each with the rooms that it includes, without those that follow from others."""
    edges = {room: set() for room in SEES}
    for path, text in sources.items():
        for _, quoted, _ in includes(text):
            if quoted and room_of(quoted) not in ("", room_of(path)):
                edges[room_of(path)].add(room_of(quoted))

    def below(room, seen):
        for target in edges[room] - seen:
            seen.add(target)
            below(target, seen)
        return seen

    lines = ["| room | includes |", "|---|---|"]
    for room in SEES:
        beyond = set().union(*(below(target, set()) for target in edges[room]))
        lines.append(f"| {room} | {', '.join(sorted(edges[room] - beyond))} |")
    return "\n".join(lines) + "\n"


def main(arguments):
    draw = "--draw" in arguments
    given = [argument for argument in arguments if argument != "--draw"]
    folder = pathlib.Path(given[0]) if given else pathlib.Path(__file__).resolve().parents[2]
    sources = {path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8")
               for top in ("engine", "bindings") for path in sorted((folder / top).rglob("*"))
               if path.suffix in (".cpp", ".hpp", ".h") and "node_modules" not in path.parts}
    if not sources:
        return ["no file of engine/ or bindings/ was found"]
    page = folder / "docs" / "contributor.md"
    words = page.read_text(encoding="utf-8")
    before, begin, rest = words.partition(BEGIN)
    old, end, after = rest.partition(END)
    if draw:
        page.write_text(before + begin + drawn(sources) + end + after, encoding="utf-8")
        return []
    found = [complaint for path, text in sources.items() for complaint in complaints_of(path, text)]
    listed = {room: [seen for seen in sees.split() if seen in SEES] for room, sees in SEES.items()}
    if rooms := circle(listed):
        found.append("rooms see each other in a circle: " + " -> ".join(rooms))
    headers = {path: [quoted for _, quoted, _ in includes(text) if quoted in sources]
               for path, text in sources.items()}
    if files := circle(headers):
        found.append("files include each other in a circle: " + " -> ".join(files))
    if files := knot(headers):
        found.append("sources and their headers include each other in a circle: " + " -> ".join(files))
    folders = {}
    for path, targets in headers.items():
        here = path.rpartition("/")[0]
        folders.setdefault(here, set()).update({target.rpartition("/")[0] for target in targets} - {here})
    if around := circle(folders):
        found.append("folders include each other in a circle: " + " -> ".join(around))
    if old != drawn(sources):
        found.append("docs/contributor.md: the table of the rooms is old: tests/checks/rooms.py --draw")
    if not found:
        print(f"{len(sources)} files include only their own room and those it sees")
    return found


if __name__ == "__main__":
    complaints = main(sys.argv[1:])
    print("\n".join(complaints), end="\n" if complaints else "")
    sys.exit(1 if complaints else 0)
