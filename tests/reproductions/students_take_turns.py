#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# One student fills the queue with endless loops; another student's short script need not wait for a limit of time.
from serving import Server, finished, program

with Server(program, "--classroom", "127.0.0.1", "--students", "3", "--runs", "2") as server:
    one, two = server.tokens["student 1"], server.tokens["student 2"]
    for _ in range(4):
        server.begin("while true do end", token=one)
    run = server.begin("print(1)", token=two)
    assert finished(server.events(run, token=two))["status"] == "done"
