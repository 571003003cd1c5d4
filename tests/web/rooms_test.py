#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# A room of students, and the end of the server.
import json
import os
import signal
import subprocess
import tempfile
import threading

import runner
from client import Server, alive, chart, children_of, finished, patience, until


def test_students_find_their_own_runs_only():
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as names:
        names.write("Ada Lovelace\nÉmilie\n")
        names.flush()
        with Server(runner.program, "--classroom", "127.0.0.1", "--names", names.name) as server:
            assert list(server.tokens) == ["teacher", "Ada Lovelace", "Émilie"], list(server.tokens)
            ada, emilie = server.tokens["Ada Lovelace"], server.tokens["Émilie"]
            assert len(set(server.tokens.values())) == 3 and all(len(token) == 43 for token in server.tokens.values())
            run = server.begin(chart, token=ada, views=True)
            server.events(run, token=ada)
            for path in (f"/api/runs/{run}", f"/api/runs/{run}/events", f"/api/runs/{run}/files/line.csv",
                         f"/api/runs/{run}/views/surface-1"):
                assert server.ask("GET", path, token=emilie).status == 404, path
            assert server.ask("DELETE", f"/api/runs/{run}", token=emilie).status == 404
            assert server.ask("GET", "/api/runs", token=emilie).json() == []
            assert server.ask("GET", f"/api/runs/{run}/files/line.csv", token=ada).status == 200
            assert server.ask("GET", "/api/about", token=ada).json()["classroom"] is True


def test_one_student_cannot_take_every_place():
    loop = "while true do end"
    with Server(runner.program, "--classroom", "127.0.0.1", "--students", "3", "--runs", "2") as server:
        one, two, three = (server.tokens[f"student {k}"] for k in (1, 2, 3))
        first = server.begin(loop, token=one)
        while server.ask("POST", "/api/runs", {"script": loop}, token=one).status == 201:
            pass
        for token in (two, three, two, server.tokens["teacher"]):
            assert finished(server.events(server.begin("print(1)", token=token), token=token))["status"] == "done"
        # Two at the same time, while the first goes on.
        both = [(server.begin("print(1)", token=token), token) for token in (two, three)]
        for run, token in both:
            assert finished(server.events(run, token=token))["status"] == "done"
        states = [run["state"] for run in server.ask("GET", "/api/runs", token=one).json()]
        assert states.count("running") == 1 and states.count("waiting") == 20, states
        # Who waits is told how many are before.
        told = first_event(server, "3", one)
        assert told["type"] == "waiting" and told["before"] >= 1, told
        # The teacher sees and stops any run, and no student does.
        assert server.ask("GET", "/api/room", token=two).status == 404
        assert server.ask("DELETE", f"/api/runs/{first}", token=two).status == 404
        room = server.ask("GET", "/api/room").json()
        assert {"id": first, "name": "", "state": "running", "owner": "student 1"} in room, room
        assert server.ask("GET", "/api/about").json()["teacher"] and not server.ask("GET", "/api/about", token=one).json()["teacher"]
        assert server.ask("DELETE", f"/api/runs/{first}").status == 200
        assert finished(server.events(first, token=one))["status"] == "stopped"


def first_event(server, run, token):
    connection = server.connect()
    connection.sendall(f"GET /api/runs/{run}/events HTTP/1.1\r\nHost: {server.host}\r\nAuthorization: Bearer {token}\r\n\r\n".encode())
    seen = b""
    while seen.count(b"\n{") < 1 or not seen.split(b"\n{", 1)[1].count(b"\n"):
        piece = connection.recv(4096)
        assert piece, seen
        seen += piece
    connection.close()
    return json.loads(b"{" + seen.split(b"\n{", 1)[1].split(b"\n", 1)[0])


