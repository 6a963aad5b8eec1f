#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page of piola report: whole, closed to the outside, and the same frames as in the files.

The script that decodes frames in the browser (web/frames.js) runs in node, where there is one, and its positions are
compared with those of the frames.
"""
import base64
import html.parser
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zlib
from collections import Counter
from pathlib import Path

SOURCE = Path(os.environ.get("PIOLA_SOURCE_DIR", Path(__file__).resolve().parents[2]))
PROGRAM = os.environ.get("PIOLA_PROGRAM", "")
HOSTILE = "</script><img src=x onerror=alert(1)> & \"quotes\" <!-- "
BAR = (SOURCE / "tests/app/bar.toml").read_text().split("[output.frames]")[0]
CASE = BAR.replace('"Short bar"', f"'{HOSTILE}'") + '[output.frames]\nevery = "1 ms"\n'
CHECKS = """
[[variant]]
name = "standard"
short = true
[[variant]]
name = "faster"
set = ["run.cfl=0.5"]
[[check]]
variant = "standard"
quantity = "sway"
reference = "0.18 m"
tolerance = "50 %"
source = "a guess"
evidence = "theory"
"""


def program(*arguments, code=0):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout + done.stderr


class Elements(html.parser.HTMLParser):
    """What a browser would make of a page: the tags, and the texts of data elements by their id."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.data, self.title, self._at = [], {}, "", None
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        self._at = dict(attrs).get("id", "").replace("data-", "", 1) if tag == "script" else tag

    def handle_endtag(self, tag):
        self._at = None

    def handle_data(self, text):
        if self._at == "title":
            self.title += text
        elif self._at is not None:
            self.data[self._at] = self.data.get(self._at, "") + text


def halves(text):
    """Numbers from folded differences, as encode_numbers of src/piola/report/frame_codec.cpp packs them; below 2^32."""
    packed = zlib.decompress(base64.b64decode(text))
    count, numbers = len(packed) // 4, []
    for at in (0, 2 * count):
        total, part = 0, []
        for low, high in zip(packed[at:at + count], packed[at + count:at + 2 * count]):
            folded = low | high << 8
            total = (total + ((folded >> 1) ^ -(folded & 1))) & 0xffff
            part.append(total)
        numbers.append(part)
    return [low + 65536 * high for low, high in zip(*numbers)]


