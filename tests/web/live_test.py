#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# Scripts that follow their knobs: what a move computes, who ends whom, and that no process is left behind.
import json
import os
import signal
import struct
import threading

import runner
from client import Server, alive, children_of, patience, processor_ticks, until

pressed = """
local lab = require "asperity"
local p = lab.knob{ name="pressure", from="1 MPa", to="200 MPa", value="20 MPa", log=true }
local s = lab.surface.self_affine{ cells=64, size="1 mm", hurst=0.8, rms_height="1 um", short_wave="40 um",
  material=lab.material "Al-2011" }
local c = lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
local st = c:press{ pressure=p }
print("at", p)
lab.notebook "areas":write{ ["p [Pa]"]=p, area=st.area_fraction }
"""
endless = 'local n = require "asperity".knob{ name="n", from=0, to=9, value=1 }\nif n > 1 then while true do end end\nprint(n)\n'


def frames(body):
    at, parts = 0, []
    while at < len(body):
        count, = struct.unpack_from("<Q", body, at)
        at += 8
        texts = []
        for _ in range(count):
            length, = struct.unpack_from("<Q", body, at)
            texts.append(body[at + 8:at + 8 + length])
            at += 8 + length
        parts.append(json.loads(texts[0]) | {"numbers": [struct.unpack(f"<{len(t) // 4}f", t) for t in texts[1:]]})
    return parts


def begin(server, script, tab="tab", token=None):
    answer = server.ask("POST", "/api/live", {"script": script, "tab": tab}, token=token)
    assert answer.status == 201, (answer.status, answer.body)
    return answer.json()["id"]


def move(server, live, token=None, view="", map="", **knobs):
    answer = server.ask("POST", f"/api/live/{live}", {"knobs": knobs, "view": view, "map": map}, token=token)
    assert answer.status == 200, (answer.status, answer.body)
    return frames(answer.body)


def whole(parts):
    assert parts[-1]["part"] == "whole", parts[-1]
    return parts[-1]


def events(part, kind):
    return [event for event in part["events"] if event["type"] == kind]


def until_gone(processes):
    until(lambda: not any(alive(process) for process in processes), "a process stays")


def until_it_has(server, count):
    return until(lambda: len(found := children_of(server.process.pid)) == count and found, f"there should be {count} processes")


def until_it_computes(process):
    """A tenth of a second of processor time, which only a loop without end takes."""
    begun = processor_ticks(process)
    until(lambda: processor_ticks(process) > begun + 10, "it does not compute")


def test_a_move_computes_what_the_knob_touches():
    with Server(runner.program) as server:
        live = begin(server, pressed)
        first = whole(move(server, live))
        process, = children_of(server.process.pid)
        assert (first["computed"], first["recalled"]) == (2, 0), first
        assert first["knobs"]["pressure"]["value"] == 2e7
        second = whole(move(server, live, pressure="50 MPa"))
        assert (second["computed"], second["recalled"]) == (1, 1), second
        assert events(second, "output")[0]["text"] == "at\t50000000.0\n"
        row = events(second, "row")[0]
        assert row["notebook"] == "areas" and row["row"]["p"] == 5e7, row
        assert [view["name"] for view in second["views"]] == ["surface-1", "press-1"]
        assert second["view"]["name"] == "press-1"
        names = [field["name"] for field in second["view"]["fields"]]
        assert names[:3] == ["pressure", "gap", "contact"], names
        pressure = second["numbers"][0]
        assert len(pressure) == 64 * 64 and abs(sum(pressure) / len(pressure) / 5e7 - 1) < 1e-4
        again = whole(move(server, live))
        assert (again["computed"], again["recalled"]) == (0, 2), again
        assert again["numbers"] == first["numbers"]
        surface = whole(move(server, live, view="surface-1"))
        assert surface["view"]["name"] == "surface-1" and len(surface["numbers"]) == 1
        gap, others = move(server, live, map="gap")
        assert (gap["part"], gap["first"], others["part"]) == ("whole", 1, "others"), (gap, others)
        assert others["numbers"][:1] + gap["numbers"] + others["numbers"][1:] == first["numbers"]
        assert whole(move(server, live, map="height"))["numbers"] == first["numbers"], "a map of another view"
        assert children_of(server.process.pid) == [process], "no other process was started"


def test_what_a_knob_gives_is_what_a_run_records():
    with Server(runner.program) as server:
        row = events(whole(move(server, begin(server, pressed), pressure="37 MPa")), "row")[0]["row"]
        recorded = [e for e in server.run(pressed, knobs={"pressure": "37 MPa"}) if e["type"] == "row"][0]["row"]
        assert row == recorded, (row, recorded)


