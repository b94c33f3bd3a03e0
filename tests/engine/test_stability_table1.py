"""Table I of Chen and Ricles (2012): each coefficient of the characteristic polynomial (6c), derived exactly.

The determinant is affine in each of k1a, k1e, k2a, k2e, alpha1 and alpha2 and homogeneous in m and dt^2 k, so its values at
0 and 1 give every coefficient in whole numbers.

Found: the printed table is not the polynomial of equations (3) to (5). It is that of a loop without the analytical
restoring force K_a x and with each actuator commanded by its floor's displacement, the second not by the storey's drift:
M a + K_e (G_1 x_1, G_2 x_2) = F, K_a appearing in (3c) alone. a5 lacks two terms of that polynomial.
"""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from rths_engine.stability import published

STIFFNESSES = ("k1a", "k1e", "k2a", "k2e")
ALPHAS = ("", "alpha1", "alpha2", "alpha1 alpha2")
# Table I as printed: integer factors of z^6 ... z^0 for each product of masses and stiffnesses (times its power of dt),
# by 1, alpha1, alpha2 and alpha1 alpha2
PRINTED = {
    "m m": (
        (0, 0, 16, -64, 96, -64, 16),
        (0, 16, -80, 160, -160, 80, -16),
        (0, 16, -80, 160, -160, 80, -16),
        (16, -96, 240, -320, 240, -96, 16),
    ),
    "m k1a": (
        (0, 0, 4, -16, 24, -16, 4),
        (0, 4, -20, 40, -40, 20, -4),
        (0, 4, -20, 40, -40, 20, -4),
        (4, -24, 60, -80, 60, -24, 4),
    ),
    "m k1e": (
        (0, 0, 20, -48, 40, -16, 4),
        (0, 4, -20, 40, -40, 20, -4),
        (0, 20, -68, 88, -56, 20, -4),
        (4, 0, 60, -80, 60, -24, 4),
    ),
    "m k2a": (
        (0, 0, 8, -32, 48, -32, 8),
        (0, 8, -40, 80, -80, 40, -8),
        (0, 8, -40, 80, -80, 40, -8),
        (8, -48, 120, -160, 120, -48, 8),
    ),
    "m k2e": (
        (0, 0, 40, -96, 80, -32, 8),
        (0, 24, -88, 128, -96, 40, -8),
        (0, 24, -88, 128, -96, 40, -8),
        (8, -48, 120, -160, 120, -48, 8),
    ),
    "k1a k2a": (
        (0, 0, 1, -4, 6, -4, 1),
        (0, 1, -5, 10, -10, 5, -1),
        (0, 1, -5, 10, -10, 5, -1),
        (1, -6, 15, -20, 15, -6, 1),
    ),
    "k1a k2e": (
        (0, 0, 5, -12, 10, -4, 1),
        (0, 5, -17, 22, -14, 5, -1),
        (0, 1, -5, 10, -10, 5, -1),
        (1, 0, 15, -20, 15, -6, 1),
    ),
    "k1e k2a": (
        (0, 0, 5, -12, 10, -4, 1),
        (0, 1, -5, 10, -10, 5, -1),
        (0, 5, -17, 22, -14, 5, -1),
        (1, -6, 15, -20, 15, -6, 1),
    ),
    "k1e k2e": (
        (0, 0, 25, -20, 14, -4, 1),
        (0, 5, -17, 22, -14, 5, -1),
        (0, 5, -17, 22, -14, 5, -1),
        (1, -6, 15, -20, 15, -6, 1),
    ),
}
LOST = {("m k1e", "alpha1 alpha2", 5), ("k1a k2e", "alpha1 alpha2", 5)}  # terms absent from a5


def multiplied(*factors: list[int]) -> list[int]:
    product_ = [1]
    for factor in factors:
        longer = [0] * (len(product_) + len(factor) - 1)
        for i, one in enumerate(product_):
            for j, other in enumerate(factor):
                longer[i + j] += one * other
        product_ = longer
    return product_


def added(*terms: list[int]) -> list[int]:
    size = max(map(len, terms))
    return [sum(term[i] if i < len(term) else 0 for term in terms) for i in range(size)]


def times(factor: int, term: list[int]) -> list[int]:
    return [factor * one for one in term]


