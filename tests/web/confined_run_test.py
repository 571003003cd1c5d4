#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# `asperity run --confined`: what a script of somebody else's cannot do, and that all else is as in any other run.
import json
import os
import shutil
import signal
import subprocess
import tempfile
from contextlib import contextmanager

import runner
from client import alive, in_terminal, patience, until
from confinement_test import refuse_calls


@contextmanager
def workshop():
    """A folder with a home, a script's folder in it, and secrets around."""
    top = os.path.realpath(tempfile.mkdtemp(prefix="asperity-confined-"))
    try:
        for folder in ("home/work", "home/data", "other"):
            os.makedirs(f"{top}/{folder}")
        for secret in ("home/.secret", "other/secret"):
            with open(f"{top}/{secret}", "w") as file:
                file.write("SECRET")
        with open(f"{top}/home/data/in.txt", "w") as file:
            file.write("data of its own\n")
        with open(f"{top}/home/work/beside.lua", "w") as file:
            file.write("return 'a module beside'\n")
        yield top
    finally:
        shutil.rmtree(top, ignore_errors=True)


def put(top, text, name="s.lua"):
    with open(f"{top}/home/work/{name}", "w") as file:
        file.write(text)


def asperity(top, *arguments, cwd="home/work", before=None, environment=None):
    return subprocess.run([runner.program, *arguments], cwd=f"{top}/{cwd}", capture_output=True, text=True, errors="replace",
                          timeout=patience, preexec_fn=before, env={**os.environ, "HOME": top + "/home", **(environment or {})})


def manifest(top, run="home/work/R"):
    with open(f"{top}/{run}/manifest.json") as file:
        return json.load(file)


work = """local lab = require "asperity"
print(require "beside", arg[1], ...)
io.stderr:write "to standard error\\n"
local book = lab.notebook "n"
for k = 1, 3 do book:write{ k=k, square=k * k } end
book:expect("square", { at_least=1 })
book:chart{ x="k", y="square" }
lab.surface.sine{ cells=16, size=1e-3, amplitude=1e-6 }:write "s.h5"
"""


def test_it_does_what_any_run_does():
    with workshop() as top:
        put(top, work)
        free = asperity(top, "run", "s.lua", "--out", "F", "--", "one", "t\xe9xt")
        done = asperity(top, "run", "--confined", "--read", ".", "s.lua", "--out", "R", "--", "one", "t\xe9xt")
        assert free.returncode == 0 and done.returncode == 0, (free, done)
        assert done.stdout == free.stdout and "a module beside" in done.stdout, done.stdout
        assert "to standard error" in done.stderr and "results in" in done.stderr, done.stderr
        for name in ("n.csv", "n-square-k.svg", "s.h5", "journal.jsonl"):
            with open(f"{top}/home/work/R/{name}", "rb") as one, open(f"{top}/home/work/F/{name}", "rb") as other:
                ours, theirs = one.read(), other.read()
                assert ours == theirs or name == "journal.jsonl", name
        facts = manifest(top)
        assert facts["confined"] is True and facts["status"] == "done", facts
        assert facts["unhashed"]["barriers"]["read"] == [top + "/home/work"] and facts["unhashed"]["barriers"]["by"], facts
        assert facts["unhashed"]["directory"] == top + "/home/work/R", facts["unhashed"]
        # What the process that works can no longer look at was found out before.
        assert facts["unhashed"]["machine"] == manifest(top, "home/work/F")["unhashed"]["machine"], facts["unhashed"]
        assert "confined" not in manifest(top, "home/work/F")
        # From elsewhere, by other names of the place, and into the usual directory.
        os.symlink(top + "/home/work", top + "/other/link")
        again = asperity(top, "run", "--confined", "--read", "link", "link/s.lua", "--", "one", "t\xe9xt", cwd="other")
        assert again.returncode == 0 and again.stdout == free.stdout, again
        assert os.path.exists(top + "/other/runs/s-1/n.csv"), again.stderr


