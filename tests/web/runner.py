# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the tests of a file, functions test_NAME, against a program: FILE PROGRAM [NAME...]; without a name all.
import os
import sys

program = ""


def main(scope):
    global program
    program = os.path.abspath(sys.argv[1])
    tests = {name[5:]: test for name, test in scope.items() if name.startswith("test_")}
    if sys.argv[2:] == ["--list"]:
        print("\n".join(tests))
        return
    for name in sys.argv[2:] or tests:
        print(name, flush=True)
        tests[name]()
