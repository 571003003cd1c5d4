#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which checks a change calls for, from the paths it touches.

usage: select_checks.py [--since COMMIT] [--why]    the paths of the difference from COMMIT; without it from the commit in .ci/checked
       select_checks.py --paths PATH..              these paths
       select_checks.py --everything

Prints a line for each part of .ci/run: `release`, `sanitize` and `thread` with a regular expression of CTest's names, and
`sanitize_targets`, `thread_targets`, `fuzz`, `packages`, `newcomer`, `wasm`, `selection` with words. An empty word means: not at all. `wasm` is `node` for the program under
node, `page` for the page in Chromium too.
Where the difference is not known, everything is called for.
"""
import argparse
import functools
import os
import re
import subprocess
import sys

sys.dont_write_bytecode = True
import base as recorded  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# Rooms and those they are built on, as CMake links them.
CORE = ("engine/core",)
STATISTICS = CORE + ("engine/statistics",)
SURFACE = STATISTICS + ("engine/surface",)
METROLOGY = SURFACE + ("engine/metrology",)
CONTACT = SURFACE + ("engine/contact",)
PLOT = SURFACE + ("engine/plot",)
FRICTION = CONTACT + ("engine/friction",)
SPECIMEN = FRICTION + ("engine/accuracy", "engine/specimen")
RUN = CONTACT + ("engine/plot", "engine/run")
RECORDING = SPECIMEN + ("engine/plot", "engine/recording")
STUDY = RECORDING + ("engine/metrology", "engine/run", "engine/study")
LUA = STUDY + ("bindings/lua", "scripts")
PROGRAM = LUA + ("bindings/cli", "bindings/main")
WEB = PROGRAM + ("bindings/web",)

# Tests of CTest: what their names begin with, the rooms they are made of, and where they stand.
GROUPS = {
    "core": ("core: ?", CORE, ("tests/core",)),
    "statistics": ("statistics: ?", STATISTICS, ("tests/statistics",)),
    "surface": ("surface: ?", SURFACE, ("tests/surface",)),
    "metrology": ("metrology: ?", METROLOGY, ("tests/metrology",)),
    "contact": ("contact: ?", CONTACT + ("engine/accuracy",), ("tests/contact",)),
    "friction": ("friction: ?", FRICTION + ("engine/metrology",), ("tests/friction",)),
    "plot": ("plot: ?", PLOT, ("tests/plot",)),
    "accuracy": ("accuracy: ?", SPECIMEN, ("tests/accuracy",)),
    "specimen": ("specimen: ?", SPECIMEN, ("tests/specimen",)),
    "run": ("run: ?", RUN, ("tests/run",)),
    "recording": ("recording: ?", RECORDING, ("tests/recording",)),
    "study": ("study: ?", STUDY, ("tests/study",)),
    "bindings": ("bindings(_c)?: ?", LUA, ("tests/bindings",)),
    "web": ("web: ?", WEB, ("tests/web",)),
    "laboratory": ("laboratory: ", SPECIMEN + ("engine/metrology",), ("tests/laboratory",)),
    "distributions": ("distributions: ", SPECIMEN, ("tests/accuracy/distributions",)),
    "stability": ("stability: ?", PROGRAM, ("tests/stability",)),
    "fuzz": ("fuzz: ", LUA, ("tests/fuzz",)),
    "scripts": ("(scripts|module): ", PROGRAM, ("tests/scripts", "tests/card")),
    "command_line": ("command line: ?(CommandLine|replay|knobs|prompt|completion|shard|resume|run directory|whole record|fixed order|power cut|processors)", PROGRAM + ("bindings/web/serve_command",), ("tests/scripts/runner",)),
    "ranks": ("command line: (ranks|spread)", (), ("tests/scripts/runner/ranks.sh", "tests/scripts/runner/spread.sh")),
    "reproductions": ("(reproductions|known to fail): ", WEB + ("docs", "examples/paper", "README.md"),
                      ("tests/reproductions", "tests/known_to_fail")),
    "examples": ("examples: ", PROGRAM, ("examples",)),
    "lessons": ("lessons: ", PROGRAM, ("scripts/lessons",)),
    "serve": ("(serve|confined run|plain streams): ", ("bindings/lua", "bindings/cli", "bindings/main", "bindings/web", "scripts"), ("tests/web",)),
    "page": ("page:", ("bindings/web", "scripts/lessons", "engine/plot/palette"), ("tests/page",)),
    "package": ("package: ", STUDY, ("tests/package", "examples/library")),
    "worked": ("worked examples: ?", CONTACT + ("docs/contributor.md",), ("tests/contributor",)),
    "guards": ("guards: ", PROGRAM + ("docs/asperity.d.lua", "examples/data", "tests/data", "tests/fuzz/corpus"), ("tests/guards",)),
    "mistakes": ("mistakes: ", (), ("tests/mistakes",)),
    "checks": ("checks:", PROGRAM, ("tests/checks", "docs", "examples", "bench", "tests")),
}

# What is compiled again with sanitizers for a change: the programs of tests that belong to a room, and only those.
# The rooms above meet the change in the release build's tests.
SANITIZED = {
    "core": ("engine/core",),
    "statistics": ("engine/statistics",),
    "surface": ("engine/surface",),
    "metrology": ("engine/metrology",),
    "contact": ("engine/contact",),
    "friction": ("engine/friction",),
    "plot": ("engine/plot",),
    "accuracy": ("engine/accuracy",),
    "specimen": ("engine/specimen",),
    "run": ("engine/run",),
    "recording": ("engine/recording",),
    "study": ("engine/study",),
    "bindings": ("bindings/lua",),
    "web": ("bindings/web",),
    "dignity": ("engine/contact", "engine/accuracy", "engine/specimen"),
}
SANITIZED_NAMES = {"bindings": "bindings_c: shard", "dignity": "stability: shard"}
SANITIZED_TARGETS = {"bindings": ("test_bindings_c",)}
# What the thread sanitizer watches of them: the targets of the preset `thread`.
THREADED = ("core", "surface", "metrology", "contact", "run", "bindings", "dignity")
# Readers, by the room that reads.
FUZZED = {"core": ("engine/core/files/json",),
          "surface": ("engine/surface/io", "engine/core/text", "engine/core/quantity", "engine/core/files/source_file",
                      "engine/core/files/text_table"),
          "statistics": ("engine/statistics", "engine/core/files/text_encoding", "engine/core/files/text_table"),
          "recording": ("engine/recording", "engine/statistics"),
          "bindings": ("bindings/lua",)}
# What several reproductions and claims have in common; any other file of theirs is one test.
SHARED_BY_REPRODUCTIONS = ("tests/reproductions/beginning.sh", "tests/reproductions/reproduction.py",
                           "tests/reproductions/serving.py",
                           "tests/known_to_fail/known_to_fail.sh")
USED_BY_REPRODUCTIONS = ("tests/scripts/runner/run_script", "tests/scripts/runner/process", "tests/scripts/runner/saying",
                         "tests/web/client")
# What runs over the ranks of mpirun.
RANKS = re.compile("slab|mpi|spread|ranks|ensemble|scheduler|packed_value|^engine/core/|^bindings/(cli/|main)")
# Files of the build: a change there may change anything. A CMakeLists.txt below a folder of tests/ changes the tests of that folder.
BUILD = re.compile(r"\.ci/|cmake/|tests/support/|(?!examples/|tests/.+/|bindings/wasm/)((.*/)?CMakeLists\.txt|.*\.cmake)$|(CMakePresets\.json|lab|\.clang-format)$")
# What is built for WebAssembly only; the page without a server is tested in a browser too.
WASM = ("bindings/wasm", "tests/wasm")
WASM_PAGE = WASM + ("bindings/web/page/src/alone",)
# The record of passes, which changes nothing.
CHECKED = recorded.CHECKED


# Headers of the library whose name stands in whatever uses them.
SPELT = ("array", "complex", "deque", "initializer_list", "limits", "map", "mutex", "optional", "set", "span", "thread", "variant",
         "vector")


def under(path, places):
    """Whether the path is one of the places, lies in one, or is a source of that name."""
    return any(path == place or path.startswith((place + "/", place + ".")) for place in places)


def may_change_anything(path):
    return path != CHECKED and BUILD.match(path) is not None


def sources():
    found = []
    for folder in ("engine", "bindings", "tests", "bench"):
        for where, _, names in os.walk(os.path.join(ROOT, folder)):
            if "node_modules" not in where:
                found += [os.path.relpath(os.path.join(where, n), ROOT) for n in names if n.endswith((".cpp", ".hpp", ".h"))]
    return sorted(found)


@functools.cache
def include_graph():
    """Each source with the files of this project that it includes."""
    graph = {}
    for path in sources():
        with open(os.path.join(ROOT, path), encoding="utf-8") as text:
            graph[path] = re.findall(r'^\s*#\s*include\s+"([^"]+)"', text.read(), re.M)
    return graph


@functools.cache
def included_by():
    """Each file with the sources that include it."""
    turned = {}
    for path, targets in include_graph().items():
        for target in targets:
            turned.setdefault(target, []).append(path)
    return turned


def includers(paths):
    """The sources that include one of the paths, directly or not."""
    reached, todo = set(), list(paths)
    while todo:
        for path in included_by().get(todo.pop(), []):
            if path not in reached:
                reached.add(path)
                todo.append(path)
    return reached


@functools.cache
def found_from(path):
    """What a source names in its #include lines and in those of the files of this project that it includes, directly or not."""
    names, seen, todo = set(), {path}, [path]
    while todo:
        with open(os.path.join(ROOT, todo.pop()), encoding="utf-8") as text:
            for name in re.findall(r'^\s*#\s*include\s+(["<][^">]+)[">]', text.read(), re.M):
                names.add(name)
                inner = name[1:]
                if inner not in seen and inner in include_graph():
                    seen.add(inner)
                    todo.append(inner)
    return names