def test_status_of_what_fails_passes_through():
    with workshop() as top:
        put(top, "error 'on purpose'")
        failed = asperity(top, "run", "--confined", "s.lua", "--out", "R")
        assert failed.returncode == 1 and "s.lua:1: on purpose" in failed.stderr, failed
        assert f"no files but those in {top}/home/work/R; --read FOLDER adds more" in failed.stderr, failed
        put(top, "os.exit(7)")
        assert asperity(top, "run", "--confined", "s.lua").returncode == 7
        assert asperity(top, "run", "--confined", "nothing.lua").returncode == 2
        assert asperity(top, "run", "--confined", "s.lua", "--out", "R").returncode == 2
        trusted = asperity(top, "run", "--confined", "--trust", "s.lua")
        assert trusted.returncode == 2 and "--trust" in trusted.stderr, trusted
        mpi = asperity(top, "run", "--confined", "s.lua", environment={"OMPI_COMM_WORLD_SIZE": "2", "OMPI_COMM_WORLD_RANK": "0"})
        assert mpi.returncode == 2 and "mpirun" in mpi.stderr, mpi
        loose = asperity(top, "run", "--read", "../data", "s.lua")
        assert loose.returncode == 2 and "--confined" in loose.stderr, loose


reading = """for _, name in ipairs(arg) do
  local file, why = io.open(name)
  print(name, file and file:read "a" or "refused")
end
for _, name in ipairs{ "../written", "../../other/written", "/tmp/asperity-written", "beside.lua" } do
  local good, file = pcall(io.open, name, "w")
  if good and file then file:write "x" file:close() end
end
"""


def test_it_reads_the_folders_named_and_no_hand_in_beside_it():
    with workshop() as top:
        put(top, reading)
        os.symlink(top + "/other/secret", top + "/home/work/link")
        os.symlink(top + "/other", top + "/home/work/folder")
        secrets = ["/etc/passwd", "../.secret", top + "/other/secret", "link", "folder/secret", "/proc/self/environ", "/proc/1/cmdline"]
        done = asperity(top, "run", "--confined", "s.lua", "--out", "R", "--", *secrets, "beside.lua", "./beside.lua", "../data/in.txt")
        assert done.returncode == 0, done
        found = dict(line.split("\t") for line in done.stdout.splitlines() if "\t" in line)
        assert all(found[name] == "refused" for name in [*secrets, "beside.lua", "./beside.lua", "../data/in.txt"]), done.stdout
        own = asperity(top, "run", "--confined", "--read", ".", "s.lua", "--", "beside.lua")
        assert "a module beside" in own.stdout, own
        named = asperity(top, "run", "--confined", "--read", "../data", "s.lua", "--", *secrets, "../data/in.txt")
        found = dict(line.split("\t") for line in named.stdout.splitlines() if "\t" in line)
        assert "data of its own" in found["../data/in.txt"], named
        assert all(found[name] == "refused" for name in secrets), named.stdout
        for written in ("home/written", "other/written"):
            assert not os.path.exists(f"{top}/{written}"), written
        assert not os.path.exists("/tmp/asperity-written")
        with open(f"{top}/home/work/beside.lua") as file:
            assert file.read() == "return 'a module beside'\n"
        assert asperity(top, "run", "--confined", "--read", "nowhere", "s.lua").returncode == 2
        assert asperity(top, "run", "--confined", "--read", "/", "s.lua").returncode == 2


def test_links_in_the_folder_of_a_script_lead_nowhere():
    # A folder from elsewhere may hold a link instead of the script, or of the data it asks to be given.
    with workshop() as top:
        os.symlink("../.secret", top + "/home/work/s.lua")
        refused = asperity(top, "run", "--confined", "s.lua", "--out", "R")
        assert refused.returncode == 2 and "is a link to " + top + "/home/.secret" in refused.stderr, refused
        assert not os.path.exists(top + "/home/work/R"), "a run was begun"
        os.remove(top + "/home/work/s.lua")
        put(top, "print(io.open 'inner.lua', ...)", "inner.lua")
        os.symlink("inner.lua", top + "/home/work/s.lua")
        assert "file (" in asperity(top, "run", "--confined", "--read", ".", "s.lua").stdout
        os.symlink("../../other", top + "/home/work/data")
        named = asperity(top, "run", "--confined", "--read", "data/", "s.lua")
        assert named.returncode == 0 and "data is a link to " + top + "/other" in named.stderr, named


