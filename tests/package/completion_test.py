# SPDX-License-Identifier: GPL-3.0-or-later
"""What the shells complete is what the program takes: completion_test.py CMAKE SOURCE_FOLDER BUILD_FOLDER."""

import functools
import re
import shutil
import tempfile
import unittest
from pathlib import Path

from installation import BUILD, SOURCE, call

PROGRAM = BUILD / "bin" / "fretwork"
FOLDER = SOURCE / "app" / "completion"
OPTION = re.compile(r"(?<![\w-])--?[a-z][a-z-]*")

# zsh's _arguments, which _fretwork calls, replaced by one that writes down what it is given, and the commands.
OF_ZSH = """
_arguments() { print -rl -- "$@"; [[ $@[-1] != *_describe* ]] || print -rl -- $subcommands }
fpath=($COMPLETION)
autoload -Uz _fretwork
words=("$@"); CURRENT=$#
_fretwork
"""


@functools.cache
def commands_of_program():
    listed = call(PROGRAM, "--help").split("Subcommands:")[1].split("\n\n")[0]
    return set(re.findall(r"^  (\w+)", listed, re.MULTILINE))


@functools.cache
def options_of_program(*command):
    listed = call(PROGRAM, *command, "--help").split("\nOptions:")[1].split("\n\n")[0]
    return {option for names in re.findall(r"^  (-\S+)", listed, re.MULTILINE) for option in names.split(",")}


def bash(*words, folder=None):
    """What bash completes the last word to."""
    script = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); compopt() { :; }; _fretwork; printf "%s\\n" "${COMPREPLY[@]}"'
    return set(call("bash", "-c", script, "bash", FOLDER / "fretwork", "fretwork", *words, cwd=folder).split())


def zsh(*words):
    """The specifications that zsh's _arguments gets, and the commands."""
    return call("zsh", "-f", "-c", OF_ZSH, "zsh", "fretwork", *words, env={"COMPLETION": str(FOLDER), "PATH": "/usr/bin:/bin"})


def options_of_specifications(text):
    """Specifications are (exclusions)*-option[text]:argument."""
    return set(re.findall(r"^(?:\([^)]*\))?\*?(--?[a-z][a-z-]*)", text, re.MULTILINE))


class Bash(unittest.TestCase):
    def test_commands(self):
        self.assertEqual({word for word in bash("") if not word.startswith("-")}, commands_of_program())
        self.assertEqual(bash("-"), options_of_program())

    def test_options_of_every_command(self):
        for command in commands_of_program():
            with self.subTest(command):
                self.assertEqual(bash(command, "-"), options_of_program(command))

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a.toml", "b.txt"):
                (Path(folder) / name).touch()
            (Path(folder) / "c.results").mkdir()
            self.assertEqual(bash("run", "", folder=folder), {"a.toml", "c.results"})
            self.assertEqual(bash("report", "", folder=folder), {"c.results"})
            self.assertEqual(bash("run", "a.toml", "--set", "", folder=folder), set())

    def test_formats(self):
        listed = re.search(r"--format TEXT:\{(.*)\}", call(PROGRAM, "export", "--help")).group(1)
        self.assertEqual(bash("export", "--format", ""), set(listed.split(",")))


@unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
class Zsh(unittest.TestCase):
    def test_commands(self):
        written = zsh("")
        self.assertEqual(set(re.findall(r"^([a-z]+):", written, re.MULTILINE)), commands_of_program())
        self.assertEqual(options_of_specifications(written), options_of_program())

    def test_options_of_every_command(self):
        for command in commands_of_program():
            with self.subTest(command):
                self.assertEqual(options_of_specifications(zsh(command, "-")), options_of_program(command))


class Manual(unittest.TestCase):
    def test_every_command_and_option_is_in_the_manual_page(self):
        manual = (SOURCE / "doc" / "fretwork.1").read_text().replace("\\-", "-")
        manual = re.sub(r"\\f.", "", manual)
        for command in commands_of_program():
            self.assertRegex(manual, rf"\b{command}\b")
            for option in options_of_program(command) - {"-h", "--help"}:
                self.assertIn(option, OPTION.findall(manual))


if __name__ == "__main__":
    unittest.main()
