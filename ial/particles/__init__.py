"""Comparators: what is not guaranteed, to compare with.

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.particles.bounce_monte_carlo import BounceMonteCarlo as BounceMonteCarlo
    from ial.particles.brute_force import BruteForce as BruteForce
    from ial.particles.likelihood_field import BeamModel as BeamModel
    from ial.particles.markov import HistogramOptions as HistogramOptions
    from ial.particles.markov import MarkovLocalization as MarkovLocalization
    from ial.particles.monte_carlo import MonteCarlo as MonteCarlo
    from ial.particles.monte_carlo import MonteCarloConfig as MonteCarloConfig
    from ial.particles.odometry_model import OdometryModel as OdometryModel
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "bounce_monte_carlo": ("BounceMonteCarlo",),
            "brute_force": ("BruteForce",),
            "likelihood_field": ("BeamModel",),
            "markov": ("HistogramOptions", "MarkovLocalization"),
            "monte_carlo": ("MonteCarlo", "MonteCarloConfig"),
            "odometry_model": ("OdometryModel",),
        },
    )
