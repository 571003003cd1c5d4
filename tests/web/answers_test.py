#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# What the page asks and is told.
import base64
import json
import os
import struct

import runner
from client import Server, chart, finished, of_type, press, printed


def test_about_says_its_limits():
    with Server(runner.program, "--limit-time", "7s", "--limit-memory", "300M", "--runs", "3") as server:
        about = server.ask("GET", "/api/about").json()
        assert about["limits"]["seconds"] == 7 and about["limits"]["memory_bytes"] == 300 << 20, about
        assert about["limits"]["runs"] == 3 and about["classroom"] is False and about["version"], about


def test_a_run_tells_rows_expectations_files_and_its_end():
    with Server(runner.program) as server:
        events = server.run(chart, name="squares")
        assert [event["n"] for event in events] == list(range(1, len(events) + 1))
        assert events[0]["type"] == "started"
        rows = of_type(events, "row")
        assert [row["row"] for row in rows] == [{"k": k, "square": k * k} for k in range(1, 6)], rows
        assert rows[0]["notebook"] == "line" and rows[0]["units"] == {"square": "m"}, rows[0]
        assert [e["held"] for e in of_type(events, "expectation")] == [True]
        assert printed(events) == "drawn\n", printed(events)
        assert finished(events)["status"] == "done" and finished(events)["exit"] == 0, finished(events)
        names = {event["name"]: event for event in of_type(events, "file")}
        assert set(names) == {"line.csv", "line-square-k.svg"}, names
        assert server.ask("GET", "/api/runs").json() == [{"id": "1", "name": "squares", "state": "done"}]
        csv = server.ask("GET", "/api/runs/1/files/line.csv")
        assert csv.body.startswith(b"k,square [m]\n1,1\n"), csv.body
        assert len(csv.body) == names["line.csv"]["bytes"] and csv.headers["Content-Type"].startswith("text/csv")


def test_a_chart_is_drawn_for_a_run_that_can_start_nothing():
    with Server(runner.program) as server:
        finished(server.run(chart))
        svg = server.ask("GET", "/api/runs/1/files/line-square-k.svg")
        assert svg.status == 200 and svg.headers["Content-Type"] == "image/svg+xml", svg.status
        assert b"<svg" in svg.body and b"</svg>" in svg.body and len(svg.body) > 3000


def test_charts_are_foretold_by_the_check_and_told_by_the_run():
    script = """local lab = require "asperity"
    local book = lab.notebook "line"
    for k = 1, 5 do book:write{ k=k, ["square [m]"]=k*k, cube=k^3 } end
    for _, y in ipairs{ "square", "cube" } do
      book:chart{ x="k", y=y, where={ k={ 1, 2, 3 } }, log_y=y == "cube", title=y .. " of k" }
    end"""
    with Server(runner.program) as server:
        told = server.ask("POST", "/api/check", {"script": script}).json()["charts"]
        assert [event["notebook"] for event in told] == ["line", "line"], told
        first, second = (event["chart"] for event in told)
        assert first["x"] == "k" and first["y"] == ["square"] and first["where"] == {"k": [1, 2, 3]}, first
        assert second["title"] == "cube of k" and second["log_y"] and not first["log_y"], second
        events = of_type(server.run(script), "chart")
        assert [event["chart"] for event in events] == [first, second], events


def test_events_are_taken_up_again_from_a_number():
    with Server(runner.program) as server:
        all_of_them = server.run(chart)
        assert server.events("1", after=4) == all_of_them[4:]
        assert server.ask("GET", "/api/runs/1/events?after=-1").status == 400
        assert server.ask("GET", "/api/runs/1/events?after=x").status == 400


def test_rows_come_while_the_run_goes_on():
    script = """local lab = require "asperity"
    local book = lab.notebook "slow"
    book:write{ k=1 } print "one"
    while true do end"""
    with Server(runner.program) as server:
        run = server.begin(script)
        connection = server.connect()
        connection.sendall(f"GET /api/runs/{run}/events HTTP/1.1\r\nHost: {server.host}\r\n"
                           f"Authorization: Bearer {server.token}\r\n\r\n".encode())
        seen = b""
        while b'"row"' not in seen or b'one\\n' not in seen:
            piece = connection.recv(65536)
            assert piece, seen
            seen += piece
        connection.close()
        assert server.ask("DELETE", f"/api/runs/{run}").status == 200
        end = finished(server.events(run))
        assert end["status"] == "stopped", end
        assert server.ask("GET", f"/api/runs/{run}/files/slow.csv").body == b"k\n1\n"


def test_errors_carry_their_line():
    with Server(runner.program) as server:
        events = server.run('local lab = require "asperity"\n\nlocal s = lab.surface.flat{ cell=8, size=1 }\n')
        error = of_type(events, "error")[0]
        assert error["line"] == 3 and "cells" in error["message"] and "traceback" in error, error
        assert finished(events)["status"] == "failed"
        events = server.run("local x = = 2")
        assert of_type(events, "error")[0]["line"] == 1


