# SPDX-License-Identifier: GPL-3.0-or-later
# What reproductions of the page's server share with ../web: a server started for a test, and a client of it.
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../web"))
from client import Server, finished, of_type, printed, until  # noqa: E402,F401

program = os.path.abspath(sys.argv[1])
if subprocess.run([program, "serve", "--help"], capture_output=True, check=False).returncode != 0:
    print("skipped: this program has no `asperity serve`")
    sys.exit(77)