def test_mistakes_end_no_session():
    with Server(runner.program) as server:
        script = pressed.replace("local st", 'if p > 1.5e8 then error "too much" end\nlocal st')
        live = begin(server, script)
        failed = whole(move(server, live, pressure="180 MPa"))
        error = events(failed, "error")[0]
        assert error["line"] == 7 and error["message"] == "too much", error
        assert whole(move(server, live, pressure="10 MPa"))["computed"] == 1
        unknown = events(whole(move(server, live, preshure="10 MPa")), "error")[0]["message"]
        assert "did you mean `pressure`" in unknown, unknown
        assert server.ask("POST", f"/api/live/{live}", {"knobs": {"pressure": "much"}}).status == 400
        # Wrong kinds are told by their names.
        for knobs, words in ((3, "`knobs` is no object"), ({"pressure": 3}, "the value of `pressure` is no text")):
            answer = server.ask("POST", f"/api/live/{live}", {"knobs": knobs})
            assert answer.status == 400 and words in answer.json()["error"]["message"], (answer.status, answer.json())
        assert "`tab` is no text" in server.ask("POST", "/api/live", {"script": script, "tab": 3}).json()["error"]["message"]


# Its status, what it had printed and warned of, and its tables; another move is answered by the same process.
def test_a_script_that_ends_itself_is_answered():
    with Server(runner.program) as server:
        live = begin(server, pressed + """
io.write("no newline")
if p > 1.5e8 then os.exit(3) end
if p > 1.2e8 then os.exit() end
if p > 1.1e8 then pcall(os.exit, false) end
if p > 1.0e8 then coroutine.wrap(function() pcall(os.exit, 4) while true do end end)() end
print(" and its end")
""")
        first = whole(move(server, live))
        process = children_of(server.process.pid)
        assert "exit" not in first and not events(first, "error"), first
        assert events(first, "output")[0]["text"] == "at\t20000000.0\nno newline and its end\n", first
        for pressure, status in (("160 MPa", 3), ("130 MPa", 0), ("115 MPa", 1), ("105 MPa", 4), ("160 MPa", 3)):
            ended = whole(move(server, live, pressure=pressure))
            assert ended["exit"] == status, ended
            value = float(pressure.split()[0]) * 1e6
            assert events(ended, "output")[0]["text"] == f"at\t{value}\nno newline", ended
            assert events(ended, "row")[0]["row"]["p"] == value, ended
            assert ended["knobs"]["pressure"]["value"] == value, ended
            assert ended["view"]["name"] == "press-1" and len(ended["numbers"][0]) == 64 * 64
            messages = [event["message"] for event in events(ended, "error")]
            assert messages == ([f"the script ended itself by os.exit({status})"] if status else []), ended
        assert (ended["computed"], ended["recalled"]) == (0, 2), "computed before, and in memory"
        assert whole(move(server, live, pressure="20 MPa"))["recalled"] == 2
        assert children_of(server.process.pid) == process
        # One that names a knob it does not make is told so, however it ends.
        unmade = whole(move(server, begin(server, "print(1) os.exit()"), n="1"))
        assert unmade["exit"] == 0 and "`n`" in events(unmade, "error")[0]["message"], unmade


def test_a_newer_move_ends_an_endless_one():
    with Server(runner.program) as server:
        live = begin(server, endless)
        assert whole(move(server, live))["events"][0]["text"] == "1.0\n"
        older = []
        asking = threading.Thread(target=lambda: older.extend(move(server, live, n="5")))
        asking.start()
        process = children_of(server.process.pid)
        until_it_computes(process[0])
        assert whole(move(server, live, n="0"))["events"][0]["text"] == "0.0\n"
        asking.join()
        assert [part["part"] for part in older] == ["outdated"], older
        assert children_of(server.process.pid) == process


def test_a_limit_of_time_is_met():
    with Server(runner.program, "--limit-time", "3s") as server:
        live = begin(server, endless)
        message = events(whole(move(server, live, n="5")), "error")[0]["message"]
        assert "time limit of 3 s" in message, message
        assert whole(move(server, live, n="1"))["events"][0]["text"] == "1.0\n"
        # What cannot be interrupted is ended with its process, and the next move finds none.
        stuck = begin(server, 'local n = require "asperity".knob{ name="n", from=0, to=9, value=1 }\n'
                              'string.rep("a", 300):find(string.rep(".-", 12) .. "b")\n')
        process = children_of(server.process.pid)
        last = move(server, stuck)[-1]
        assert last["part"] == "ended" and "time limit" in last["why"], last
        until_gone(process)
        until(lambda: server.ask("POST", f"/api/live/{stuck}", {"knobs": {}}).status == 404, "its end is not known")