def test_one_process_works_in_a_run_directory():
    with workshop() as top:
        put(top, """local book = require("asperity").notebook "n" book:write{ k=1 } print "begun" io.stdout:flush()
        repeat local go = io.open "../data/go" until go book:write{ k=2 }""")
        run = subprocess.Popen([runner.program, "run", "--confined", "--read", "../data", "s.lua", "--out", "R"],
                               cwd=top + "/home/work", text=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env={**os.environ, "HOME": top + "/home"})
        assert run.stdout.readline() == "begun\n"
        there = {name: os.stat(f"{top}/home/work/R/{name}").st_mtime_ns for name in os.listdir(top + "/home/work/R")}
        for arguments in (["run", "--confined", "s.lua", "--out", "R"], ["run", "s.lua", "--out", "R"], ["run", "--resume", "R", "--read", "../data"],
                          ["run", "--confined", "--read", "../data", "s.lua", "--resume", "R", "--reuse", "R"], ["replay", "R", "--read", "../data", "--out", "R"]):
            second = asperity(top, *arguments)
            named = f"is being written by process {run.pid} on {os.uname().nodename}"
            assert second.returncode == 2 and named in second.stderr, (arguments, second)
        assert {name: os.stat(f"{top}/home/work/R/{name}").st_mtime_ns for name in os.listdir(top + "/home/work/R")} == there
        # It is killed: one process takes it up, at once.
        run.kill()
        run.communicate()
        open(top + "/home/data/go", "w").close()
        again = asperity(top, "run", "--resume", "R", "--read", "../data")
        assert again.returncode == 0 and manifest(top)["status"] == "done" and manifest(top)["confined"] is True, again
        with open(top + "/home/work/R/n.csv") as table:
            assert len(table.readlines()) == 3, "rows twice"


def test_links_in_the_run_directory_lead_nowhere():
    script = """local f = io.open("table.csv", "w") print(f) if f then f:write "x" f:close() end
    local g = io.open("folder/secret", "w") print(g) if g then g:write "x" g:close() end while true do end"""
    with workshop() as top:
        put(top, script.replace("while true do end", "error 'cut off'"))
        asperity(top, "run", "--confined", "s.lua", "--out", "R")
        os.remove(top + "/home/work/R/table.csv")
        shutil.rmtree(top + "/home/work/R/folder", ignore_errors=True)
        os.symlink(top + "/other/secret", top + "/home/work/R/table.csv")
        os.symlink(top + "/other", top + "/home/work/R/folder")
        asperity(top, "run", "--resume", "R")
        # Nor in the place of its own files.
        for own in (".lock", "journal.jsonl", "manifest.json", "store"):
            shutil.rmtree(top + "/home/work/R2", ignore_errors=True)
            shutil.copytree(top + "/home/work/R", top + "/home/work/R2", symlinks=True)
            victim = top + ("/other" if own == "store" else "/other/victim")
            if own != "store":
                shutil.copy(top + "/home/work/R/" + own, victim)
                os.remove(top + "/home/work/R2/" + own)
            before = open(top + "/other/victim", "rb").read()
            os.symlink(victim, top + "/home/work/R2/" + own)
            refused = asperity(top, "run", "--confined", "--resume", "R2")
            assert refused.returncode == 2 and "is a link" in refused.stderr, (own, refused)
            assert open(top + "/other/victim", "rb").read() == before and sorted(os.listdir(top + "/other")) == ["secret", "victim"]
        with open(top + "/other/secret") as file:
            assert file.read() == "SECRET"


