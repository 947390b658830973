"""`OdometryPath`: odometry at several times, in compact arrays."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.datasets.odometry import Odometry

NUMBERS = 6  # of an `Odometry`


@dataclass(frozen=True, eq=False)
class OdometryPath:
    """Odometry at several times, in the order in which the robot was there.

    Parameters
    ----------
    stamps_ns
        Times in nanoseconds, int64 of shape (n,).
    numbers
        Rows (x, y, z, w, error_m, error_rad) of an `Odometry` each, float64 of shape (n, 6).
    """

    stamps_ns: npt.NDArray[np.int64]
    numbers: npt.NDArray[np.float64]

    def __post_init__(self) -> None:
        stamps = np.array(self.stamps_ns, dtype=np.int64)
        numbers = np.array(self.numbers, dtype=np.float64).reshape(-1, NUMBERS)
        if stamps.shape != (len(numbers),):
            raise ValueError(f"{stamps.size} stamps for {len(numbers)} odometry messages; give one for each")
        for name, array in (("stamps_ns", stamps), ("numbers", numbers)):
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    def __repr__(self) -> str:
        return f"<OdometryPath of {len(self)} messages>"

    @classmethod
    def of(cls, samples: Iterable[tuple[int, Odometry]] = ()) -> "OdometryPath":
        """Return the path of pairs of stamp in nanoseconds and odometry."""
        pairs = list(samples)
        return cls(np.array([stamp for stamp, _ in pairs], dtype=np.int64), np.array([odometry.numbers for _, odometry in pairs]))

    @classmethod
    def joined(cls, paths: Iterable["OdometryPath"]) -> "OdometryPath":
        """Return paths one after the other."""
        each = [cls.of(), *paths]
        return cls(np.concatenate([path.stamps_ns for path in each]), np.concatenate([path.numbers for path in each]))

    def __len__(self) -> int:
        return len(self.stamps_ns)

    def __iter__(self) -> Iterator[tuple[int, Odometry]]:
        """Yield pairs of stamp and odometry."""
        for stamp, row in zip(self.stamps_ns.tolist(), self.numbers.tolist(), strict=True):
            yield stamp, Odometry(*row)

    @property
    def last(self) -> Odometry:
        """The last odometry."""
        return Odometry(*self.numbers[-1].tolist())

    def after(self, stamp_ns: int) -> "OdometryPath":
        """Return the part that is later than a time."""
        later = self.stamps_ns > stamp_ns
        return self if later.all() else OdometryPath(self.stamps_ns[later], self.numbers[later])

    def joining(self, first: tuple[int, Odometry], last: tuple[int, Odometry]) -> "OdometryPath":
        """Return the path from one odometry over these messages to another."""
        stamps = np.concatenate([[first[0]], self.stamps_ns, [last[0]]])
        return OdometryPath(stamps, np.concatenate([[first[1].numbers], self.numbers, [last[1].numbers]]))

    def within(self, start_ns: int | None, stop_ns: int) -> "OdometryPath":
        """Return the same messages at stamps between two times.

        Stamps that all lie there, and increase, are kept. Otherwise no clock can be trusted, and the time is shared equally among the
        messages, of which several may have one stamp where there are more than nanoseconds; nothing is known of those before the first
        scan, where there is no time to share.
        """
        stamps = self.stamps_ns
        begun = start_ns is None or (stamps > start_ns).all()
        if begun and (stamps < stop_ns).all() and (np.diff(stamps) > 0).all():
            return self
        if start_ns is None:
            return OdometryPath.of()
        share = (stop_ns - start_ns) / (len(self) + 1)
        steps = np.floor(share * np.arange(1, len(self) + 1)).astype(np.int64)
        return OdometryPath(start_ns + steps, self.numbers)
