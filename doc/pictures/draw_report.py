# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of a report in a headless Chromium, one below the other.

draw_report.py REPORT.html CHROMIUM PICTURE.png HEIGHT "SECTION" ...     (needs Pillow)
"""

import base64
import io
import sys
from pathlib import Path

from PIL import Image

sys.path.insert(0, str(Path(__file__).parents[2] / "tests" / "report"))
from browser import Browser  # noqa: E402

WIDTH = 800  # px
COLOURS = 128

# Leaves nothing but these sections, whose interactive pictures are not yet live.
SHOWN = """(() => {
  const titles = %s;
  const picture = document.createElement('div');
  for (const title of titles) {
    const heading = [...document.querySelectorAll('h2')].find(h => h.textContent === title);
    if (!heading) throw new Error('no section ' + title);
    picture.append(heading.closest('section'));
  }
  document.body.replaceChildren(picture);
  document.body.style.margin = document.body.style.padding = '0 12px';
  window.scrollTo(0, 0);
})()"""


def save(browser, clip, picture):
    """A rectangle of the page (px), in few colours."""
    data = browser.send("Page.captureScreenshot", format="png", captureBeyondViewport=True, clip={**clip, "scale": 1})["data"]
    Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB").quantize(COLOURS).save(picture, optimize=True)


def main(page, chromium, picture, height, *titles):
    height = int(height)
    with Browser(chromium, (WIDTH, height)) as browser:
        browser.send("Emulation.setDeviceMetricsOverride", width=WIDTH, height=height, deviceScaleFactor=1, mobile=False)
        browser.open(Path(page))
        browser.run(SHOWN % list(titles))
        save(browser, {"x": 0, "y": 0, "width": WIDTH, "height": height}, picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
