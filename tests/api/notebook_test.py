# SPDX-License-Identifier: Apache-2.0
"""Runs the code of a notebook, cell after cell, in an empty folder: notebook_test.py FILE.ipynb"""
import json
import os
import pathlib
import sys
import tempfile

notebook = json.loads(pathlib.Path(sys.argv[1]).read_text())
assert notebook["nbformat"] == 4
names = {}
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for number, cell in enumerate(notebook["cells"]):
        assert not cell.get("outputs"), f"cell {number} was committed with its output"
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), f"cell {number}", "exec"), names)
    os.chdir("/")
effects = [effect.name for effect in names["diagnosis"].effects]
assert effects == ["hard_iron"], effects
