#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# The body of a request is never read as another request.
from serving import Server, program

with Server(program) as server:
    head = f"GET /api/about HTTP/1.1\r\nHost: {server.host}\r\nAuthorization: Bearer {server.token}\r\n"
    hidden = head + "\r\n"
    with server.connect() as client:
        client.sendall((head + f"Content-Length: {len(hidden)}\r\n\r\n" + hidden).encode())
        answers = b""
        try:
            while piece := client.recv(65536):
                answers += piece
        except ConnectionResetError:
            pass
    assert answers.count(b"HTTP/1.1 ") == 1, answers
    assert b" 400 " in answers.split(b"\r\n")[0], answers