def test_long_moves_are_answered_on_fewer_cells_first():
    with Server(runner.program) as server:
        live = begin(server, pressed.replace("cells=64", "cells=2048"))
        move(server, live)
        move(server, live, pressure="30 MPa")
        parts = move(server, live, pressure="40 MPa")
        assert [part["part"] for part in parts] == ["coarse", "whole"], [part["part"] for part in parts]
        coarse, fine = parts
        assert coarse["factor"] < 1 and fine["factor"] == 1
        assert coarse["view"]["fields"][0]["from_nx"] == 2048 * coarse["factor"]
        assert fine["view"]["fields"][0]["from_nx"] == 2048


def test_cells_that_a_script_does_not_take_are_not_tried_again():
    with Server(runner.program) as server:
        # At half of its cells the shortest wave would have fewer than two.
        live = begin(server, pressed.replace("cells=64", "cells=512").replace("40 um", "4 um"))
        for pressure in range(20, 25):
            parts = move(server, live, pressure=f"{pressure} MPa")
            assert [part["part"] for part in parts] == ["whole"], parts
            assert not events(parts[0], "error"), parts


def test_barriers_hold_while_a_knob_moves():
    with Server(runner.program, "--limit-memory", "500M") as server:
        live = begin(server, 'local f, why = io.open("/etc/passwd")\nprint(f, why)\nprint(pcall(os.execute, "true"))\n')
        text = events(whole(move(server, live)), "output")[0]["text"]
        assert text.startswith("nil\t") and "root:" not in text, text
        big = begin(server, 'local t = {}\nfor k = 1, 1e9 do t[k] = ("x"):rep(1e6) .. k end\n')
        last = move(server, big)[-1]
        assert last["part"] == "ended" or "memory" in events(last, "error")[0]["message"], last
        long = begin(server, 'for k = 1, 1e5 do print(("x"):rep(100)) end\n')
        text = events(whole(move(server, long)), "output")[0]["text"]
        assert len(text) < 70000 and text.endswith("printed more than is shown while a knob moves\n")


def test_one_script_a_tab_and_nobody_elses():
    with Server(runner.program, "--classroom", "127.0.0.1", "--students", "2") as server:
        one, two = server.tokens["student 1"], server.tokens["student 2"]
        live = begin(server, endless, token=one)
        move(server, live, token=one)
        mine = children_of(server.process.pid)
        assert server.ask("POST", f"/api/live/{live}", {"knobs": {}}, token=two).status == 404
        assert server.ask("DELETE", f"/api/live/{live}", token=two).status == 200
        assert alive(mine[0]), "another person's word ends nothing"
        # Another script of the same tab takes its place.
        other = begin(server, pressed, token=one)
        until_gone(mine)
        until_it_has(server, 1)
        assert server.ask("POST", f"/api/live/{live}", {"knobs": {}}, token=one).status == 404
        # Of one person's tabs the one that was left longest makes room.
        tabs = [begin(server, endless, tab=f"tab {k}", token=one) for k in range(4)]
        assert server.ask("POST", f"/api/live/{other}", {"knobs": {}}, token=one).status == 404
        whole(move(server, tabs[-1], token=one))
        until_it_has(server, 2)
        assert whole(move(server, begin(server, endless, token=two), token=two))
        for tab in tabs:
            server.ask("DELETE", f"/api/live/{tab}", token=one)
        until_it_has(server, 1)


def test_no_process_is_left_of_a_server_that_ends():
    for how in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
        with Server(runner.program) as server:
            move(server, begin(server, endless, tab="idle"))
            idle = children_of(server.process.pid)
            busy = begin(server, endless, tab="busy")
            asking = threading.Thread(target=lambda: _quietly(lambda: move(server, busy, n="5")))
            asking.start()
            processes = until_it_has(server, 2)
            until_it_computes(*[process for process in processes if process not in idle])
            server.process.send_signal(how)
            server.process.wait(patience)
            until_gone(processes)
            asking.join()
            assert not os.path.exists(server.folder + "/runs/scratch") or how == signal.SIGKILL


def _quietly(act):
    try:
        act()
    except Exception:
        pass


if __name__ == "__main__":
    runner.main(globals())
