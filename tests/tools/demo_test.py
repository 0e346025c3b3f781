# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the scripts that build and run on a fresh machine: demo_test.py SOURCE_FOLDER. What they call is replaced by programs that only
write down how they were called."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1))

CALLED = """#!/bin/sh
echo "$(basename "$0") $*" >>"$CALLS"
"""
APT = CALLED + """
for percent in 0.5 7.25 13.1 19.9 100; do echo "dlstatus:1:$percent:Retrieving file"; done
echo "Reading package lists..."
for percent in 0.1 42.5; do echo "pmstatus:libfmt9:$percent:Installing libfmt9 (amd64)"; done
"""
FRETWORK = CALLED + 'echo "made-up results"\n'


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)


class Demo(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="fretwork_demo_")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        shutil.copytree(SOURCE / "tools", self.folder / "tools")
        for program in ("cmake", "ctest"):
            write(self.folder / "bin" / program, CALLED)
        write(self.folder / "bin" / "apt-get", APT)
        write(self.folder / "bin" / "dpkg-query", "#!/bin/sh\nexit 1\n")  # nothing is installed
        write(self.folder / "bin" / "sudo", '#!/bin/sh\nexec "$@"\n')
        write(self.folder / "build" / "release" / "bin" / "fretwork", FRETWORK)

    def run_script(self, name):
        """What the script said, and what it called."""
        calls = self.folder / "calls"
        environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}", "CALLS": str(calls)}
        environment.pop("CI", None)  # where warnings are errors
        done = subprocess.run([self.folder / "tools" / name], env=environment, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, calls.read_text().splitlines()

    def calls_of(self, calls, start):
        return [call for call in calls if call.startswith(start)]

    def test_the_demo_installs_and_builds_the_program_alone(self):
        _, calls = self.run_script("demo.sh")
        installed = self.calls_of(calls, "apt-get install")[0].split()
        self.assertIn("libslepc-real-dev", installed)
        for package in ("libgtest-dev", "libbenchmark-dev"):
            self.assertNotIn(package, installed)
        self.assertIn("-DFRETWORK_TESTS=OFF -DFRETWORK_BENCH=OFF", self.calls_of(calls, "cmake --preset")[0])
        build = self.calls_of(calls, "cmake --build")[0]
        self.assertIn("--target fretwork", build)
        self.assertNotIn("--quiet", build)

    def test_the_demo_leaves_a_build_with_tests_as_it_is(self):
        write(self.folder / "build" / "release" / "CMakeCache.txt", "")
        _, calls = self.run_script("demo.sh")
        self.assertEqual(self.calls_of(calls, "cmake --preset"), ["cmake --preset release"])
        self.assertIn("--target fretwork", self.calls_of(calls, "cmake --build")[0])

    def test_the_demo_says_what_comes_and_where_the_report_is(self):
        said, _ = self.run_script("demo.sh")
        for step in ("1 of 3", "2 of 3", "3 of 3"):
            self.assertIn(step, said)
        self.assertIn("report.html", said[said.index("made-up results"):])

    def test_the_installation_says_how_far_it_is_also_in_a_log(self):
        said, _ = self.run_script("install_packages.sh")
        told = [line.strip() for line in said.splitlines() if " % " in line]
        self.assertEqual(told, ["0 % Retrieving file", "13 % Retrieving file", "100 % Retrieving file",
                                "0 % Installing libfmt9 (amd64)", "42 % Installing libfmt9 (amd64)"])

    def test_the_tests_have_their_packages_and_targets(self):
        _, calls = self.run_script("test.sh")
        self.assertIn("libgtest-dev", self.calls_of(calls, "apt-get install")[0].split())
        self.assertIn("-DFRETWORK_TESTS=ON", self.calls_of(calls, "cmake --preset")[0])
        self.assertNotIn("--target", self.calls_of(calls, "cmake --build")[0])
        self.assertTrue(self.calls_of(calls, "ctest"))


if __name__ == "__main__":
    unittest.main()