def misses(path, name):
    """Whether a source may use what an #include gives, and does not find it."""
    if name in found_from(path):
        return False
    with open(os.path.join(ROOT, path), encoding="utf-8") as text:
        return name[1:] not in SPELT or name[1:] in text.read()


def poorer_sources(base):
    """The sources that include a header which gave up an #include since the commit, and that miss what it included."""
    lost, path = {}, ""
    difference = subprocess.run(["git", "diff", "--no-renames", base, "--", "*.hpp"], cwd=ROOT, capture_output=True, text=True, check=True)
    for line in difference.stdout.splitlines():
        if line.startswith("--- a/"):
            path = line[6:]
        elif given_up := re.match(r'-\s*#\s*include\s+(["<][^">]+)[">]', line):
            lost.setdefault(path, set()).add(given_up[1])
    return {source for header, names in lost.items() for source in includers([header])
            if any(misses(source, name) for name in names)}


def groups_of_folder(folder):
    """The groups whose tests a CMakeLists.txt of a folder of tests/ declares."""
    found = {name for name, (_, _, places) in GROUPS.items()
             if any(under(place, (folder,)) for place in places)} - {"checks"}
    if folder == "tests/checks":
        return {"checks"}
    return found or {group_of(folder)} - {None}


def group_of(path):
    """The group whose program a file of tests/ belongs to."""
    best = None
    for name, (_, _, places) in GROUPS.items():
        for place in places:
            if under(path, (place,)) and name != "checks" and (best is None or len(place) > best[1]):
                best = (name, len(place))
    return best and best[0]


