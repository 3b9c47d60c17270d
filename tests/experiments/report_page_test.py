# SPDX-License-Identifier: BSD-3-Clause
"""The page of the default study in a browser without a network: what the first screen shows, on a phone, on paper."""
import base64
import re
import shutil
import unittest

from browser import PROGRAM, Browser
from programs import call, temporary_folder

LARGEST = 5_000_000  # bytes
BOX = "(() => {{ const b = document.querySelector({!r}).getBoundingClientRect(); return [b.left, b.top, b.right, b.bottom]; }})()"

# How far the picture of a figure on the page is from another one, of 255: the mean over all pixels, and the largest over
# squares of 4 x 4 pixels in any colour.
DIFFERENCE = """(async (name, other) => {
  const read = async (address) => {
    const picture = new Image();
    picture.src = address;
    await picture.decode();
    const canvas = Object.assign(document.createElement("canvas"), {width: picture.naturalWidth, height: picture.naturalHeight});
    const context = canvas.getContext("2d");
    context.drawImage(picture, 0, 0);
    return context.getImageData(0, 0, canvas.width, canvas.height);
  };
  const one = await read(document.querySelector(`#${name} img`).src), two = await read(other);
  if (one.width !== two.width || one.height !== two.height) return [255, 255];
  let sum = 0, largest = 0;
  for (let y = 0; y < one.height; y += 4) {
    for (let x = 0; x < one.width; x += 4) {
      for (let colour = 0; colour < 3; ++colour) {
        let square = 0;
        for (let v = y; v < Math.min(y + 4, one.height); ++v) {
          for (let u = x; u < Math.min(x + 4, one.width); ++u) {
            const at = 4 * (v * one.width + u) + colour;
            square += one.data[at] - two.data[at];
            sum += Math.abs(one.data[at] - two.data[at]);
          }
        }
        largest = Math.max(largest, Math.abs(square) / 16);
      }
    }
  }
  return [sum / (3 * one.width * one.height), largest];
})"""


@unittest.skipUnless(PROGRAM, "skipped, because chromium is not installed")
class ReportPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        call("energy_drift", "--out", "out", folder=cls.folder)
        cls.page = cls.folder / "out/report.html"
        cls.browser = cls.enterClassContext(Browser())

    def open(self, **how):
        self.browser.errors.clear()
        self.browser.requests.clear()
        self.browser.open(self.page, ready="true", **how)

    def box(self, selector):
        left, top, right, bottom = self.browser.run(BOX.format(selector))
        self.assertGreater(right - left, 0, selector)
        self.assertGreater(bottom - top, 0, selector)
        return left, top, right, bottom

    def test_the_first_screen_has_method_step_and_reason(self):
        self.open(width=1280, height=900)
        self.assertLess(self.box("#answer .answer:last-of-type")[3], 500)
        self.assertLess(self.box("#answer table")[3], 900)
        text = self.browser.run("[...document.querySelectorAll('#answer .answer')].map(p => p.textContent).join(' ')")
        self.assertRegex(text, r"needs the fewest right-hand sides.*(dt|tolerance) = \S+.*times as many")
        if shutil.which("gnuplot"):
            top, bottom = (self.box("#answer figure img")[k] for k in (1, 3))
            self.assertLess(top, 700)  # a good part of the figure is seen
            self.assertGreater(bottom, top + 200)

    def test_it_asks_nothing_of_a_network_and_reports_no_error(self):
        self.open(width=1280, height=900)
        self.assertEqual(self.browser.errors, [])
        self.assertEqual([url for url in self.browser.requests if not url.startswith(("file:", "data:"))], [])
        self.assertLess(self.page.stat().st_size, LARGEST)
        outside = re.findall(r'(?:src|href)="(?!data:|#)([^"]*:[^"]*)"', self.page.read_text(encoding="utf-8"))
        self.assertEqual(outside, [])

    @unittest.skipUnless(shutil.which("gnuplot"), "skipped, because gnuplot is not installed")
    def test_its_pictures_are_those_of_the_files_in_fewer_bytes(self):
        self.open(width=1280, height=900)
        pictures = sorted((self.page.parent / "figures").glob("*.svg"))
        self.assertGreaterEqual(len(pictures), 6)
        text = self.page.read_text(encoding="utf-8")
        self.assertLess(len(text), sum(picture.stat().st_size for picture in pictures))
        for picture in pictures:
            address = "data:image/svg+xml;base64," + base64.b64encode(picture.read_bytes()).decode()
            mean, largest = self.browser.run(f"{DIFFERENCE}({picture.stem!r}, {address!r})")
            self.assertLess(mean, 0.1, picture.stem)
            self.assertLess(largest, 32, picture.stem)  # the antialiasing of a few edges

    def test_a_phone_shows_all_of_its_width(self):
        self.open(width=390, height=844)
        self.assertLessEqual(self.browser.run("document.scrollingElement.scrollWidth"), 390)
        self.assertLessEqual(self.box("#scenario svg")[2], 390)
        smallest = self.browser.run("Math.min(...[...document.querySelectorAll('#scenario svg text')].map("
                                    "t => parseFloat(getComputedStyle(t).fontSize) * t.getScreenCTM().a))")
        self.assertGreaterEqual(smallest, 8)  # pixels

    def test_the_drawing_follows_the_answer_and_has_a_text_in_its_place(self):
        self.open(width=1280, height=900)
        self.assertGreater(self.box("#scenario svg")[1], self.box("#answer")[3])
        label = self.browser.run("document.querySelector('#scenario svg').getAttribute('aria-label')")
        self.assertIn("peters_hsu", label)
        self.assertIn("10 kg", label)
        order = self.browser.run("[...document.querySelectorAll('main > *')].map(e => e.id).filter(id => id)")
        self.assertEqual(order[:4], ["answer", "scenario", "reading", "seen"])

    def test_paper_has_the_answer_and_the_drawing(self):
        self.open(width=1280, height=900, media="print")
        for selector in ("#answer table", "#scenario svg"):
            self.box(selector)
        self.assertEqual(self.browser.run("getComputedStyle(document.querySelector('nav')).display"), "none")


if __name__ == "__main__":
    unittest.main()
