#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# A script that writes as fast as it can uses no more than its share of the disk.
import os

from serving import Server, program

flood = 'local s=("x"):rep(2^20) for k=1,1000 do local f=assert(io.open("f"..k,"w")) for i=1,60 do f:write(s) end f:close() end'
with Server(program, "--classroom", "127.0.0.1", "--students", "2") as server:
    student = server.tokens["student 1"]
    server.events(server.begin(flood, token=student), token=student)
    left = count = 0
    for where, _, names in os.walk(server.folder + "/runs"):
        for name in names:
            left += os.lstat(os.path.join(where, name)).st_blocks * 512
            count += 1
    assert left < 65 << 20, left
    assert count < 2100, count