def test_the_teacher_sees_predictions_and_who_needs_help():
    with Server(runner.program, "--classroom", "127.0.0.1", "--students", "2") as server:
        one, two = server.tokens["student 1"], server.tokens["student 2"]
        put = lambda token, guesses, lesson="real_area", why="": server.ask(
            "POST", "/api/predictions", {"lesson": lesson, "guesses": guesses, "why": why}, token=token)
        assert put(one, {"percent": 10, "growth": 2.5}).status == 200
        assert put(one, {"percent": 3}).status == 200                  # instead of those before
        assert put(two, {"percent": 50}).status == 200 and put(two, {}).status == 200
        assert put(two, {"heavy": "same"}, "tilt", "it presses, too").status == 200
        assert server.ask("POST", "/api/help", {"wanted": True}, token=two).status == 200
        assert server.ask("GET", "/api/about", token=two).json()["help"] is True
        assert server.ask("GET", "/api/people").json() == [
            {"name": "student 1", "help": False, "script": False,
             "predictions": [{"lesson": "real_area", "name": "percent", "value": 3}], "whys": []},
            {"name": "student 2", "help": True, "script": False,
             "predictions": [{"lesson": "tilt", "name": "heavy", "value": "same"}], "whys": [{"lesson": "tilt", "text": "it presses, too"}]}]
        assert put(two, {}, "tilt").status == 200
        assert server.ask("GET", "/api/people").json()[1] == {
            "name": "student 2", "help": True, "script": False, "predictions": [], "whys": []}
        assert server.ask("GET", "/api/people", token=one).status == 404
        assert server.ask("POST", "/api/help", {"wanted": False}, token=two).status == 200
        assert [p["help"] for p in server.ask("GET", "/api/people").json()] == [False, False]
        # What is no prediction is refused, and one person cannot fill the memory.
        for guesses in ("many", {"percent": "t" * 61}, {"percent": None}, {"n" * 61: 1}, {str(k): k for k in range(13)}):
            answer = put(one, guesses)
            assert answer.status == 400, (guesses, answer.status)
        assert put(one, {"a": 1}, lesson="l" * 61).status == 400 and put(one, {}, why="w" * 2001).status == 400
        kept = [put(one, {"a": 1}, lesson=f"lesson {k}").status for k in range(60)]
        assert kept.count(200) == 39 and kept.count(400) == 21, kept
    # Outside a room there is nobody to see them.
    with Server(runner.program) as server:
        assert server.ask("POST", "/api/predictions", {"lesson": "tilt", "guesses": {}}).status == 404
        assert server.ask("GET", "/api/people").status == 404


def test_a_script_goes_to_the_room_and_one_comes_with_a_request_for_help():
    with Server(runner.program, "--classroom", "127.0.0.1", "--students", "2") as server:
        one, two = server.tokens["student 1"], server.tokens["student 2"]
        handed = lambda token, after=0: server.ask("GET", f"/api/handed?after={after}", token=token)
        assert handed(one).json() == {"number": 0}
        for body in ({"name": "x", "script": "s" * (256 * 1024 + 1)}, {"name": "n" * 201, "script": ""}, {"script": "print(1)"}):
            assert server.ask("POST", "/api/handed", body).status == 400, body.keys()
        assert server.ask("POST", "/api/handed", {"name": "mine", "script": ""}, token=one).status == 404
        number = server.ask("POST", "/api/handed", {"name": "Springs", "script": "print(1)"}).json()["number"]
        assert handed(two).json() == {"number": number, "name": "Springs", "script": "print(1)"}
        assert handed(two, number).json() == {"number": number}
        assert server.ask("POST", "/api/handed", {}).json()["number"] > number
        assert "script" not in handed(one).json()
        # A student's script is for the teacher, as long as help is wanted.
        shown = lambda token=None: server.ask("GET", "/api/people/student%201", token=token)
        assert shown().status == 404
        help = {"wanted": True, "name": "Tilt it", "script": "local mine = 1"}
        assert server.ask("POST", "/api/help", help | {"script": "s" * (64 * 1024 + 1)}, token=one).status == 400
        assert server.ask("POST", "/api/help", help, token=one).status == 200
        assert shown().json() == {"name": "Tilt it", "script": "local mine = 1"}
        assert shown(one).status == 404 and shown(two).status == 404
        assert [p["script"] for p in server.ask("GET", "/api/people").json()] == [True, False]
        assert server.ask("POST", "/api/help", {"wanted": False}, token=one).status == 200
        assert shown().status == 404 and server.ask("GET", "/api/people/nobody").status == 404
    with Server(runner.program) as server:
        assert server.ask("GET", "/api/handed").status == 404


def test_scripts_that_are_checked_for_long_keep_nobody_from_theirs():
    with Server(runner.program, "--classroom", "127.0.0.1", "--students", "6") as server:
        over, long, said = threading.Event(), set(), []
        def loop(token):
            while not over.is_set():
                said.append(server.ask("POST", "/api/check", {"script": "while true do end"}, token=token).body)
                long.add(token)
        loops = [threading.Thread(target=loop, args=(server.tokens[f"student {k}"],)) for k in range(1, 6)]
        for thread in loops:
            thread.start()
        until(lambda: len(long) == len(loops), "each should be known to take long")
        until(lambda: any(b"because others wait" in answer for answer in said), "a long check should end for others")
        answer = server.ask("POST", "/api/check", {"script": "print(1)"}, token=server.tokens["student 6"])
        over.set()
        for thread in loops:
            thread.join()
        assert answer.status == 200, answer.status