def test_the_home_folder_is_not_read():
    with workshop() as top:
        put(top, "print(io.open '.secret' == nil and 'unread')", "../s.lua")
        alone = asperity(top, "run", "--confined", "s.lua", cwd="home")
        assert alone.returncode == 0 and "unread" in alone.stdout, alone
        wished = asperity(top, "run", "--confined", "--read", ".", "s.lua", cwd="home")
        assert wished.returncode == 0, wished
        # In a folder below, what lies in the home is not there, and nothing of the environment comes along.
        put(top, "print(io.open(os.getenv('HOME') or '../.secret'), os.getenv 'TOKEN')")
        below = asperity(top, "run", "--confined", "s.lua", environment={"TOKEN": "a key"})
        assert below.returncode == 0 and "a key" not in below.stdout and "file (" not in below.stdout, below
        # Nor is it written.
        for option in ("--store", "--resume"):
            written = asperity(top, "run", "--confined", option, "..", "s.lua")
            assert written.returncode == 2 and option in written.stderr and "home folder" in written.stderr, written
        assert sorted(os.listdir(top + "/home")) == [".secret", "data", "runs", "s.lua", "work"], os.listdir(top + "/home")


def test_no_process_no_socket_no_program():
    # What a script that got out of the language would try: the same process with the same barriers tries it.
    with workshop() as top:
        request = {"work": "probe", "drawing": False, "memory_bytes": 1 << 30, "file_bytes": 1 << 20, "processor_seconds": 10,
                   "script": "", "name": "", "seed": 1, "seconds": 5, "threads": 1, "views": False, "barriers": [],
                   "places": [{"folder": top + "/home/work", "seen": top + "/home/work", "write": False},
                              {"folder": top + "/home/data", "seen": top + "/home/data", "write": True}],
                   "work_folder": top + "/home"}
        done = subprocess.run([runner.program, "--confined"], input=json.dumps(request), cwd=top + "/home/data",
                              capture_output=True, text=True, timeout=patience)
        found = json.loads(done.stdout.splitlines()[-1])
        assert [barrier["name"] for barrier in found["barriers"] if barrier["holds"]] == ["files", "processes", "network", "programs"], found
        put(top, "print(pcall(os.execute, 'id'), pcall(io.popen, 'id'), package.loadlib, io.read())")
        tried = asperity(top, "run", "--confined", "s.lua")
        assert "uid=" not in tried.stdout and tried.stdout.endswith("nil\tnil\n"), tried
        # The process itself, from outside: no rights, a filter, nothing inherited but its pipes.
        put(top, "while true do end")
        run = subprocess.Popen([runner.program, "run", "--confined", "s.lua", "--out", "R"], cwd=top + "/home/work",
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, "HOME": top + "/home"})
        try:
            child = child_of(run.pid, top)
            facts = open(f"/proc/{child}/status").read()
            assert "NoNewPrivs:\t1" in facts and "CapEff:\t0000000000000000" in facts, facts
            with open(f"/proc/{child}/cmdline", "rb") as line:
                assert line.read() == b"asperity\0--confined\0"
        finally:
            run.kill()
            run.wait()
        until(lambda: not alive(child), "the script outlives who runs it")


def child_of(parent, top):
    """The confined process, once its script runs."""
    def found():
        for entry in os.listdir("/proc"):
            try:
                with open(f"/proc/{entry}/stat") as facts:
                    if not entry.isdigit() or facts.read().rsplit(")", 1)[1].split()[1] != str(parent):
                        continue
                if "Seccomp:\t2" in open(f"/proc/{entry}/status").read() and os.path.exists(top + "/home/work/R/manifest.json"):
                    return int(entry)
            except (OSError, IndexError):
                pass
    return until(found, "there is no confined process")


def state_of(process):
    with open(f"/proc/{process}/stat") as facts:
        return facts.read().rsplit(")", 1)[1].split()[0]


def bounded(top, script, *options):
    """What is said of a script that must meet a limit."""
    put(top, script)
    shutil.rmtree(top + "/home/work/R", ignore_errors=True)
    done = asperity(top, "run", "--confined", *options, "s.lua", "--out", "R")
    assert done.returncode == 1, (script, done)
    return done.stderr


