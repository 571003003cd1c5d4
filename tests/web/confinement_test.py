#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# What a run cannot do, and what ends it.
import ctypes
import json
import os
import re
import struct
import subprocess
import tempfile

import runner
from client import Server, children_of, finished, of_type, patience, printed, until


escapes = {
    "bytecode": 'local f, why = load(string.dump(function() end), "x", "b") print(f, why)',
    "bytecode by any mode": 'local f = load(string.dump(function() return 7 end)) print(f)',
    "string metatable": 'print(pcall(function() getmetatable("").__index = function() return os.execute end end)) print(pcall(("").execute))',
    "debug": 'print(rawget(debug, "sethook"), rawget(debug, "getregistry"), rawget(debug, "setmetatable"), rawget(debug, "getupvalue"))',
    "library": 'print(package.loadlib, package.cpath) print(pcall(require, "socket"))',
    "program": 'print(pcall(os.execute, "id")) print(pcall(io.popen, "id"))',
    "file": 'print(io.open("/etc/passwd")) print(io.open("../events.jsonl")) print(io.open("/proc/self/environ"))',
    "lines": 'print(pcall(io.lines, "/etc/passwd"))',
    "written": 'print(pcall(io.open, "/tmp/asperity-escaped", "w")) print(pcall(io.open, "../escaped", "w"))',
    "exit code": 'os.exit(0)',
}


def test_script_escapes():
    with Server(runner.program) as server:
        for name, script in escapes.items():
            events = server.run(script)
            said = printed(events) + printed(events, "err") + json.dumps(of_type(events, "error"))
            assert finished(events)["status"] in ("done", "failed"), (name, events)
            for sign in ("root:", "uid=", "PATH=", "file (0x"):
                assert sign not in said, (name, said)
        bytecode = printed(server.run(escapes["bytecode by any mode"]))
        assert bytecode.startswith("nil"), bytecode
        debug = printed(server.run(escapes["debug"]))
        assert debug.split() == ["nil"] * 4, debug
        assert not os.path.exists("/tmp/asperity-escaped") and not os.path.exists(server.folder + "/runs/escaped")
        assert server.ask("GET", "/api/about").status == 200


def test_coroutines_do_not_get_round_the_limits():
    script = """local function go() while true do pcall(function() while true do end end) end end
    while true do local c = coroutine.wrap(go) pcall(c) end"""
    with Server(runner.program, "--limit-time", "2s") as server:
        end = finished(server.run(script))
        assert end["status"] == "limit" and "time" in end["reason"], end


def test_pattern_bombs_are_ended():
    script = "print(string.find(string.rep('a', 100000), string.rep('a-', 60) .. 'b'))"
    with Server(runner.program, "--limit-time", "2s") as server:
        end = finished(server.run(script))
        assert end["status"] == "limit", end


def test_memory_bombs_are_ended():
    bombs = ["local t = {} for k = 1, 1e12 do t[k] = { k } end", "local s = 'x' while true do s = s .. s end",
             "local s = string.rep('x', 1 << 40)", "local t = table.pack(table.unpack({}, 1, 1e8))",
             "require('asperity').surface.flat{ cells=60000, size=1 }"]
    with Server(runner.program, "--limit-memory", "200M") as server:
        for bomb in bombs:
            end = finished(server.run(bomb))
            assert end["status"] in ("limit", "failed") and end["exit"] != 0, (bomb, end)
        assert finished(server.run("print(1)"))["status"] == "done"


def test_a_flood_of_output_is_cut_and_the_run_goes_on():
    with Server(runner.program) as server:
        script = "for k = 1, 3000 do print(string.rep('x', 1000)) end require('asperity').notebook 'n':write{ k=1 }"
        events = server.run(script)
        assert finished(events)["status"] == "done" and of_type(events, "row"), finished(events)
        assert 1 << 20 <= len(printed(events)) < 2 << 20 and "printed more than 1 MiB" in printed(events, "err")
    with Server(runner.program, "--limit-time", "3s") as server:
        for endless in ("while true do print(string.rep('x', 1000)) end", "while true do io.stderr:write('\\255\\128') end"):
            end = finished(server.run(endless))
            assert end["status"] == "limit" and "time" in end["reason"], end


