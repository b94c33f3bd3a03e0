"""Shares u (samples, fields) in (0, 1) of a Latin hypercube or of Monte Carlo: the same for the same seed, count and fields.

Latin hypercube: each field has exactly one sample in each of `samples` intervals of equal probability. Source: McKay, Beckman
and Conover (1979), Technometrics 21, 239-245; made by scipy.stats.qmc.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from rths_engine.foundation.arrays import Array


@lru_cache(maxsize=4)
def shares(method: str, samples: int, fields: int, seed: int) -> Array:
    """The shares, read-only."""
    generator = np.random.Generator(np.random.PCG64(seed))
    if method == "latin_hypercube" and fields:
        from scipy.stats import qmc  # takes a second to import

        found: Array = qmc.LatinHypercube(fields, rng=generator).random(samples)
    else:
        found = generator.random((samples, fields))
    found = np.clip(found, np.finfo(float).tiny, np.nextafter(1.0, 0.0))
    found.setflags(write=False)
    return found