class Selection:
    """`release` names groups; `names` single tests; the others what is built and run beside the release build."""

    def __init__(self):
        self.everything = False
        self.release, self.names = {"checks"}, set()
        self.sanitize, self.fuzz = set(), set()
        self.packages = self.newcomer = False
        self.wasm = ""

    def add(self, path):
        if path == CHECKED:
            return
        if under(path, WASM_PAGE):
            self.wasm = "page"
        if under(path, WASM):
            return
        if may_change_anything(path):
            self.everything = True
            return
        stem = os.path.splitext(os.path.basename(path))[0]
        for name, (_, rooms, _) in GROUPS.items():
            if under(path, rooms):
                self.release.add(name)
        for name, rooms in SANITIZED.items():
            if under(path, rooms):
                self.sanitize.add(name)
        for name, places in FUZZED.items():
            if under(path, places):
                self.fuzz.add(name)
        if under(path, PROGRAM):
            self.wasm = self.wasm or "node"
        if RANKS.search(path):
            self.release.add("ranks")
        if path.startswith("tests/"):
            self.add_test(path, stem)
        elif path.startswith("examples/"):
            if path.endswith(".lua"):
                self.names.add(f"examples: (check )?{stem}")
            else:
                self.release |= {"examples", "package", "command_line"}
        elif path.startswith("docs/"):
            self.release.add("stability" if "stability" in stem else "checks")
            self.newcomer |= stem == "newcomer"
            if stem == "asperity":
                self.release |= {"command_line"}

    def add_folder(self, path):
        groups = groups_of_folder(os.path.dirname(path))
        if not groups:
            self.everything = True  # a place that belongs to no group
        self.release |= groups
        self.sanitize |= groups & set(SANITIZED)
        if path.startswith("tests/stability/dignity/"):
            self.sanitize.add("dignity")
        if "fuzz" in groups:
            self.fuzz |= set(FUZZED)

    def add_test(self, path, stem):
        if os.path.basename(path) == "CMakeLists.txt":
            self.add_folder(path)
            return
        if path.startswith("tests/checks/"):
            return  # they run each time
        for source in includers([path]) | {path}:
            group = group_of(source)
            if group is None:
                self.everything = True  # a place that nobody has told of
                continue
            if group == "scripts" and source == path and path.endswith(".lua"):
                self.names |= {f"scripts: {stem}", f"module: {stem}"}
                continue
            if group == "reproductions" and path not in SHARED_BY_REPRODUCTIONS:
                self.names.add(f"(reproductions|known to fail): {stem.replace('_', ' ')}")
                continue
            self.release.add(group)
            if "/dignity/" in source:
                self.sanitize.add("dignity")
            if group in SANITIZED:
                self.sanitize.add(group)
            if group == "fuzz":
                self.fuzz |= set(FUZZED)
        if path.startswith("tests/data/") or path.startswith("tests/reference/"):
            self.release |= {"surface", "metrology", "friction", "contact", "specimen", "recording", "bindings", "scripts", "examples"}
        if path.startswith(USED_BY_REPRODUCTIONS):
            self.release.add("reproductions")
        if path.startswith("tests/package/"):
            self.packages = self.newcomer = True

    def lines(self):
        def shards(groups):
            patterns = [SANITIZED_NAMES.get(name, f"{name}: shard") for name in sorted(groups)]
            return "^(" + "|".join(patterns) + ")" if patterns else ""

        def targets(groups):
            return " ".join(t for name in sorted(groups) for t in SANITIZED_TARGETS.get(name, (f"test_{name}",)))

        def threads(groups):
            groups = set(groups) & set(THREADED)
            return {"thread": shards(groups).replace("bindings_c", "bindings"), "thread_targets": targets(groups).replace("test_bindings_c", "test_bindings")}

        if self.everything:
            return {"release": ".", "sanitize": ".", "sanitize_targets": "all", **threads(THREADED), "fuzz": " ".join(FUZZED),
                    "packages": "yes", "newcomer": "yes", "wasm": "", "selection": "everything"}
        release = "^(" + "|".join(GROUPS[name][0] for name in GROUPS if name in self.release) + ")"
        release += "".join(f"|^{name}$" for name in sorted(self.names))
        corpora = f"^fuzz: ({'|'.join(sorted(self.fuzz))}): " if self.fuzz else ""
        sanitize = "|".join(filter(None, (shards(self.sanitize), corpora)))
        return {"release": release, "sanitize": sanitize, "sanitize_targets": targets(self.sanitize),
                **threads(self.sanitize), "fuzz": " ".join(sorted(self.fuzz)), "packages": "yes" if self.packages else "",
                "newcomer": "yes" if self.newcomer else "", "wasm": self.wasm, "selection": " ".join(sorted(self.release))}


def select(paths):
    selection = Selection()
    if paths is None:
        selection.everything = True
    else:
        for path in paths:
            selection.add(path)
    return selection


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--since")
    parser.add_argument("--paths", nargs="*")
    parser.add_argument("--everything", action="store_true")
    parser.add_argument("--why", action="store_true", help="say on standard error what differs")
    given = parser.parse_args()
    paths = None
    if not given.everything:
        paths = given.paths if given.paths is not None else recorded.differing(given.since or recorded.base()[0])
    if given.why:
        print("the difference is not known" if paths is None else "\n".join(paths), file=sys.stderr)
    for key, value in select(paths).lines().items():
        print(key, value)


if __name__ == "__main__":
    main()
