"""Margins: by how much bounds are widened where numbers are rounded to nearest and not outward, each with what it covers.

There are two kinds. `ROUNDINGS`, and the factors `ABOVE` and `BELOW` that are made of it, cover a short chain of ordinary operations; the
line that uses one says which operations, and how large their terms are. All others belong to the elementary functions of
`ial.contractors.intervals`, which compute with sums of two doubles. In both a margin is relative: it grows with the numbers that are
rounded, and so holds for numbers of every size, unless they underflow or overflow.

References
----------
Higham: Accuracy and Stability of Numerical Algorithms, 2nd edition (2002), lemma 3.1. Joldes, Muller, Popescu: Tight and rigorous error
bounds for basic building blocks of double-word arithmetic, ACM Transactions on Mathematical Software 44 (2017).
"""

UNIT = 2.0**-53
"""u: rounding to nearest changes the result of one operation by at most this part of it."""

ROUNDINGS = 32.0 * UNIT
"""For a value made of terms whose sizes add up to M, ROUNDINGS·M covers 31 roundings, at most, on the way from the terms to the value.

n roundings change it by at most ((1 + u)ⁿ − 1)·M < 1.01·n·u·M. A sine or cosine from `trigonometric.sincos`, which is off by less than u,
counts as one of them, and so does a constant such as π that is a double's distance from what it stands for.
"""

ABOVE, BELOW = 1.0 + ROUNDINGS, 1.0 - ROUNDINGS
"""Factors for a number that is a sum, product, quotient or root of numbers of one sign: 30 roundings, and that of the factor itself.

(1 − u)³¹·(1 + 32u) > 1. Where numbers of both signs are added, terms may cancel: there the margin is a part of the terms, not of the sum.
"""

# Of the elementary functions. High and low are the parts of a sum of two doubles. What follows is proved at the lines that use it; the
# tests compare with exact values, and `bench/oracles.py` with those of other libraries.

TANGENT = UNIT
"""The relative error of a tangent: those of a sine, 0.63u, and of a cosine, 0.16u, and of a quotient, far below."""

PRODUCT, QUOTIENT, ROOT = 8.0 * UNIT**2, 16.0 * UNIT**2, 64.0 * UNIT**2
"""Relative errors of a product (6·2⁻¹⁰⁶, Joldes et al., algorithm 11), a quotient and a root of sums of two doubles."""

SMALL = 2.0**-26
"""Up to here tan, tanh, asinh and atanh are x and the next term of their series."""

SERIES = 16.0 * UNIT
"""The relative error of the next term of a series up to `SMALL`: three roundings, and the term after it, below x² <= 2u of it."""

HYPERBOLIC_SINE = 8.0 * UNIT
"""The relative error of sinh x − x up to 1/2: below 5u, and the rounding of what it is multiplied with."""

EXPONENTIAL = 4.0 * UNIT
"""The error of e^r, as a part of r²: less than 2u for the polynomial, 0.6u each for three sums."""

LOGARITHM = 16.0 * UNIT
"""The error of log(1 + f), as a part of s·f²/2: less than 11u for the series, 3u for two sums."""

LOGARITHM_REST = 4.0 * UNIT**2
"""The error of a logarithm, as a part of it (or of 1), for what is left out of a rest below u, and for the sum with k·ln 2."""

REDUCTION = 2.0**16 * UNIT**2
"""The error of k·ln 2, as a part of k: both constants, their products and the sums with them are off by less than half of this."""

EXPONENT = 2.0**16 * UNIT**2
"""The error of log(x) / n: a quotient, `QUOTIENT` of at most 745, and less than u of 2⁻⁴³ for an n that is no double."""

CHANGE_OF_BASE = 8.0 * UNIT**2
"""The relative error of a logarithm's product with a constant of two doubles: its parts round off less than 4u² of it."""

HALVES = 256.0 * UNIT**2
"""The error of e^x·2⁻ᵏ ± its inverse, which is at most 2: a quotient, and sums of rests below 2u."""

COMPOSED = 512.0 * UNIT**2
"""The error of a function made of those above, as a part of it or of 1: roots, quotients, products and sums of rests before the last."""
