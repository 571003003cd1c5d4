#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The commit that .ci/run compares with, and the record of its passes in .ci/checked.

usage: base.py base                           the commit to compare with, or why there is none
       base.py write COMMIT MODE BASE STEPS   the record of a pass of COMMIT (`dirty` where there were changes); MODE is short, full or all

`base` prints three lines: `base` with a commit or nothing, `mode` with short or full, `why` with a sentence.

The record has two lines of six columns each: `full` for the last pass of --full or --all, `last` for the last pass of any kind:
    full|last DATE COMMIT TREE PASSES STEPS
PASSES counts the short passes since the last full one. A short pass is recorded only on top of a recorded commit, so everything
that changed since the full pass has run the checks it calls for.
"""
import datetime
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
CHECKED = ".ci/checked"
# Every fiftieth pass is a full one.
FULL_EVERY = 50
HEAD = f"""\
# Commits that passed .ci/run, which writes this file. Commit it after a pass.
# full: the last pass of --full or --all. last: the last pass of any kind.
# Columns: date, commit, tree, passes since the last full one, steps.
"""
LINE = re.compile(r"^(full|last) (\d{4}-\d\d-\d\d) ([0-9a-f]{40}) ([0-9a-f]{40}) (\d+) (.+)$", re.M)


def git(root, *words):
    answer = subprocess.run(["git", "-C", root, *words], capture_output=True, text=True, check=False)
    return answer.stdout.strip() if answer.returncode == 0 else None


def read(root):
    """The lines of the record by their first word."""
    try:
        with open(os.path.join(root, CHECKED), encoding="utf-8") as text:
            return {line["name"]: line for line in
                    (dict(zip(("name", "date", "commit", "tree", "passes", "steps"), found)) for found in LINE.findall(text.read()))}
    except OSError:
        return {}


def base(root=ROOT):
    """(commit, passes since the last full one, why not): the commit is None where the record is refused."""
    record = read(root)
    if set(record) != {"full", "last"}:
        return None, 0, f"{CHECKED} names no commit that passed"
    for line in record.values():
        commit = line["commit"]
        if git(root, "rev-parse", "--verify", "--quiet", commit + "^{tree}") != line["tree"]:
            return None, 0, f"commit {commit[:12]} of {CHECKED} is not here, or its tree is not the recorded one"
        if git(root, "merge-base", "--is-ancestor", commit, "HEAD") is None:
            return None, 0, f"commit {commit[:12]} of {CHECKED} is no ancestor of HEAD"
    return record["last"]["commit"], int(record["last"]["passes"]), ""


def differing(commit, root=ROOT):
    """The paths that differ from the commit, also those not yet committed; None where git does not know the commit."""
    if not commit or git(root, "merge-base", "--is-ancestor", commit, "HEAD") is None:
        return None
    paths = [git(root, "diff", "--name-only", "--no-renames", commit), git(root, "ls-files", "--others", "--exclude-standard")]
    return None if None in paths else [path for listed in paths for path in listed.split("\n") if path]


def plan(root=ROOT):
    """(commit to compare with or None, short or full, why)."""
    commit, passes, refused = base(root)
    if commit is None:
        return None, "full", f"{refused}: everything runs"
    only_the_record = set(differing(commit, root) or ()) <= {CHECKED}
    if passes + 1 >= FULL_EVERY and not only_the_record:
        return None, "full", f"short passes since the last full one: {passes}, so everything runs"
    return commit, "short", f"compared with commit {commit[:12]}; short passes since the last full one: {passes}"


def write(commit, mode, before, steps, root=ROOT):
    """Records a pass of `commit`, compared with `before`. Returns what was written, or why nothing was."""
    if commit == "dirty" or git(root, "status", "--porcelain") != "":
        return f"{CHECKED} stays: there are changes that are not committed"
    if git(root, "rev-parse", "HEAD") != commit:
        return f"{CHECKED} stays: HEAD has moved during the run"
    passes = 0
    record = read(root)
    if mode == "short":
        recorded, passes, refused = base(root)
        if recorded is None or recorded != before:
            return f"{CHECKED} stays: {refused or 'the run was compared with another commit than the recorded one'}"
        if set(differing(recorded, root)) <= {CHECKED}:
            return f"{CHECKED} stays: nothing else differs from the recorded commit"
        passes += 1
    date = datetime.datetime.now(datetime.timezone.utc).date().isoformat()
    line = f"{date} {commit} {git(root, 'rev-parse', commit + '^{tree}')} {passes} {steps}"
    full = "full " + " ".join(record["full"][key] for key in ("date", "commit", "tree", "passes", "steps")) if passes else f"full {line}"
    with open(os.path.join(root, CHECKED), "w", encoding="utf-8") as text:
        text.write(f"{HEAD}{full}\nlast {line}\n")
    return f"{CHECKED} names commit {commit[:12]}: commit this file"


def main():
    if sys.argv[1:] == ["base"]:
        commit, mode, why = plan()
        print(f"base {commit or ''}\nmode {mode}\nwhy {why}")
    elif len(sys.argv) == 6 and sys.argv[1] == "write" and sys.argv[3] in ("short", "full", "all"):
        print(write(*sys.argv[2:]))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
