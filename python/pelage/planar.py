"""Measures of flat pictures: what patterns of different models have in common, in numbers."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import UsageError

Picture = NDArray[np.float64]

#: Of the Gaussians of ln k by which spectra are smoothed, as in docs/measure.md.
_SMOOTHING = 0.1
#: Pixels finer than this part of a wavelength say nothing of the pattern: grain, and the resolution of the picture.
_GRAIN = 0.06


def grey(picture: ArrayLike) -> Picture:
    """(h, w) or (h, w, 3 or 4), row 0 on top, as numbers along the direction in which its colours differ most; bright
    is high. Transparency is left out."""
    values = np.asarray(picture, dtype=float)
    if values.ndim == 3 and values.shape[2] in (1, 3, 4):
        colors = values[..., :min(values.shape[2], 3)].reshape(-1, min(values.shape[2], 3))
        axis = np.linalg.eigh(np.cov(colors, rowvar=False).reshape(colors.shape[1], -1))[1][:, -1]
        values = ((colors - colors.mean(0)) @ (axis if axis.sum() >= 0 else -axis)).reshape(values.shape[:2])
    if values.ndim != 2 or min(values.shape) < 8:
        raise UsageError(f"a picture has the shape (h, w) or (h, w, 3), at least 8 x 8; this one has {values.shape}")
    if not np.isfinite(values).all():
        raise UsageError("the picture has values that are not finite")
    return values


def measure_picture(picture: ArrayLike, *, pixel: float = 1, periodic: bool = False) -> dict[str, Any]:
    """What the pattern of a flat picture is like; all but the wavelength do not depend on its scale.

    picture:   (h, w), or (h, w, 3) with colours; what is bright is the pattern, the rest its ground
    pixel:     length of a pixel [your unit]
    periodic:  its right side continues on the left, and its lower one on top

    wavelength:   2 pi / k at the peak of the variance per ln k [your unit]
    bandwidth:    ln k between which the middle half of the variance lies
    coverage:     share of what is above the level halfway between the lowest and highest half percent
    euler:        parts less holes of what is above, per squared wavelength: 0.87 for a triangular lattice of spots,
                  -0.87 for one of holes, about 0 for stripes
    coherence:    (a - b) / (a + b) with the mean square slopes a across and b along, in means over half a wavelength
    order:        the same in means over all of the picture
    orientation:  degrees of the stripes from the x axis (to the right), counter-clockwise, from 0 to 180
    kind:         "spots", "holes" or "stripes", see kind_of; "uniform": no pattern, and no other numbers
    across:       wavelengths along the square root of the area
    """
    values = grey(picture)
    deviation = values.std()
    if not deviation > 1e-9 * max(1.0, float(np.abs(values).max())):
        return {"kind": "uniform"}
    wave_number, bandwidth = _spectrum(values - values.mean(), periodic)
    wavelength = 2 * math.pi / wave_number  # in pixels from here on
    smooth = _blurred(values, min(_GRAIN * wavelength, min(values.shape) / 4), periodic)
    low, high = np.quantile(smooth, (0.005, 0.995))
    above = smooth > (low + high) / 2
    euler = _euler_density(above, periodic) * wavelength**2
    xx, yy, xy = (_blurred(t, min(wavelength / 2, min(values.shape) / 4), periodic) for t in _slopes(smooth, periodic))
    slopes = (xx + yy).sum()
    order = math.hypot((xx - yy).sum(), 2 * xy.sum()) / slopes
    across = math.atan2(2 * xy.sum(), (xx - yy).sum()) / 2
    coherence = float(np.hypot(xx - yy, 2 * xy).sum() / slopes)
    return {"wavelength": wavelength * pixel, "bandwidth": bandwidth, "coverage": float(above.mean()), "euler": euler,
            "coherence": coherence, "order": float(order), "orientation": (math.degrees(across) + 90) % 180,
            "kind": kind_of(euler, coherence), "across": math.sqrt(values.size) / wavelength}


def kind_of(euler: float, coherence: float) -> str:
    """Spots or holes where the Euler number per squared wavelength outweighs the coherence, else stripes. Of the models
    here spots have 0.6 to 0.9 against 0 to 0.3, labyrinths 0 to 0.3 against 0.4 to 0.9."""
    return "stripes" if abs(euler) <= coherence else "spots" if euler > 0 else "holes"


def _spectrum(u: Picture, periodic: bool) -> tuple[float, float]:
    """The wave number [1/pixel] at the peak of the smoothed variance per ln k, and ln k between the quartiles."""
    rows, columns = u.shape
    longest = 2 * math.pi / max(rows, columns)
    if not periodic:  # a window, or the jump between opposite sides would be waves along the axes
        window = np.outer(_hann(rows), _hann(columns))
        u = window * (u - (window * u).sum() / window.sum())
        longest *= 1.5  # the window is a wave itself
    power = np.abs(np.fft.fft2(u))**2
    k = np.hypot(_waves(rows)[:, None], _waves(columns))
    inside = k >= 0.999 * longest
    step = _SMOOTHING / 40
    low, high = math.log(0.7 * longest), math.log(1.1 * k.max())
    shares, edges = np.histogram(np.log(k[inside]), np.arange(low, high + step, step), weights=power[inside])
    at = (edges[1:] + edges[:-1]) / 2
    density = np.convolve(shares, np.exp(-(np.arange(-160, 161) / 40)**2 / 2), "same")
    top = int(density.argmax())
    peak = at[top] + step * _vertex(density[max(top - 1, 0):top + 2])
    below = np.cumsum(shares) / shares.sum()
    lower, upper = np.interp((0.25, 0.75), below, edges[1:])
    return math.exp(peak), float(upper - lower)


def _waves(count: int) -> Picture:
    """Wave numbers in the order of numpy.fft.fft [1/pixel]."""
    return 2 * math.pi * np.asarray((np.arange(count) + count // 2) % count - count // 2, dtype=float) / count


def _vertex(three: Picture) -> float:
    """Of the parabola through three numbers, from the middle one, in their distances."""
    if len(three) < 3 or three[0] - 2 * three[1] + three[2] == 0:
        return 0
    return float((three[0] - three[2]) / (2 * (three[0] - 2 * three[1] + three[2])))


def _hann(count: int) -> Picture:
    return np.asarray(np.sin(math.pi * (np.arange(count) + 0.5) / count)**2)


def _blurred(u: Picture, sigma: float, periodic: bool) -> Picture:
    """By a Gaussian; where the picture does not repeat, it is mirrored at its sides."""
    r = 0 if periodic else min(math.ceil(4 * sigma), *u.shape)
    wide = u if periodic else np.pad(u, r, mode="symmetric")
    k2 = _waves(wide.shape[0])[:, None]**2 + _waves(wide.shape[1])**2
    wide = np.fft.ifft2(np.fft.fft2(wide) * np.exp(-k2 * sigma**2 / 2)).real
    return wide[r:r + u.shape[0], r:r + u.shape[1]]


def _slopes(u: Picture, periodic: bool) -> tuple[Picture, Picture, Picture]:
    """Products of the slopes along x, to the right, and y, upward: xx, yy, xy."""
    if periodic:
        x = (np.roll(u, -1, 1) - np.roll(u, 1, 1)) / 2
        y = (np.roll(u, 1, 0) - np.roll(u, -1, 0)) / 2
    else:
        x, y = np.gradient(u, axis=1), -np.gradient(u, axis=0)
    return x * x, y * y, x * y


def _euler_density(above: NDArray[np.bool_], periodic: bool) -> float:
    """Parts less holes per pixel, from blocks of 2 x 2: one pixel of them is a quarter of a turn, three are one back.
    Pixels that touch at a corner only are of one part for one half."""
    a = np.pad(above, ((0, 1), (0, 1)), mode="wrap") if periodic else above
    count = a[:-1, :-1].astype(int) + a[:-1, 1:] + a[1:, :-1] + a[1:, 1:]
    return float(((count == 1).sum() - (count == 3).sum()) / 4 / count.size)
