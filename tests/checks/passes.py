#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of passes that .ci/run compares with (.ci/base.py), in a repository of its own: which records are refused, when a
pass is a full one, and which passes are recorded.

usage: passes.py [the project's folder]
"""
import os
import re
import subprocess
import sys
import tempfile

project = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "../.."))
sys.path.insert(0, os.path.join(project, ".ci"))
sys.dont_write_bytecode = True
import base  # noqa: E402

wrong = []


def expect(holds, sentence):
    if not holds:
        wrong.append(sentence)


def git(*words):
    given = ("-c", "user.name=test", "-c", "user.email=test@localhost", "-c", "commit.gpgsign=false")
    return subprocess.run(["git", "-C", root, *given, *words], capture_output=True, text=True, check=True).stdout.strip()


def change(path, text, commit=True):
    os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
    with open(os.path.join(root, path), "w", encoding="utf-8") as file:
        file.write(text)
    if commit:
        git("add", "--all")
        git("commit", "-q", "-m", f"Change {path}")
    return git("rev-parse", "HEAD")


def record():
    with open(os.path.join(root, base.CHECKED), encoding="utf-8") as file:
        return file.read()


def commit_record():
    git("commit", "-q", "-a", "-m", "Record a pass")


def refused(sentence):
    commit, mode, why = base.plan(root)
    expect(commit is None and mode == "full" and sentence in why, f"plan gives {commit} {mode}: {why}, not: {sentence}")


def passes(mode, before=None):
    return base.write(git("rev-parse", "HEAD"), mode, before, "a step; another", root)


with tempfile.TemporaryDirectory() as root:
    git("init", "-q", "-b", "main")
    first = change("engine/a.cpp", "1\n")
    refused("names no commit that passed")
    change(base.CHECKED, f"The last commit that passed\n{first}\n")
    refused("names no commit that passed")  # the former format
    expect("names no commit" in passes("short", first), "a short pass is recorded on a commit without a record")

    # A full pass begins a record; the commit of the record itself is the successor of its base.
    full = git("rev-parse", "HEAD")
    expect("commit this file" in passes("full"), "a full pass is not recorded")
    expect(re.search(rf"^full \S+ {full} \S+ 0 a step; another\nlast \S+ {full} \S+ 0 a step; another$", record(), re.M),
           f"the record of a full pass is {record()}")
    commit_record()
    expect(base.plan(root)[:2] == (full, "short"), "the commit of the record is not compared with its base")
    expect(base.differing(full, root) == [base.CHECKED], "the commit of the record differs in more than the record")
    expect("nothing else differs" in passes("short", full), "a record is recorded again")

    # A short pass goes on from it.
    second = change("engine/a.cpp", "2\n")
    expect("another commit" in passes("short", first), "a pass compared with another commit is recorded")
    change("engine/b.cpp", "1\n", commit=False)
    expect("not committed" in passes("short", full), "a pass with an untracked file is recorded")
    os.remove(os.path.join(root, "engine/b.cpp"))
    expect("not committed" in base.write("dirty", "short", full, "a step", root), "a pass that began with changes is recorded")
    expect("HEAD has moved" in base.write(first, "short", full, "a step", root), "a pass of another commit is recorded")
    expect("commit this file" in passes("short", full), "a short pass is not recorded")
    expect(re.search(rf"^full \S+ {full} \S+ 0 .*\nlast \S+ {second} \S+ 1 ", record(), re.M), f"the record of a short pass is {record()}")
    commit_record()

    # Every fiftieth pass is a full one; a commit of the record alone is none.
    short = record()
    change(base.CHECKED, re.sub(r"^(last \S+ \S+ \S+) 1 ", rf"\1 {base.FULL_EVERY - 1} ", short, flags=re.M))
    expect(base.plan(root)[1] == "short", "the record alone calls for a full pass")
    change("engine/a.cpp", "3\n")
    refused(f"since the last full one: {base.FULL_EVERY - 1}, so everything runs")
    expect("commit this file" in passes("full") and base.plan(root)[1] == "short", "a full pass does not begin a new count")
    change(base.CHECKED, re.sub(r"^(last \S+ \S+ \S+) 1 ", rf"\1 {base.FULL_EVERY - 2} ", short, flags=re.M))
    expect(base.plan(root)[:2] == (second, "short"), "a pass before the fiftieth is a full one")

    # Records that do not hold.
    tree = git("rev-parse", f"{second}^{{tree}}")
    change(base.CHECKED, short.replace(tree, git("rev-parse", f"{first}^{{tree}}")))
    refused("its tree is not the recorded one")
    change(base.CHECKED, short.replace(second, "0" * 40))
    refused("is not here")
    change(base.CHECKED, short.split("last ")[0])
    refused("names no commit that passed")
    git("checkout", "-q", "-b", "aside", first)
    aside = change("engine/c.cpp", "1\n")
    git("checkout", "-q", "main")
    change(base.CHECKED, short.replace(second, aside).replace(tree, git("rev-parse", f"{aside}^{{tree}}")))
    refused("is no ancestor of HEAD")
    expect(base.differing("0" * 40, root) is None and base.differing("", root) is None, "an unknown commit differs in known paths")

print("\n".join(wrong) if wrong else "records of passes are read, refused and written as they should")
sys.exit(1 if wrong else 0)
