#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the documents' site strictly into a temporary folder. Every link and anchor must exist, every page must be reachable
from the first one, and no page may load anything from another host. Skipped (77) without mkdocs.

usage: site.py FOLDER
"""
import html.parser
import pathlib
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

LOADS = {"script": "src", "img": "src", "link": "href", "source": "src", "iframe": "src"}


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.loads = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        of = dict(attributes)
        self.anchors |= {of[key] for key in ("id", "name") if of.get(key)}
        if tag == "a" and of.get("href"):
            self.links.append(of["href"])
        if tag in LOADS and of.get(LOADS[tag]) and of.get("rel") != "canonical":
            self.loads.append(of[LOADS[tag]])


def foreign(address):
    return address.startswith("//") or urllib.parse.urlparse(address).scheme not in ("", "data", "mailto")


def faults_of(site):
    pages = {path: Page(path.read_text()) for path in site.rglob("*.html")}
    reached, faults = {site / "index.html"}, []
    for path, page in pages.items():
        name = path.relative_to(site)
        if name.name == "404.html":
            continue
        faults += [f"{name} loads {address}" for address in page.loads if foreign(address)]
        for address in page.links + page.loads:
            if foreign(address) or address.startswith(("data:", "mailto:")):
                continue
            target, _, anchor = address.partition("#")
            file = (path.parent / urllib.parse.unquote(target)).resolve() if target else path
            file = file / "index.html" if file.is_dir() else file
            if not file.is_file():
                faults.append(f"{name} links to {address}, which does not exist")
            elif anchor and file in pages and urllib.parse.unquote(anchor) not in pages[file].anchors:
                faults.append(f"{name} links to {address}, and that page has no such anchor")
            reached.add(file)
    return faults + [f"no page links to {path.relative_to(site)}" for path in pages
                     if path not in reached and path.name != "404.html"]


def main():
    project = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    if shutil.which("mkdocs") is None:
        print("mkdocs is not installed (Debian: mkdocs-material)")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        site = pathlib.Path(folder).resolve() / "site"
        built = subprocess.run(["mkdocs", "build", "--strict", "--quiet", "--site-dir", site], cwd=project, check=False,
                               capture_output=True, text=True)
        if built.returncode != 0:
            print(built.stdout + built.stderr)
            return 1
        faults = faults_of(site)
        print("\n".join(faults) or f"{len(list(site.rglob('*.html')))} pages, all links exist")
        return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
