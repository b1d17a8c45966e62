"""Cameras, lights and color from spectra, with the digits of the program's command line.

Wavelengths are in nanometers, temperatures in kelvins, reflectances fractions; the last axis of an array holds channels or coordinates.
Wrong input raises ValueError with the command line's sentence.
"""

from os import PathLike
from typing import Any, Literal, Protocol, TypedDict, final, overload

from numpy import float32, float64
from numpy.typing import ArrayLike, NDArray

__version__: str

class _HasSpectra(Protocol):
    """Curves at common wavelengths, as the objects of `colour` are."""

    @property
    def wavelengths(self) -> ArrayLike: ...
    @property
    def values(self) -> ArrayLike: ...

class _DataSet(TypedDict, total=False):
    """A data set of the library: wavelengths in nm (n,), values (n,) or (n, curves), NaN where a curve has no sample."""

    name: str
    columns: list[str]
    wavelengths: NDArray[float64]
    values: NDArray[float64]
    quantity: str
    unit: str
    source: str
    license: str
    notes: list[str]

class _Curve(TypedDict, total=False):
    """A curve of a file: wavelengths in nm, values and standard uncertainty of shape (n,); and what was decided for the file."""

    name: str
    file: str
    kind: str
    quantity: str
    unit: str | None
    wavelengths: NDArray[float64]
    values: NDArray[float64]
    standard_uncertainty: NDArray[float64] | None
    coverage_factor: float | None
    missing: int
    channels: list[int] | None
    decisions: list[dict[str, str]]
    warnings: list[dict[str, Any]]
    reading: dict[str, Any]
    notes: list[str]

class _Recovered(TypedDict):
    """Sensitivities per energy of shape (n, 3) with standard uncertainties; taken as a camera by other functions."""

    name: str
    columns: list[str]
    wavelengths: NDArray[float64]
    values: NDArray[float64]
    standard_uncertainty: NDArray[float64]
    report: str

_Path = str | PathLike[str]
_Spectra = _Path | _HasSpectra | _DataSet | _Curve | _Recovered | tuple[ArrayLike, ArrayLike]
_Diagram = Literal["xy", "uv-prime"]
_Quantity = Literal["camera", "matching-functions"]

def open(path: _Path, **options: Any) -> list[_Curve]:
    """Curves of a file of any format, or of all files of a folder, with every decision made on reading."""

@overload
def cameras(name: None = None) -> list[_DataSet]: ...
@overload
def cameras(name: str) -> _DataSet:
    """Spectral sensitivities of cameras: red, green, blue. All of them, or the one that a name matches."""

@overload
def observers(name: None = None) -> list[_DataSet]: ...
@overload
def observers(name: str) -> _DataSet:
    """Color matching functions and cone fundamentals. All of them, or the one that a name matches."""

@overload
def charts(name: None = None) -> list[_DataSet]: ...
@overload
def charts(name: str) -> _DataSet:
    """Reflectances of charts' patches, as fractions. All charts, or the one that a name matches."""

@overload
def illuminants(name: None = None) -> list[_DataSet]: ...
@overload
def illuminants(name: str) -> _DataSet:
    """Spectral power of lights. All of them, or the one that a name matches."""

@overload
def filters(name: None = None) -> list[_DataSet]: ...
@overload
def filters(name: str) -> _DataSet:
    """Transmittances of filters, as fractions. All of them, or the one that a name matches."""

@overload
def materials(name: None = None) -> list[_DataSet]: ...
@overload
def materials(name: str) -> _DataSet:
    """Single reflectances, as fractions. All of them, or the one that a name matches."""

def responses(
    spectra: ArrayLike,
    wavelengths_nm: ArrayLike,
    sensitivities: str | _HasSpectra | _DataSet | _Recovered | tuple[ArrayLike, ArrayLike],
    light: str | _HasSpectra | _DataSet | tuple[ArrayLike, ArrayLike] | None = None,
    quantity: _Quantity = "camera",
) -> NDArray[float64] | NDArray[float32]:
    """I_c = ∫ S(λ) L(λ) C_c(λ) dλ, 380 to 780 nm: spectra (…, wavelengths) give (…, channels); float32 gives float32."""

