"""The module gives the digits of the command line."""

import csv
import io
import json
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

import chromascope as cs
from support import ROOT, SAMPLES, command

CAMERA = "Nikon D70 (UPenn 2011)"
OBSERVER = "CIE 1931 2°"


class Digits(unittest.TestCase):
    def table(self, columns, text):
        rows = list(csv.DictReader(io.StringIO(text.decode())))
        self.assertEqual(list(columns), list(rows[0]))
        for head, column in columns.items():
            cells = [row[head] for row in rows]
            if isinstance(column, np.ndarray):
                expected = [float(cell) if cell else np.nan for cell in cells]
                np.testing.assert_array_equal(column, expected, head)
            else:
                self.assertEqual(column, cells)

    def test_metrics(self):
        given = ("--camera", CAMERA, "--camera", "Canon EOS 10D", "--illuminant", "A", "--metrics", "all")
        with warnings.catch_warnings(record=True) as remarks:
            warnings.simplefilter("always")
            found = cs.metrics(CAMERA, "Canon EOS 10D", illuminant="A", metrics="all")
        text, said = command("compare", *given, "--format", "json")
        self.assertEqual(found, json.loads(text))
        self.assertEqual([str(remark.message) for remark in remarks], [
            line.removeprefix("chromascope: ") for line in said.splitlines()
        ])

    def test_light(self):
        text, _ = command("light", "FL2", "LED-B3", "--camera", CAMERA, "--format", "json")
        self.assertEqual(cs.light("FL2", "LED-B3", camera=CAMERA), json.loads(text))

    def test_matrix(self):
        text, _ = command("matrix", "Nikon D3300", "--illuminant", "D55", "--format", "json")
        expected = json.loads(text)
        found = cs.matrix("Nikon D3300", "D55")
        self.assertEqual(found["lights"][0]["errors"], expected["lights"][0]["errors"])
        self.assertTrue((found["lights"][0]["xyz_from_rgb"] == expected["lights"][0]["xyz_from_rgb"]).all())
        self.assertEqual(found["lights"][0]["xyz_from_rgb"].shape, (3, 3))
        np.testing.assert_array_equal(found["idt"]["aces_from_rgb"], expected["idt"]["aces_from_rgb"])
        # The text has seven decimals of the same numbers.
        words, _ = command("matrix", "Nikon D3300", "--illuminant", "D55")
        rounded = " ".join(f"{value:.7f}" for value in found["lights"][0]["xyz_from_rgb"].flat)
        self.assertIn(rounded, " ".join(words.decode().split()))

    def test_profile(self):
        for form in ["dcp", "icc", "clf", "dng", "text"]:
            bytes_, _ = command("matrix", "Nikon D3300", "--illuminant", "D55", "--format", form)
            self.assertEqual(cs.profile("Nikon D3300", "D55", form), bytes_)

    def test_locus(self):
        text, _ = command("locus", "--camera", CAMERA, "--observer", OBSERVER, "--temperatures", "2856,5500.5,6504")
        self.table(cs.locus(camera=CAMERA, observer=OBSERVER, temperatures=[2856, 5500.5, 6504]), text)

    def test_patches(self):
        text, _ = command("patches", "--preset", "paper", "--camera", CAMERA, "--illuminant", "A")
        self.table(cs.patches(preset="paper", camera=CAMERA, illuminant="A"), text)

    def test_planckian_locus(self):
        kelvins = np.linspace(1500, 20000, 40)
        text, _ = command("locus", "--observer", OBSERVER, "--temperatures", ",".join(map(str, kelvins)))
        rows = list(csv.DictReader(io.StringIO(text.decode())))
        for diagram, heads in [("xy", ["x", "y"]), ("uv-prime", ["u_prime", "v_prime"])]:
            found = cs.chromaticities(cs.planckian_locus(OBSERVER, None, kelvins), diagram)
            expected = np.array([[row[head] for head in heads] for row in rows], float)
            np.testing.assert_allclose(found, expected, rtol=0, atol=1e-13)

    def test_cct_and_differences_of_patches(self):
        columns = cs.patches(camera=[CAMERA], chart="ColorChecker 24 (Ohta 1997)", observer=[])
        xyz = np.stack([columns[f"{axis}_tristimulus"] for axis in "xyz"], -1)
        cct, duv = cs.cct_duv(cs.chromaticities(xyz))
        np.testing.assert_allclose(cct, columns["cct_k"], rtol=1e-9)
        np.testing.assert_allclose(duv, columns["duv"], atol=1e-13)
        reference = cs.patches(observer=OBSERVER, chart="ColorChecker 24 (Ohta 1997)")
        labs = [np.stack([of[f"lab_{axis}"] for axis in "lab"], -1) for of in (reference, columns)]
        for formula, column in [("delta-e2000", "delta_e_2000"), ("delta-e1976", "delta_e_1976"),
                                ("delta-e1994", "delta_e_1994")]:
            np.testing.assert_allclose(cs.delta_e(*labs, formula), columns[column], rtol=1e-11)

    def test_open(self):
        corpus = ROOT / "tests" / "spectral-file" / "corpus"
        paths = [path for path in sorted(corpus.iterdir()) if path.is_file()]
        read = 0
        for path in sorted(SAMPLES.iterdir()) + paths[:: max(1, len(paths) // 60)]:
            with self.subTest(path.name):
                try:
                    found = cs.open(path)
                except ValueError as error:
                    _, said = command("inspect", path, code=1)
                    self.assertEqual(f"chromascope: {error}", said.splitlines()[-1])
                    continue
                report = json.loads(command("inspect", "--json", path)[0])
                self.assertEqual(len(found), len(report["curves"]))
                read += 1
                for curve, expected in zip(found, report["curves"]):
                    self.assertEqual(curve["decisions"], report["decisions"])
                    self.assertEqual(curve["warnings"], report["warnings"])
                    self.assertEqual(curve["name"], expected["name"])
                    np.testing.assert_array_equal(curve["wavelengths"], expected["wavelengths_nm"])
                    np.testing.assert_array_equal(curve["values"], expected["values"])
        self.assertGreater(read, 20)

    def test_open_with_overrides_and_folders(self):
        path = SAMPLES / "cri_14.csv"
        self.assertEqual(cs.open(path, role="illuminant")[0]["kind"], "illuminant")
        self.assertEqual(set(np.diff(cs.open(path, step=10)[0]["wavelengths"])), {10})
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.assertGreater(len({curve["file"] for curve in cs.open(SAMPLES)}), 3)

    def test_library(self):
        for kind in ["cameras", "observers", "charts", "illuminants", "filters", "materials"]:
            names = command("list", kind)[0].decode().splitlines()
            sets = getattr(cs, kind)()
            self.assertEqual([one["name"] for one in sets], names[: len(sets)])
            self.assertGreaterEqual(len(sets), len(names) - 1)
            for one in sets:
                self.assertTrue(one["source"] and one["license"])
                self.assertEqual(len(one["values"]), len(one["wavelengths"]))

    def test_figures(self):
        chart = "ColorChecker 24 (BabelColor average)"
        patches = cs.charts(chart)
        raw = cs.responses(patches["values"].T, patches["wavelengths"], CAMERA, "D65")
        both = {"camera": [CAMERA, "Nikon D3300"]}
        alone = {"camera": [CAMERA]}
        for kind, file, options in [
            *((kind, None, both) for kind in ["chromaticity", "differences", "strip", "spectra", "swatches", "light",
                                              "metrics", "head-to-head"]),
            ("report-card", None, alone),
            ("correction", None, {**alone, "second_light": "A"}),
            ("render", None, {**both, "mesh": "sphere", "width": "20mm"}),
            ("curves", patches, {}),
            ("recorded", 1e4 * raw / raw.max(), {"chart": chart, "illuminant": "D65"}),
        ]:
            with self.subTest(kind), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                figure = cs.figure(kind, file, **options)
                self.assertEqual(figure._repr_svg_(), figure.svg)
                self.assertTrue(figure.svg.startswith("<svg") and figure.svg.rstrip().endswith("</svg>"))
                if options in (both, alone) and file is None:
                    with tempfile.TemporaryDirectory() as folder:
                        out = Path(folder) / "figure.svg"
                        named = [part for camera in options["camera"] for part in ("--camera", camera)]
                        command("figure", kind, *named, "--out", out)
                        self.assertEqual(figure.svg, out.read_text())
        self.assertEqual(cs.figure("spectra", form="pdf")[:5], b"%PDF-")

    def test_render_of_a_spectral_image(self):
        cube = ROOT / "tests" / "spectral-image" / "data" / "spy_f32.hdr"
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            pictures = cs.render(image=cube, camera=CAMERA)
        self.assertEqual([picture.shape for picture in pictures.values()], [(3, 4, 7)])

    def test_render(self):
        with tempfile.TemporaryDirectory() as folder:
            command("render", "--size", "40x30", "--camera", CAMERA, "--mesh", "sphere", "--out", folder)
            names = {path.stem for path in Path(folder).iterdir()}
        linear = cs.render(size=(40, 30), camera=CAMERA, mesh="sphere")
        shown = cs.render("png", size="40x30", camera=CAMERA, mesh="sphere")
        self.assertEqual(set(linear), names)
        self.assertEqual(set(shown), names)
        (pixels,) = linear.values()
        self.assertEqual((pixels.shape, pixels.dtype), ((30, 40, 7), np.float32))
        self.assertEqual(next(iter(shown.values())).shape, (30, 40, 4))
        self.assertGreater(pixels[15, 20, 3:6].min(), 0)


class ByValue(unittest.TestCase):
    """Arrays in the place of names."""

    def test_a_camera_by_value_is_that_camera(self):
        camera = cs.cameras(CAMERA)
        own = cs.patches(camera=camera, illuminant="D65")
        named = cs.patches(camera=CAMERA, illuminant="D65")
        for head in ["r", "g", "b", "lab_l", "delta_e_2000"]:
            np.testing.assert_allclose(own[head], named[head], rtol=1e-12, atol=1e-12)

    def test_objects_like_those_of_colour(self):
        class Curves:
            name = "Mine"
            labels = ["red", "green", "blue"]

            def __init__(self, of):
                self.wavelengths, self.values = of["wavelengths"], of["values"]

        camera = cs.cameras(CAMERA)
        found = cs.metrics(Curves(camera), (camera["wavelengths"], camera["values"]), illuminant=cs.illuminants("D65"))
        first, second = found["cameras"]
        self.assertEqual({first["name"], second["name"]}, {"Mine", "camera"})
        self.assertEqual(first["values"], second["values"])
        spectra = np.random.default_rng(2).random((3, 401))
        nm = np.arange(380, 781)
        for sensitivities in [Curves(camera), camera, (camera["wavelengths"], camera["values"])]:
            np.testing.assert_array_equal(
                cs.responses(spectra, nm, sensitivities), cs.responses(spectra, nm, CAMERA)
            )

    def test_lists_and_tuples(self):
        camera = cs.cameras(CAMERA)
        other = {**cs.cameras("Nikon D3300"), "name": "Other"}
        for both in [(camera, other), [camera, other]]:
            self.assertEqual(len(set(cs.patches(camera=both)["sensor"])), 2)
        self.assertEqual(cs.locus(temperatures=(3000.0, 4000))["temperature_k"][-2:].tolist(), [3000, 4000])
        self.assertEqual(cs.locus(from_=np.float64(3000), to=3000, count=1)["temperature_k"][0], 3000)
        free, kept = (cs.matrix("Nikon D3300", "D65", free_white=free, fit="lab-least-squares") for free in (True, False))
        self.assertNotEqual(free["lights"][0]["errors"], kept["lights"][0]["errors"])

    def test_recovery_from_raw_values(self):
        chart = "ColorChecker 24 (BabelColor average)"
        truth = cs.cameras(CAMERA)
        patches = cs.charts(chart)
        raw = cs.responses(patches["values"].T, patches["wavelengths"], CAMERA, "D65")
        raw = 10000 * raw / raw.max()
        found = cs.recover(raw, chart=chart, illuminant="D65", title="Twin")
        self.assertEqual(found["name"], "Twin")
        self.assertEqual(found["values"].shape, (found["wavelengths"].size, 3))
        self.assertTrue((found["standard_uncertainty"] > 0).any())
        at = np.stack([np.interp(found["wavelengths"], truth["wavelengths"], v) for v in truth["values"].T], -1)
        scaled = found["values"] * (at.sum(0) / found["values"].sum(0))
        self.assertLess(np.sqrt(((scaled - at) ** 2).mean()) / at.max(), 0.05)
        ranking = cs.metrics(found, CAMERA)["cameras"]
        self.assertEqual({camera["name"] for camera in ranking}, {"Twin", CAMERA})
        best = cs.identify(raw, chart=chart, illuminant="D65")
        self.assertIn(CAMERA, json.dumps(best["cameras"][0] if "cameras" in best else best))


if __name__ == "__main__":
    unittest.main()
