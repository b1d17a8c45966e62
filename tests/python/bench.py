"""Time and error of the module beside colour-science and NumPy, both in one run: python bench.py [SECONDS]

Each error is against the definition that the function states, evaluated in extended precision or through the inverse; each time is the
median of the repetitions that fit into SECONDS (1 unless given). Needs colour-science 0.4.7.
"""

import statistics
import sys
import time
import warnings

import numpy as np

import chromascope as cs

warnings.simplefilter("ignore")
import colour  # noqa: E402

SECONDS = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
GENERATOR = np.random.default_rng(20)


def timed(call):
    """Median time in seconds after one call that is not counted, and the answer."""
    answer = call()
    times, end = [], time.perf_counter() + SECONDS
    while time.perf_counter() < end or len(times) < 3:
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return statistics.median(times), answer


def told(what, own, other, aim):
    """A line with both, and their ratio."""
    (own_time, own_error), (name, other_time, other_error) = own, other
    ratio = other_time / own_time
    met = "" if ratio >= aim else f"   below the aim of {aim}"
    print(f"{what:34} chromascope {own_time * 1e3:9.3f} ms, error {own_error:.1e}   "
          f"{name} {other_time * 1e3:9.3f} ms, error {other_error:.1e}   {ratio:6.1f} times faster{met}")


def ciede2000(first, second):
    """CIE 142-2001 as published (Sharma, Wu and Dalal 2005), in extended precision."""
    (l1, a1, b1), (l2, a2, b2) = (np.moveaxis(np.asarray(lab, np.longdouble), -1, 0) for lab in (first, second))
    pi = 2 * np.arccos(np.longdouble(0))
    c = (np.hypot(a1, b1) + np.hypot(a2, b2)) / 2
    g = (1 - np.sqrt(c**7 / (c**7 + np.longdouble(25) ** 7))) / 2
    a1, a2 = (1 + g) * a1, (1 + g) * a2
    c1, c2 = np.hypot(a1, b1), np.hypot(a2, b2)
    h1, h2 = np.arctan2(b1, a1) % (2 * pi), np.arctan2(b2, a2) % (2 * pi)
    dh = (h2 - h1 + pi) % (2 * pi) - pi
    big = 2 * np.sqrt(c1 * c2) * np.sin(dh / 2)
    h = (h1 + h2) / 2
    h = np.where(abs(h1 - h2) > pi, np.where(h1 + h2 < 2 * pi, h + pi, h - pi), h)
    l, c, degree = (l1 + l2) / 2, (c1 + c2) / 2, pi / 180
    t = (1 - np.longdouble("0.17") * np.cos(h - 30 * degree) + np.longdouble("0.24") * np.cos(2 * h)
         + np.longdouble("0.32") * np.cos(3 * h + 6 * degree) - np.longdouble("0.2") * np.cos(4 * h - 63 * degree))
    turn = 30 * degree * np.exp(-(((h / degree - 275) / 25) ** 2))
    rotation = -2 * np.sqrt(c**7 / (c**7 + np.longdouble(25) ** 7)) * np.sin(2 * turn)
    dl = (l2 - l1) / (1 + np.longdouble("0.015") * (l - 50) ** 2 / np.sqrt(20 + (l - 50) ** 2))
    dc = (c2 - c1) / (1 + np.longdouble("0.045") * c)
    dh = big / (1 + np.longdouble("0.015") * c * t)
    return np.sqrt(dl**2 + dc**2 + dh**2 + rotation * dc * dh)


def relative(found, exact):
    return float(np.max(abs(found - exact) / abs(exact)))


def differences():
    first = GENERATOR.uniform([0, -100, -100], [100, 100, 100], (200_000, 3))
    second = first + GENERATOR.normal(0, 5, first.shape)
    own, found = timed(lambda: cs.delta_e(first, second))
    other, theirs = timed(lambda: colour.difference.delta_E_CIE2000(first, second))
    exact = ciede2000(first, second)
    told("ΔE*00 of 200,000 pairs, relative", (own, relative(found, exact)),
         ("colour", other, relative(theirs, exact)), 10)


