# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the program and its studies as dicts."""

from __future__ import annotations

import json
import math
import os
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .results import Results


class RunFailed(Exception):
    """The program ended with an error; the message is its own."""


def program() -> str:
    """The executable: FRETWORK of the environment, the one this package was installed with, or `fretwork` of the PATH."""
    beside = Path(__file__).resolve().parents[4] / "bin" / "fretwork"
    found = os.environ.get("FRETWORK") or (str(beside) if beside.exists() else None) or shutil.which("fretwork")
    if not found:
        raise RunFailed("the program fretwork is not on the PATH; install it, or name it in the environment variable FRETWORK")
    return found


def read_study(file: str | Path) -> dict[str, Any]:
    """A study file as a dict."""
    with open(file, "rb") as stream:
        return tomllib.load(stream)


def _toml(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else str(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(str(key))} = {_toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if hasattr(value, "tolist"):  # of numpy
        return _toml(value.tolist())
    raise TypeError(f"a study holds texts, numbers, booleans, lists and dicts, not {type(value).__name__}")


def write_study(study: Mapping[str, Any], file: str | Path) -> Path:
    """Writes a study; paths in it count from the folder of the file."""
    path = Path(file)
    path.write_text("".join(f"{json.dumps(key)} = {_toml(value)}\n" for key, value in study.items()), encoding="utf-8")
    return path


def run(study: str | Path, overrides: Mapping[str, Any] | None = None, ranks: int = 1, output: str | Path | None = None, progress: bool = True) -> Results:
    """Runs a study file; returns its results.

    overrides: values by key, e.g. {"modes.count": 60}, as `--set` of the program takes them. ranks: processes (mpirun). output: folder of the
    results; by default the study's name with .results. progress: what the program prints is printed.
    Raises RunFailed with the program's message."""
    file = Path(study)
    folder = Path(output) if output else file.with_suffix(".results")
    command = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
    command += [program(), "run", str(file), "--output", str(folder)]
    for key, value in (overrides or {}).items():
        command += ["--set", f"{key}={_toml(value)}"]
    lines: list[str] = []
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        for line in process.stdout or ():
            lines.append(line)
            if progress:
                sys.stdout.write(line)
    if process.returncode:
        raise RunFailed("".join(lines[-20:]).strip() or f"fretwork ended with status {process.returncode}")
    return Results(folder)