def test_completions_of_one_student_take_turns():
    with Server(runner.program, "--classroom", "127.0.0.1", "--students", "2") as server:
        long = json.dumps({"text": "local s = lab.surface.flat{ cells=8, size=1 }\n" * 5000, "position": 0}).encode()
        over, answered = threading.Event(), []
        def complete(body):
            answer = server.ask("POST", "/api/complete", body, token=server.tokens["student 1"])
            assert answer.status == 200, answer.status
        def repeat():
            while not over.is_set():
                complete(long)
                answered.append(1)
        threads = [threading.Thread(target=repeat) for _ in range(24)]
        for thread in threads:
            thread.start()
        until(lambda: len(answered) > 24, "the long ones should be answered")
        before = len(answered)
        complete({"text": "lab.sur", "position": 7})
        overtaken = len(answered) - before
        over.set()
        for thread in threads:
            thread.join()
        # In turn it comes after the waiting ones; side by side it would overtake nearly all.
        assert overtaken >= 8, overtaken


def test_one_student_cannot_take_every_answer():
    with Server(runner.program, "--classroom", "127.0.0.1", "--students", "2") as server:
        one, two = server.tokens["student 1"], server.tokens["student 2"]
        run = server.begin("while true do end", token=one)
        streams = []
        for _ in range(24):
            stream = server.connect()
            stream.sendall(f"GET /api/runs/{run}/events HTTP/1.1\r\nHost: {server.host}\r\n"
                           f"Authorization: Bearer {one}\r\n\r\n".encode())
            assert b" 200 " in stream.recv(4096)
            streams.append(stream)
        assert server.ask("GET", f"/api/runs/{run}/events", token=one).status == 429
        assert finished(server.events(server.begin("print(1)", token=two), token=two))["status"] == "done"
        for stream in streams:
            stream.close()
        until(lambda: server.ask("GET", f"/api/runs/{run}/files/none", token=one).status == 404, "what was closed is not given back")
        assert server.ask("DELETE", f"/api/runs/{run}", token=one).status == 200


def test_a_room_is_served_only_by_name():
    def refused(*options):
        done = subprocess.run([runner.program, "serve", *options], capture_output=True, text=True, timeout=patience)
        assert done.returncode == 2, (options, done)
        return done.stderr
    assert "every network" in refused("--classroom", "0.0.0.0", "--students", "2")
    assert "no address" in refused("--classroom", "everywhere", "--students", "2")
    assert "students" in refused("--classroom", "127.0.0.1")
    assert "--classroom" in refused("--students", "2")
    assert "cannot be listened on" in refused("--classroom", "203.0.113.7", "--students", "2")


def test_the_end_stops_the_runs_and_keeps_their_records():
    script = """local book = require("asperity").notebook "kept"
    book:write{ k=1 } while true do end"""
    with Server(runner.program) as server:
        run = server.begin(script)
        csv = f"{server.folder}/runs/{run}/run/kept.csv"
        until(lambda: os.path.exists(csv), "no row was written")
        children = children_of(server.process.pid)
        assert children
        server.process.send_signal(signal.SIGINT)
        assert server.process.wait(patience) == 0
        assert not any(alive(child) for child in children)
        manifest = json.load(open(f"{server.folder}/runs/{run}/run/manifest.json"))
        assert manifest["status"] == "interrupted", manifest["status"]
        assert open(csv).read() == "k\n1\n"
        assert server.folder in server.said() and not os.path.exists(server.folder + "/runs/scratch")


def test_the_runs_of_a_server_that_was_killed_end_with_it():
    with Server(runner.program) as server:
        server.begin("while true do end")
        children = until(lambda: children_of(server.process.pid), "no run began")
        server.process.kill()
        server.process.wait()
        until(lambda: not any(alive(child) for child in children), "a run outlives its server")


def test_nobody_can_serve_too():
    if os.geteuid() != 0 or not os.access(runner.program, os.X_OK):
        return
    try:
        server = Server(runner.program, as_nobody=True)
    except AssertionError as problem:
        if "ermission" in str(problem):
            print("skipped: the program lies where nobody may not read")
            return
        raise
    with server:
        events = server.run(chart)
        assert finished(events)["status"] == "done", events
        assert "NOT SHUT" not in server.said(), server.said()


if __name__ == "__main__":
    runner.main(globals())
