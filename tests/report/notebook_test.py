# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the tutorial: notebook_test.py PYTHON_FOLDER FRETWORK; a cell that fails is an error."""

import os
import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient

python, program = Path(sys.argv[1]).resolve(), str(Path(sys.argv[2]).resolve())
os.environ.update(FRETWORK=program, PYTHONPATH=str(python), MPLBACKEND="Agg", PYTHONDONTWRITEBYTECODE="1")
notebook = nbformat.read(python / "tutorial/tutorial.ipynb", as_version=4)
NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(python / "tutorial")}}).execute()
outputs = [cell.outputs for cell in notebook.cells if cell.cell_type == "code"]
sys.exit(0 if outputs[-1] and outputs[-1][0]["data"]["text/plain"] == "True" else "the last cell does not say True")