def test_a_flood_of_rows_is_ended():
    script = """local book = require("asperity").notebook "flood"
    local long = string.rep("y", 50000) while true do book:write{ text=long } end"""
    with Server(runner.program) as server:
        end = finished(server.run(script))
        assert end["status"] == "limit", end


def test_no_script_leaves_more_than_its_limit():
    script = """local s = ("x"):rep(2^20) for k = 1, 1000 do
    local f = assert(io.open("f" .. k, "w")) for i = 1, 60 do f:write(s) end f:close() end"""
    many = "for k = 1, 1e9 do local f = assert(io.open('f' .. k, 'w')) f:write('x') f:close() end"
    with Server(runner.program, "--classroom", "127.0.0.1", "--students", "1") as server:
        for k, text in enumerate((script, many), 1):
            assert finished(server.run(text))["status"] in ("limit", "failed")
            run = f"{server.folder}/runs/{k}/run"
            taken = [os.lstat(os.path.join(at, name)) for at, folders, files in os.walk(run) for name in [*folders, *files]]
            assert len(taken) <= 2000, len(taken)
            assert sum(max(one.st_size, 512 * one.st_blocks) for one in taken) <= (64 << 20) + 4096


def test_a_stopped_run_does_not_wait_for_its_drawing():
    script = """local book = require("asperity").notebook "n"
    for k = 1, 60000 do book:write{ k=k, v=math.random(), w=math.random() } end
    print "draws" io.stdout:flush()
    for k = 1, 1e6 do book:chart{ x="v", y="w", file="c" .. k .. ".png" } end"""
    with Server(runner.program, "--runs", "1") as server:
        run = server.begin(script)
        until(lambda: any("gnuplot" in command_of(child) for child in children_of(server.process.pid)), "nothing is drawn")
        server.ask("DELETE", f"/api/runs/{run}")
        assert finished(server.events(run))["status"] == "stopped"
        assert finished(server.run("print(1)"))["status"] == "done"


def command_of(process):
    try:
        with open(f"/proc/{process}/cmdline") as line:
            return line.read()
    except OSError:
        return ""


def test_a_flood_of_files_is_ended():
    one = "local f = io.open('big', 'w') local s = string.rep('z', 1 << 20) while true do assert(f:write(s)) end"
    many = "for k = 1, 1e9 do local f = assert(io.open('d' .. k % 7 .. '/f' .. k, 'w')) f:write('x') f:close() end"
    with Server(runner.program, "--classroom", "127.0.0.1", "--students", "1") as server:
        for script in (one, many):
            end = finished(server.run(script))
            assert end["status"] in ("limit", "failed") and end["exit"] != 0, end
        size = int(subprocess.run(["du", "-sm", server.folder], capture_output=True, text=True).stdout.split()[0])
        assert size < 400, size


bare_request = {"work": "probe", "drawing": False, "memory_bytes": 1 << 30, "file_bytes": 1 << 20, "processor_seconds": 10,
                "script": "", "name": "", "seed": 1, "seconds": 5, "threads": 1, "views": False, "barriers": []}


def probe(*prefix, before=None):
    request = bare_request
    with tempfile.TemporaryDirectory() as folder:
        os.chmod(folder, 0o777)
        done = subprocess.run([*prefix, runner.program, "--confined"], input=json.dumps(request), cwd=folder,
                              capture_output=True, text=True, timeout=patience, preexec_fn=before)
        return json.loads(done.stdout.splitlines()[-1]) if done.stdout else {"error": done.stderr}


drawings = {
    "drawn": ("set print 'picture'\nstats 'data' using 1 nooutput\nprint 'sum ', STATS_sum\nset print", True),
    "a file": ("set print 'picture'\nstats 'SECRET' using 1 nooutput\nprint 'sum ', STATS_sum\nset print", False),
    "a script": ("load 'PLACE/script'", False),
    "a program": ("set print 'picture'\nprint system('echo sum 3')\nset print", False),
    "a pipe": ("set print 'picture'\nstats '< echo 3' using 1 nooutput\nprint 'sum ', STATS_sum\nset print", False),
    "a shell": ("!echo sum 3 > picture\n", False),
    "elsewhere": ("set print 'PLACE/written'\nprint 'sum 3'\nset print", False),
}