def test_time_and_memory_meet_their_limits():
    with workshop() as top:
        assert "time limit of 300 ms" in bounded(top, "while true do end", "--limit-time", "0.3s")
        assert "memory limit of 60 MiB" in bounded(top, "local t = {} for k = 1, 1e12 do t[k] = { k } end", "--limit-memory", "60M")
        # A function of C that never comes back is given two seconds.
        pattern = "string.find(string.rep('a', 100000), string.rep('a-', 60) .. 'b')"
        assert "time limit of 300 ms" in bounded(top, pattern, "--limit-time", "0.3s")


def test_no_run_leaves_more_on_the_disk_than_it_may():
    with workshop() as top:
        flood = """local s = ("x"):rep(2^20) for k = 1, 1000 do
        local f = assert(io.open("f" .. k, "w")) for i = 1, 6 do f:write(s) end f:close() end"""
        said = bounded(top, flood, "--limit-disk", "30M")
        assert "30 MiB" in said and "removed" in said, said
        size = sum(max(os.lstat(os.path.join(at, name)).st_size, 512 * os.lstat(os.path.join(at, name)).st_blocks)
                   for at, folders, files in os.walk(top + "/home/work/R") for name in [*folders, *files])
        assert size <= 30 << 20, size
        assert os.path.exists(top + "/home/work/R/manifest.json")


def test_removed_files_are_no_hiding_place():
    with workshop() as top:
        put(top, """local s, open = ("x"):rep(2^18), {}
        for k = 1, 3 do open[k] = assert(io.open("f" .. k, "w+")) os.remove("f" .. k) end
        for i = 1, 10 do for k = 1, 3 do open[k]:write(s) open[k]:flush() end end
        local function kept(k) return open[k]:seek "end" > 0 end
        while arg[1] and (kept(1) or kept(2) or kept(3)) do end
        for k = 1, 3 do print(kept(k)) end""")
        assert asperity(top, "run", "s.lua").stdout.split() == ["true"] * 3
        hidden = asperity(top, "run", "--confined", "--limit-disk", "5M", "s.lua", "--", "wait")
        assert hidden.returncode == 0 and hidden.stdout.split() == ["false"] * 3, hidden


cut_off = """local lab = require "asperity"
print(io.open("../.secret"), io.open("../data/in.txt"))
lab.notebook "n":write{ k=1 }
if not io.open "../data/go" then error "cut off" end
"""


def test_resume_and_replay_are_confined():
    with workshop() as top:
        put(top, cut_off)
        begun = asperity(top, "run", "--confined", "--read", "../data", "s.lua", "--out", "R")
        assert begun.returncode == 1 and "cut off" in begun.stderr, begun
        assert begun.stdout.startswith("nil") and "file (" in begun.stdout, begun.stdout
        # Whoever goes on with it names again what it may read.
        bare = asperity(top, "run", "--resume", "R")
        assert bare.returncode == 2 and "--read " + top + "/home/data" in bare.stderr, bare
        open(top + "/home/data/go", "w").close()
        ended = asperity(top, "run", "--resume", "R", "--read", "../data")
        assert ended.returncode == 0 and ended.stdout.startswith("nil") and "file (" in ended.stdout, ended
        facts = manifest(top)
        assert facts["confined"] is True and facts["status"] == "done", facts
        over = asperity(top, "run", "--resume", "R", "--read", "../data")
        assert over.returncode == 0 and "nothing to resume" in over.stderr, over
        with open(top + "/home/work/R/n.csv", "w"):
            pass
        mended = asperity(top, "run", "--resume", "R", "--read", "../data")
        assert mended.returncode == 0 and "every file is again as it was recorded" in mended.stderr, mended
        bare = asperity(top, "replay", "R")
        assert bare.returncode == 2 and "--read" in bare.stderr, bare
        again = asperity(top, "replay", "R", "--read", "../data", "--out", "R2")
        assert again.returncode == 0 and "the same again" in again.stdout, again
        assert manifest(top, "home/work/R2")["confined"] is True
        # A run that was free may be replayed behind barriers, too.
        assert asperity(top, "run", "s.lua", "--out", "F").returncode == 0
        assert asperity(top, "replay", "F", "--confined", "--read", "../data", "--out", "F2").returncode == 0
        assert manifest(top, "home/work/F2")["confined"] is True


