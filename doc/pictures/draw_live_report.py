# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of doc/report.md: a report as a browser shows it, turned and zoomed by the mouse.

draw_live_report.py REPORT.html CHROMIUM FOLDER     (needs Pillow)
"""

import sys
from pathlib import Path

from draw_report import Browser, save

WIDTH, HEIGHT = 1100, 900  # px
SECTION = "[...document.querySelectorAll('h2')].find(h => h.textContent.includes(\"%s\")).closest('section')"


class Page:
    def __init__(self, browser, page, folder):
        self.browser, self.folder = browser, folder
        browser.send("Emulation.setDeviceMetricsOverride", width=WIDTH, height=HEIGHT, deviceScaleFactor=1, mobile=False)
        browser.open(page)

    def show(self, element):
        """Scrolled into view, its pictures live."""
        self.browser.run(f"window.shown = {element}; shown.scrollIntoView(); 0")
        self.browser.wait("[...shown.querySelectorAll('script.live')].every(s => s.closest('figure').classList.contains('on') ||"
                          " s.closest('figure').getBoundingClientRect().top > innerHeight)")

    def drag(self, element, start, end):
        """By shares of the element's width and height."""
        left, top, width, height = self.browser.run(f"(r => [r.left, r.top, r.width, r.height])({element}.getBoundingClientRect())")
        self.browser.drag(*[(left + x * width, top + y * height) for x, y in (start, end)])

    def save(self, name, height=None):
        """What is shown, from its top."""
        left, top, width, whole = self.browser.run("(r => [r.left, r.top + scrollY, r.width, r.height])(shown.getBoundingClientRect())")
        clip = {"x": left - 4, "y": top - 4, "width": width + 8, "height": min(whole, height or whole) + 8}
        save(self.browser, clip, self.folder / f"report_{name}.png")


def main(report, chromium, folder):
    with Browser(chromium, (WIDTH, HEIGHT)) as browser:
        page = Page(browser, Path(report), Path(folder))
        page.show(SECTION % "Structure")
        browser.wait("fretworkReport.scenes.length === 1")
        page.drag("shown.querySelector('canvas')", (0.5, 0.5), (0.57, 0.47))
        page.save("structure")

        page.show(SECTION % "that wear most")
        page.save("orbits", 790)
        page.show(SECTION % "that wear most" + ".querySelector('.panel')")
        page.drag("shown.querySelectorAll('.u-over')[1]", (0.50, 0.3), (0.53, 0.32))
        page.save("history")

        page.show(SECTION % "Spectra")
        page.save("spectra", 620)


if __name__ == "__main__":
    main(*sys.argv[1:])