def test_gnuplot_of_a_confined_run_gets_out_nowhere():
    numbers = {"x86_64": (0xC000003E, 272), "aarch64": (0xC00000B7, 97)}
    architecture, unshare = numbers.get(os.uname().machine, (0, 0))
    lacking = [None] if architecture == 0 else [None, unshare, 444, 442]  # namespaces, Landlock, attributes of mounts
    with tempfile.TemporaryDirectory() as place:
        with open(place + "/secret", "w") as file, open(place + "/script", "w") as script:
            file.write("1\n2\n")
            script.write("set print 'picture'\nprint 'sum 3'\nset print\n")
        for without in lacking:
            for what, (script, drawn) in drawings.items():
                with tempfile.TemporaryDirectory() as folder:
                    for name, text in (("script", script.replace("SECRET", place + "/secret").replace("PLACE", place)), ("data", "1\n2\n")):
                        with open(f"{folder}/{name}", "w") as file:
                            file.write(text)
                    request = {**bare_request, "work": "draw", "drawing": True}
                    done = subprocess.run([runner.program, "--confined"], input=json.dumps(request), cwd=folder, capture_output=True, text=True,
                                          timeout=patience, preexec_fn=None if without is None else lambda: refuse_calls(architecture, [without]))
                    assert done.returncode != 127, done
                    picture = open(folder + "/picture").read() if os.path.exists(folder + "/picture") else ""
                    assert (re.search("sum +3", picture) is not None) == drawn, (what, without, picture, done)
        assert sorted(os.listdir(place)) == ["script", "secret"], os.listdir(place)


