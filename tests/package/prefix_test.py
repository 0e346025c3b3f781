# SPDX-License-Identifier: GPL-3.0-or-later
"""An installation in a prefix works by itself, wherever the prefix is: prefix_test.py CMAKE SOURCE_FOLDER BUILD_FOLDER."""

import json
import math
import shutil
import unittest

from installation import BUILD, CMAKE, SOURCE, Prefix, bare_environment, call

SAME_MOTION = 1e-9  # relative: the same scheme on the same modes; the mode shapes' round-off is 1e-12
MESH_OF_TEN = 1e-5  # relative: ten elements of order 4 against the exact cantilever

CONSUMER = """
cmake_minimum_required(VERSION 3.23)
project(consumer LANGUAGES CXX)
find_package(Fretwork COMPONENTS contact transient REQUIRED)
if(TARGET PkgConfig::SLEPC OR TARGET MPI::MPI_CXX)
  message(FATAL_ERROR "these components need neither MPI nor SLEPc")
endif()
find_package(Fretwork COMPONENTS wings QUIET)
if(Fretwork_FOUND)
  message(FATAL_ERROR "there is no component wings")
endif()
add_library(all_headers OBJECT headers.cpp)
target_link_libraries(all_headers PRIVATE Fretwork::transient)
"""


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.prefix = Prefix()
        cls.addClassCleanup(cls.prefix.folder.cleanup)
        cls.study = shutil.copytree(cls.prefix.path / "share/doc/fretwork/examples/cantilever_stop", cls.prefix.work("run") / "study")
        cls.said = call(cls.prefix.program, "run", cls.study / "study.toml", cwd="/", env=bare_environment())
        cls.results = cls.study / "study.results"

    def test_the_report_has_its_libraries_and_scripts(self):
        page = (self.results / "report.html").read_text()
        installed = self.prefix.path / "share/fretwork/python/fretwork/report"
        for part in ("page.js", "vendor/uplot/uPlot.iife.min.js", "vendor/three/three.min.js"):
            self.assertIn((installed / part).read_text().strip()[-200:], page, part)

    def test_results_are_exported(self):
        call(self.prefix.program, "export", self.results, "--format", "vtu", cwd="/", env=bare_environment())
        self.assertTrue(list((self.results / "export-vtu").rglob("*.vtu")))

    def test_geometries_are_meshed(self):
        study = shutil.copytree(self.prefix.path / "share/doc/fretwork/examples/straight_tube", self.prefix.work("mesh") / "study")
        call(self.prefix.program, "mesh", study / "study.toml", "--quiet", cwd="/", env=bare_environment())

    def test_the_python_package_is_there(self):
        environment = {**bare_environment(), "PYTHONPATH": str(self.prefix.path / "share/fretwork/python"), "PYTHONDONTWRITEBYTECODE": "1"}
        told = call("python3", "-c", "import fretwork.runs; print(fretwork.runs.program())", env=environment)
        self.assertEqual(told.strip(), str(self.prefix.program.resolve()))

    def test_documents(self):
        documents = self.prefix.path / "share/doc/fretwork"
        for name in ("README.md", "LICENSE", "CHANGELOG.md", "doc/study-file.md", "../../man/man1/fretwork.1",
                     "../../bash-completion/completions/fretwork", "../../zsh/site-functions/_fretwork"):
            self.assertTrue((documents / name).exists(), name)
        self.assertEqual({folder.name for folder in (documents / "examples").iterdir()},
                         {folder.name for folder in (SOURCE / "examples").iterdir() if folder.is_dir()})
        self.assertFalse(list(documents.rglob("*.results")))

    def test_no_text_names_the_source_or_the_build(self):
        compiled = (b"\x7fELF", b"!<arch>")  # assertions may name their file there
        for file in self.prefix.path.rglob("*"):
            if file.is_file() and not (content := file.read_bytes()).startswith(compiled):
                for folder in (SOURCE, BUILD):
                    self.assertNotIn(str(folder).encode(), content, file)

    def build(self, source, *options):
        """Configures and builds a project against the installation; its build folder."""
        build = self.prefix.work("build_of_" + source.name)
        call(CMAKE, "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix.path}", *options)
        call(CMAKE, "--build", build)
        return build

    def test_the_example_of_the_libraries_gives_what_the_program_gives(self):
        build = self.build(self.prefix.path / "share/doc/fretwork/examples/library")
        told = call(build / "cantilever", self.study / "beam.msh")
        values = {line.split()[0]: float(line.split()[1]) for line in told.splitlines()}
        stiffness, mass_of_length, length = 1e10 * math.pi * 0.2**4 / 64, 1e6 * math.pi * 0.2**2 / 4, 1.0
        exact = 1.8751040687119611**2 * math.sqrt(stiffness / mass_of_length) / (2 * math.pi * length**2)
        self.assertAlmostEqual(values["frequency"] / exact, 1.0, delta=MESH_OF_TEN)
        [stop] = json.loads((self.results / "summary.json").read_text())["contacts"]
        self.assertAlmostEqual(values["peak_force"] / stop["normal_force"]["max"], 1.0, delta=SAME_MOTION)

    def test_every_header_compiles_without_mpi_and_petsc(self):
        source = self.prefix.work("consumer")
        headers = self.prefix.path / "include/fretwork"
        known = [header.relative_to(headers) for folder in ("core", "contact", "kernels", "signals", "transient", "vibration") for header in sorted((headers / folder).rglob("*.hpp"))]
        (source / "CMakeLists.txt").write_text(CONSUMER)
        (source / "headers.cpp").write_text("".join(f'#include "{name}"\n' for name in known if name.name not in ("mpi.hpp", "mpi_counter.hpp", "petsc.hpp")))
        self.build(source)


if __name__ == "__main__":
    unittest.main()
