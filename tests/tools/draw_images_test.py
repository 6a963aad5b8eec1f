#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/draw_images: the list of pictures is complete; a changed picture is found, one whose edges moved is none."""
import importlib.machinery
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

ROOT = Path(os.environ.get("PIOLA_SOURCE_DIR", Path(__file__).resolve().parents[2]))
TOOL = ROOT / "tools/draw_images"


def tool():
    loader = importlib.machinery.SourceFileLoader("draw_images", str(TOOL))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("draw_images", loader))
    sys.dont_write_bytecode = True
    loader.exec_module(module)
    return module


def chunk(kind, data):
    return len(data).to_bytes(4, "big") + kind + data + zlib.crc32(kind + data).to_bytes(4, "big")


def png(width, height, colour):
    """A PNG of colour(x, y), the rows with the five filters by turns."""
    rows, before = b"", bytes(3 * width)
    for y in range(height):
        row = b"".join(bytes(colour(x, y)) for x in range(width))
        out = bytearray()
        for k, value in enumerate(row):
            left, up, corner = (row[k - 3] if k >= 3 else 0), before[k], (before[k - 3] if k >= 3 else 0)
            guess = left + up - corner
            paeth = min((left, up, corner), key=lambda p, g=guess: abs(p - g))
            out.append((value - (0, left, up, (left + up) // 2, paeth)[y % 5]) & 255)
        rows += bytes([y % 5]) + bytes(out)
        before = row
    head = width.to_bytes(4, "big") + height.to_bytes(4, "big") + bytes([8, 2, 0, 0, 0])
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def pattern(x, y):
    return (7 * x * y) % 256, (31 * x + y * y) % 256, (x ^ y) % 256


class Pixels(unittest.TestCase):
    def test_filters_of_rows(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.png"
            path.write_bytes(png(23, 17, pattern))
            width, height, channels, values = tool().pixels(path)
        self.assertEqual((width, height, channels), (23, 17, 3))
        self.assertEqual(values, b"".join(bytes(pattern(x, y)) for y in range(17) for x in range(23)))


class House(unittest.TestCase):
    """A folder with the tool, one case and its picture; the program copies a file."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.house = Path(folder.name)
        for path in ("tools", "docs/images", "cases/a/b"):
            (self.house / path).mkdir(parents=True)
        shutil.copy(TOOL, self.house / "tools/draw_images")
        (self.house / "tools/quickstart").write_text("# default cases/a/b/case.toml\n")
        (self.house / "docs/images/pictures.txt").write_text("quickstart | a/b | 1 ms |\n")
        (self.house / "cases/a/b/case.toml").write_text("")
        (self.house / "cases/a/b/README.md").write_text("![b](../../../docs/images/quickstart.png)\n")
        self.picture = self.house / "docs/images/quickstart.png"
        self.picture.write_bytes(png(40, 30, pattern))
        program = self.house / "program"
        program.write_text('#!/bin/sh\nmkdir -p "$5/pictures"\n'
                           'cp "$(dirname "$0")/drawn.png" "$5/pictures/p-000001.png"\n')
        program.chmod(0o755)

    def tool(self, *arguments):
        command = [sys.executable, self.house / "tools/draw_images", *arguments]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def compare(self, drawn):
        (self.house / "drawn.png").write_bytes(drawn)
        return self.tool(self.house / "program", "--compare")

    def test_the_same_picture(self):
        self.assertEqual(self.compare(png(40, 30, pattern)), (0, "quickstart: the same but for 0.00 % of its pixels\n"))

    def test_an_edge_that_moved(self):
        status, said = self.compare(png(40, 30, lambda x, y: (0, 0, 0) if y == 3 and 3 < x < 12 else pattern(x, y)))
        self.assertEqual(status, 0, said)
        self.assertNotIn("0.00 %", said)

    def test_another_picture(self):
        status, said = self.compare(png(40, 30, lambda x, y: (0, 0, 0) if y < 2 else pattern(x, y)))
        self.assertEqual(status, 1, said)
        self.assertIn("others than in docs/images", said)
        self.assertEqual(self.compare(png(41, 30, pattern))[0], 1, "another size")

    def test_drawing_replaces(self):
        drawn = png(40, 30, lambda x, y: (x, y, 0))
        (self.house / "drawn.png").write_bytes(drawn)
        self.assertEqual(self.tool(self.house / "program", "quickstart")[0], 0)
        self.assertEqual(self.picture.read_bytes(), drawn)

    def test_the_list(self):
        self.assertEqual(self.tool("--check"), (0, ""))
        (self.house / "cases/a/b/README.md").write_text("![b](../../../docs/images/other.png)\n")
        self.assertEqual(self.tool("--check"), (1, "draw_images: other is shown by a case, but not listed\n"))


class Repository(unittest.TestCase):
    def test_every_picture_is_listed_and_there(self):
        done = subprocess.run([sys.executable, TOOL, "--check"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
