# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes report.html, one file that needs nothing else, from the results of a run: python3 -m fretwork.report DIR [-o FILE]"""

import argparse
import html
import importlib.util
import os
import sys
from pathlib import Path

PACKAGES = {"numpy": "python3-numpy", "h5py": "python3-h5py"}


def missing_packages():
    """Debian packages of the modules that this interpreter lacks."""
    return [package for module, package in PACKAGES.items() if importlib.util.find_spec(module) is None]


def build(directory):
    """The report as HTML text."""
    from . import flow_section, forces_section, page, run_data, sections, wear_section

    run = run_data.load(directory)
    parts = [sections.key_figures, sections.structure, sections.modes, flow_section.profiles, flow_section.stability,
             flow_section.response, sections.along_the_tube, sections.contacts,
             sections.contact_table, sections.nodes, forces_section.forces, wear_section.wear, sections.impacts, flow_section.spectra, sections.energy, sections.computation, sections.study]
    title = run.summary["study"] or Path(directory).resolve().stem
    subtitle = f"Impact, friction and wear: results of Fretwork {html.escape(run.summary['version'])}"
    return page.page(title, subtitle, "".join(part(run) for part in parts))


def write_whole(path, text):
    """The file is replaced when the new one is complete, which is created exclusively: no symbolic link is followed."""
    part = path.with_name(path.name + ".part")
    part.unlink(missing_ok=True)
    try:
        with open(part, "x", encoding="utf-8") as file:
            file.write(text)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def main():
    parser = argparse.ArgumentParser(description="Writes report.html from the results of a run.")
    parser.add_argument("directory", type=Path, help="folder with summary.json and results.h5")
    parser.add_argument("-o", "--output", type=Path, help="default: report.html in the folder")
    arguments = parser.parse_args()
    missing = missing_packages()
    if missing:
        return f"the report needs {' and '.join(missing)}, which {sys.executable} does not have: apt install {' '.join(missing)}"
    from . import run_data

    try:
        text = build(arguments.directory)
        write_whole(arguments.output or arguments.directory / "report.html", text)
    except run_data.NoResults as error:
        return str(error)
    except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        return f"{arguments.directory}: the results are not those of a run ({type(error).__name__}: {str(error)[:200]}); run the study again"
    except OSError as error:
        return f"the report cannot be written: {error}"
    return 0
