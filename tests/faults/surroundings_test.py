# SPDX-License-Identifier: GPL-3.0-or-later
"""The same results in any surroundings: surroundings_test.py FRETWORK STUDY MPIRUN

A short run of the study, its folder copied, is given again without HOME, in other locales, in folders of odd names, under odd umasks, with
closed standard streams and into folders that cannot be written. A rank of a run under MPI is killed; the run is resumed on other numbers of
ranks. Each gives the results of the reference, byte for byte, or a status that is not 0 and a message where one can be written.
"""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

LONGEST = 60  # s: a command that takes longer hangs
AFTER_A_KILL = 30  # s: all ranks have ended
NOBODY = 65534
LOCALES = ["C", "C.UTF-8", "de_DE.UTF-8", "tr_TR.UTF-8", "no such locale"]
NAMES = ["with spaces", "it's \"quoted\"", "Röhre_管_🎻", "$HOME;`x`&|", "-o", "new\nline"]
FRETWORK, STUDY, MPIRUN = sys.argv[1:4]
SHORT = ["transient.duration=0.02", "output.statistics_from=0"]
# An environment of its own may name the kernels of the linear algebra, which decide the last digits, and what sanitizers look at.
KEPT = {key: value for key, value in os.environ.items() if key.startswith(("OPENBLAS_", "ASAN_", "UBSAN_"))}
LONG = ["transient.duration=0.25", "transient.step=1e-6", "output.statistics_from=0", "output.checkpoint=0.01"]


def command(study, results, keys=SHORT):
    return [FRETWORK, "run", str(study), "--no-report", "-o", str(results)] + [word for key in keys for word in ("--set", key)]


def run(arguments, **more):
    return subprocess.run(arguments, capture_output=True, text=True, timeout=LONGEST, check=False, **more)


class Surroundings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="fretwork_surroundings_")
        cls.root = Path(cls.temporary.name)
        cls.study = cls.root / "study" / "study.toml"
        shutil.copytree(Path(STUDY).parent, cls.study.parent)
        done = run(command(cls.study, cls.root / "reference"))
        assert done.returncode == 0, done.stderr
        cls.reference = (cls.root / "reference" / "results.h5").read_bytes()

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def setUp(self):
        self.results = Path(tempfile.mkdtemp(dir=self.root)) / "results"

    def same(self, done, results=None):
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(((results or self.results) / "results.h5").read_bytes(), self.reference)

    def test_no_home_and_an_empty_environment(self):
        self.same(run(command(self.study, self.results), env={"PATH": os.environ["PATH"], **KEPT}))
        shutil.rmtree(self.results)
        self.same(run(command(self.study, self.results), env={"PATH": os.environ["PATH"], "HOME": "/no/such/folder", **KEPT}))

    def test_locales(self):
        for name in LOCALES:
            with self.subTest(name):
                self.same(run([*command(self.study, self.results), "--force"], env=dict(os.environ, LC_ALL=name, LANG=name)))

    def test_names_of_folders(self):
        for name in NAMES:
            with self.subTest(name):
                folder = self.results.parent / name
                shutil.copytree(self.study.parent, folder)
                done = run(command(folder / "study.toml", folder / "results"))
                self.same(done, folder / "results")

    def test_umasks(self):
        for mask in (0o000, 0o027, 0o077, 0o177, 0o777):
            with self.subTest(oct(mask)):
                results = self.results.parent / oct(mask)
                done = run(command(self.study, results), umask=mask)
                if done.returncode == 0:
                    self.same(done, results)
                else:
                    self.assertEqual(done.returncode, 1, done.stderr)
                    self.assertIn("fretwork: ", done.stderr)

    def test_closed_streams(self):
        for closed in ([0], [1], [2], [0, 1], [1, 2], [0, 1, 2]):
            with self.subTest(closed):
                def close(streams=closed):
                    for stream in streams:
                        os.close(stream)

                results = self.results.parent / "".join(map(str, closed))
                silent = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
                done = subprocess.run(command(self.study, results), preexec_fn=close, timeout=LONGEST, check=False, **silent)
                self.assertIn(done.returncode, (0, 1, 2))
                again = run(command(self.study, results))  # nothing that was written to a stream is in the results
                self.same(again, results)
                if done.returncode == 0:
                    self.assertIn("up to date", again.stdout)

    def test_folders_that_cannot_be_written(self):
        read_only = self.results.parent / "read only"
        read_only.mkdir(mode=0o555)
        for folder in (self.root, self.results.parent):
            folder.chmod(0o755)
        other_user = {"user": NOBODY} if os.geteuid() == 0 else {}
        for results, more in ((read_only, other_user), (read_only / "below", other_user), (Path("/proc/results"), {})):
            with self.subTest(results):
                done = run(command(self.study, results), **more)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn("fretwork: ", done.stderr)

    def test_a_killed_rank(self):
        whole, environment = self.results.parent / "whole", dict(
            os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1"
        )
        self.assertEqual(run(command(self.study, whole, LONG)).returncode, 0)
        for ranks, again in ((2, 3), (3, 1)):
            with self.subTest(f"{ranks} ranks, then {again}"):
                results = self.results.parent / f"of_{ranks}"
                job = subprocess.Popen([MPIRUN, "-n", str(ranks), *command(self.study, results, LONG)], env=environment,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
                end = time.monotonic() + LONGEST
                while not (results / "checkpoint.h5").exists() and job.poll() is None and time.monotonic() < end:
                    time.sleep(0.01)
                children = Path(f"/proc/{job.pid}/task/{job.pid}/children").read_text().split()
                self.assertEqual(len(children), ranks)
                os.kill(int(children[-1]), signal.SIGKILL)
                self.assertNotEqual(job.wait(timeout=AFTER_A_KILL), 0)
                self.assertFalse((results / "summary.json").exists())
                done = run([MPIRUN, "-n", str(again), *command(self.study, results, LONG)], env=environment)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("going on from", done.stdout)
                self.assertEqual((results / "results.h5").read_bytes(), (whole / "results.h5").read_bytes())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
