"""Exact conversion of decimal text to float64, compiled: the float nearest to the digits, as Python's `float` gives it.

value = m * 10^e, m < 10^19. Three ways, the first that applies:
1. m <= 2^53 and |e| <= 22: both are floats without error, so one product or quotient is correctly rounded (Clinger 1990).
2. m times the first 128 bits of 10^e, where these bits decide the rounding (Lemire 2021, Number Parsing at a Gigabyte per
   Second, Software: Practice and Experience 51, section 5).
3. Otherwise (more digits, subnormal or infinite values, a tie that 128 bits do not decide) the number is not converted here;
   the caller asks Python.
"""

from __future__ import annotations

import math

import numpy as np

from rths_engine.foundation.kernel import compiled

# of 64-bit arithmetic and of IEEE 754 by definition; the two ways of Clinger 1990 and Lemire 2021
_U = np.uint64
_ZERO, _ONE, _TEN, _LOW = _U(0), _U(1), _U(10), _U(0xFFFFFFFF)
_EXACT = _U(1 << 53)
_NINE_BITS = _U(0x1FF)  # of the product, below the 53 bits of the result and the bit that rounds them
_S9, _S32, _S63 = _U(9), _U(32), _U(63)
_MOST_DIGITS = 19  # that always fit 64 bits
_LEAST, _MOST = -342, 308  # exponents beyond which a number of 19 digits is zero or infinite
_EXACT_POWERS = np.array([10.0**k for k in range(23)])


def _power(exponent: int) -> int:
    """The first 128 bits of 10^exponent, rounded down."""
    power: int = 10 ** abs(exponent)
    bits = power.bit_length()
    if exponent < 0:
        return (1 << (bits + 127)) // power
    return power >> (bits - 128) if bits > 128 else power << (128 - bits)


# by definition: see `_power`
_POWERS = [_power(exponent) for exponent in range(_LEAST, _MOST + 1)]
_HIGH = np.array([power >> 64 for power in _POWERS], dtype=_U)
_REST = np.array([power & (2**64 - 1) for power in _POWERS], dtype=_U)


@compiled
def _product(a, b):
    """High and low 64 bits of a * b."""
    a1, a0, b1, b0 = a >> _S32, a & _LOW, b >> _S32, b & _LOW
    low, middle, other = a0 * b0, a1 * b0, a0 * b1
    carry = (low >> _S32) + (middle & _LOW) + (other & _LOW)
    return a1 * b1 + (middle >> _S32) + (other >> _S32) + (carry >> _S32), a * b


@compiled
def _by_product(digits, exponent):
    """Digits * 10^exponent from 128 bits of the power, and whether these bits decide the result."""
    shifted, moved = digits, 0
    while shifted >> _S63 == _ZERO:
        shifted, moved = shifted << _ONE, moved + 1
    high, low = _product(shifted, _HIGH[exponent - _LEAST])
    if high & _NINE_BITS == _NINE_BITS and low + shifted < shifted:
        more, rest = _product(shifted, _REST[exponent - _LEAST])
        total = low + more
        if total < low:
            high += _ONE
        if high & _NINE_BITS == _NINE_BITS and total + _ONE == _ZERO and rest + shifted < shifted:
            return 0.0, False
        low = total
    top = high >> _S63
    mantissa = high >> (top + _S9)
    if low == _ZERO and high & _NINE_BITS == _ZERO and mantissa & _U(3) == _ONE:
        return 0.0, False  # a tie
    mantissa = (mantissa + (mantissa & _ONE)) >> _ONE
    binary = ((217706 * exponent) >> 16) + 11 - moved + np.int64(top)  # floor(log2(10^exponent)) = 217706 exponent / 2^16
    if binary < -1074 or binary > 970:
        return 0.0, False  # subnormal, or close to the largest float
    return math.ldexp(np.float64(np.int64(mantissa)), binary), True


@compiled
def _value(digits, exponent):
    """Digits * 10^exponent, and whether the value is exact."""
    if digits == _ZERO:
        return 0.0, True
    if digits <= _EXACT and -22 <= exponent <= 22:
        whole = np.float64(np.int64(digits))
        return (whole / _EXACT_POWERS[-exponent] if exponent < 0 else whole * _EXACT_POWERS[exponent]), True
    if exponent < _LEAST or exponent > _MOST:
        return 0.0, False
    return _by_product(digits, exponent)


@compiled
def decimal_number(text, at, point):
    """The number that starts at `text[at]`: its value, the index after it, and whether it was converted.

    `text` is an array of bytes that ends with a byte of no number; `point` the decimal sign. Numbers are written as
    `[+-]digits[.digits][e[+-]digits]`, also with the letters E, D and d (Fortran), with digits before or after the point.
    """
    minus = text[at] == 45
    if minus or text[at] == 43:
        at += 1
    digits, significant, written, exponent, after = _ZERO, 0, 0, 0, False
    while True:
        sign = text[at]
        if 48 <= sign <= 57:
            digits = digits * _TEN + _U(sign - 48)
            significant += significant > 0 or sign > 48
            written += 1
            exponent -= after
        elif sign == point and not after:
            after = True
        else:
            break
        at += 1
    if written == 0 or significant > _MOST_DIGITS:
        return 0.0, at, False
    if sign == 69 or sign == 101 or sign == 68 or sign == 100:
        at += 1
        down = text[at] == 45
        if down or text[at] == 43:
            at += 1
        first, power = at, 0
        while 48 <= text[at] <= 57:
            power = min(power * 10 + int(text[at] - 48), 100_000)
            at += 1
        if at == first:
            return 0.0, at, False
        exponent += -power if down else power
    value, exact = _value(digits, exponent)
    return (-value if minus else value), at, exact
