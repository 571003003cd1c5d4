#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# Who may ask, and what paths lead to.
import gzip
import json
import os
import tempfile

import runner
from client import Server, chart, finished, until


def test_a_token_is_needed():
    with Server(runner.program) as server:
        for path in ("/api/about", "/api/runs", "/api/lessons", "/api/runs/1/events", "/api/nothing"):
            assert server.ask("GET", path, token="").status == 401, path
        for wrong in (server.token[:-1], server.token + "A", server.token[:-1] + "~", "x" * 43, "é"):
            assert server.ask("GET", "/api/about", headers={"Authorization": b"Bearer " + wrong.encode()}).status == 401
        assert server.ask("GET", "/api/about", headers={"Authorization": server.token}).status == 401
        assert server.ask("GET", "/api/about", headers={"Authorization": "Basic " + server.token}).status == 401
        assert server.ask("POST", "/api/runs", {"script": "print(1)"}, token="").status == 401
        assert server.ask("GET", "/api/about?token=" + server.token, token="").status == 401
        assert server.ask("GET", "/api/runs").json() == []


def test_a_page_of_another_site_is_refused():
    with Server(runner.program) as server:
        for origin in ("http://evil.example", "null", "http://127.0.0.1", f"https://{server.host}",
                       f"http://{server.host}.evil.example", f"http://{server.address}:{server.port + 1}"):
            for method, path in (("GET", "/api/about"), ("POST", "/api/runs"), ("DELETE", "/api/runs/1"), ("GET", "/")):
                body = {"script": "print(1)"} if method == "POST" else None
                assert server.ask(method, path, body, headers={"Origin": origin}).status == 403, (origin, path)
        assert server.ask("GET", "/api/about", headers={"Sec-Fetch-Site": "cross-site"}).status == 403
        assert server.ask("GET", "/api/about", headers={"Sec-Fetch-Site": "same-site"}).status == 403
        # A form of another site cannot say that it sends JSON.
        assert server.ask("POST", "/api/runs", {"script": "print(1)"}, headers={"Content-Type": "text/plain"}).status == 415
        assert server.ask("OPTIONS", "/api/runs", headers={"Origin": "http://evil.example"}).status in (403, 405)
        assert server.ask("GET", "/api/runs").json() == []
        assert server.ask("GET", "/api/about", headers={"Origin": f"http://{server.host}"}).status == 200
        assert server.ask("GET", "/api/about").headers.get("Access-Control-Allow-Origin") is None


def test_a_host_name_made_to_point_here_is_refused():
    with Server(runner.program) as server:
        for host in ("evil.example", f"evil.example:{server.port}", "127.0.0.1", f"127.0.0.1:{server.port + 1}",
                     f"127.0.0.1.evil.example:{server.port}", f"2130706433:{server.port}", ""):
            for path in ("/", "/api/about"):
                assert server.ask("GET", path, headers={"Host": host}).status in (400, 403), (host, path)
        assert server.ask("GET", "/api/about", headers={"Host": None}).status in (400, 403)
        assert server.ask("GET", "/api/about", headers={"Host": f"localhost:{server.port}"}).status == 200
        twice = server.connect()
        twice.sendall(f"GET /api/about HTTP/1.1\r\nHost: {server.host}\r\nHost: evil.example\r\n"
                      f"Authorization: Bearer {server.token}\r\nConnection: close\r\n\r\n".encode())
        assert b" 403 " in twice.recv(65536)


def test_only_this_machine_is_served():
    with Server(runner.program) as server:
        assert server.address == "127.0.0.1"
        # Addresses are in hexadecimal, the last number first: this is 127.0.0.1.
        here = f":{server.port:04X}"
        listening = [line.split() for line in open("/proc/net/tcp")] + [line.split() for line in open("/proc/net/tcp6")]
        assert [at[1] for at in listening if at[3] == "0A" and at[1].endswith(here)] == ["0100007F" + here]


def test_a_server_that_has_just_begun_stops():
    for _ in range(10):
        with Server(runner.program) as server:
            assert server.port
        assert server.process.returncode == 0