def test_a_manifest_that_denies_its_barriers_is_removed():
    # As a script could that got out of the language.
    with workshop() as top:
        put(top, "while true do end")
        run = subprocess.Popen([runner.program, "run", "--confined", "s.lua", "--out", "R"], cwd=top + "/home/work", text=True,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env={**os.environ, "HOME": top + "/home"})
        child = child_of(run.pid, top)
        facts = manifest(top)
        del facts["confined"]
        with open(top + "/home/work/R/manifest.json", "w") as file:
            json.dump(facts, file)
        os.kill(child, signal.SIGKILL)
        _, said = run.communicate(timeout=patience)
        assert run.returncode == 137 and "no longer said that the run was confined" in said, (run.returncode, said)
        assert not os.path.exists(top + "/home/work/R/manifest.json")
        # One of a free run that is only looked at stays.
        put(top, "print(1)")
        assert asperity(top, "run", "s.lua", "--out", "F").returncode == 0
        assert "nothing to resume" in asperity(top, "run", "--confined", "--resume", "F").stderr
        assert manifest(top, "home/work/F")["status"] == "done"


def test_a_record_decides_nothing_of_what_is_read():
    with workshop() as top:
        put(top, 'print(io.open("' + top + '/home/data/in.txt")) error "cut off"')
        assert asperity(top, "run", "--confined", "s.lua", "--out", "R").returncode == 1
        facts = manifest(top)
        # As if the script had lain there.
        facts["unhashed"]["script_path"] = top + "/home/data/s.lua"
        with open(top + "/home/work/R/manifest.json", "w") as file:
            json.dump(facts, file)
        resumed = asperity(top, "run", "--resume", "R")
        assert resumed.returncode == 1 and resumed.stdout.startswith("nil"), resumed


def test_stores_and_shards():
    script = """local lab = require "asperity"
    local rows = lab.ensemble{ over={ k={ 1, 2, 3, 4 } }, run=function(case) return { y=2 * case.k } end }"""
    with workshop() as top:
        put(top, script)
        for shard in ("1/2", "2/2"):
            done = asperity(top, "run", "--confined", "--store", "../data/store", "--shard", shard, "s.lua")
            assert done.returncode == 0, done
        whole = asperity(top, "run", "--confined", "--store", "../data/store", "s.lua", "--out", "R")
        assert whole.returncode == 0 and os.listdir(top + "/home/data/store"), whole
        reused = asperity(top, "run", "--confined", "--reuse", "../data/store", "s.lua", "--out", "U")
        assert reused.returncode == 0, reused
        # Every case result is copied, for a later resume. The shared store has the list of its cases besides, for `status`.
        taken, shared = set(os.listdir(top + "/home/work/U/store")), set(os.listdir(top + "/home/data/store"))
        assert "4 results" in reused.stderr and taken < shared and len(shared - taken) == 1, (reused, shared - taken)
        # It adds no more to a folder of others than it may take on the disk, the list of cases included.
        put(top, script.replace("4 }", ", ".join(map(str, range(4, 250))) + " }"))
        little = asperity(top, "run", "--confined", "--store", "../data/little", "--shard", "1/1", "--limit-disk", "60K", "s.lua")
        assert little.returncode == 1 and "60 KiB that it may add to its store" in little.stderr, little
        added = sum(os.path.getsize(os.path.join(folder, file))
                    for folder, _, files in os.walk(top + "/home/data/little") for file in files)
        assert 0 < added <= 60 * 1024, added


