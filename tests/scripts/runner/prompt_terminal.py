# SPDX-License-Identifier: GPL-3.0-or-later
# `asperity repl` in a terminal: a pseudo terminal types what a person would and looks at what is shown.
# usage: prompt_terminal.py PROGRAM FOLDER
import os
import pty
import re
import select
import shutil
import signal
import stat
import sys
import time

program, folder = sys.argv[1], sys.argv[2]
tab, ctrl_c, ctrl_d, up, enter = b"\t", b"\x03", b"\x04", b"\x1b[A", b"\r"
patience = 600.0  # seconds for anything to be shown, after which a wait counts as a hang


class Terminal:
    def __init__(self, *options, term="xterm"):
        environment = dict(os.environ, TERM=term, XDG_STATE_HOME=os.path.join(folder, "state"), LC_ALL="C.UTF-8",
                           COLUMNS="100")
        environment.pop("NO_COLOR", None)
        self.pid, self.file = pty.fork()
        if self.pid == 0:
            os.chdir(folder)
            os.execve(program, [program, "repl", *options], environment)
        self.shown = ""

    def read(self, seconds):
        ready, _, _ = select.select([self.file], [], [], seconds)
        if not ready:
            return False
        try:
            data = os.read(self.file, 65536)
        except OSError:
            return None
        if not data:
            return None
        self.shown += data.decode("utf-8", "replace")
        return True

    def plain(self):
        return re.sub(r"\x1b\[[0-9;?]*[A-Za-z]|\x1b[()=>].?|[\r\a]", "", self.shown)

    # Waits until this is shown, and forgets what was shown up to there.
    def expect(self, pattern, what):
        until = time.monotonic() + patience
        while not re.search(pattern, self.plain()):
            if time.monotonic() > until or self.read(0.2) is None:
                sys.exit(f"{what}: waited for {pattern!r}, and was shown:\n{self.plain()}\n--- {self.shown!r}")
        plain = self.plain()
        self.shown = ""
        return plain

    def type(self, keys):
        os.write(self.file, keys if isinstance(keys, bytes) else keys.encode())

    def say(self, line, pattern, what):
        self.type(line.encode() + enter)
        return self.expect(pattern, what)

    def end(self, what, status=0):
        until = time.monotonic() + patience
        while time.monotonic() < until:
            while self.read(0.05):
                pass
            pid, ended = os.waitpid(self.pid, os.WNOHANG)
            if pid:
                got = os.waitstatus_to_exitcode(ended)
                if got != status:
                    sys.exit(f"{what}: exit status {got}, not {status}:\n{self.plain()}")
                return self.plain()
        sys.exit(f"{what}: the program did not end:\n{self.plain()}")


def check(holds, what):
    if not holds:
        sys.exit(what)


shutil.rmtree(folder, ignore_errors=True)
os.makedirs(folder)

t = Terminal()
t.expect(r"exit ends\.\n> $", "the greeting")
t.say("local plate = lab.surface.sine{ cells=64, size='1 mm', amplitude='1 um' }", r"> $", "a local variable")

# Completion: the class of a variable that lives, a whole word, what there is, keys with `=`, words in strings.
t.type(b"plate:rough" + tab)
t.expect(r"plate:roughness$", "completion of a method")
t.type(b"().R" + tab)
t.expect(r"R", "no completion of what is not known")
t.type(b"a" + enter)
t.expect(r"636\.1 nm \(6\.3\d+e-07 m\)\n> $", "a field with its unit")
t.type(b"pl" + tab)
t.expect(r"plate$", "completion of a variable")
t.type(b":" + tab)
shown = t.expect(r"roughness[\s\S]*write[\s\S]*> plate:$", "a list of methods")
check("peak_to_valley" not in shown, "a colon offers methods only")
t.type(ctrl_c)
t.expect(r"\n> $", "Ctrl-C forgets the line")
t.type(b"c = lab.contact{ low" + tab)
t.expect(r"lower=$", "completion of a key")
t.type(b"plate, bound" + tab + b"'per" + tab)
t.expect(r"boundary='periodic$", "completion of a word")
t.type(b"', up" + tab + b"lab.ri" + tab + b", effects={ elasticity='ha" + tab + b"' } }" + enter)
t.expect(r"`upper`[\s\S]*> $|Young|material[\s\S]*> $", "an error of the laboratory")
t.say("c", r"never set[\s\S]*> $", "a line that failed leaves no variable")

# Lines that are not whole.
t.say("for i = 1, 2 do", r">> $", "a loop to be continued")
t.say("  print('turn', i)", r">> $", "its body")
t.say("end", r"turn\t?\s*1\n(.*\n)*turn\t?\s*2\n> $", "its end")
t.say("x = {", r">> $", "a table to be continued")
t.type(ctrl_c)
t.expect(r"\n> $", "Ctrl-C forgets all of it")
t.say("1 + 1", r"\n2\n> $", "the line after it")
t.say("µ = 1", r"asperity: prompt:1: [\s\S]*> $", "letters beyond ASCII")
t.say("'µm'", r"\nµm\n> $", "text beyond ASCII")

