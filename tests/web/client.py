# SPDX-License-Identifier: GPL-3.0-or-later
# A server started for a test, and a client that speaks to it as a page would, or worse.
import http.client
import json
import os
import pty
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import time


patience = 600  # s, after which a wait counts as a hang; on a quiet machine no wait takes a twentieth of it


def until(test, what):
    """Waits until `test` gives something true, and returns that."""
    end = time.monotonic() + patience
    while not (found := test()):
        assert time.monotonic() < end, what
        time.sleep(0.02)
    return found


def in_terminal(command, **options):
    """What a command writes to its pseudo terminal, and its exit status."""
    master, slave = pty.openpty()
    run = subprocess.Popen(command, stdout=slave, **options)
    os.close(slave)
    shown = b""
    while True:
        try:
            piece = os.read(master, 4096)
        except OSError:
            break
        if not piece:
            break
        shown += piece
    os.close(master)
    return shown, run.wait(patience)


class Answer:
    def __init__(self, status, headers, body):
        self.status, self.headers, self.body = status, headers, body

    def json(self):
        return json.loads(self.body)


class Server:
    """`asperity serve`, ended with the block it is used in."""

    def __init__(self, program, *options, as_nobody=False):
        self.folder = tempfile.mkdtemp(prefix="asperity-serve-test-")
        command = [program, "serve", "--out", self.folder + "/runs", *options]
        if "--limit-time" not in options:
            command += ["--limit-time", f"{4 * patience}s"]  # no run ends by itself while a test waits
        if as_nobody:
            os.chmod(self.folder, 0o777)
            command = ["setpriv", "--reuid", "65534", "--regid", "65534", "--clear-groups", *command]
        self.errors = open(self.folder + "/errors", "w+")
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=self.errors, cwd=self.folder, text=True)
        self.tokens = {}
        while True:
            line = self.process.stdout.readline()
            assert line, "the server ended: " + self.said()
            found = re.match(r"(?:(.*?)\s+)?http://(\[?[^/]+\]?):(\d+)/#(\S+)$", line.strip())
            if not found:
                continue
            self.tokens[found[1] or "you"] = found[4]
            self.address, self.port = found[2], int(found[3])
            if "--classroom" not in options or len(self.tokens) == self.expected(options):
                break
        self.token = next(iter(self.tokens.values()))
        self.host = f"{self.address}:{self.port}"

    @staticmethod
    def expected(options):
        if "--students" in options:
            return 1 + int(options[options.index("--students") + 1])
        with open(options[options.index("--names") + 1]) as names:
            return 1 + sum(1 for name in names if name.strip())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        try:
            self.process.wait(patience)
        except subprocess.TimeoutExpired:
            self.process.kill()
        self.process.stdout.close()
        self.errors.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def said(self):
        self.errors.flush()
        with open(self.folder + "/errors") as text:
            return text.read()

    def ask(self, method, path, body=None, token=None, headers=None):
        connection = http.client.HTTPConnection(self.address, self.port, timeout=patience)
        sent = {"Host": self.host}
        if token != "":
            sent["Authorization"] = "Bearer " + (token or self.token)
        data = None
        if body is not None:
            data = body if isinstance(body, bytes) else json.dumps(body).encode()
            sent["Content-Type"] = "application/json"
        for name, value in (headers or {}).items():
            if value is None:
                sent.pop(name, None)
            else:
                sent[name] = value
        try:
            connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
            if data is not None and "Content-Length" not in sent:
                sent["Content-Length"] = str(len(data))
            for name, value in sent.items():
                connection.putheader(name, value)
            connection.endheaders(data)
            answer = connection.getresponse()
            return Answer(answer.status, answer.headers, answer.read())
        finally:
            connection.close()

    def begin(self, script, token=None, **more):
        answer = self.ask("POST", "/api/runs", {"script": script, **more}, token=token)
        assert answer.status == 201, (answer.status, answer.body)
        return answer.json()["id"]

    def events(self, run, after=0, token=None):
        """All events after a number, to the end of the run."""
        events = []
        while not events or events[-1]["type"] != "finished":
            answer = self.ask("GET", f"/api/runs/{run}/events?after={after}", token=token)
            assert answer.status == 200, (answer.status, answer.body)
            for line in answer.body.decode().splitlines():
                events.append(json.loads(line))
                after = events[-1]["n"]
        return events

    def run(self, script, **more):
        return self.events(self.begin(script, **more))

    def connect(self):
        return socket.create_connection((self.address, self.port), timeout=patience)


def of_type(events, kind):
    return [event for event in events if event["type"] == kind]


def printed(events, stream="out"):
    return "".join(event["text"] for event in of_type(events, "output") if event["stream"] == stream)


def state_and_parent(process):
    """Of /proc/N/stat; a process may end while its line is read."""
    try:
        with open(f"/proc/{process}/stat") as facts:
            return facts.read().rsplit(")", 1)[1].split()[:2]
    except OSError:
        return ["Z", ""]


def processor_ticks(process):
    with open(f"/proc/{process}/stat") as facts:
        return sum(map(int, facts.read().rsplit(")", 1)[1].split()[11:13]))


def alive(process):
    return state_and_parent(process)[0] != "Z"


def children_of(process):
    """Those that live: one that has ended stays listed until its parent asks how."""
    entries = [(int(entry), state_and_parent(entry)) for entry in os.listdir("/proc") if entry.isdigit()]
    return [child for child, (state, parent) in entries if state != "Z" and parent == str(process)]


def finished(events):
    assert events[-1]["type"] == "finished", events[-1]
    return events[-1]


# Scripts that several tests run.
chart = """
local lab = require "asperity"
local book = lab.notebook "line"
for k = 1, 5 do book:write{ k=k, ["square [m]"]=k*k } end
book:expect("square", { at_least=1, label="squares" })
book:chart{ x="k", y="square" }
print "drawn"
"""

press = """
local lab = require "asperity"
local s = lab.surface.self_affine{ cells=600, size="600 um", hurst=0.8, short_wave="4 um", rms_height="1 um", seed=3, material=lab.material "Al-2011" }
local c = lab.contact{ lower=s, upper=lab.rigid, boundary="free", effects={ elasticity="box" } }
local st = c:press{ indentation=0.3 }
print(st.area_fraction)
"""
