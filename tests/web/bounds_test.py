#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# Requests that are too long or too slow, and many runs at once.
import json
import threading
import time

import runner
from client import Server, finished, printed, until


def test_requests_that_are_too_long_are_refused():
    with Server(runner.program) as server:
        long = json.dumps({"script": "-" * (3 << 20)}).encode()
        for _ in range(3):
            try:
                assert server.ask("POST", "/api/runs", long).status == 413
            except (ConnectionError, BrokenPipeError):
                pass  # closed while the rest was still being sent
        assert server.ask("POST", "/api/runs", {"script": "-" * (1 << 20) + "-"}).status == 400
        assert server.ask("GET", "/api/" + "a" * 3000).status == 414
        for head in (b"GET /" + b"a" * 100000, b"GET / HTTP/1.1\r\n" + b"X: " + b"a" * 100000,
                     b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 20000):
            attacker = server.connect()
            try:
                attacker.sendall(head + b"\r\n\r\n")
                answer = attacker.recv(65536)
                assert answer == b"" or b" 200 " not in answer.split(b"\r\n")[0], answer[:100]
            except (ConnectionError, BrokenPipeError):
                pass
            attacker.close()
        assert server.ask("POST", "/api/check", b"{" * 100000).status == 400
        assert server.ask("POST", "/api/check", b"\xff\xfe").status == 400
        assert server.ask("POST", "/api/runs", {"script": 7}).status == 400
        assert server.ask("POST", "/api/runs", {"script": "x", "seed": -1}).status == 400
        assert server.ask("POST", "/api/runs", {"script": "x"}, headers={"Content-Encoding": "gzip"}).status == 411
        assert server.ask("GET", "/api/about").status == 200
        assert server.ask("GET", "/api/runs").json() == []


def test_slow_clients_are_cut_off_and_keep_nobody_out():
    with Server(runner.program) as server:
        slow = []
        for k in range(900):  # more than there may be connections
            connection = server.connect()
            connection.setblocking(False)
            try:
                connection.send(b"GET / HT" if k % 2 else b"POST /api/runs HTTP/1.1\r\nContent-Le")
            except OSError:
                pass
            slow.append(connection)
        assert server.ask("GET", "/api/about").status == 200
        assert finished(server.run("print(1)"))["status"] == "done"
        # A byte every second does not keep one open.
        def closed(connection):
            try:
                return connection.recv(65536) == b"" or True
            except BlockingIOError:
                return False
            except OSError:
                return True
        dripping = slow[-1]
        def given_up():
            try:
                dripping.send(b"x")
                time.sleep(1)
            except OSError:
                pass
            return closed(dripping)
        until(given_up, "a connection that drips stays open")
        until(lambda: all(map(closed, slow)), "slow connections stay open")
        for connection in slow:
            connection.close()


def test_who_does_not_fetch_is_given_up():
    with Server(runner.program) as server:
        run = server.begin("for k = 1, 200 do print(string.rep('x', 4000)) end")
        server.events(run)
        lazy = []
        for _ in range(20):
            connection = server.connect()
            connection.setsockopt(1, 8, 4096)  # a small buffer to receive in
            connection.sendall(f"GET /api/runs/{run}/events HTTP/1.1\r\nHost: {server.host}\r\n"
                               f"Authorization: Bearer {server.token}\r\n\r\n".encode())
            lazy.append(connection)
        assert server.ask("GET", "/api/about").status == 200
        for connection in lazy:
            connection.close()


def test_two_hundred_runs_at_once():
    with Server(runner.program, "--runs", "4") as server:
        runs = []
        def begin(k):
            runs.append((k, server.begin(f"print({k})", name=f"run {k}")))
        threads = [threading.Thread(target=begin, args=(k,)) for k in range(200)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert len(runs) == 200
        outcomes = {}
        def follow(k, run):
            outcomes[k] = server.events(run)
        threads = [threading.Thread(target=follow, args=pair) for pair in runs]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert len(outcomes) == 200
        for k, events in outcomes.items():
            assert finished(events)["status"] == "done" and printed(events) == f"{k}\n", (k, events)
        assert server.ask("POST", "/api/runs", {"script": ""}).status == 201


def test_more_runs_than_may_wait_are_refused():
    with Server(runner.program, "--classroom", "127.0.0.1", "--students", "1", "--runs", "1") as server:
        statuses = [server.ask("POST", "/api/runs", {"script": "while true do end"}).status for _ in range(40)]
        assert statuses.count(201) in (20, 21) and statuses[-1] == 429, statuses
        refused = server.ask("POST", "/api/runs", {"script": ""}).json()["error"]
        assert "wait" in refused["message"], refused
        # The other person's turn comes all the same.
        other = server.tokens["student 1"]
        run = server.begin("print(1)", token=other)
        server.ask("DELETE", "/api/runs/1")
        assert finished(server.events(run, token=other))["status"] == "done"


if __name__ == "__main__":
    runner.main(globals())
