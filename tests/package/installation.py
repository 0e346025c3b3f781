# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of installations share: <test>.py CMAKE SOURCE_FOLDER BUILD_FOLDER."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

CMAKE, SOURCE, BUILD = (Path(sys.argv.pop(1)) for _ in range(3))


def call(*command, **options):
    """What the command wrote; its failure is that of the test."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}: status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def bare_environment():
    """Neither folders of the user nor of the build."""
    kept = {name: value for name, value in os.environ.items() if name.startswith(("OMPI_", "OMP_", "ASAN_", "UBSAN_"))}
    return {**kept, "PATH": "/usr/bin:/bin", "HOME": "/nonexistent", "LC_ALL": "C.UTF-8"}


class Prefix:
    """An installation in a temporary folder, moved after it was made."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="fretwork_install_")
        made = Path(self.folder.name) / "made"
        call(CMAKE, "--install", BUILD, "--prefix", made)
        self.path = made.rename(Path(self.folder.name) / "moved")
        self.program = self.path / "bin" / "fretwork"

    def work(self, name):
        """A folder to work in."""
        folder = Path(self.folder.name) / name
        folder.mkdir()
        return folder
