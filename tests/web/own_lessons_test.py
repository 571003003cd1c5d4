#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# Lessons of a teacher's folder: `asperity serve --lessons DIR`.
import os
import pathlib
import re
import subprocess
import tempfile

import runner
from client import Server, finished, patience, printed

lesson = """-- Springs
-- Question: Which spring is stiffer?
-- Predict: By how much?
-- Minutes: 5
-- Code: hidden
--
-- Two springs.
-- Notes:
-- The secret.

print "a spring"
"""


def put(folder, name, text):
    path = os.path.join(folder, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as file:
        file.write(text)


def listed(server, token=None):
    return {entry["name"]: entry for entry in server.ask("GET", "/api/lessons", token=token).json()}


def test_lessons_of_a_folder_are_read_at_each_request():
    with tempfile.TemporaryDirectory() as folder:
        put(folder, "01_springs.lua", lesson)
        put(folder, "06_tilt.lua", lesson.replace("Springs", "My tilt"))
        put(folder, "de/01_springs.txt", "Federn\nQuestion: Welche?\n")
        put(folder, "notes.txt", "no lesson")
        with Server(runner.program, "--lessons", folder) as server:
            entries = listed(server)
            assert list(entries)[:3] == ["springs", "tilt", "roughness"], list(entries)
            assert len(entries) == 11 and entries["tilt"]["title"] == "My tilt"
            assert entries["springs"]["languages"] == {"de": {"title": "Federn", "question": "Welche?"}}
            mine = server.ask("GET", "/api/lessons/springs").json()
            assert mine["notes"] == "The secret." and mine["hides_code"] is True
            assert mine["script"] == lesson.replace("-- Notes:\n-- The secret.\n", "")
            put(folder, "01_springs.lua", lesson.replace("Two springs.", "Three springs."))
            assert server.ask("GET", "/api/lessons/springs").json()["text"] == "Three springs.\n"
            os.remove(os.path.join(folder, "01_springs.lua"))
            assert "springs" not in listed(server) and server.ask("GET", "/api/lessons/springs").status == 404


def test_a_lesson_in_markdown_is_listed_shown_and_run():
    with tempfile.TemporaryDirectory() as folder:
        put(folder, "01_springs.md", "# Springs\n\n**Question:** Which spring is stiffer?\n\n**Predict:** By how much?\n\n"
            "**Minutes:** 5\n\nTwo springs.\n\n```lua\nprint \"a spring\"\n```\n\nNotes: the secret.\n")
        put(folder, "02_broken.md", "# Broken\n")
        with Server(runner.program, "--lessons", folder) as server:
            mine = server.ask("GET", "/api/lessons/springs").json()
            assert mine["notes"] == "the secret." and mine["text"] == "Two springs.\n"
            assert 'print "a spring"' in mine["script"] and "secret" not in mine["script"]
            assert "blocks ```lua" in listed(server)["02_broken.md"]["problem"]
        def lesson_command(*words):
            return subprocess.run([runner.program, "lesson", *words, "--lessons", folder], cwd=folder, capture_output=True, text=True)
        shown = lesson_command()
        assert "1  springs: Springs (5 min)" in shown.stdout and "02_broken.md is no lesson" in shown.stdout, shown.stdout
        ran = lesson_command("springs", "--run")
        assert ran.returncode == 0 and ran.stdout.startswith("a spring"), ran
        assert lesson_command("02_broken.md").returncode == 2


def test_faults_of_lessons_hide_no_other_lesson():
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as elsewhere:
        put(elsewhere, "secret.lua", lesson)
        put(folder, "01_good.lua", lesson)
        put(folder, "02_good.lua", lesson)
        put(folder, "03_grammar.lua", lesson + "local = 1\n\n")
        put(folder, "04_bare.lua", "print(1)\n")
        put(folder, "05_long.lua", lesson + "-- " + "x" * (128 * 1024))
        put(folder, "07_german.lua", lesson)
        os.symlink(os.path.join(elsewhere, "secret.lua"), os.path.join(folder, "06_link.lua"))
        os.makedirs(os.path.join(folder, "de"))
        os.symlink(os.path.join(elsewhere, "secret.lua"), os.path.join(folder, "de/07_german.txt"))
        os.symlink(elsewhere, os.path.join(folder, "en"))
        os.mkfifo(os.path.join(folder, "08_pipe.lua"))
        with Server(runner.program, "--lessons", folder, "--classroom", "127.0.0.1", "--students", "1") as server:
            entries = listed(server)
            found = {name: entry["problem"] for name, entry in entries.items() if "problem" in entry}
            for name, part in {"02_good.lua": "is a second lesson `good`: rename one", "03_grammar.lua": "03_grammar.lua:12: <name> expected",
                               "04_bare.lua": "lacks a title", "05_long.lua": "131072 bytes", "06_link.lua": "is a link",
                               "de/07_german.txt": "`de/07_german.txt` is a link", "08_pipe.lua": "is a link, or cannot be read"}.items():
                assert part in found.pop(name), (name, entries[name])
                assert name in server.said(), server.said()
                assert server.ask("GET", f"/api/lessons/{name}").status == 404
            assert not found and {"good", "german", "tilt"} <= entries.keys(), found
            # Students see good lessons, and no notes.
            student = server.tokens["student 1"]
            assert not any("problem" in entry for entry in listed(server, student).values())
            good = server.ask("GET", "/api/lessons/good", token=student)
            assert good.status == 200 and b"secret" not in good.body, good.body
            assert server.ask("GET", "/api/lessons/good").json()["notes"] == "The secret."


def test_too_many_lessons_are_not_all_read():
    with tempfile.TemporaryDirectory() as folder:
        for k in range(70):
            put(folder, f"{k + 1}_lesson{k + 1}.lua", lesson)
        with Server(runner.program, "--lessons", folder) as server:
            entries = listed(server)
            assert sum("problem" not in entry for entry in entries.values()) == 60 + 10
            assert any("more than 60 lessons" in entry.get("problem", "") for entry in entries.values())


def test_a_folder_that_is_not_there_is_refused():
    done = subprocess.run([runner.program, "serve", "--lessons", "nowhere"], capture_output=True, text=True, timeout=patience)
    assert done.returncode == 2 and "`--lessons` names `nowhere`, which is no folder" in done.stderr, done


def test_the_lesson_of_the_documents_is_served_and_runs():
    page = (pathlib.Path(__file__).parents[2] / "docs/teacher.md").read_text()
    code, text = (re.search(rf"<!-- own {part} -->\n```\w+\n(.*?)```", page, re.S)[1] for part in ("lesson", "text"))
    with tempfile.TemporaryDirectory() as folder:
        put(folder, "01_ball.lua", code)
        put(folder, "de/01_ball.txt", text)
        with Server(runner.program, "--lessons", folder) as server:
            served = server.ask("GET", "/api/lessons/ball").json()
            assert served["notes"].startswith("Many say ten.") and served["languages"]["de"]["answers"]["the growth"] == "Wachstum"
            assert "{1}" in served["languages"]["de"]["reason"] and served["minutes"] == 10
            events = server.run(served["script"].replace("my_guess = nil", "my_guess = 10"))
            assert finished(events)["status"] == "done", events
            assert "You said 10 of the growth: it is 4.62, 2.2 times too much." in printed(events), printed(events)


if __name__ == "__main__":
    runner.main(globals())
