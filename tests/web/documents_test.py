#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# The documents' site under /docs/, served by a copy of the program that is installed in a temporary folder.
import base64
import contextlib
import glob
import hashlib
import os
import re
import shutil
import tempfile

import runner
from client import Server

script, deeper = "top=new URL('.',location)", "top=new URL('..',location)"
data = '<script id="config" type="application/json">{}</script>'
files = {
    "index.html": (f"<!doctype html><script>{script}</script>{data}", "text/html; charset=utf-8"),
    "stability/case.html": (f"<!doctype html><script>{deeper}</script>{data}", "text/html; charset=utf-8"),
    "assets/bundle.js": ("'use strict'", "text/javascript; charset=utf-8"),
    "assets/main.css": ("p { margin: 0 }", "text/css; charset=utf-8"),
    "assets/text.woff2": ("wOF2", "font/woff2"),
    "search/search_index.json": ("{}", "application/json"),
    "sitemap.xml": ("<urlset/>", "application/xml"),
    "pictures/worn.png": ("png", "image/png"),
    "pictures/drawn.svg": ("<svg/>", "image/svg+xml"),
}


@contextlib.contextmanager
def installed(site):
    """The program of an installation with these files in its site; None: without a site."""
    with tempfile.TemporaryDirectory(prefix="asperity-installed-") as folder:
        os.makedirs(folder + "/bin")
        os.makedirs(folder + "/lib/asperity")
        os.makedirs(folder + "/share/asperity")
        shutil.copy(runner.program, folder + "/bin")
        for part in glob.glob(os.path.dirname(runner.program) + "/asperity-*.so"):
            shutil.copy(part, folder + "/lib/asperity")
        for name, (text, _) in (site or {}).items():
            path = folder + "/share/asperity/site/" + name
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w") as file:
                file.write(text)
        yield folder + "/bin/" + os.path.basename(runner.program)


def test_documents_need_no_token():
    with installed(files) as program, Server(program) as server:
        for name, (text, kind) in files.items():
            answer = server.ask("GET", "/docs/" + name, token="")
            assert (answer.status, answer.body.decode(), answer.headers["Content-Type"]) == (200, text, kind), name
            head = server.ask("HEAD", "/docs/" + name, token="")
            assert head.status == 200 and head.body == b"" and head.headers["Content-Type"] == kind, name
        first = server.ask("GET", "/docs/", token="")
        assert first.body.decode() == files["index.html"][0]
        assert server.ask("GET", "/docs/", headers={"If-None-Match": first.headers["ETag"]}).status == 304
        redirected = server.ask("GET", "/docs", token="")
        assert redirected.status == 308 and redirected.headers["Location"] == "/docs/"
        assert server.ask("GET", "/api/about").json()["documents"] is True
        for method in ("POST", "PUT", "DELETE", "OPTIONS"):
            body = {} if method == "POST" else None
            assert server.ask(method, "/docs/", body).status in (400, 405), method


def test_documents_have_their_own_policy():
    with installed(files) as program, Server(program) as server:
        named = {"'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'" for text in (script, deeper)}
        for path in ("/docs/", "/docs/stability/case.html", "/docs/assets/bundle.js", "/docs/nothing.html"):
            policy = server.ask("GET", path, token="").headers["Content-Security-Policy"]
            rules = {rule.split()[0]: set(rule.split()[1:]) for rule in policy.split(";")}
            assert rules["script-src"] == {"'self'", *named} and rules["default-src"] == {"'none'"}, policy
            assert not re.search(r"unsafe|https?:|\*", policy), policy
        assert "sha256" not in server.ask("GET", "/", token="").headers["Content-Security-Policy"]


def test_documents_of_another_host_or_site_are_refused():
    with installed(files) as program, Server(program) as server:
        assert server.ask("GET", "/docs/", token="", headers={"Host": f"evil.example:{server.port}"}).status == 403
        assert server.ask("GET", "/docs/", token="", headers={"Origin": "http://evil.example"}).status == 403


def test_paths_of_documents_lead_nowhere_else():
    with installed(files) as program:
        share = os.path.dirname(os.path.dirname(program)) + "/share/asperity"
        os.symlink("/etc/passwd", share + "/site/link.html")
        os.symlink("/etc", share + "/site/folder")
        for name in (share + "/secret.html", share + "/site/.hidden.html"):
            with open(name, "w") as file:
                file.write("secret")
        with Server(program) as server:
            with open(share + "/site/late.html", "w") as file:
                file.write("not there at the start")
            for name in ("../secret.html", "%2e%2e/secret.html", "..%2fsecret.html", "..%5csecret.html", "/etc/passwd",
                         "%2fetc%2fpasswd", "../../../../../../etc/passwd", "link.html", "folder/passwd", ".hidden.html",
                         "late.html", "assets", "assets/", "stability/", "./index.html", "assets/../index.html",
                         "index.html/", "index.html%00.css", "%c0%ae%c0%ae/secret.html", "/index.html", "."):
                answer = server.ask("GET", "/docs/" + name, token="")
                assert answer.status in (400, 404) and b"secret" not in answer.body, (name, answer.status, answer.body)
            assert server.ask("GET", "/docs../secret.html", token="").status == 404


def test_missing_documents_say_how_they_are_built():
    with installed(None) as program, Server(program) as server:
        for path in ("/docs/", "/docs/index.html"):
            answer = server.ask("GET", path, token="")
            assert answer.status == 404, (path, answer.status)
            for words in (b"./lab docs", b"build/site", b"share/asperity/site"):
                assert words in answer.body, answer.body
        assert server.ask("GET", "/api/about").json()["documents"] is False


if __name__ == "__main__":
    runner.main(globals())
