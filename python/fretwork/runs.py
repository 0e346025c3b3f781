# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the program and its studies as dicts."""

from __future__ import annotations

import json
import math
import os
import re
import shutil
import subprocess
import tomllib
from collections.abc import Iterator, Mapping
from itertools import takewhile
from pathlib import Path
from typing import Any

from .results import Results
from .sweeps import Sweep


class RunFailed(Exception):
    """The program ended with an error; the message is its own."""


def program() -> str:
    """The executable: FRETWORK of the environment, the one this package was installed with, or `fretwork` of the PATH."""
    beside = Path(__file__).resolve().parents[4] / "bin" / "fretwork"
    named = os.environ.get("FRETWORK")
    if named and not shutil.which(named):
        raise RunFailed(f"FRETWORK = {named} is no program that can be run; name the executable fretwork in this environment variable")
    found = named or (str(beside) if beside.exists() else None) or shutil.which("fretwork")
    if not found:
        raise RunFailed("the program fretwork is not on the PATH; install it, or name it in the environment variable FRETWORK")
    return found


def _command(ranks: int) -> list[str]:
    if ranks < 1:
        raise ValueError(f"ranks = {ranks}: a number of processes >= 1 is expected")
    if ranks > 1 and not shutil.which("mpirun"):
        raise RunFailed(f"ranks = {ranks} needs mpirun, which is not on the PATH; install openmpi-bin, or use one rank")
    return ["mpirun", "-n", str(ranks), program()] if ranks > 1 else [program()]


def read_study(file: str | Path) -> dict[str, Any]:
    """A study file as a dict."""
    with open(file, "rb") as stream:
        return tomllib.load(stream)


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _key(key: Any) -> str:
    return str(key) if re.fullmatch(r"[A-Za-z0-9_-]+", str(key)) else _text(str(key))


def _toml(value: Any, key: str) -> str:
    """A value on one line; `key` for messages."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, Path)):
        return _text(str(value))
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(float(value)) if math.isfinite(value) else str(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(name)} = {_toml(item, f'{key}.{name}')}" for name, item in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(item, f"{key}[{i}]") for i, item in enumerate(value)) + "]"
    if hasattr(value, "tolist"):  # of numpy
        return _toml(value.tolist(), key)
    raise TypeError(f"{key} = {value!r}: a study holds texts, paths, numbers, booleans, lists and dicts, not {type(value).__name__}; "
                    "leave the key out for its default")


def _tables(value: Mapping[str, Any], path: str) -> Iterator[str]:
    """Lines of a table: values first, then tables and arrays of tables under headers of their own, so that messages name a line."""
    inner: list[tuple[str, Mapping[str, Any]]] = []
    for name, item in value.items():
        key = f"{path}.{_key(name)}" if path else _key(name)
        if isinstance(item, Mapping):
            inner.append((f"[{key}]", item))
        elif isinstance(item, (list, tuple)) and item and all(isinstance(entry, Mapping) for entry in item):
            inner += [(f"[[{key}]]", entry) for entry in item]
        else:
            yield f"{_key(name)} = {_toml(item, key)}"
    for header, table in inner:
        if header.startswith("[[") or not table or not all(isinstance(item, Mapping) for item in table.values()):  # a header that something follows
            yield from ("", header)
        yield from _tables(table, header.strip("[]"))


def write_study(study: Mapping[str, Any], file: str | Path) -> Path:
    """Writes a study; paths in it count from the folder of the file. Returns the file."""
    path = Path(file)
    path.write_text("\n".join(_tables(study, "")) + "\n", encoding="utf-8")
    return path


def _execute(command: str, ending: str, study: str | Path, overrides: Mapping[str, Any] | None, ranks: int, output: str | Path | None, progress: bool) -> Path:
    """The folder of the results."""
    if isinstance(study, Mapping):
        raise TypeError(f"study is a dict: {command} takes a file; write it first, {command}(write_study(study, \"mine.toml\"))")
    file = Path(study)
    folder = Path(output) if output else file.with_suffix(ending)
    words = [*_command(ranks), command, str(file), "--output", str(folder)]
    for key, value in (overrides or {}).items():
        words += ["--set", f"{key}={_toml(value, key)}"]
    lines: list[str] = []
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        try:
            for line in process.stdout or ():
                lines.append(line)
                if progress:
                    print(line, end="", flush=True)
        except BaseException:  # an interrupt of a notebook reaches only this process; the program saves a checkpoint and ends
            process.terminate()
            process.wait()
            raise
    if process.returncode:
        own = list(takewhile(lambda line: not re.fullmatch("-+\n", line), lines))  # what mpirun adds to it is between such rules
        raise RunFailed("".join(own[-20:]).strip() or "".join(lines[-20:]).strip() or f"fretwork ended with status {process.returncode}")
    return folder


def run(study: str | Path, overrides: Mapping[str, Any] | None = None, ranks: int = 1, output: str | Path | None = None, progress: bool = True) -> Results:
    """Runs a study file (of a dict: write_study); returns its results.

    overrides: values by key, e.g. {"modes.count": 60}, as `--set` of the program takes them. ranks: processes (mpirun). output: folder of the
    results; by default the study's name with .results. progress: what the program prints is printed,
    and how far it is. An interrupted run goes on from its checkpoint when it is started again. Raises RunFailed with the program's message."""
    return Results(_execute("run", ".results", study, overrides, ranks, output, progress))


def sweep(study: str | Path, overrides: Mapping[str, Any] | None = None, ranks: int = 1, output: str | Path | None = None, progress: bool = True) -> Sweep:
    """Computes the cases of [sweep] of a study file; returns their table and statistics.

    Arguments as of `run`; by default the folder is the study's name with .sweep. An interrupted sweep goes on when it is started again.
    Raises RunFailed with the program's message, also where no case has a result."""
    return Sweep(_execute("sweep", ".sweep", study, overrides, ranks, output, progress))
