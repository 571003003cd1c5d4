#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# The key of the page appears in no argument of a program.
import glob
import os
import tempfile

from serving import Server, program, until

with tempfile.TemporaryDirectory() as folder:
    with open(folder + "/xdg-open", "w") as opener:
        opener.write(f"#!/bin/sh\necho opened > {folder}/opened\nsleep 3\n")
    os.chmod(folder + "/xdg-open", 0o755)
    os.environ["PATH"] = folder + ":" + os.environ["PATH"]
    with Server(program, "--open") as server:
        until(lambda: os.path.exists(folder + "/opened"), "nothing was opened")
        for name in glob.glob("/proc/[0-9]*/cmdline"):
            try:
                with open(name, "rb") as line:
                    assert server.token.encode() not in line.read(), name
            except OSError:
                pass
