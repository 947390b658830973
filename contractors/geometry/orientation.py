"""On which side of a line a point lies, decided exactly."""

import numpy as np

from ial.contractors.intervals.arithmetic import mul, sub
from ial.contractors.intervals.error_free import two_product, two_sum
from ial.contractors.kernels import kernel

# Products of this size have exact errors, which neither underflow nor overflow.
_SMALLEST, _LARGEST = 2.0**-900, 2.0**1000


@kernel
def orientation(ax, ay, bx, by, cx, cy):  # type: ignore[no-untyped-def]
    """Return 1.0 where c lies left of the line from a to b, -1.0 where it lies right of it, and 0.0 on it.

    The answer is exact for coordinates whose products are 0 or within 2^-900 … 2^1000; where one is not, 0.0 may also mean "not known".

    References
    ----------
    Shewchuk: Adaptive precision floating-point arithmetic and fast robust geometric predicates, Discrete & Computational Geometry 18
    (1997), figure 6 (the sum of an expansion and a number) and theorem 10. The first stage is here interval arithmetic.
    """
    left = mul(*sub(ax, ax, cx, cx), *sub(by, by, cy, cy))
    right = mul(*sub(ay, ay, cy, cy), *sub(bx, bx, cx, cx))
    low, high = sub(*left, *right)
    if low > 0.0 or high < 0.0:
        return 1.0 if low > 0.0 else -1.0
    # The determinant as six products of coordinates, each the sum of two doubles, is added up without any error: the parts of the sum do
    # not overlap, so that the last one that is not 0 has its sign.
    parts = np.empty(12)
    count = 0
    for a, b in ((ax, by), (-ay, bx), (bx, cy), (-by, cx), (cx, ay), (-cy, ax)):
        product, error = two_product(a, b)
        if a != 0.0 and b != 0.0 and not _SMALLEST < abs(product) < _LARGEST:
            return 0.0
        for term in (error, product):
            total = term
            for i in range(count):
                total, parts[i] = two_sum(total, parts[i])
            parts[count] = total
            count += 1
    for i in range(count):
        part = parts[count - 1 - i]
        if part != 0.0:
            return 1.0 if part > 0.0 else -1.0
    return 0.0
