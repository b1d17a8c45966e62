"""Wrong input raises ValueError with the command line's sentence; nothing panics."""

import unittest
import warnings

import numpy as np

import chromascope as cs
from support import command

NM = np.arange(400, 701, 10)
FLAT = np.ones((NM.size, 3))

ARRAYS = [
    None, "", "text", b"bytes", object(), [], (), {}, 1.0, np.nan, np.inf, True, [1, 2], [[1, 2], [3]], np.zeros(0),
    np.zeros((0, 3)), np.zeros((3, 0)), np.zeros((2, 2, 2, 2)), np.array("x"), np.array([object()]), [1j, 2, 3],
    np.array([1 + 2j]), np.full((4, 3), np.nan), np.full(3, np.inf), [1e308, 1e308, 1e308], [-1e308, 1e308, 0],
    np.zeros(3, bool), np.array(["1", "2", "3"]), {"wavelengths": NM}, {"wavelengths": NM, "values": None},
    {"wavelengths": NM[::-1], "values": FLAT}, {"wavelengths": NM, "values": FLAT[:4]},
    {"wavelengths": NM, "values": 0 * FLAT}, {"wavelengths": NM, "values": np.nan * FLAT},
    {"wavelengths": [500, 500], "values": [1, 1]}, {"wavelengths": -1.0 * NM[::-1], "values": FLAT},
    {"wavelengths": [1e-300, 1e300], "values": [1, 1]}, {"wavelengths": [500], "values": [1]}, (NM, FLAT[:2]),
]


class Refusals(unittest.TestCase):
    def only_value_errors(self, call, *arguments, **keywords):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                return call(*arguments, **keywords)
            except (ValueError, TypeError):
                return None

    def test_sentences_are_those_of_the_command_line(self):
        cases = [
            (lambda: cs.metrics("No such camera"), ["compare", "--camera", "No such camera"]),
            (lambda: cs.patches(illuminant="blackbody"), ["patches", "--illuminant", "blackbody"]),
            (lambda: cs.patches(chart="missing.csv"), ["patches", "--chart", "missing.csv"]),
            (lambda: cs.locus(temperatures=[0]), ["locus", "--temperatures", "0"]),
            (lambda: cs.matrix("Nikon D70", "D65", fit="magic"),
             ["matrix", "Nikon D70", "--illuminant", "D65", "--format", "json", "--fit", "magic"]),
            (lambda: cs.open("/nowhere.csv"), ["inspect", "--json", "/nowhere.csv"]),
            (lambda: cs.metrics(nonsense=3), ["compare", "--nonsense=3"]),
            (lambda: cs.figure("nonsense"), ["figure", "nonsense", "--out", "x.svg"]),
        ]
        for call, arguments in cases:
            with self.subTest(arguments):
                with warnings.catch_warnings(), self.assertRaises(ValueError) as raised:
                    warnings.simplefilter("ignore")
                    call()
                code = 2 if arguments[-1] in ("0", "magic", "--nonsense=3", "blackbody", "x.svg") else 1
                _, said = command(*arguments, code=code)
                sentence = str(raised.exception)
                self.assertTrue(sentence)
                self.assertIn(sentence, said)

    def test_arrays_of_any_kind(self):
        for one in ARRAYS:
            for call in [
                lambda x: cs.delta_e(x, [50, 0, 0]),
                lambda x: cs.delta_e([50, 0, 0], x, "delta-e1994"),
                lambda x: cs.cct_duv(x),
                lambda x: cs.cct_duv(x, "uv-prime"),
                lambda x: cs.chromaticities(x),
                lambda x: cs.responses(x, NM, (NM, FLAT)),
                lambda x: cs.responses(FLAT.T, x, (NM, FLAT)),
                lambda x: cs.responses(FLAT.T, NM, x),
                lambda x: cs.responses(FLAT.T, NM, (NM, FLAT), x),
                lambda x: cs.planckian_locus(x, None, [3000]),
                lambda x: cs.planckian_locus(FLAT, x, [3000]),
                lambda x: cs.planckian_locus("CIE 1931", None, x),
            ]:
                with self.subTest(repr(one)[:60]):
                    self.only_value_errors(call, one)

    def test_spectra_of_any_kind_in_commands(self):
        for one in ARRAYS:
            for call in [
                lambda x: cs.patches(camera=x),
                lambda x: cs.patches(camera="Nikon D3300", illuminant=x),
                lambda x: cs.light(x),
                lambda x: cs.matrix(x, "D65"),
                lambda x: cs.identify(x, chart="ColorChecker 24 (Ohta 1997)", illuminant="D65", camera="Nikon D3300"),
                lambda x: cs.recover(x, chart="ColorChecker 24 (Ohta 1997)", illuminant="D65"),
                lambda x: cs.open(x),
                lambda x: cs.cameras(x),
            ]:
                with self.subTest(repr(one)[:60]):
                    self.only_value_errors(call, one)

    def test_what_is_refused(self):
        for call in [
            lambda: cs.delta_e([[50, 0, np.nan]], [50, 0, 0]),
            lambda: cs.delta_e(np.zeros((2, 3)), np.zeros((3, 3))),
            lambda: cs.delta_e([50, 0], [50, 0]),
            lambda: cs.delta_e([50, 0, 0], [50, 0, 0], "delta-e2001"),
            lambda: cs.cct_duv([0.3, np.inf]),
            lambda: cs.cct_duv([0.3, 0.3], "rgb"),
            lambda: cs.responses(np.full((2, NM.size), np.nan), NM, (NM, FLAT)),
            lambda: cs.responses(np.full((2, NM.size), np.inf, np.float32), NM, (NM, FLAT)),
            lambda: cs.responses(FLAT, NM, (NM, FLAT)),
            lambda: cs.responses(FLAT.T, NM[::-1], (NM, FLAT)),
            lambda: cs.planckian_locus("CIE 1931", None, [0.0]),
            lambda: cs.planckian_locus(FLAT[:, :2], NM, [3000]),
            lambda: cs.planckian_locus("nobody", None, [3000]),
            lambda: cs.metrics({"wavelengths": NM, "values": FLAT[:, 0]}),
            lambda: cs.patches(camera=object()),
            lambda: cs.patches(camera=[["nested", object()]]),
            lambda: cs.light(b"D65"),
            lambda: cs.open(3.5j),
            lambda: cs.run("nothing"),
            lambda: cs.patches(white_balance={"wavelengths": NM, "values": FLAT[:, 0]}),
        ]:
            with self.assertRaises(ValueError):
                call()

    def test_views_and_orders(self):
        generator = np.random.default_rng(5)
        lab = generator.random((3, 40)) * 100
        expected = cs.delta_e(lab.T.copy(), lab.T[::-1].copy())
        np.testing.assert_array_equal(cs.delta_e(lab.T, lab.T[::-1]), expected)
        np.testing.assert_array_equal(cs.delta_e(np.asfortranarray(lab.T), lab.T[::-1].astype(">f8")), expected)
        np.testing.assert_array_equal(cs.delta_e(lab.T.reshape(5, 8, 3), lab.T[::-1].reshape(5, 8, 3)).ravel(), expected)
        odd = np.frombuffer(b"\0" + lab.T.tobytes(), np.float64, offset=1).reshape(40, 3)
        np.testing.assert_array_equal(cs.delta_e(odd, lab.T[::-1]), expected)
        spectra = generator.random((NM.size, 6))
        np.testing.assert_array_equal(
            cs.responses(spectra.T, NM, (NM, FLAT)), cs.responses(spectra.T.copy(), NM, (NM, FLAT))
        )

    def test_lone_and_empty(self):
        self.assertEqual(cs.delta_e([50, 0, 0], [50, 0, 0]).shape, ())
        self.assertEqual(cs.delta_e(np.zeros((0, 3)), [50, 0, 0]).shape, (0,))
        self.assertEqual(cs.cct_duv(np.zeros((0, 2)))[0].shape, (0,))
        self.assertTrue(np.isnan(cs.cct_duv([0.7, 0.2])[0]))
        self.assertTrue(np.isnan(cs.chromaticities([0, 0, 0])).all())

    def test_threads(self):
        from concurrent.futures import ThreadPoolExecutor

        with ThreadPoolExecutor(4) as pool:
            both = list(pool.map(lambda light: cs.light(light)[0]["light"], ["A", "D65", "D50", "FL2"] * 3))
        self.assertEqual(both, ["A", "D65", "D50", "FL2"] * 3)