def test_completion_bears_any_text():
    with Server(runner.program) as server:
        for piece in ("(", "{", "[[", "function ", "a.b.c(", "x = { ", "lab.contact{", "\"", "--[[", "a:", "..", "\\u{"):
            text = (piece * (250000 // len(piece)))
            answer = server.ask("POST", "/api/complete", {"text": text, "position": len(text)})
            assert answer.status == 200, (piece, answer.status)


def test_a_confined_run_writes_every_kind_of_file():
    script = """local lab = require "asperity"
    local s = lab.surface.sine{ cells=64, size="1 mm", amplitude="1 um" }
    for _, name in ipairs{ "s.h5", "s.npy", "s.txt", "below/s.csv" } do s:write(name) end
    s:picture("s.png", {})
    print(lab.surface.read("s.h5").digest == s.digest)"""
    with Server(runner.program) as server:
        events = server.run(script)
        assert finished(events)["status"] == "done", events
        names = {event["name"] for event in of_type(events, "file")}
        assert {"s.h5", "s.npy", "below/s.csv", "s.png"} <= names, names
        assert server.ask("GET", "/api/runs/1/files/s.png").body.startswith(b"\x89PNG")
        assert printed(events) == "true\n", printed(events)


def test_runs_use_the_threads_they_have():
    script = """local lab = require "asperity"
    local rows = lab.ensemble{ over={ seed={1, 2, 3, 4, 5, 6, 7, 8} }, run=function(case)
      return { Ra=lab.surface.self_affine{ cells=128, size="1 mm", hurst=0.8, rms_height="1 um", short_wave="32 um",
                                           seed=case.seed }:roughness().Ra } end }
    for _, row in ipairs(rows) do print(row.seed, row.Ra) end"""
    with Server(runner.program) as server:
        events = server.run(script)
        assert finished(events)["status"] == "done" and len(printed(events).splitlines()) == 8, events


def test_a_confined_process_gets_out_nowhere():
    found = probe()
    assert {barrier["name"] for barrier in found["barriers"]} == {"files", "processes", "network", "programs"}, found
    assert all(barrier["holds"] for barrier in found["barriers"]), found
    print("by", ", ".join(found["made"]), "without", ", ".join(found["missing"]) or "nothing")


def test_a_confined_process_of_nobody_gets_out_nowhere():
    if os.geteuid() == 0:
        found = probe("setpriv", "--reuid", "65534", "--regid", "65534", "--clear-groups")
    else:
        found = probe()
    assert len(found.get("barriers", [])) == 4 and all(barrier["holds"] for barrier in found["barriers"]), found
    print("by", ", ".join(found["made"]), "without", ", ".join(found["missing"]) or "nothing")


def test_a_run_cannot_fork_or_reach_others():
    # The parent of the run and its own threads are all there is to aim at; none of it can be named from Lua, so the
    # process itself tries before a script would be begun (sandbox/confinement.cpp). Here: it has no children and
    # there is one process for each run.
    with Server(runner.program) as server:
        run = server.begin("while true do end")
        children = until(lambda: children_of(server.process.pid), "no run began")
        assert len(children) == 1 and children_of(children[0]) == [], children
        status = lambda: open(f"/proc/{children[0]}/status").read()
        until(lambda: "Seccomp:\t2" in status(), "it does not shut itself in")
        facts = status()
        assert "NoNewPrivs:\t1" in facts, facts
        for kind in ("CapEff", "CapPrm", "CapBnd", "CapInh", "CapAmb"):
            assert f"{kind}:\t0000000000000000" in facts, kind
        limits = open(f"/proc/{children[0]}/limits").read()
        assert any(line.split()[3:6] == ["size", "0", "0"] for line in limits.splitlines() if "core" in line), limits
        server.ask("DELETE", f"/api/runs/{run}")


def test_barriers_that_one_kernel_lacks_are_met_by_the_others():
    numbers = {"x86_64": (0xC000003E, 272), "aarch64": (0xC00000B7, 97)}
    if os.uname().machine not in numbers:
        return
    architecture, unshare = numbers[os.uname().machine]
    landlock = 444  # the same on both
    held = {}
    for name, lacking in (("namespaces", [unshare]), ("Landlock", [landlock]), ("both", [unshare, landlock])):
        found = probe(before=lambda lacking=lacking: refuse_calls(architecture, lacking))
        held[name] = {barrier["name"]: barrier["holds"] for barrier in found["barriers"]}
        print(f"without {name}: by {', '.join(found['made'])}; without {', '.join(found['missing'])}")
        assert found["missing"], (name, found)
    assert all(held["namespaces"].values()) and all(held["Landlock"].values()), held
    # Nothing shuts files then; the rest holds, and a room is not served.
    assert not held["both"]["files"] and held["both"]["processes"] and held["both"]["network"], held
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([runner.program, "serve", "--classroom", "127.0.0.1", "--students", "1"], capture_output=True, text=True,
                              cwd=folder, timeout=patience, preexec_fn=lambda: refuse_calls(architecture, [unshare, landlock]))
    assert done.returncode == 2 and "a room is not served" in done.stderr and "NOT SHUT" in done.stderr, done


def refuse_calls(architecture, numbers):
    """A kernel that lacks these system calls, for this process and what it becomes."""
    code = [(0x20, 0, 0, 4), (0x15, 1, 0, architecture), (0x06, 0, 0, 0x7FFF0000), (0x20, 0, 0, 0)]
    for k, number in enumerate(numbers):
        code.append((0x15, len(numbers) - k, 0, number))
    code += [(0x06, 0, 0, 0x7FFF0000), (0x06, 0, 0, 0x00050000 | 38)]  # allowed; ENOSYS
    program_bytes = b"".join(struct.pack("HBBI", *step) for step in code)
    buffer = ctypes.create_string_buffer(program_bytes)
    filter_program = struct.pack("HxxxxxxQ", len(code), ctypes.addressof(buffer))
    library = ctypes.CDLL(None, use_errno=True)
    assert library.prctl(38, 1, 0, 0, 0) == 0
    assert library.prctl(22, 2, ctypes.create_string_buffer(filter_program), 0, 0) == 0, ctypes.get_errno()


if __name__ == "__main__":
    runner.main(globals())
