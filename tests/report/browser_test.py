# SPDX-License-Identifier: GPL-3.0-or-later
"""The report in a headless Chromium: browser_test.py WRITE_MADE_UP PYTHON_FOLDER CHROMIUM SCREENSHOTS"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

WRITE_MADE_UP, PYTHON, CHROMIUM, SCREENSHOTS = sys.argv.pop(1), sys.argv.pop(1), sys.argv.pop(1), Path(sys.argv.pop(1))
sys.path[:0] = [PYTHON, str(Path(__file__).parent)]

from browser import Browser  # noqa: E402
from made_up_tables import add_tables  # noqa: E402
from fretwork.report import write_report  # noqa: E402

PAPER = 695  # px: A4 between its margins, page.py
LIVE = "document.querySelectorAll('figure.on').length"


class InABrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="fretwork_browser_test_")
        folder = Path(cls.temporary.name)
        subprocess.run([WRITE_MADE_UP, folder, "5", "4000", "1", "wear"], check=True, stdout=subprocess.DEVNULL)
        rows = "".join(f'"apex","displacement y",m2/Hz,{f},{1e-12 / (1 + f**2)},{6e-13 / (1 + f**2)},{2e-12 / (1 + f**2)}\n' for f in range(200))
        (folder / "spectra.csv").write_text("name,quantity,unit,frequency [Hz],density,low_95,high_95\n" + rows)
        add_tables(folder)
        cls.page = write_report(folder)
        SCREENSHOTS.mkdir(parents=True, exist_ok=True)
        cls.browser = Browser(CHROMIUM)
        cls.browser.open(cls.page)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.temporary.cleanup()

    def heading(self, title):
        self.browser.run(f"[...document.querySelectorAll('h2')].find(h => h.textContent === '{title}').scrollIntoView()")

    def tearDown(self):
        self.assertEqual(self.browser.errors, [])

    def test_makes_every_picture_interactive_that_has_data(self):
        count = self.browser.run("document.querySelectorAll('script.live').length")
        self.assertEqual(count, 1 + 3 * 5 + self.browser.run("document.querySelectorAll('svg[aria-label^=\"Displacement of\"]').length") + 1)
        for i in range(count):
            self.browser.box("script.live", 0)
            self.browser.run(f"document.querySelectorAll('script.live')[{i}].closest('figure').scrollIntoView()")
            self.browser.wait(f"document.querySelectorAll('script.live')[{i}].closest('figure').classList.contains('on')")
        self.assertEqual(self.browser.run(LIVE), count)
        for title, name in (("Contacts", "orbits"), ("Spectra", "spectra"), ("Structure", "structure")):
            self.heading(title)
            self.browser.screenshot(SCREENSHOTS / f"{name}.png")

    def test_zooms_a_history_and_shows_all_again(self):
        self.heading("Contacts")
        self.browser.wait("fretworkReport.plots.some(p => p.axes[0].label === 'time [s]')")
        self.browser.run("window.history_ = fretworkReport.plots.find(p => p.axes[0].label === 'time [s]'); history_.over.id = 'over'; 0")
        span = "history_.scales.x.max - history_.scales.x.min"
        whole = self.browser.run(span)
        left, top, width, height = self.browser.box("#over")
        self.browser.drag((left + 0.4 * width, top + 0.5 * height), (left + 0.6 * width, top + 0.52 * height))
        self.browser.wait(f"{span} < {0.5 * whole}")
        self.assertAlmostEqual(self.browser.run(span) / whole, 0.2, delta=0.02)
        self.browser.screenshot(SCREENSHOTS / "zoomed_history.png")
        self.browser.run("history_.over.dispatchEvent(new MouseEvent('dblclick', {bubbles: true})); 0")
        self.browser.wait(f"{span} > {0.99 * whole}")

    def test_zooms_an_orbit_and_shows_all_again(self):
        self.heading("Contacts")
        self.browser.wait("fretworkReport.plots.some(p => p.mode === 2)")
        self.browser.run("window.orbit_ = fretworkReport.plots.find(p => p.mode === 2); orbit_.over.id = 'orbit'; 0")
        span = "orbit_.scales.y.max - orbit_.scales.y.min"
        whole = self.browser.run(span)
        left, top, width, height = self.browser.box("#orbit")
        self.browser.drag((left + 0.25 * width, top + 0.25 * height), (left + 0.75 * width, top + 0.75 * height))
        self.browser.wait(f"{span} < {0.6 * whole}")
        self.browser.screenshot(SCREENSHOTS / "zoomed_orbit.png")
        self.browser.run("orbit_.over.dispatchEvent(new MouseEvent('dblclick', {bubbles: true})); 0")
        self.browser.wait(f"{span} > {0.99 * whole}")

    def test_turns_the_structure_and_moves_a_mode(self):
        self.heading("Structure")
        self.browser.wait("fretworkReport.scenes.length === 1")
        position = "fretworkReport.scenes[0].camera.position.toArray()"
        before = self.browser.run(position)
        left, top, width, height = self.browser.box(".live-picture canvas")
        self.browser.drag((left + 0.5 * width, top + 0.5 * height), (left + 0.7 * width, top + 0.4 * height))
        after = self.browser.run(position)
        self.assertGreater(sum(abs(a - b) for a, b in zip(before, after)), 0.1 * sum(abs(a) for a in before))
        picture = "(() => { const c = fretworkReport.scenes[0]; c.renderer.domElement.toDataURL(); return 0; })()"
        self.browser.run("(() => { const s = fretworkReport.scenes[0].select; s.value = 1; s.onchange(); window.frames_ = fretworkReport.scenes[0].renderer.info.render.frame; })()")
        self.browser.run(picture)
        self.browser.wait("fretworkReport.scenes[0].renderer.info.render.frame > frames_ + 3")
        self.browser.screenshot(SCREENSHOTS / "mode.png")

    def test_sorts_a_table_and_saves_it(self):
        table = "[...document.querySelectorAll('section')].find(s => s.querySelector('h2').textContent === 'Modes').querySelector('table')"
        column = f"[...{table}.querySelectorAll('tbody tr')].map(r => parseFloat(r.cells[1].textContent))"
        self.browser.run(f"{table}.querySelectorAll('th')[1].click()")
        values = self.browser.run(column)
        self.assertEqual(values, sorted(values, reverse=True))
        self.browser.run(f"{table}.querySelectorAll('th')[1].click()")
        self.assertEqual(self.browser.run(column), sorted(values))
        saved = self.browser.run(
            "(async () => { let blob; const make = URL.createObjectURL; URL.createObjectURL = b => (blob = b, make.call(URL, b));"
            f" {table}.parentElement.previousElementSibling.click(); URL.createObjectURL = make; return blob.text(); }})()")
        lines = saved.splitlines()
        self.assertTrue(lines[0].startswith("mode,frequency [Hz],damping [%]"), lines[0])
        self.assertEqual([float(line.split(",")[1]) for line in lines[1:]], sorted(values))

    def test_sorts_by_the_keyboard_and_names_by_their_numbers(self):
        table = "[...document.querySelectorAll('section')].find(s => s.querySelector('h2').textContent === 'Modes').querySelector('table')"
        names = ["plate[10]", "plate[9]", "plate[100]"]
        last = f"{table}.rows[0].cells.length - 1"
        self.browser.run(f"{table}.querySelectorAll('tbody tr').forEach((r, i) => r.cells[{last}].textContent = {names}[i % 3])")
        for key in ("Enter", " "):
            self.browser.run(f"{table}.rows[0].cells[{last}].dispatchEvent(new KeyboardEvent('keydown', {{ key: '{key}', bubbles: true }}))")
            found = self.browser.run(f"[...{table}.querySelectorAll('tbody tr')].map(r => r.cells[{last}].textContent)")
            expected = sorted(found, key=lambda name: int(name[6:-1]), reverse=key == "Enter")
            self.assertEqual(found, expected)
        self.browser.open(self.page)

    def test_fits_a_narrow_window(self):
        try:
            self.browser.send("Emulation.setDeviceMetricsOverride", width=420, height=900, deviceScaleFactor=1, mobile=False)
            self.browser.open(self.page)
            for title in ("Structure", "Contacts", "Spectra", "Wear"):
                self.heading(title)
                self.browser.wait("document.readyState === 'complete'")
            outside = ("[...document.querySelectorAll('figure, .panel, h3, p')].filter(e => !e.closest('.scroll') && e.getBoundingClientRect().right > innerWidth)"
                       ".map(e => e.textContent.slice(0, 40))")
            self.assertEqual(self.browser.run(outside), [])
            self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), 420)
        finally:
            self.browser.send("Emulation.clearDeviceMetricsOverride")
            self.browser.open(self.page)

    def test_labels_of_ticks_are_those_of_the_page_in_any_language(self):
        self.heading("Contacts")
        self.browser.wait("fretworkReport.plots.some(p => p.axes[0].label === 'time [s]')")
        label = "fretworkReport.plots.find(p => p.axes[0].label === 'time [s]').axes[0].values(null, {}, 0, 50, {})"
        self.assertEqual(self.browser.run(label.format("[-25000, 0, 25000]", 25000)), ["−25000", "0", "25000"])
        self.assertEqual(self.browser.run(label.format("[0, 0.25, 0.5]", 0.25)), ["0", "0.25", "0.50"])
        self.heading("Spectra")
        self.browser.wait("fretworkReport.plots.some(p => p.axes[0].label === 'frequency [Hz]')")
        label = "fretworkReport.plots.find(p => p.axes[0].label === 'frequency [Hz]').axes[0].values(null, {})"
        self.assertEqual(self.browser.run(label.format("[100, 200, 1000, 2000]")), ["100", "", "1000", ""])
        self.assertEqual(self.browser.run(label.format("[30, 40, 50, 60]")), ["", "", "50", ""])
        self.assertEqual(self.browser.run(label.format("[1e-9, 1e-8]")), ["1e−9", "1e−8"])

    def test_prints_static_pictures(self):
        self.browser.send("Emulation.setEmulatedMedia", media="print")
        try:
            shown = self.browser.run("[...document.querySelectorAll('.live-picture')].filter(e => e.getBoundingClientRect().height > 0).length")
            static = self.browser.run("[...document.querySelectorAll('figure > .static')].filter(e => e.getBoundingClientRect().height === 0).length")
            self.assertEqual((shown, static), (0, 0))
            self.browser.send("Emulation.setDeviceMetricsOverride", width=PAPER, height=1000, deviceScaleFactor=1, mobile=False)
            clipped = self.browser.run("[...document.querySelectorAll('.scroll, .row, .panel, pre')].filter(e => e.scrollWidth > e.clientWidth + 1).map(e => e.outerHTML.slice(0, 80))")
            self.assertEqual(clipped, [], "wider than the paper")
            self.browser.send("Emulation.clearDeviceMetricsOverride")
            self.browser.pdf(SCREENSHOTS / "report.pdf")
        finally:
            self.browser.send("Emulation.setEmulatedMedia", media="")

    def test_runs_no_script_but_its_own(self):
        self.browser.run("(() => { const s = document.createElement('script'); s.textContent = 'window.injected = 1'; document.body.append(s); })()")
        self.assertIsNone(self.browser.run("window.injected"))
        self.assertTrue(any("Content Security Policy" in error for error in self.browser.errors), self.browser.errors)
        self.browser.errors.clear()


class ManyContacts(unittest.TestCase):
    CONTACTS, FOLDED = 24, 15  # more than a table shows at first

    def test_folds_long_tables_on_the_screen_alone(self):
        section = "[...document.querySelectorAll('section')].find(s => s.querySelector('h2').textContent === 'Table of contacts')"
        rows = f"[...{section}.querySelector('tbody').rows].filter(r => r.getBoundingClientRect().height > 0).length"
        fold = f"{section}.querySelector('.fold')"
        with tempfile.TemporaryDirectory(prefix="fretwork_browser_test_") as folder, Browser(CHROMIUM) as browser:
            subprocess.run([WRITE_MADE_UP, folder, str(self.CONTACTS), "100", "1"], check=True, stdout=subprocess.DEVNULL)
            browser.open(write_report(Path(folder)))
            self.assertEqual(browser.run(rows), self.FOLDED)
            browser.send("Emulation.setEmulatedMedia", media="print")
            self.assertEqual(browser.run(rows), self.CONTACTS)
            browser.send("Emulation.setEmulatedMedia", media="")
            self.assertIn(f"all {self.CONTACTS} rows", browser.run(fold + ".textContent"))
            browser.run(fold + ".click()")
            self.assertEqual(browser.run(rows), self.CONTACTS)
            browser.run(fold + ".click()")
            self.assertEqual(browser.run(rows), self.FOLDED)
            self.assertEqual(browser.errors, [])


if __name__ == "__main__":
    unittest.main()