# Ctrl-C stops a loop of Lua, and a solve, and not the session.
t.say("plate = plate:with{ material=lab.material 'Al-2011' }", r"> $", "a material")
t.say("print 'begun' n = 0 while true do n = n + 1 end", r"\nbegun\n", "a loop without end")
t.type(ctrl_c)
t.expect(r"interrupted\n> $", "Ctrl-C in a loop")
t.say("big = lab.surface.self_affine{ cells=1024, size='1 mm', hurst=0.8, rms_slope=0.1, short_wave='8 um', "
      "material=lab.material 'Al-2011' }", r"> $", "a large surface")
t.say("bench = lab.contact{ lower=big, upper=lab.rigid, boundary='periodic', "
      "effects={ elasticity='half_space' }, accuracy={ tolerance=1e-12 } }", r"> $", "a large contact")
t.say("print 'begun' for st in bench:sweep{ pressure={'1 MPa', '2 MPa', '4 MPa', '8 MPa', '16 MPa', '32 MPa'} } do "
      "last = st end", r"\nbegun\n", "a sweep")
t.type(ctrl_c)
t.expect(r"interrupted\n> $", "Ctrl-C in a solve")
t.say("last", r"never set[\s\S]*> $", "what the stopped line had set is taken back")
t.say("plate.peak_to_valley", r"2 um \(2e-06 m\)\n> $", "variables after Ctrl-C")
t.say("bench.lower", r"> $", "the contact after Ctrl-C")

# Pictures: half blocks in colour; no run directory until a file is written.
t.say("show(plate)", r"▀[\s\S]*height from[\s\S]*> $", "a map")
check(not os.path.exists(os.path.join(folder, "runs")), "a run directory was made though nothing was written")
t.say("show(plate, 'plate.png')", r"drawn in \S*/runs/prompt-1/plate\.png\n> $", "a picture in a file")
check(os.path.getsize(os.path.join(folder, "runs/prompt-1/plate.png")) > 1000, "the picture is empty")

# SIGINT from elsewhere while nothing runs, and SIGTERM.
os.kill(t.pid, signal.SIGINT)
t.expect(r"\n> $", "SIGINT at the prompt")
t.type(ctrl_d)
t.end("Ctrl-D")
script = open(os.path.join(folder, "runs/prompt-1/script.lua")).read()
check("plate = lab.surface.sine{" in script and "while true" not in script and "local" not in script,
      f"script.lua is not what was said:\n{script}")

# History: kept, bounded, private, and come back to.
history = os.path.join(folder, "state/asperity/history")
check(stat.S_IMODE(os.stat(history).st_mode) == 0o600, "others can read the history")
check("show(plate)" in open(history).read().splitlines(), "a line is not in the history")
with open(history, "a") as file:
    file.writelines(f"old = {k}\n" for k in range(2000))
t = Terminal()
t.expect(r"> $", "the second session")
check(len(open(history).read().splitlines()) == 1000, "the history is not cut")
t.type(up)
t.expect(r"old = 1999$", "a line of an earlier session")
t.type(enter)
t.expect(r"> $", "a line that came back")
t.say("old", r"\n1999\n> $", "its value")
t.say("os.exit(3)", r"", "os.exit")
t.end("os.exit", 3)

before = open(history).read()
t = Terminal("--no-history", term="dumb")
t.expect(r"> $", "a session without history")
t.say("secret = 1", r"> $", "a line that is not kept")
os.kill(t.pid, signal.SIGTERM)
t.end("SIGTERM", 143)
check(open(history).read() == before, "--no-history wrote the history")
# Ctrl-C while a knob moves: the session is as it was, and another move works.
t = Terminal()
t.expect(r"exit ends\.\n> $", "the greeting")
t.say("turns = lab.knob{ name='turns', from=0, to=10, value=1 }", r"> $", "a knob")
t.say("if turns > 9 then print 'moving' while true do end end", r"> $", "a line that may not end")
t.say("lab.knob.set('turns', 10)", r"\nmoving\n", "a move that does not end")
t.type(ctrl_c)
t.expect(r"interrupted\n> $", "Ctrl-C in a move")
t.say("turns", r"\n1(\.0)?\n> $", "the knob after Ctrl-C")
t.say("lab.knob.set('turns', 3)", r"turns = 3: heavy results: 0 computed, 0 taken from memory\n> $", "another move")
t.say("turns", r"\n3(\.0)?\n> $", "the knob after it")
t.type(ctrl_d)
t.end("Ctrl-D")

print("the prompt does in a terminal what it says")
