#!/usr/bin/env python3
"""Every section that a stage, a law or a comment in the code names must be a section of docs/, and docs/parameters.md what
the program prints.

usage: sources.py PROGRAM ROOT

Forms: "3.1" is a section of docs/theory.md, "twopoint 5" one of docs/theory_twopoint.md, "1, Drag" a heading with these
words in chapter 1 of docs/theory.md. In comments: "theory 3.1", "theory_twopoint 6, 7". A reference solution is named in
docs/references.md by its file."""
import pathlib
import re
import subprocess
import sys

FOLDERS = ["core", "eos", "constitutive", "mpm", "coupling", "twopoint", "ice", "references", "run"]
HEADING = re.compile(r"^#+ (\d+(?:\.\d+)*)\.? (.+)$", re.MULTILINE)
COMMENT = re.compile(r"\btheory(_twopoint)? (\d+(?:\.\d+)?(?:, \d+(?:\.\d+)?)*)")


def headings(page):
    """Number -> title of a page's numbered headings."""
    return dict(HEADING.findall(page.read_text()))


def listed(program):
    """[(what, name, source)] of `mpmice list`."""
    found, what = [], None
    for line in subprocess.run([program, "list"], check=True, capture_output=True, text=True).stdout.splitlines():
        if line and not line.startswith(" "):
            what = line.split(" (")[0].rstrip(":")
        elif line.startswith("  ") and what in ("stages", "skeleton laws", "equations of state", "drag laws", "references"):
            name, _, source = line.strip().partition(" ")
            found.append((what, name, source.strip().split(";")[0]))
    return found


def is_section(source, theory, twopoint):
    if re.fullmatch(r"twopoint [\d.]+", source):
        return source.split()[1] in twopoint
    if re.fullmatch(r"\d+(\.\d+)*", source):
        return source in theory
    match = re.fullmatch(r"(\d+), (.+)", source)
    return bool(match) and any(
        number.split(".")[0] == match[1] and match[2].lower() in title.lower() for number, title in theory.items())


def main(program, root):
    root = pathlib.Path(root)
    theory, twopoint = headings(root / "docs/theory.md"), headings(root / "docs/theory_twopoint.md")
    references = (root / "docs/references.md").read_text()
    faults, count = [], {}
    for what, name, source in listed(program):
        count[what] = count.get(what, 0) + 1
        good = f"`references/{name}.c`" in references if what == "references" else is_section(source, theory, twopoint)
        if not good:
            faults.append(f"{what}: {name}: no section \"{source}\" in docs/")
    for folder in FOLDERS:
        for file in sorted((root / folder).rglob("*.[ch]")):
            for page, numbers in COMMENT.findall(file.read_text()):
                count["comments"] = count.get("comments", 0) + 1
                faults += [f"{file.relative_to(root)}: no section {number} in docs/theory{page}.md"
                           for number in numbers.split(", ") if number not in (twopoint if page else theory)]
    made = subprocess.run([program, "list", "--markdown"], check=True, capture_output=True, text=True).stdout
    if made != (root / "docs/parameters.md").read_text():
        faults.append("docs/parameters.md is old; make it anew: mpmice list --markdown > docs/parameters.md")
    empty = [what for what in ("stages", "skeleton laws", "equations of state", "drag laws", "references", "comments")
             if not count.get(what)]
    faults += [f"no {what} found: has the output of `mpmice list` changed?" for what in empty]
    print("\n".join(faults) if faults else ", ".join(f"{n} {what}" for what, n in count.items()) + ": all have their section")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