def planckian_locus(
    sensitivities: str | ArrayLike | _HasSpectra | _DataSet | _Recovered,
    wavelengths_nm: ArrayLike | None,
    temperatures: ArrayLike,
    quantity: _Quantity = "camera",
) -> NDArray[float64]:
    """C_c(T) = ∫ S_c(λ) M(λ, T) dλ up to a factor of each T: kelvins (…) give (…, 3)."""

def chromaticities(xyz: ArrayLike, diagram: _Diagram = "xy") -> NDArray[float64]:
    """x, y or u′, v′ of tristimulus values: (…, 3) gives (…, 2); NaN where undefined."""

def cct_duv(chromaticities: ArrayLike, diagram: _Diagram = "xy") -> tuple[NDArray[float64], NDArray[float64]]:
    """Correlated color temperature in kelvins and Duv (CIE 1931 2°): (…, 2) gives two of (…); NaN where there is none."""

def delta_e(
    lab1: ArrayLike,
    lab2: ArrayLike,
    formula: Literal["delta-e2000", "delta-e1976", "delta-e1994"] = "delta-e2000",
) -> NDArray[float64]:
    """Difference of lab2 from lab1 in CIE L*a*b*: (…, 3) and (…, 3) or (3,) give (…)."""

def locus(**options: Any) -> dict[str, Any]:
    """Planckian loci of sensors as columns, as `chromascope locus`."""

def patches(**options: Any) -> dict[str, Any]:
    """Colors of a chart through sensors as columns, as `chromascope patches`."""

def metrics(*cameras: _Spectra, **options: Any) -> dict[str, Any]:
    """Figures of merit with standard uncertainties and ranks, as `chromascope compare --format json`."""

def light(*lights: _Spectra, **options: Any) -> list[dict[str, Any]]:
    """CCT, Duv, Ra, Rf, Rg, SSI and consistency of cameras, as `chromascope light --format json`."""

def matrix(camera: _Spectra, illuminant: _Spectra, **options: Any) -> dict[str, Any]:
    """XYZ = M · RGB fitted under a light, with errors, DNG's matrices and the ACES input transform."""

def profile(
    camera: _Spectra,
    illuminant: _Spectra,
    form: Literal["dcp", "icc", "clf", "dng", "text"] = "dcp",
    **options: Any,
) -> bytes:
    """Profile of a camera as the bytes of a file."""

def identify(recorded: _Path | ArrayLike, **options: Any) -> dict[str, Any]:
    """Cameras ranked by how well they explain raw values (patches, 3), as `chromascope identify --format json`."""

def recover(recorded: _Path | ArrayLike | list[_Path | ArrayLike], **options: Any) -> _Recovered:
    """Sensitivities from what a camera recorded of a chart, (patches, 3) for each light, as `chromascope recover chart`."""

@final
class Figure:
    """A figure, which notebooks show."""

    @property
    def kind(self) -> str: ...
    @property
    def svg(self) -> str: ...
    def _repr_svg_(self) -> str: ...

@overload
def figure(
    kind: str, file: _Path | ArrayLike | None = None, form: Literal["svg"] = "svg", **options: Any
) -> Figure: ...
@overload
def figure(
    kind: str,
    file: _Path | ArrayLike | None = None,
    form: Literal["pdf", "png", "tif", "csv", "json", "tex"] = ...,
    **options: Any,
) -> bytes:
    """Figure of a kind, as `chromascope figure`; another form gives the bytes of such a file."""

def render(form: Literal["exr", "png"] = "exr", **options: Any) -> dict[str, NDArray[Any]]:
    """Pictures through cameras by name: `exr` float32 (height, width, RGBXYZA), linear; `png` uint8 (height, width, 4), sRGB."""

def run(command: str, *arguments: Any, **options: Any) -> str:
    """Output of a command of the program, as text."""