def temperatures():
    kelvins = 1e6 / np.linspace(1e6 / 15000, 1e6 / 2000, 20_000)
    # Each program's own locus, back to its temperatures.
    ours = cs.chromaticities(cs.planckian_locus("CIE 1931 2°", None, kelvins))
    theirs = colour.temperature.CCT_to_uv_Ohno2013(np.stack([kelvins, 0 * kelvins], -1))
    own, (found, _) = timed(lambda: cs.cct_duv(ours))
    other, back = timed(lambda: colour.temperature.uv_to_CCT_Ohno2013(theirs))
    told("CCT and Duv of 20,000 colors, K", (own, float(np.max(abs(found - kelvins)))),
         ("colour", other, float(np.max(abs(back[:, 0] - kelvins)))), 10)


def tristimulus():
    nm = np.arange(380, 781)
    spectra = GENERATOR.random((20_000, nm.size))
    shape = colour.SpectralShape(380, 780, 1)
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape)
    equal = colour.sd_ones(shape)
    integral = observer.values[:, 1].sum() / 100
    own, found = timed(lambda: cs.responses(spectra, nm, observer, quantity="matching-functions"))
    other, theirs = timed(
        lambda: colour.msds_to_XYZ(spectra, observer, equal, method="Integration", shape=shape))
    exact = (spectra[:100].astype(np.longdouble)[:, None, :] * observer.values.T).astype(np.longdouble)
    exact = (exact.sum(-1) - (exact[..., 0] + exact[..., -1]) / 2)
    told("XYZ of 20,000 spectra, relative", (own, relative(found[:100], exact)),
         ("colour", other, relative(np.asarray(theirs)[:100] * integral, exact)), 10)


def tristimulus_of_objects():
    """Colour's own call as it is documented, on its own objects, which both take."""
    nm = np.arange(380, 781)
    spectra = colour.MultiSpectralDistributions(GENERATOR.random((nm.size, 200)), nm)
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(colour.SpectralShape(380, 780, 1))
    integral = observer.values[:, 1].sum() / 100
    own, found = timed(
        lambda: cs.responses(spectra.values.T, spectra.wavelengths, observer, quantity="matching-functions"))
    other, theirs = timed(lambda: colour.msds_to_XYZ(spectra, observer))
    exact = spectra.values.T.astype(np.longdouble)[:, None, :] * observer.values.T
    exact = exact.sum(-1) - (exact[..., 0] + exact[..., -1]) / 2
    told("XYZ of 200 of colour's spectra", (own, relative(found, exact)),
         ("colour", other, relative(np.asarray(theirs) * integral, exact)), 10)


def products(kind):
    nm = np.arange(380, 781, 5)
    spectra = GENERATOR.random((1_000_000, nm.size), kind)
    camera = cs.cameras("Nikon D70 (UPenn 2011)")
    # The curves that the sum at 1 nm has for samples at 5 nm, so that both compute the same.
    curves = cs.responses(np.eye(nm.size), nm, camera)
    rounded = np.ascontiguousarray(curves.astype(kind))
    own, found = timed(lambda: cs.responses(spectra, nm, camera))
    other, theirs = timed(lambda: np.matmul(spectra, rounded))
    exact = spectra[:1000].astype(np.longdouble) @ curves.astype(np.longdouble)
    told(f"responses to 1,000,000 spectra, {np.dtype(kind).name}", (own, relative(found[:1000], exact)),
         ("numpy.matmul", other, relative(theirs[:1000], exact)), 2)


if __name__ == "__main__":
    print(f"NumPy {np.__version__}, colour-science {colour.__version__}, chromascope {cs.__version__}")
    differences()
    temperatures()
    tristimulus()
    tristimulus_of_objects()
    products(np.float64)
    products(np.float32)
