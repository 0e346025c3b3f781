# SPDX-License-Identifier: GPL-3.0-or-later
"""doc/tutorial.md speaks of the study that it walks through, and of keys that exist: tutorial_test.py ROOT (of the tree)."""

import re
import sys
import tomllib
import unittest
from pathlib import Path

ROOT = Path(sys.argv.pop(1))
TEXT = (ROOT / "doc/tutorial.md").read_text(encoding="utf-8")
KEYS = (ROOT / "doc/study-file.md").read_text(encoding="utf-8")
WORDS = re.compile(r"[a-z][a-z_0-9]+")


def holds(whole, part):
    """Whether a study has all keys and values of a part of it; of arrays of tables some entry."""
    if isinstance(part, dict):
        return isinstance(whole, dict) and all(key in whole and holds(whole[key], value) for key, value in part.items())
    if isinstance(part, list) and part and isinstance(part[0], dict):
        return all(any(holds(entry, one) for entry in whole) for one in part)
    return whole == part


class Tutorial(unittest.TestCase):
    def test_snippets_are_of_the_study(self):
        study = tomllib.loads((ROOT / "examples/tube_study/study.toml").read_text(encoding="utf-8"))
        snippets = re.findall(r"```toml\n(.*?)```", TEXT, flags=re.S)
        self.assertGreater(len(snippets), 5)
        for snippet in snippets:
            with self.subTest(snippet):
                self.assertTrue(holds(study, tomllib.loads(snippet)))
        self.assertFalse(holds(study, {"modes": {"count": 99}}))
        self.assertFalse(holds(study, {"contacts": [{"name": "inner_bars", "friction": 0.31}]}))

    def test_keys_of_the_table_of_code_aster_exist(self):
        rows = [line.split("|")[2] for line in TEXT.splitlines() if line.startswith("| ") and line.count("|") == 4]
        quoted = [code for row in rows for code in re.findall(r"`([^`]*)`", row)]
        words = {word for code in quoted for word in WORDS.findall(code)}
        self.assertGreater(len(words), 40)
        for word in words - {"name", "degrees", "m"}:
            with self.subTest(word):
                self.assertIn(word, KEYS)

    def test_links_lead_to_files(self):
        for link in re.findall(r"\]\(([^)#:]+)\)", TEXT):
            self.assertTrue((ROOT / "doc" / link).exists(), link)


if __name__ == "__main__":
    unittest.main()