class Values(unittest.TestCase):
    """Against definitions, in NumPy."""

    def test_responses_are_the_sum_at_a_nanometer(self):
        nm = np.arange(380, 781)
        camera = cs.cameras("Nikon D70 (UPenn 2011)")
        spectra = np.random.default_rng(3).random((50, nm.size))
        fine = np.random.default_rng(4).random((nm.size, 4))
        found = cs.responses(spectra, nm, (nm, fine))
        np.testing.assert_allclose(found, np.trapezoid(spectra[:, None, :] * fine.T, nm), rtol=1e-13)
        light = cs.illuminants("D65")
        lit = cs.responses(spectra, nm, camera, "D65")
        power = np.interp(nm, light["wavelengths"], light["values"])
        np.testing.assert_allclose(lit, cs.responses(spectra * power, nm, camera), rtol=1e-13)
        planck = nm**-5.0 / np.expm1(1.4388e7 / nm / 3000)  # the c2 of the program, that of ITS-90
        ratio = cs.responses(spectra, nm, camera, "blackbody:3000") / cs.responses(spectra * planck, nm, camera)
        np.testing.assert_allclose(ratio, ratio[0, 0], rtol=1e-12)
        with self.assertRaisesRegex(ValueError, 'light: "warm" is not a temperature; write daylight:5500'):
            cs.responses(spectra, nm, camera, "daylight:warm")
        uneven = np.unique(np.concatenate([[395.5, 702.25], np.random.default_rng(6).uniform(396, 702, 60)]))
        coarse = np.random.default_rng(7).random((9, uneven.size))
        filled = np.array([np.interp(nm, uneven, one) for one in coarse])
        np.testing.assert_allclose(cs.responses(coarse, uneven, camera), cs.responses(filled, nm, camera), rtol=1e-13)
        single = cs.responses(spectra.astype(np.float32), nm, camera)
        self.assertEqual(single.dtype, np.float32)
        np.testing.assert_allclose(single, cs.responses(spectra, nm, camera), rtol=1e-5)

    def test_pairs_of_sharma(self):
        pairs = [
            ([50, 2.6772, -79.7751], [50, 0, -82.7485], 2.0425), ([50, 0, 0], [50, -1, 2], 2.3669),
            ([50, 2.49, -0.001], [50, -2.49, 0.0011], 7.2195), ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
            ([2.0776, 0.0795, -1.135], [0.9033, -0.0636, -0.5514], 0.9082),
        ]
        for first, second, expected in pairs:
            self.assertAlmostEqual(float(cs.delta_e(first, second)), expected, places=4)

    def test_temperatures_come_back(self):
        kelvins = np.linspace(1500, 19000, 300)
        cct, duv = cs.cct_duv(cs.chromaticities(cs.planckian_locus("CIE 1931 2°", None, kelvins)))
        np.testing.assert_allclose(cct, kelvins, rtol=1e-9)
        np.testing.assert_allclose(duv, 0, atol=1e-12)


if __name__ == "__main__":
    unittest.main()
