#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# What files and scripts hold is shown and never obeyed, in any output of any command.
import json
import os
import shutil
import subprocess
import tempfile

import runner
from client import in_terminal, patience

hostile = "a\x1b]0;pwn\x07\x1b[31mred\x9b2J\r\x1b[Kover\x08\x7f"
in_lua = "a\\27]0;pwn\\7\\27[31mred\\xC2\\x9B2J\\x9B2J\\r\\27[Kover\\8\\127"


def assert_plain(output, what):
    text = output.decode("utf-8")  # every byte is of a character
    steering = [c for c in text if (ord(c) < 0x20 and c not in "\n\t") or 0x7F <= ord(c) < 0xA0]
    assert not steering, (what, steering, text)


def run(folder, *arguments, status=None):
    done = subprocess.run([runner.program, *arguments], cwd=folder, capture_output=True, timeout=patience)
    assert status is None or done.returncode == status, done
    return done


def test_no_command_steers_a_terminal():
    folder = tempfile.mkdtemp(prefix="asperity-plain-")
    name = hostile.replace("\x9b", "").replace("/", "") + ".lua"
    scripts = {
        "error": f'error("{in_lua}")',
        "value": f'error({{ "{in_lua}" }})',
        "syntax": f'local x = = "{hostile}"',
        "global": f'return _G["{in_lua}"].y',
        "title": f'require("asperity").notebook("{in_lua}"):write{{ ["{in_lua}"]="{in_lua}" }}',
        "expectation": f'local b = require("asperity").notebook "n" b:write{{ a=1 }} b:expect("a", {{ at_least=2, label="{in_lua}" }})',
        "file": f'io.open("{in_lua}", "w"):close()',
        "errors of its own": f'io.stderr:write("{in_lua}\\n")',
    }
    try:
        for what, script in scripts.items():
            with open(os.path.join(folder, name), "w") as file:
                file.write(script)
            out = os.path.join(folder, "R")
            shutil.rmtree(out, ignore_errors=True)
            ran = run(folder, "run", name, "--out", "R")
            assert_plain(ran.stderr, what)
            for arguments in (["check", name], ["explain", name], ["replay", "R"], ["run", "--resume", "R"], ["run", name, "--out", "R"]):
                done = run(folder, *arguments)
                assert_plain(done.stderr, (what, arguments))
                if arguments[0] != "run":
                    assert_plain(done.stdout, (what, arguments))
        for arguments in (["run", hostile.replace("\x9b", "")], ["help", hostile], [hostile], ["run", "--" + hostile], ["lesson", hostile],
                          ["replay", hostile], ["run", "x.lua", "--limit-time", hostile]):
            done = run(folder, *arguments, status=2)
            assert_plain(done.stderr + done.stdout, arguments)
        # What a record says, though somebody else wrote it.
        with open(os.path.join(folder, "s.lua"), "w") as file:
            file.write('require("asperity").notebook "n":write{ a=1 }')
        run(folder, "run", "s.lua", "--out", "Q", status=0)
        journal = os.path.join(folder, "Q/journal.jsonl")
        with open(journal) as file:
            lines = file.read().splitlines()
        altered = [json.loads(line) for line in lines]
        for line in altered:
            if line.get("event") == "row":
                line["row"] = {"a": hostile}
        with open(journal, "w") as file:
            file.write("".join(json.dumps(line) + "\n" for line in altered))
        done = run(folder, "replay", "Q", status=1)
        assert_plain(done.stdout + done.stderr, "replay of an altered record")
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def test_what_a_script_prints_is_its_own_but_on_a_terminal():
    with tempfile.TemporaryDirectory() as folder:
        with open(folder + "/s.lua", "w") as file:
            file.write('io.write("\\27]0;pwn\\7\\0\\255", "\\27[1;31mred\\27[0m \\xC3") io.write("\\xA9\\n")')
        piped = run(folder, "run", "s.lua", status=0)
        assert piped.stdout == b"\x1b]0;pwn\x07\0\xff\x1b[1;31mred\x1b[0m \xc3\xa9\n", piped.stdout
        shown, status = in_terminal([runner.program, "run", "s.lua"], cwd=folder, stderr=subprocess.DEVNULL)
        assert status == 0
        assert shown == b"?]0;pwn???\x1b[1;31mred\x1b[0m \xc3\xa9\r\n", shown


def test_formulas_are_texts_in_a_table():
    with tempfile.TemporaryDirectory() as folder:
        with open(folder + "/s.lua", "w") as file:
            file.write('require("asperity").notebook "n":write{ ["=1+1"]="=cmd|\' /C calc\'!A0" }')
        run(folder, "run", "s.lua", "--out", "R", status=0)
        with open(folder + "/R/n.csv") as table:
            assert table.read() == "\"'=1+1\"\n\"'=cmd|' /C calc'!A0\"\n"


if __name__ == "__main__":
    runner.main(globals())