def test_every_answer_is_guarded_by_its_headers():
    with Server(runner.program) as server:
        for path in ("/", "/api/about", "/api/nothing", "/nothing.js", "/../../etc/passwd"):
            answer = server.ask("GET", path)
            policy = answer.headers["Content-Security-Policy"]
            assert "default-src 'none'" in policy and "frame-ancestors 'none'" in policy, path
            assert "unsafe" not in policy and "script-src 'self'" in policy
            assert answer.headers["X-Content-Type-Options"] == "nosniff" and answer.headers["Referrer-Policy"] == "no-referrer"
        page = server.ask("GET", "/", token="")
        assert page.status in (200, 503), page.status
        if page.status == 503:
            assert b"npm" in page.body
        else:
            assert b"<script>" not in page.body and page.headers["Content-Type"] == "text/html; charset=utf-8"
            again = server.ask("GET", "/", headers={"If-None-Match": page.headers["ETag"]})
            assert again.status == 304 and again.body == b""


def test_page_files_are_packed_for_clients_of_gzip():
    with Server(runner.program) as server:
        plain = server.ask("GET", "/", token="")
        if plain.status == 503:
            return
        assert plain.headers["Content-Encoding"] is None
        def asked(accepted, **more):
            return server.ask("GET", "/", token="", headers={"Accept-Encoding": accepted, **more})
        for accepted in ("gzip", "br, gzip;q=0.5", "deflate,gzip ; q=1"):
            answer = asked(accepted)
            assert answer.headers["Content-Encoding"] == "gzip" and answer.headers["Vary"] == "Accept-Encoding", accepted
            assert len(answer.body) < len(plain.body) and gzip.decompress(answer.body) == plain.body, accepted
            again = asked(accepted, **{"If-None-Match": answer.headers["ETag"]})
            assert again.status == 304 and again.body == b"" and again.headers["Content-Encoding"] is None
        for accepted in ("identity", "br", "gzip;q=0", "x-gzip", "", "gzip;q=x"):
            answer = asked(accepted)
            assert answer.headers["Content-Encoding"] is None and answer.body == plain.body, accepted
        about = server.ask("GET", "/api/about", headers={"Accept-Encoding": "gzip"})
        assert about.headers["Content-Encoding"] is None and about.json()["version"]


def test_a_refused_request_is_never_read_as_another():
    with Server(runner.program) as server:
        head = f"Host: {server.host}\r\nAuthorization: Bearer {server.token}\r\n"
        hidden = f"GET /api/about HTTP/1.1\r\n{head}\r\n"
        length = f"Content-Length: {len(hidden)}\r\n"
        outer = {
            "a body of GET": f"GET /api/about HTTP/1.1\r\n{head}{length}\r\n",
            "two lengths": f"GET /api/about HTTP/1.1\r\n{head}Content-Length: 0\r\n{length}\r\n",
            "two lengths of POST": f"POST /api/check HTTP/1.1\r\n{head}Content-Type: application/json\r\nContent-Length: 0\r\n{length}\r\n",
            "pieces": f"GET /api/about HTTP/1.1\r\n{head}Transfer-Encoding: chunked\r\n\r\n",
            "pieces and a length": f"POST /api/check HTTP/1.1\r\n{head}{length}Transfer-Encoding: chunked\r\n\r\n",
            "a blank before the colon": f"GET /api/about HTTP/1.1\r\n{head}Content-Length : {len(hidden)}\r\n\r\n",
            "a folded line": f"GET /api/about HTTP/1.1\r\n{head}X: y\r\n {length}\r\n",
            "line ends of one byte": f"GET /api/about HTTP/1.1\n{head}{length}\r\n\r\n",
            "a length with a sign": f"POST /api/check HTTP/1.1\r\n{head}Content-Length: +0\r\n\r\n",
            "a type that is none": f"POST /api/check HTTP/1.1\r\n{head}Content-Type: text/plain\r\n{length}\r\n",
            "no token": f"POST /api/check HTTP/1.1\r\nHost: {server.host}\r\n{length}\r\n",
            "another method": f"PUT /api/about HTTP/1.1\r\n{head}{length}\r\n",
            "a control character": f"GET /api/about HTTP/1.1\r\n{head}X: a\x01b\r\n{length}\r\n",
        }
        for what, text in outer.items():
            client = server.connect()
            client.sendall((text + hidden + hidden).encode())
            answers = b""
            try:
                while piece := client.recv(65536):
                    answers += piece
            except ConnectionError:
                pass
            client.close()
            assert answers.count(b"HTTP/1.1 ") == 1 and b" 200 " not in answers.split(b"\r\n")[0], (what, answers[:300])
        # Two that are whole come one after the other on one connection.
        client = server.connect()
        client.sendall((hidden + hidden.replace("Host", "Connection: close\r\nHost")).encode())
        answers = b""
        while piece := client.recv(65536):
            answers += piece
        client.close()
        assert answers.count(b"HTTP/1.1 200 ") == 2, answers


