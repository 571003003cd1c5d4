#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# An address with a NUL is refused, another content type is not read as JSON, and `.views` belongs to the run.
import json

from serving import Server, program

with Server(program) as server:
    assert server.ask("GET", "/api/about%00x").status == 400
    wrong = server.ask("POST", "/api/check", {"script": "print(1)"}, headers={"Content-Type": "application/jsonx"})
    assert wrong.status == 415, wrong.status
    assert "belongs to the run" in json.dumps(server.run('print(io.open(".views/x", "w"))'))