def determinant(m: int, k: tuple[int, ...], alpha: tuple[int, int], as_printed: bool) -> list[int]:
    """Coefficients of z^0 ... z^6 with dt = 1: (4 M + K)(z - 1)^2 + 4 z (K_a + K_e G), times both lags.

    Columns hold one actuator each where it is commanded by a floor; a drift is the difference of two.
    """
    k1a, k1e, k2a, k2e = k
    z, moved = [0, 1], [1, -2, 1]
    lag1, lag2 = ([1 - one, one] for one in alpha)
    total = [[k1a + k1e + k2a + k2e, -k2a - k2e], [-k2a - k2e, k2a + k2e]]
    analytical = [[0, 0], [0, 0]] if as_printed else [[k1a + k2a, -k2a], [-k2a, k2a]]
    plain = [
        [added(times(4 * m * (i == j) + total[i][j], moved), times(4 * analytical[i][j], z)) for j in range(2)]
        for i in range(2)
    ]
    z2 = [0, 0, 4]
    if as_printed:
        felt = [[k1e + k2e, -k2e], [-k2e, k2e]]
        entry = [[added(multiplied(plain[i][j], (lag1, lag2)[j]), times(felt[i][j], z2)) for j in range(2)] for i in range(2)]
        return added(multiplied(entry[0][0], entry[1][1]), times(-1, multiplied(entry[0][1], entry[1][0])))
    (p11, p12), (_, p22) = plain
    whole = added(multiplied(p11, p22), times(-1, multiplied(p12, p12)))
    first, second = times(k1e, z2), times(k2e, z2)
    return added(
        multiplied(whole, lag1, lag2),
        multiplied(first, p22, lag2),
        multiplied(second, added(p11, p22, times(2, p12)), lag1),
        multiplied(first, second),
    )


def table(as_printed: bool) -> dict[str, tuple[tuple[int, ...], ...]]:
    """Every coefficient by inclusion and exclusion of the values at 0 and 1."""

    def affine(stiffnesses: tuple[int, ...], m: int, alpha: tuple[int, int]) -> list[int]:
        total = [0] * 7
        ons = [one for one in range(4) if stiffnesses[one]]
        for chosen in product((0, 1), repeat=len(ons)):
            k = [0, 0, 0, 0]
            for place, on in zip(ons, chosen, strict=True):
                k[place] = on
            for picked in product(*((0, 1) if on else (0,) for on in alpha)):
                sign = (-1) ** (sum(stiffnesses) - sum(chosen) + sum(alpha) - sum(picked))
                total = added(total, times(sign, determinant(m, tuple(k), (picked[0], picked[1]), as_printed)))
        return total

    found = {}
    for name in PRINTED:
        parts = name.split()
        stiffnesses = tuple(int(one in parts) for one in STIFFNESSES)
        m = int("m" in parts)
        rows = []
        for alpha in ((0, 0), (1, 0), (0, 1), (1, 1)):
            rows.append(tuple(reversed(affine(stiffnesses, m, alpha))))
        found[name] = tuple(rows)
    return found


def differences(one: dict[str, tuple[tuple[int, ...], ...]]) -> set[tuple[str, str, int]]:
    return {
        (name, ALPHAS[row], 6 - place)
        for name, rows in PRINTED.items()
        for row, values in enumerate(rows)
        for place, value in enumerate(values)
        if value != one[name][row][place]
    }


def test_the_printed_table_is_the_loop_without_analytical_force_and_with_actuators_at_the_floors() -> None:
    assert differences(table(as_printed=True)) == LOST


def test_the_equations_of_the_paper_give_another_table_beyond_its_first_and_last_coefficient() -> None:
    differing = differences(table(as_printed=False))
    assert {power for _, _, power in differing} == {1, 2, 3, 4, 5}


@pytest.mark.parametrize("alpha", [(1.0, 1.0), (1.5, 1.2), (4.0, 9.0)])
def test_the_numerical_polynomial_has_the_derived_coefficients(alpha: tuple[float, float]) -> None:
    symbols = {"m": published.MASS, **{one: published.DT**2 * published.STIFFNESS / 2 for one in STIFFNESSES}}
    weights = np.array([1.0, alpha[0], alpha[1], alpha[0] * alpha[1]])
    total = np.zeros(7)
    for name, rows in table(as_printed=False).items():
        total += np.prod([symbols[one] for one in name.split()]) * weights @ np.array(rows)
    found = published.characteristic(alpha, ratio=0.0)
    # both sum some thirty terms of up to 1e15, of which the larger cancel to 1e-3
    assert found == pytest.approx(total[::-1], abs=1e-12 * np.max(np.abs(total)))


def test_without_delay_the_polynomial_is_the_undamped_structure() -> None:
    roots = np.asarray(Polynomial(published.characteristic((1.0, 1.0), ratio=0.0)).roots(), dtype=complex)
    periods = published.DT * np.pi / np.arctan(np.abs(np.tan(np.angle(roots[np.abs(roots) > 0.5]) / 2)))
    # tan(theta / 2) = omega dt / 2 for CR; the paper gives its periods with three digits
    assert sorted(set(np.round(periods, 2))) == [0.39, 1.02]