def test_knobs_are_given_with_a_run():
    script = 'local lab = require "asperity"\nprint(lab.knob{ name="p", from="1 MPa", to="9 MPa", value="2 MPa" })\n'
    with Server(runner.program) as server:
        def begun(knobs):
            return server.ask("POST", "/api/runs", {"script": script, "knobs": knobs})
        run = begun({"p": "5e6"}).json()["id"]
        events = server.events(run)
        assert finished(events)["status"] == "done", events
        assert of_type(events, "output")[0]["text"] == "5000000.0\n", events
        manifest = server.ask("GET", f"/api/runs/{run}/files/manifest.json").json()
        assert manifest["knobs"] == {"p": {"value": 5e6, "from": 1e6, "to": 9e6, "log": False, "unit": "Pa"}}
        run = begun({"q": "1"}).json()["id"]
        end = finished(server.events(run))
        assert end["status"] == "failed", end
        # Who moves a slider knows no options of a command line.
        told = [end["reason"]] + [event["message"] for event in of_type(server.events(run), "error")]
        assert "the knob `q` was set" in told[0] and not any("--" in words for words in told), told
        for wrong in ([], "p", {"p": 5}, {"p": "fast"}, {"p=q": "1"}, {"": "1"}, {"p": "1" * 200},
                      {f"p{k}": "1" for k in range(101)}):
            answer = begun(wrong)
            assert answer.status == 400 and "--" not in json.dumps(answer.json()), (wrong, answer.json())


def test_views_are_block_means_and_say_so():
    with Server(runner.program) as server:
        events = server.run(press, views=True)
        assert finished(events)["status"] == "done", events
        names = [event["name"] for event in of_type(events, "view")]
        assert names == ["surface-1", "press-1"], names
        surface = server.ask("GET", "/api/runs/1/views/surface-1").json()
        field = surface["fields"][0]
        assert (field["name"], field["nx"], field["ny"], field["from_nx"]) == ("height", 200, 200, 600), field
        assert field["reduction"] == "mean of 3 x 3 nodes" and field["unit"] == "m"
        heights = struct.unpack("<40000f", base64.b64decode(field["data"]))
        assert abs(sum(heights) / len(heights)) < 1e-7 and max(heights) > 1e-6
        contact = server.ask("GET", "/api/runs/1/views/press-1").json()
        fields = {field["name"]: field for field in contact["fields"]}
        assert set(fields) == {"pressure", "gap", "contact"}, set(fields)
        shares = struct.unpack("<40000f", base64.b64decode(fields["contact"]["data"]))
        share = sum(shares) / len(shares)
        assert abs(share - float(printed(events))) < 1e-6, (share, printed(events))
        assert any(0 < part < 1 for part in shares)


def test_views_do_not_hold_up_a_run():
    with Server(runner.program) as server:
        events = server.run(
            """local lab = require "asperity"
local s = lab.surface.sine{ cells=256, size="1 mm", wavelength="1 mm", amplitude="1 um", material=lab.material "steel" }
local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity={ model="box", stiffness="1 GPa/um" } } }
for k = 1, 400 do c:press{ pressure=k * 1e6 } end
""", views=True)
        assert finished(events)["status"] == "done", events
        titles = [event["title"] for event in of_type(events, "view")]
        left_out = of_type(events, "views_left_out")[0]["count"]
        assert 20 < len(titles) <= 200 and len(titles) + left_out == 401, (len(titles), left_out)
        assert titles[19].endswith("19 MPa") and titles[-1].endswith("400 MPa"), (titles[19], titles[-1])


def test_views_are_not_made_unless_asked_for():
    with Server(runner.program) as server:
        events = server.run(press)
        assert of_type(events, "view") == []
        assert server.ask("GET", "/api/runs/1/views/surface-1").status == 404


def test_check_marks_the_line():
    with Server(runner.program) as server:
        bad = 'local lab = require "asperity"\nlocal s = lab.surface.flat{ cells=8, siz=1 }\n'
        marks = server.ask("POST", "/api/check", {"script": bad}).json()["marks"]
        assert len(marks) == 1 and marks[0]["line"] == 2 and marks[0]["severity"] == "error", marks
        assert "size" in marks[0]["message"]
        good = server.ask("POST", "/api/check", {"script": chart}).json()
        assert good["marks"] == [], good
        depends = 'local lab = require "asperity"\nlocal s = lab.surface.flat{ cells=8, size=1 }\n' \
                  'if s:roughness().Ra > 0 then print(1) end\n'
        assert server.ask("POST", "/api/check", {"script": depends}).json() == {"marks": [], "checked_to": 3}
        knobs = depends.replace("size=1", 'size=lab.knob{ name="size", from="1 mm", to="2 m", value="1 m" }')
        assert server.ask("POST", "/api/check", {"script": knobs}).json() == {
            "marks": [], "checked_to": 3,
            "knobs": {"size": {"value": 1, "from": 0.001, "to": 2, "log": False, "unit": "m"}}}
        bomb = server.ask("POST", "/api/check", {"script": "while true do end"}).json()
        assert bomb["marks"] and "stopped" in bomb["marks"][0]["message"], bomb


def test_completion_counts_as_a_browser_does():
    with Server(runner.program) as server:
        text = "-- µ𝛼\nlocal lab = require \"asperity\"\nlab.sur"
        units = len(text.encode("utf-16-le")) // 2
        answer = server.ask("POST", "/api/complete", {"text": text, "position": units}).json()
        assert answer["from"] == units - 3, answer
        assert "surface" in [candidate["text"] for candidate in answer["candidates"]], answer
        assert set(answer["candidates"][0]) == {"text", "kind", "detail", "help"}


def test_lessons_are_read_by_name_alone():
    with Server(runner.program) as server:
        lessons = server.ask("GET", "/api/lessons").json()
        assert len(lessons) == 10 and all(lesson["question"] and lesson["minutes"] > 0 for lesson in lessons), lessons
        for lesson in lessons:
            whole = server.ask("GET", "/api/lessons/" + lesson["name"]).json()
            assert whole["title"] and whole["text"] and whole["script"].startswith("--"), whole
        for name in ("..%2f..%2fREADME", "../about", "%2e%2e/%2e%2e/sandbox", "sandbox", ""):
            assert server.ask("GET", "/api/lessons/" + name).status in (404, 400), name


if __name__ == "__main__":
    runner.main(globals())