def decoded(page, numbers):
    """{frame: [codes of x, y, z; bytes of fields]} of a page, by the script that the browser runs."""
    script = (SOURCE / "web" / "frames.js").read_text(encoding="utf-8") + """
const data = JSON.parse(require("fs").readFileSync(0, "utf8"));
(async () => {
  const store = new FrameStore(JSON.parse(data.frames), (name) => {
    const text = data[name];
    delete data[name];
    return text;
  });
  const out = {};
  for (const k of JSON.parse(data.numbers)) {
    const frame = await store.get(k), facets = await store.facets(k);
    out[k] = [frame.x, frame.fields, [facets || []]].map((list) => list.map((values) => [...values]));
  }
  console.log(JSON.stringify(out));
})();
"""
    done = subprocess.run(["node", "-e", script], input=json.dumps({**page.data, "numbers": json.dumps(numbers)}),
                          capture_output=True, text=True, check=True)
    return {int(k): lists for k, lists in json.loads(done.stdout).items()}


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.run_folder = cls.folder / "run"
        (cls.folder / "case.toml").write_text(CASE, encoding="utf-8")
        program("run", cls.folder / "case.toml", "--quiet", "--out", cls.run_folder)
        program("report", cls.run_folder, "--checks", cls.write_checks(), "-o", cls.folder / "page.html")
        cls.text = (cls.folder / "page.html").read_text(encoding="utf-8")
        cls.page = Elements(cls.text)
        cls.about, cls.frames = (json.loads(cls.page.data[name]) for name in ("about", "frames"))

    @classmethod
    def write_checks(cls):
        path = cls.folder / "checks.toml"
        path.write_text(CHECKS, encoding="utf-8")
        return path

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_texts_of_a_case_stay_texts(self):
        self.assertEqual(self.about["title"], HOSTILE)
        self.assertEqual(self.page.title, HOSTILE)
        self.assertFalse([tag for tag, _ in self.page.tags if tag in ("img", "iframe", "object", "link")])
        self.assertNotIn("<img", self.text)

    def test_nothing_is_fetched(self):
        for _, attributes in self.page.tags:
            self.assertFalse({"src", "href"} & set(attributes))
        policy = [a["content"] for tag, a in self.page.tags if a.get("http-equiv") == "Content-Security-Policy"]
        self.assertEqual(len(policy), 1)
        self.assertIn("default-src 'none'", policy[0])
        self.assertNotIn("http", policy[0])
        self.assertNotRegex(self.text, r"\b(fetch|XMLHttpRequest|importScripts|innerHTML)\b")

    def test_the_run_is_told(self):
        self.assertEqual(self.about["status"], "completed")
        self.assertIn("sway", self.about["summary"]["quantities"])
        self.assertEqual([plot["name"] for plot in self.about["plots"]][:2], ["energies", "top.displacement x"])
        plot = self.about["plots"][0]
        self.assertIn(b"<svg", zlib.decompress(base64.b64decode(plot["svg"])))
        self.assertAlmostEqual(plot["high"], 0.02)
        self.assertLess(plot["left"], plot["right"])
        self.assertEqual(len(self.frames["times"]), 21)
        self.assertEqual([body["name"] for body in self.frames["bodies"]], ["bar"])

    def test_the_view_is_that_of_the_pictures_by_angles_or_by_name(self):
        self.assertEqual((self.about["view"], self.about["up"], self.about["perspective"]), ([30, 20], "y", False))
        for setting, view in (('output.pictures.view="-z"', [180, 0]), ('output.pictures.view="iso"', [45, 35.264]),
                              ("output.pictures.view=[10, 70]", [10, 70])):
            folder = self.folder / "looked at"
            shutil.copytree(self.run_folder, folder, dirs_exist_ok=True)
            program("run", self.folder / "case.toml", "--quiet", "--force", "--out", folder, "--set", 'run.end="1 ms"',
                    "--set", "output.pictures.every=0", "--set", setting, "--set", "output.pictures.perspective=20")
            program("report", folder)
            about = json.loads(Elements((folder / "report.html").read_text(encoding="utf-8")).data["about"])
            self.assertTrue(about["perspective"])
            for angle, wanted in zip(about["view"], view):
                self.assertAlmostEqual(angle, wanted, places=3)

    def test_checks_are_judged_for_the_variant_that_the_run_is(self):
        rows = self.about["rows"]
        self.assertEqual([(row["variant"], row["quantity"]) for row in rows], [("standard", "sway")])
        self.assertIn(rows[0]["verdict"], ("passes", "falls short"))
        other = program("report", self.run_folder, "--checks", self.folder / "checks.toml", "--variant", "fastr",
                        "-o", self.folder / "other.html", code=2)
        self.assertIn('did you mean "faster"', other)

    def test_same_run_same_bytes(self):
        program("report", self.run_folder, "--checks", self.folder / "checks.toml", "-o", self.folder / "again.html")
        self.assertEqual((self.folder / "again.html").read_text(encoding="utf-8"), self.text)

    def test_a_budget_is_kept_and_what_it_costs_is_said(self):
        large = self.folder / "large"
        settings = ["body.bar.shape.particles=[21,21,41]", "body.bar.shape.jitter=0.2", 'run.end="2 ms"',
                    'output.frames.every="0.05 ms"']
        program("run", self.folder / "case.toml", "--quiet", "--out", large,
                *(word for setting in settings for word in ("--set", setting)))
        said = program("report", large, "--budget", "1", "-o", self.folder / "small.html")
        self.assertLessEqual((self.folder / "small.html").stat().st_size, 1_000_000)
        self.assertIn("to stay within 1 MB", said)
        self.assertIn(said.split("note: ")[1].split(";")[0], (self.folder / "small.html").read_text(encoding="utf-8"))
        program("report", self.run_folder, "--frames", "3", "--fields", "Pressure", "--bits", "12",
                "-o", self.folder / "few.html")
        few = json.loads(Elements((self.folder / "few.html").read_text(encoding="utf-8")).data["frames"])
        self.assertEqual(few["numbers"], [0, 10, 20])
        self.assertEqual([field["name"] for field in few["fields"]], ["Pressure"])
        self.assertEqual(few["missing"], 4095)

    def test_bad_wishes_are_refused(self):
        self.assertIn('did you mean "Pressure"', program("report", self.run_folder, "--fields", "Presure", code=2))
        self.assertIn("holds no run", program("report", self.folder, code=2))
        self.assertIn("--bits", program("report", self.run_folder, "--bits", "40", code=2))

    def test_a_run_without_frames_has_a_page(self):
        folder = self.folder / "bare"
        shutil.copytree(self.run_folder, folder)
        shutil.rmtree(folder / "frames")
        (folder / "frames.hdf.series").unlink()
        self.assertIn("no frames", program("report", folder))
        data = Elements((folder / "report.html").read_text(encoding="utf-8")).data
        self.assertNotIn("frames", data)
        self.assertEqual(json.loads(data["about"])["status"], "completed")

    def test_a_verification_has_a_section_for_each_run(self):
        case = self.folder / "cases" / "bar"
        case.mkdir(parents=True)
        (case / "case.toml").write_text(CASE, encoding="utf-8")
        (case / "checks.toml").write_text(CHECKS, encoding="utf-8")
        program("verify", "--cases", case.parent, "--report", self.folder / "verify.html")
        text = (self.folder / "verify.html").read_text(encoding="utf-8")
        about = json.loads(Elements(text).data["about"])
        self.assertEqual([(row["case"], row["variant"]) for row in about["rows"]], [("bar", "standard")])
        self.assertEqual([(run["case"], run["variant"], run["title"]) for run in about["runs"]],
                         [("bar", "standard", HOSTILE)])
        self.assertEqual(about["runs"][0]["plots"][0]["name"], "energies")
        self.assertNotIn("<img", text)

    def test_a_verification_in_markdown_shows_what_is_measured_and_what_is_expected(self):
        case = self.folder / "drawn" / "bar"
        case.mkdir(parents=True)
        (case / "case.toml").write_text(BAR, encoding="utf-8")
        (case / "checks.toml").write_text(CHECKS + "[[check]]" + CHECKS.split("[[check]]")[1].replace(
            "standard", "faster"), encoding="utf-8")
        program("verify", "--cases", case.parent, "--markdown", self.folder / "md")
        plots = re.findall(r"!\[(.*)\]\((.*\.svg)\)", (self.folder / "md" / "README.md").read_text(encoding="utf-8"))
        self.assertEqual(plots, [("top.displacement x, measured and expected", "bar-top-displacement-x.svg")])
        program("verify", "--cases", case.parent, "--out", self.folder / "kept")
        program("plot", self.folder / "kept" / "bar" / "standard", "top.displacement_x",
                "--checks", case / "checks.toml", "-o", self.folder / "one.svg")
        lines = {name: len(re.findall(r"<path [^>]*stroke-dasharray", path.read_text(encoding="utf-8")))
                 for name, path in (("one", self.folder / "one.svg"), ("all", self.folder / "md" / plots[0][1]))}
        self.assertEqual(lines, {"one": 1, "all": 1})  # both variants have the same reference: it is drawn once

    def test_frames_are_packed_as_told(self):
        sizes = {len(zlib.decompress(base64.b64decode(text))) for name, text in self.page.data.items()
                 if re.fullmatch(r"frame-\d+", name)}
        self.assertEqual(sizes, {self.frames["particles"] * (6 + len(self.frames["fields"]) + 6)})

    def test_the_browser_decodes_what_is_in_the_files(self):
        self.need_node()
        import h5py
        import numpy as np
        frames = decoded(self.page, [20, 3, 0, 10, 11, 19, 3])
        low, step = self.frames["low"], self.frames["step"]
        extent = np.array(step) * (self.frames["missing"] - 1)
        for number, (x, fields, _) in frames.items():
            with h5py.File(self.run_folder / "frames" / f"{int(number):06d}.hdf") as file:
                points = file["VTKHDF/Points"][:]
                pressure = file["VTKHDF/PointData/Pressure"][:]
            for axis in range(3):
                error = np.abs(low[axis] + np.array(x[axis]) * step[axis] - points[:, axis])
                self.assertLessEqual(error.max(), extent[axis] / 2**14 + 1e-7)
            at = [field["name"] for field in self.frames["fields"]].index("Pressure")
            scale, codes = self.frames["fields"][at], np.array(fields[at])
            values = scale["low"] + (codes - 1) * (scale["high"] - scale["low"]) / 254
            error = np.abs(values - np.clip(pressure, scale["low"], scale["high"]))
            self.assertLessEqual(error.max(), 0.51 * (scale["high"] - scale["low"]) / 254)


    def need_node(self):
        if shutil.which("node") is None:
            self.skipTest("there is no node")

    def test_surfaces_are_closed_and_lie_on_the_shape(self):
        self.need_node()
        program("report", self.run_folder, "--surface", "-o", self.folder / "skin.html")
        page = Elements((self.folder / "skin.html").read_text(encoding="utf-8"))
        frames = json.loads(page.data["frames"])
        numbers = halves(page.data["particles"])
        inside = 3 * 3 * 7
        self.assertEqual(frames["particles"], 5 * 5 * 9 - inside)
        self.assertEqual(len(numbers), frames["particles"])
        self.assertEqual(numbers, sorted(set(numbers)))
        self.assertEqual(len(frames["facets"]), 21)
        for number in set(frames["facets"]):
            corners = halves(page.data[f"facets-{number}"])
            self.assertEqual(len(corners), 3 * 2 * (2 * 4 * 4 + 4 * 4 * 8))
            edges = Counter(tuple(sorted(pair)) for k in range(0, len(corners), 3)
                            for pair in zip(corners[k:k + 3], (*corners[k + 1:k + 3], corners[k])))
            self.assertEqual(set(edges.values()), {2})
        corners = halves(page.data[f"facets-{frames['facets'][0]}"])
        x, _, (facets,) = decoded(page, [0])[0]
        self.assertEqual(facets, corners)
        for axis, length in enumerate((1, 1, 2)):
            places = [frames["low"][axis] + frames["step"][axis] * code for code in x[axis]]
            step = frames["step"][axis]
            self.assertLess(abs(min(places)), step)
            self.assertLess(abs(max(places) - length), step)

    def test_half_sections_are_seen_on_both_sides_of_the_axis(self):
        (self.folder / "ring.toml").write_text("""
geometry = "axisymmetric"
title = "Ring"
[run]
end = "1 ms"
[[body]]
name = "ring"
shape = { box = { min = ["1 m", "0 m"], max = ["2 m", "1 m"] }, spacing = "0.25 m" }
material = { law = "neo_hookean", density = "1100 kg/m^3", youngs_modulus = "17 MPa", poissons_ratio = 0.3 }
formulation = { name = "nodal" }
[output.frames]
every = "1 ms"
""", encoding="utf-8")
        folder = self.folder / "ring"
        program("run", self.folder / "ring.toml", "--quiet", "--out", folder)
        (folder / "case.toml").unlink()  # frames know
        program("report", folder)
        frames = json.loads(Elements((folder / "report.html").read_text(encoding="utf-8")).data["frames"])
        self.assertTrue(frames["mirrored"])
        self.assertNotIn("mirrored", self.frames)
        self.need_node()
        script = "".join((SOURCE / "web" / name).read_text(encoding="utf-8") for name in ("view.js", "scene.js")) + """
const about = JSON.parse(require("fs").readFileSync(0, "utf8")), scene = Object.create(Scene.prototype);
Object.assign(scene, { about, canvas: { width: 800, height: 600 }, view: new View("y", 0, 0) });
scene.setBox(about);
scene.view.target = [0.3, 0.2, 0.1];
const [camera, other] = scene.cameras(scene.camera());
const seen = (one, p) => {
  const d = scene.inScene(p).map((x, c) => x - one.target[c]);
  return [one.axes.right, one.axes.up, one.axes.towards].map((axis) => dot(axis, d));
};
console.log(JSON.stringify([scene.middle, scene.half, seen(other, [1.5, 0.5, 0]), seen(camera, [-1.5, 0.5, 0])]));
"""
        done = subprocess.run(["node", "-e", script], input=json.dumps(frames), capture_output=True, text=True,
                              check=True)
        middle, half, image, expected = json.loads(done.stdout)
        self.assertEqual(middle[0], 0)
        self.assertAlmostEqual(half[0], 2, places=3)
        for a, b in zip(image, expected):
            self.assertAlmostEqual(a, b)

    def test_surfaces_need_the_case(self):
        folder = self.folder / "without case"
        shutil.copytree(self.run_folder, folder)
        (folder / "case.toml").unlink()
        self.assertIn("have no surface", program("report", folder, "--surface", code=2))
        program("report", folder)
        frames = json.loads(Elements((folder / "report.html").read_text(encoding="utf-8")).data["frames"])
        self.assertIsNone(frames["stretched"])

    def test_balls_are_stretched_as_the_body_is(self):
        self.need_node()
        import h5py
        import numpy as np
        folder = self.folder / "stretched"
        program("run", self.folder / "case.toml", "--quiet", "--out", folder, "--set", 'run.end="6 ms"', "--set",
                'output.frames.fields=["DeformationGradient"]', "--set",
                'body.bar.initial_velocity=["9*Z","0","0"]')
        program("report", folder, "--fields", "DeformationGradient")
        page = Elements((folder / "report.html").read_text(encoding="utf-8"))
        frames = json.loads(page.data["frames"])
        ends = np.array(frames["stretched"])
        states = decoded(page, [0, 6])
        value = {k: ends[:, :1] + (np.array(fields[-6:]) - 1) * (ends[:, 1:] - ends[:, :1]) / 254
                 for k, (_, fields, _) in states.items()}
        unstretched = np.array([[1], [1], [1], [0], [0], [0]])
        self.assertLess(np.abs(value[0] - unstretched).max(), 1e-9)
        with h5py.File(folder / "frames" / "000006.hdf") as file:
            points = file["VTKHDF/Points"][:]
            gradient = file["VTKHDF/PointData/DeformationGradient"][:].reshape(-1, 3, 3)
        xx, yy, zz, xy, yz, xz = value[6]
        v = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).transpose(2, 0, 1)
        expected = gradient @ gradient.transpose(0, 2, 1)
        middle = np.abs(points[:, 2] - 1) < 0.5
        self.assertGreater(np.abs(expected - np.eye(3))[middle].max(), 0.05, "it is stretched at all")
        self.assertLess(np.abs(v @ v - expected)[middle].max(), 0.06)


if __name__ == "__main__":
    if not os.access(PROGRAM, os.X_OK):
        print("skipped: the program is not built")
        sys.exit(77)
    unittest.main()