def test_addresses_and_types_are_what_they_are_called():
    with Server(runner.program) as server:
        assert server.ask("GET", "/api/about%00x").status == 400
        assert server.ask("GET", "/api/" + "a" * 3000).status == 414
        def check(kind):
            return server.ask("POST", "/api/check", {"script": "print(1)"}, headers={"Content-Type": kind}).status
        assert check("application/jsonx") == 415 and check("application/json-seq") == 415
        assert check("application/json; charset=utf-8") == 200 and check("Application/JSON") == 200
        events = server.run("print(io.open('.views/x', 'w'))")
        assert "belongs to the run" in json.dumps(events), events


def test_no_argument_of_a_program_holds_a_key():
    with tempfile.TemporaryDirectory() as folder:
        with open(folder + "/xdg-open", "w") as opener:
            opener.write(f"#!/bin/sh\necho \"$1\" > {folder}/opened\nsleep 5\n")
        os.chmod(folder + "/xdg-open", 0o755)
        path, mask = os.environ["PATH"], os.umask(0)
        os.environ["PATH"] = folder + ":" + path
        try:
            with Server(runner.program, "--open") as server:
                until(lambda: os.path.exists(folder + "/opened") and os.path.getsize(folder + "/opened"), "nothing was opened")
                opened = open(folder + "/opened").read().strip()
                assert server.token in open(opened).read() and f"http://{server.host}/#" in open(opened).read()
                assert os.stat(opened).st_mode & 0o777 == 0o600, oct(os.stat(opened).st_mode)
                for place in ("", "/scratch"):
                    assert os.stat(server.folder + "/runs" + place).st_mode & 0o777 == 0o700, place
                for process in filter(str.isdigit, os.listdir("/proc")):
                    try:
                        with open(f"/proc/{process}/cmdline", "rb") as line:
                            assert server.token.encode() not in line.read(), process
                    except OSError:
                        pass
        finally:
            os.environ["PATH"] = path
            os.umask(mask)


def test_paths_lead_nowhere_else():
    with Server(runner.program) as server:
        finished(server.run(chart))
        root = server.folder + "/runs/1/run"
        os.symlink("/etc/passwd", root + "/link.csv")
        os.symlink("/etc", root + "/folder")
        os.mkfifo(root + "/pipe.csv")
        for name in ("../events.jsonl", "%2e%2e/events.jsonl", "..%2fevents.jsonl", "%2fetc%2fpasswd", "/etc/passwd",
                     "./line.csv", "a/../line.csv", "link.csv", "folder/passwd", "pipe.csv", "", ".", "..",
                     ".views/surface-1.json", "line.csv%00.svg", "line.csv/", "line.csv/x", "store", "%c0%ae%c0%ae/x"):
            answer = server.ask("GET", "/api/runs/1/files/" + name)
            assert answer.status in (404, 400, 414), (name, answer.status, answer.body[:100])
        for name in ("../line.csv", "..%2fline", "%2e%2e%2fmanifest", "/", "a.json", ""):
            assert server.ask("GET", "/api/runs/1/views/" + name).status in (404, 400), name
        for path in ("/api/runs/../runs/1", "/api/runs/2", "/api/runs/-1", "/api/runs/1e0", "/api/runs/01/events",
                     "/index.html/../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/..%5c..%5cetc"):
            assert server.ask("GET", path).status in (404, 400), path
        assert server.ask("GET", "/api/runs/1/files/line.csv").status == 200


def test_what_a_script_wrote_is_no_page_of_ours():
    script = """local f = io.open("a.html", "w") f:write("<script>alert(1)</script>") f:close()
    local f = io.open("b.svg", "w") f:write("<svg xmlns='http://www.w3.org/2000/svg'><script>1</script></svg>") f:close()"""
    with Server(runner.program) as server:
        finished(server.run(script))
        for name in ("a.html", "b.svg"):
            answer = server.ask("GET", "/api/runs/1/files/" + name)
            assert not answer.headers["Content-Type"].startswith("text/html")
            assert "script-src 'self'" in answer.headers["Content-Security-Policy"]
            assert name != "b.svg" or answer.headers["Content-Disposition"] == "attachment"


if __name__ == "__main__":
    runner.main(globals())
