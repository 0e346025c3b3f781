# SPDX-License-Identifier: GPL-3.0-or-later
"""The packages of Debian: packages_test.py CMAKE SOURCE_FOLDER BUILD_FOLDER. long.sh installs them."""

import re
import shutil
import tempfile
import unittest
from pathlib import Path

from installation import BUILD, CMAKE, SOURCE, call

# What is started as a program of its own and needed for nothing but speed or several processes.
STARTED = {"python3-h5py", "python3-numpy", "python3-meshio", "openmpi-bin", "libopenblas0-serial"}


def field(package, name):
    """The packages a field of the control file names, without versions."""
    return set(re.findall(r"(?:^|, )([a-z0-9][a-z0-9.+-]*)", call("dpkg-deb", "-f", package, name)))


@unittest.skipUnless(shutil.which("dpkg-shlibdeps"), "dpkg-shlibdeps (dpkg-dev) is not installed")
class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="fretwork_packages_")
        cls.addClassCleanup(folder.cleanup)
        call(CMAKE.parent / "cpack", "-G", "DEB", "-B", folder.name, "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", cwd=BUILD)
        [cls.program], [cls.libraries] = (list(Path(folder.name).glob(name)) for name in ("fretwork_*.deb", "libfretwork-dev_*.deb"))
        cls.root = Path(folder.name) / "root"
        for package in (cls.program, cls.libraries):
            call("dpkg-deb", "-x", package, cls.root)

    def test_the_program_depends_on_the_libraries_it_links(self):
        depends = field(self.program, "Depends")
        for library in ("libslepc-real", "libpetsc-real", "libhdf5-openmpi", "libgmsh", "libopenmpi", "libfftw3-double", "libssl", "libstdc++"):
            self.assertTrue(any(name.startswith(library) for name in depends), f"{library} in {depends}")
        self.assertFalse([name for name in depends if name.endswith("-dev")], "needed to build, not to run")

    def test_programs_that_are_started_are_recommended(self):
        self.assertLessEqual(STARTED, field(self.program, "Recommends"))
        listed = (SOURCE / "tools" / "packages.txt").read_text().split()
        self.assertLessEqual(STARTED, set(listed), "the packages that a build installs")

    def test_the_libraries_depend_on_what_their_configuration_looks_for(self):
        """Every package of tools/packages.txt that FretworkConfig.cmake names by its module."""
        configuration = (self.root / "usr/lib/cmake/Fretwork/FretworkConfig.cmake").read_text()
        package_of = {"Eigen3": "libeigen3-dev", "fmt": "libfmt-dev", "PkgConfig": "pkg-config", "libcrypto": "libssl-dev",
                      "fftw3": "libfftw3-dev", "MPI": "libopenmpi-dev", "slepc": "libslepc-real-dev"}
        looked_for = set(re.findall(r"find_dependency\((\w+)", configuration)) | set(re.findall(r"IMPORTED_TARGET (\w+)", configuration))
        self.assertEqual({package_of[module] for module in looked_for}, field(self.libraries, "Depends"))

    def test_contents(self):
        for name in ("bin/fretwork", "libexec/fretwork/fretwork-geometry", "share/fretwork/python/fretwork/report/page.js",
                     "share/fretwork/sweep/openturns_helper.py", "share/man/man1/fretwork.1", "share/doc/fretwork/copyright",
                     "share/doc/fretwork/examples/oscillator/study.toml", "share/bash-completion/completions/fretwork",
                     "share/zsh/vendor-completions/_fretwork", "include/fretwork/transient/run.hpp", "lib/libfretwork_transient.a"):
            self.assertTrue((self.root / "usr" / name).is_file(), name)
        self.assertEqual({path.name for path in self.root.iterdir()}, {"usr"})
        self.assertFalse(list(self.root.rglob("__pycache__")))

    def test_everybody_may_read_it(self):
        for path in self.root.rglob("*"):
            wanted = 0o755 if path.is_dir() or path.parent.name in ("bin",) or path.name == "fretwork-geometry" else 0o644
            self.assertEqual(path.stat().st_mode & 0o777, wanted, path)

    def test_the_program_of_the_package_runs(self):
        self.assertRegex(call(self.root / "usr/bin/fretwork", "--version"), r"^\d+\.\d+\.\d+$")


if __name__ == "__main__":
    unittest.main()
