#!/usr/bin/env python3
"""The manual page, of what the program says of itself.

    man_page.py PROGRAM USER_GUIDE     prints mudline(1): options and commands from --help, exit codes from the guide
"""
import functools
import re
import subprocess
import sys


@functools.lru_cache(maxsize=None)
def help_of(program, *words):
    done = subprocess.run([program, *words, "--help"], capture_output=True, text=True, timeout=60, check=True)
    return done.stdout.strip()


def plain(text):
    """Text in which nothing is a command of roff."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join("\\&" + line if line[:1] in (".", "'") else line for line in text.splitlines())


def as_it_is(text):
    return f".nf\n{plain(text)}\n.fi"


def commands(text):
    """[(name, meaning)] of the list of subcommands."""
    part = re.search(r"^Subcommands:\n((?:  .*\n?)+)", text, re.MULTILINE)[1]
    return re.findall(r"^  (\w+) +(.*)$", part, re.MULTILINE)


def exit_codes(guide):
    """[(code, meaning)] of the guide's table."""
    section = re.search(r"^## \d+\. Exit codes$(.*?)^## ", guide, re.DOTALL | re.MULTILINE)[1]
    rows = re.findall(r"^\| (\d+) \| (.*) \|$", section, re.MULTILINE)
    return [(code, meaning.replace("`", "")) for code, meaning in rows]


def page(program, guide):
    text = help_of(program)
    title = text.splitlines()[0].split(": ", 1)[1]
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]
    lines = [f'.TH MUDLINE 1 "" "mudline {version}" "User commands"', ".SH NAME", f"mudline \\- {plain(title)}",
             ".SH SYNOPSIS", ".B mudline", "[\\fIoptions\\fR] \\fIcommand\\fR ...", ".SH DESCRIPTION", as_it_is(text)]
    for name, meaning in commands(text):
        told = help_of(program, name)
        first = [] if told.startswith(meaning) else [plain(meaning), ".PP"]
        lines += [f".SH {name.upper()}", *first, as_it_is(told)]
    lines.append(".SH EXIT STATUS")
    for code, meaning in exit_codes(guide):
        lines += [".TP", f".B {code}", plain(meaning)]
    lines += [".SH SEE ALSO", "The documents in the folder doc/mudline, of which docs/index.md is the first page."]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    with open(sys.argv[2], encoding="utf-8") as file:
        sys.stdout.write(page(sys.argv[1], file.read()))
