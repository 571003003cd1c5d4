#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What .ci/select_checks.py calls for is enough: every file of the project maps to at least the tests that include it, files
of the build and of .ci to all; every test of CTest belongs to a group; and the thread sanitizer's filter names no test
that its build leaves out.

usage: selection.py BUILD_FOLDER [the project's folder]
"""
import fnmatch
import json
import os
import re
import subprocess
import sys

build = sys.argv[1]
root = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else os.path.join(os.path.dirname(__file__), "../.."))
sys.path.insert(0, os.path.join(root, ".ci"))
sys.dont_write_bytecode = True
import select_checks as chooser  # noqa: E402

wrong = []


def expect(holds, sentence):
    if not holds:
        wrong.append(sentence)


listed = subprocess.run(["git", "-C", root, "ls-files"], capture_output=True, text=True, check=False)
if listed.returncode != 0:
    print("skipped: this is no clone")
    sys.exit(77)
files = [path for path in listed.stdout.split("\n") if path and os.path.exists(os.path.join(root, path))]
graph = chooser.include_graph()


def implementing(paths):
    """With the sources that bear a header's name: whoever includes the header is linked with them."""
    return set(paths) | {p[:-4] + ".hpp" for p in paths if p.endswith(".cpp") and p[:-4] + ".hpp" in graph}


for path in files:
    selection = chooser.select([path])
    if path == chooser.CHECKED:
        expect(selection.release == {"checks"}, f"{path} says what was checked, and calls for {selection.release}")
        continue
    if chooser.may_change_anything(path):
        expect(selection.everything, f"{path} may change anything")
        continue
    expect("checks" in selection.release, f"{path} calls for no checks")
    if not path.endswith((".cpp", ".hpp", ".h")):
        continue
    for source in chooser.includers(implementing([path])) | {path}:
        if source.startswith("tests/") and source.endswith(".cpp"):
            group = chooser.group_of(source)
            expect(selection.everything or group in selection.release, f"{source} includes {path}, which does not call for {group}")

for name, missed in (('"engine/core/digest.hpp', False), ('"engine/contact/plan.hpp', True), ("<cctype", True), ("<deque", False)):
    expect(chooser.misses("engine/core/digest.cpp", name) == missed,
           f"engine/core/digest.cpp {'has no way to' if missed else 'finds or does not name'} {name[1:]}")

for path in ("CMakeLists.txt", "engine/CMakeLists.txt", "cmake/Packages.cmake", "CMakePresets.json", "lab", ".ci/run",
             ".ci/select_checks.py", "tests/CMakeLists.txt", "tests/support/open_files.cpp", "tests/nowhere/CMakeLists.txt"):
    expect(chooser.select([path]).everything, f"{path} may change anything")
for folder, groups in {"page": {"page"}, "web": {"web", "serve"}, "scripts": {"scripts", "command_line", "ranks"},
                       "stability/dignity": {"stability"}, "checks": set(), "fuzz": {"fuzz"}}.items():
    selection = chooser.select([f"tests/{folder}/CMakeLists.txt"])
    expect(not selection.everything and selection.release == groups | {"checks"},
           f"tests/{folder}/CMakeLists.txt calls for {' '.join(sorted(selection.release))}")
for path in ("tests/checks/budget.txt", "tests/checks/english.py", "bindings/wasm/CMakeLists.txt", "tests/wasm/run.sh"):
    selection = chooser.select([path])
    expect((selection.everything, selection.release, selection.wasm) == (False, {"checks"}, "page" if "wasm" in path else ""),
           f"{path} calls for other checks")
for path, words in {"engine/core/digest.cpp": "node", "bindings/cli/commands/run_command.cpp": "node", "bindings/main.cpp": "node",
                    "scripts/lessons/01_roughness.lua": "node", "bindings/web/page/src/alone/worker.ts": "page",
                    "bindings/web/page/src/main.ts": "", "docs/browser.md": ""}.items():
    expect(chooser.select([path]).wasm == words, f"{path} calls for `{chooser.select([path]).wasm}` of WebAssembly")
expect(chooser.select(["bindings/wasm/page.cpp", "bindings/main.cpp"]).wasm == "page", "node hides the page")
expect(chooser.select(None).everything, "what is not known calls for everything")
for path, name in {"examples/rough_on_rough.lua": "examples: rough_on_rough", "scripts/lessons/01_roughness.lua": "lessons: 01_roughness",
                   "tests/scripts/bad_keys.lua": "scripts: bad_keys", "tests/reproductions/softer_body_yields.lua": "reproductions: softer body yields",
                   "tests/known_to_fail/cost_of_long_strips.lua": "known to fail: cost of long strips",
                   "tests/reproductions/beginning.sh": "reproductions: containers share a store", "tests/page/browser.mjs": "page:teaching",
                   "tests/scripts/runner/run_script.cpp": "reproductions: softer body yields", "docs/accuracy.md": "known to fail: cost of long strips",
                   "bindings/web/http/server.cpp": "reproductions: students take turns", "bindings/main.cpp": "command line: CommandLine",
                   "bindings/web/serve_command.cpp": "command line: completion"}.items():
    expect(re.search(chooser.select([path]).lines()["release"], name), f"{path} does not call for {name}")

tests = subprocess.run(["ctest", "--test-dir", build, "-N"], capture_output=True, text=True, check=True).stdout
names = re.findall(r"^ +Test +#\d+: (.*)$", tests, re.M)
expect(len(names) > 100, f"CTest lists {len(names)} tests in {build}")
for name in names:
    expect(any(re.match(pattern, name) for pattern, _, _ in chooser.GROUPS.values()), f"the test `{name}` belongs to no group")

with open(os.path.join(root, "CMakePresets.json"), encoding="utf-8") as text:
    presets = json.load(text)
settings = next(p for p in presets["configurePresets"] if p["name"] == "thread")["cacheVariables"]
targets = set(next(p for p in presets["buildPresets"] if p["name"] == "thread")["targets"])
expect(targets == {t for name in chooser.THREADED for t in (f"test_{name}",)}, "the preset `thread` builds other programs than THREADED")
patterns = settings["ASPERITY_TEST_FILTER"].split(":")
watched = 0
for path in files:
    if not (path.startswith("tests/") and path.endswith("_test.cpp")):
        continue
    with open(os.path.join(root, path), encoding="utf-8") as text:
        cases = re.findall(r"^TEST(?:_F|_P)?\((\w+), *(\w+)\)", text.read(), re.M)
    program = "test_dignity" if "/dignity/" in path else f"test_{chooser.group_of(path)}"
    for suite, case in cases:
        if any(fnmatch.fnmatchcase(f"{suite}.{case}", pattern) for pattern in patterns):
            watched += 1
            expect(program in targets, f"the thread sanitizer is to watch {suite}.{case} of {path}, and {program} is not built")
for suite in ("Journal", "Ledger", "Notebook", "RunDirectory"):
    expect(any(fnmatch.fnmatchcase(f"{suite}Test.Anything", p) for p in patterns), f"the thread sanitizer does not watch {suite}")
expect(watched > 50, f"the thread sanitizer watches {watched} cases")

print("\n".join(wrong) if wrong else f"{len(files)} files call for what includes them; {watched} cases under the thread sanitizer")
sys.exit(1 if wrong else 0)
