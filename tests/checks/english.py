#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plain English, counted: rates in comments and documents, per room and per file of at least 300 words. A rate fails if it
exceeds its target and its recorded rate in tests/checks/english.txt, unless the file only became shorter: deleting a plain
sentence raises the rates of the others. Commit subjects are imperative and have at most 72 characters.

usage: english.py [FOLDER]           compare; a file that became worse is printed with its sentences to look at
       english.py --write [FOLDER]   record rates that are no worse, add new files, drop files that are gone
"""
import pathlib
import re
import subprocess
import sys

# Rates are per 1,000 words; openings are per 100 sentences; length: nine sentences in ten have at most so many words.
TARGETS = {"what": 2, "that": 12, "of-it": 2, "verbs": 1.5, "openings": 1.5, "length": 30}
PATTERNS = {
    "what": r"\bwhat\b",
    "that": r"\b(that|those)\b",
    "of-it": r"\bof (which|it|them|one|all|none|such|its|theirs)\b",
    "verbs": r"\b(told|asked|gone|lies|stands|goes|beside|kept|laid|hears|given up|taken for)\b",
}
OPENING = re.compile(r"(Of|What|Where|Whose|Whoever|Whichever|How|That which|Those|Beside|So does|So is|From which|With which|"
                     r"By which)\b(?!.*\?$)")
LEAST_WORDS, LEAST_RECORDED, MOST_CHARACTERS = 300, 200, 72
MARKS = {".cpp": "//", ".hpp": "//", ".h": "//", ".ts": "//", ".lua": "--"}
ROOMS = ("engine", "bindings", "tests", "scripts", "examples", "bench")
NO_VERB = re.compile(r"(A|An|The|What|Where|Whose|When|Whether|How|Of|On|In|With|Under|No|Some|Every|Each|It|This|That|Now|.*ing|"
                     r".*[^e]ed|.*[^s]s)$")


def comments(text, mark):
    """Comments as paragraphs: whole lines joined, and remarks of more than three words behind code."""
    paragraphs, block = [], []
    for line in text.splitlines():
        stripped = line.strip()
        if stripped.startswith(mark):
            block.append(stripped.lstrip("/#-").strip())
            continue
        paragraphs += [" ".join(block)] if block else []
        block = []
        remark = re.search(r"\s" + re.escape(mark) + r"\s?(.*)$", line)
        if remark and len(remark.group(1).split()) > 3:
            paragraphs.append(remark.group(1))
    return paragraphs + ([" ".join(block)] if block else [])


def pages(text):
    """Paragraphs of Markdown without code, tables, headings and pictures."""
    text = re.sub(r"```.*?```|<!--.*?-->", "", text, flags=re.S)
    return [" ".join(re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", paragraph).split())
            for paragraph in re.split(r"\n\s*\n", text) if not paragraph.lstrip().startswith(("|", "#", "!"))]


def sentences(paragraphs):
    for paragraph in paragraphs:
        if "SPDX" in paragraph:
            continue
        for sentence in re.split(r"(?<=[.!?])\s+", re.sub(r"`[^`]*`", "X", paragraph)):
            words = re.findall(r"[A-Za-z][A-Za-z'-]*", sentence)
            if len(words) >= 4:
                yield sentence.strip(), len(words)


def rates(found):
    """Rates of a list of (sentence, words), rounded to a tenth, and the number of words."""
    words = sum(count for _, count in found)
    of = {name: 1000 * sum(len(re.findall(pattern, sentence, re.I)) for sentence, _ in found) / max(1, words)
          for name, pattern in PATTERNS.items()}
    of["openings"] = 100 * sum(bool(OPENING.match(sentence)) for sentence, _ in found) / max(1, len(found))
    of["length"] = sorted(count for _, count in found)[int(.9 * (len(found) - 1))] if found else 0
    return {name: round(rate, 1) for name, rate in of.items()}, words


def measured(folder, least):
    """{file or room/: (rates, words, sentences)}, of files from that many words on."""
    by_name, rooms = {}, {}
    for top in ROOMS:
        for path in sorted((folder / top).rglob("*")):
            if path.suffix not in MARKS or not path.is_file() or {"node_modules", "dist"} & set(path.parts):
                continue
            name = path.relative_to(folder).as_posix()
            found = list(sentences(comments(path.read_text(encoding="utf-8", errors="ignore"), MARKS[path.suffix])))
            by_name[name] = found
            rooms.setdefault("/".join(name.split("/")[:-1][:2]) + "/", []).extend(found)
    for path in [*folder.glob("*.md"), *sorted((folder / "docs").glob("*.md")), *sorted((folder / "engine").rglob("*.md"))]:
        found = list(sentences(pages(path.read_text(encoding="utf-8"))))
        by_name[path.relative_to(folder).as_posix()] = found
        rooms.setdefault("documents/", []).extend(found)
    by_name.update(rooms)
    with_rates = {name: (*rates(found), found) for name, found in by_name.items()}
    return {name: found for name, found in with_rates.items() if name.endswith("/") or found[1] >= least}


def recorded(path):
    lines = [line.split() for line in path.read_text(encoding="utf-8").splitlines() if line and line[0] != "#"]
    return {name: dict(zip([*TARGETS, "words"], map(float, numbers))) for name, *numbers in lines}


def is_worse(key, rate, words, bound):
    shorter = key != "length" and rate * words <= bound[key] * bound.get("words", 0)
    return rate > bound[key] and not shorter


def subjects(folder):
    """Complaints about the subjects of the commits since this check is in the history."""
    def git(*arguments):
        return subprocess.run(["git", "-C", str(folder), *arguments], capture_output=True, text=True, check=False).stdout.splitlines()
    first = git("log", "--diff-filter=A", "--format=%H", "--", "tests/checks/english.py")
    for line in git("log", "--no-merges", "--format=%h %s", first[-1] + "..HEAD") if first else []:
        commit, _, subject = line.partition(" ")
        if len(subject) > MOST_CHARACTERS:
            yield f"commit {commit}: {len(subject)} characters, over {MOST_CHARACTERS}: {subject}"
        if NO_VERB.match(subject.split()[0]) or not subject[0].isupper():
            yield f"commit {commit}: begin with an imperative, such as Add, Fix or Remove: {subject}"


def main(arguments):
    write = arguments[:1] == ["--write"]
    rest = arguments[write:]
    folder = pathlib.Path(rest[0]) if rest else pathlib.Path(__file__).resolve().parents[2]
    record = folder / "tests/checks/english.txt"
    # Shorter files are recorded too: a file that grows to the least length has a rate to be compared with.
    now = measured(folder, LEAST_RECORDED if write else LEAST_WORDS)
    before = recorded(record) if record.exists() else None
    if write:
        lines = ["# Recorded rates of English, as english.py --write measured them: file or room, " + ", ".join(TARGETS) + ", words."]
        for name in sorted(now):
            of, words, _ = now[name]
            old = (before or {}).get(name, TARGETS if before is not None else of)
            rates_now = [old[key] if is_worse(key, rate, words, old) else rate for key, rate in of.items()]
            lines.append(" ".join([name, *(f"{rate:g}" for rate in rates_now), str(words)]))
        record.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return 0
    wrong = list(subjects(folder))
    for name, (of, words, found) in now.items():
        bound = before.get(name, TARGETS)
        over = [f"{key} {of[key]:g}, recorded {bound.get(key, 0):g}" for key in TARGETS
                if of[key] > TARGETS[key] and is_worse(key, of[key], words, bound)]
        if over:
            wrong.append(f"{name}: {'; '.join(over)}" + ("" if name in before else " (a new file meets the targets)"))
            looked_at = [sentence for sentence, count in found
                         if OPENING.match(sentence) or count > 40 or len(re.findall(r"\b(what|that)\b", sentence)) > 1]
            wrong += [] if name.endswith("/") else [f"  ? {sentence[:200]}" for sentence in looked_at[:6]]
    wrong += [f"tests/checks/english.txt: {name} is gone; run english.py --write" for name in before
              if name not in now and not (folder / name).exists()]
    reached = sum(all(of[key] <= TARGETS[key] for key in TARGETS) for of, _, _ in now.values())
    print("\n".join(wrong) if wrong else f"{len(now)} files and rooms, none worse than recorded; {reached} reach every target")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
