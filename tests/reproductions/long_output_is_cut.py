#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# The output of a script that prints more than 1 MiB is cut, and the script runs to its end.
from serving import Server, finished, program, printed

with Server(program) as server:
    events = server.run('for k = 1, 3e4 do print(("x"):rep(98)) end require("asperity").notebook "n":write{ a=1 }')
    assert finished(events)["status"] == "done", events[-1]
    assert any(event["type"] == "row" for event in events)
    assert len(printed(events)) < 1.1 * 2**20, len(printed(events))