def test_signals_and_progress_pass_through():
    with workshop() as top:
        put(top, "print 'begun' io.stdout:flush() while true do end")
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            run = subprocess.Popen([runner.program, "run", "--confined", "s.lua"], cwd=top + "/home/work", text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ, "HOME": top + "/home"})
            assert run.stdout.readline() == "begun\n"
            run.send_signal(number)
            _, said = run.communicate(timeout=patience)
            assert run.returncode == 128 + number and "interrupted" in said, (run.returncode, said)
        # Ctrl-Z rests both; who was started by nohup goes on when its terminal is closed.
        run = subprocess.Popen([runner.program, "run", "--confined", "s.lua", "--out", "R"], cwd=top + "/home/work", text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ, "HOME": top + "/home"},
                               preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        assert run.stdout.readline() == "begun\n"
        child = child_of(run.pid, top)
        run.send_signal(signal.SIGHUP)
        run.send_signal(signal.SIGTSTP)
        until(lambda: state_of(run.pid) == state_of(child) == "T", "they do not rest")
        run.send_signal(signal.SIGCONT)
        until(lambda: state_of(child) == "R", "it does not go on")
        run.send_signal(signal.SIGTERM)
        run.communicate(timeout=patience)
        assert run.returncode == 143, run.returncode
        # On a terminal progress is drawn over itself, and what a script prints cannot write to it.
        put(top, """print "\\27]0;title\\7\\27[31mred\\27[0m" io.stderr:write "\\27[2J\\n"
        require("asperity").surface.flat{ cells=8, size=1 }""")
        shown, status = in_terminal([runner.program, "run", "--confined", "s.lua"], cwd=top + "/home/work",
                                    stderr=subprocess.STDOUT, env={**os.environ, "HOME": top + "/home"})
        assert status == 0 and b"\x1b]" not in shown and b"\x07" not in shown and b"\x1b[2J" not in shown, shown
        assert b"\x1b[31mred\x1b[0m" in shown and b"results in" in shown, shown


def test_a_missing_barrier_is_refused_by_name():
    numbers = {"x86_64": (0xC000003E, 272), "aarch64": (0xC00000B7, 97)}
    if os.uname().machine not in numbers:
        return
    architecture, unshare = numbers[os.uname().machine]
    lacking = lambda: refuse_calls(architecture, [unshare, 444])
    with workshop() as top:
        put(top, reading)
        arguments = ["run", "--confined", "s.lua", "--out", "R", "--", "beside.lua"]
        refused = asperity(top, *arguments, before=lacking)
        assert refused.returncode == 2 and "lacks barriers of `--confined`: files" in refused.stderr and "Landlock" in refused.stderr, refused
        assert not os.path.exists(top + "/home/work/R"), "a run was begun"
        wrong = asperity(top, *arguments[:2], "--without-barriers", "flies", *arguments[2:], before=lacking)
        assert wrong.returncode == 2 and "did you mean `files`" in wrong.stderr, wrong
        other = asperity(top, *arguments[:2], "--without-barriers", "network", *arguments[2:], before=lacking)
        assert other.returncode == 2 and "lacks barriers of `--confined`: files" in other.stderr, other
        wished = asperity(top, *arguments[:2], "--without-barriers", "network,files", *arguments[2:], before=lacking)
        assert wished.returncode == 0 and "without barriers for files" in wished.stderr, wished
        assert manifest(top)["unhashed"]["barriers"]["open"] == ["files"], manifest(top)
        # One of the two that shut files is enough.
        half = asperity(top, "run", "--confined", "s.lua", "--", "/etc/passwd", before=lambda: refuse_calls(architecture, [unshare]))
        assert half.returncode == 0 and "root:" not in half.stdout, half
        put(top, work)
        for one in (unshare, 444, 442):  # namespaces, Landlock, attributes of mounts
            drawn = asperity(top, "run", "--confined", "--read", ".", "s.lua", "--out", f"D{one}", before=lambda: refuse_calls(architecture, [one]))
            assert drawn.returncode == 0 and os.path.getsize(f"{top}/home/work/D{one}/n-square-k.svg") > 1000, drawn


if __name__ == "__main__":
    runner.main(globals())
