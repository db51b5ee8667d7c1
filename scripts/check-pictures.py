#!/usr/bin/env python3
"""Draws SVG files with librsvg and CairoSVG, and compares them with what Chromium draws.

    scripts/check-pictures.py picture.svg...

Renderers place letters and soften edges each in their way, so means over small squares are compared: no square may differ by
more than a letter does, and the squares on average by next to nothing. Needs CairoSVG (with Pillow) from PyPI, rsvg-convert
and Chromium ($CHROMIUM names another browser). Exit codes: 0 alike, 1 not, 3 a renderer is missing.
"""

import io
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SQUARE = 8  # pixels a side
MOST = 40  # of 255, in one square: less than a letter
MEAN = 1.0  # of 255, over all squares


def missing(what):
    print(f"found no {what}; expected all of Chromium, rsvg-convert (librsvg) and CairoSVG", file=sys.stderr)
    sys.exit(3)


try:
    import cairosvg
    from PIL import Image, ImageChops, ImageStat
except (ImportError, OSError) as error:
    missing(f"CairoSVG ({error})")

names = [os.environ.get("CHROMIUM"), "chromium", "chromium-browser", "google-chrome"]
browser = next((path for path in map(shutil.which, filter(None, names)) if path), None) or missing("Chromium")
rsvg = shutil.which("rsvg-convert") or missing("rsvg-convert")


def chromium(picture, size, scratch):
    """A browser's window is less high than it says: more is taken, and cut off."""
    shot = scratch / "shot.png"
    subprocess.run(
        [browser, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--force-device-scale-factor=1",
         f"--user-data-dir={scratch / 'profile'}", f"--window-size={size[0]},{size[1] + 200}", f"--screenshot={shot}",
         picture.resolve().as_uri()],
        check=True, capture_output=True, timeout=120,
    )
    return Image.open(shot).convert("RGB").crop((0, 0, *size))


def librsvg(picture):
    drawn = subprocess.run([rsvg, picture], check=True, capture_output=True, timeout=120).stdout
    return Image.open(io.BytesIO(drawn)).convert("RGB")


def cairo(picture):
    return Image.open(io.BytesIO(cairosvg.svg2png(url=str(picture)))).convert("RGB")


def squares(image):
    return image.resize((image.width // SQUARE, image.height // SQUARE), Image.Resampling.BOX)


def main():
    alike = True
    for picture in map(pathlib.Path, sys.argv[1:]):
        drawings = {"librsvg": librsvg(picture), "CairoSVG": cairo(picture)}
        size = drawings["librsvg"].size
        with tempfile.TemporaryDirectory() as scratch:
            expected = squares(chromium(picture, size, pathlib.Path(scratch)))
        for renderer, drawing in drawings.items():
            if drawing.size != size:
                print(f"{picture}: {renderer} draws {drawing.size}, expected {size}")
                alike = False
                continue
            difference = ImageChops.difference(expected, squares(drawing))
            statistics = ImageStat.Stat(difference)
            mean, most = max(statistics.mean), max(high for _, high in statistics.extrema)
            fine = mean <= MEAN and most <= MOST
            alike = alike and fine
            print(f"{picture}: {renderer} {'as' if fine else 'NOT as'} Chromium: {mean:.2f} of 255 on average, {most} at most")
    return 0 if alike else 1


sys.exit(main())
