"""The compiled reader of rows of numbers: it fills columns, and stops at the first line that is not exactly one row.

A field of at most 8 digits before and 8 after the decimal sign is read eight bytes at a time: a byte is a digit where
(b XOR 0x30) <= 9, and three products add eight digits up. It then is an exact quotient m / 10^f with m < 10^15. Every other
field goes to `decimal_number`. What neither reads (text, comments, words for a missing value, too many or too few fields,
numbers of more than 19 digits) ends the reading at the start of its line.
"""

from __future__ import annotations

import numpy as np

from rths_engine.formats.decimal_number import decimal_number
from rths_engine.foundation.kernel import compiled, entry

PADDING = 64  # by definition: more than the eight bytes read at a time; bytes that the text needs after its last line

# of words of eight bytes and of ASCII by definition
_U = np.uint64
_ZERO, _ONE, _EIGHT, _TEN, _HUNDRED, _MYRIAD = _U(0), _U(1), _U(8), _U(10), _U(100), _U(10_000)
_S3, _S7, _S16, _S24, _S32, _S40, _S48, _S56, _S63, _S64 = (_U(k) for k in (3, 7, 16, 24, 32, 40, 48, 56, 63, 64))
_I2, _I3, _I4, _I5, _I6, _I7 = (_U(k) for k in (2, 3, 4, 5, 6, 7))
_BYTE, _MINUS, _EXACT_DIGITS = _U(0xFF), _U(ord("-")), _U(15)
_DIGIT_ZERO = _U(0x3030303030303030)
_ABOVE_NINE = _U(0x7676767676767676)  # sets the high bit of a byte above 9
_HIGH = _U(0x8080808080808080)
_ONES = _U(0x0101010101010101)
_PAIRS, _FOURS, _HALF = _U(0x00FF00FF00FF00FF), _U(0x0000FFFF0000FFFF), _U(0xFFFFFFFF)
_WHOLE_POWERS = np.array([10**k for k in range(9)], dtype=_U)
_POWERS = np.array([10.0**k for k in range(9)])


@compiled
def _word(text, at):
    """Eight bytes from `at`, the first in the lowest place; one machine instruction."""
    word = _U(text[at]) | _U(text[at + _ONE]) << _EIGHT | _U(text[at + _I2]) << _S16 | _U(text[at + _I3]) << _S24
    word |= _U(text[at + _I4]) << _S32 | _U(text[at + _I5]) << _S40
    return word | _U(text[at + _I6]) << _S48 | _U(text[at + _I7]) << _S56


@compiled
def _digits(values):
    """How many of the eight bytes, from the lowest, are 0 to 9."""
    others = (values + _ABOVE_NINE | values) & _HIGH
    return ((others - _ONE & ~others & _HIGH) >> _S7) * _ONES >> _S56


@compiled
def _number(values, count):
    """The number of the lowest `count` bytes, each 0 to 9, the lowest byte first."""
    eight = values << (_S64 - (count << _S3) & _S63)
    eight *= _U(count != _ZERO)
    eight = (eight * _TEN + (eight >> _EIGHT)) & _PAIRS
    eight = (eight * _HUNDRED + (eight >> _S16)) & _FOURS
    return (eight * _MYRIAD + (eight >> _S32)) & _HALF


@compiled
def _after_blanks(text, at, separator):
    while (text[at] == 32 or text[at] == 9) and text[at] != separator:
        at += 1
    return at


@compiled
def _field(text, at, separator, point):
    """The field that starts at `text[at]`: its value, the index after it, and whether it is a number or empty."""
    at = _after_blanks(text, at, separator)
    sign = text[at]
    if separator != 32 and (sign == separator or sign == 10 or sign == 13):
        return np.nan, at, True
    quoted = sign == 34 and separator != 32
    if quoted:
        at += 1
    if (text[at] | 32) == 110 and (text[at + 1] | 32) == 97 and (text[at + 2] | 32) == 110:
        value, at, read = np.nan, at + 3, True
    else:
        value, at, read = decimal_number(text, at, point)
    if quoted:
        read = read and text[at] == 34
        at += 1
    if separator != 32:
        at = _after_blanks(text, at, separator)
    return value, at, read


@compiled
def _ends(text, at, separator, last):
    """Index after the end of a field, of a line for the `last` field; -1 where the field or the line does not end at `at`."""
    sign = text[at]
    if separator == 32:
        after = _after_blanks(text, at, 0)
        if last:
            return after + 1 if text[after] == 10 or text[after] == 13 else -1
        return after if after > at and text[after] != 10 and text[after] != 13 else -1
    if last:
        return at + 1 if sign == 10 or sign == 13 else -1
    return at + 1 if sign == separator else -1


@compiled
def _other(text, at, separator, last):
    """Index of the byte that ends a field of text; -1 for a quoted field."""
    while True:
        sign = text[at]
        if sign == 10 or sign == 13 or sign == separator or (separator == 32 and sign == 9):
            return at
        if sign == 34:
            return -1
        at += 1


@entry
def numeric_rows(text, first, last, separator, point, targets, ending, columns, row):
    """Fill `columns[:, row:]` from `text[first:last]`; returns the rows filled, and the index after the last line.

    `text`: uint8, at least PADDING bytes longer than `last`, and `text[last]` a line end. `separator`: a byte, 32 for white
    space. `targets`: for each field its column, -1 for a field of text. `ending`: whether lines can end with a separator.
    `columns` (columns, rows) has room for all rows. The index is less than `last` where a line is not a row, or is empty: it is
    the start of this line.
    """
    at, end, fields = _U(first), _U(last), len(targets)
    while at < end:
        line = at
        if text[at] == 10 or text[at] == 13:
            if text[at] == 13 or at == _ZERO or text[at - _ONE] != 13:
                return row, np.int64(line)
            at += _ONE  # the second byte of CR LF
            continue
        for field in range(fields):
            target = targets[field]
            final = field == fields - 1
            word = _word(text, at)
            minus = _U((word & _BYTE) == _MINUS)
            values = (word >> (minus << _S3)) ^ _DIGIT_ZERO
            before = _digits(values)
            whole = _number(values, before)
            stop = at + minus + before
            after, part = _ZERO, _ZERO
            if text[stop] == point:
                stop += _ONE
                values = _word(text, stop) ^ _DIGIT_ZERO
                after = _digits(values)
                part = _number(values, after)
                stop += after
            sign = text[stop]
            count = before + after
            if (
                target >= 0
                and _ZERO < count <= _EXACT_DIGITS
                and ((sign == 10 or sign == 13) if final else (sign == separator and separator != 32))
            ):
                value = np.float64(np.int64(whole * _WHOLE_POWERS[after] + part)) / _POWERS[after]
                columns[target, row] = value * (1.0 - 2.0 * np.float64(np.int64(minus)))
                at = stop + _ONE
                continue
            place = np.int64(at)
            if separator == 32 and field == 0:
                place = _after_blanks(text, place, 0)
            if target >= 0:
                number, place, read = _field(text, place, separator, point)
                if not read:
                    return row, np.int64(line)
                columns[target, row] = number
            else:
                place = _other(text, place, separator, final)
                if place < 0:
                    return row, np.int64(line)
            if final and ending and text[place] == separator:
                place += 1
            place = _ends(text, place, separator, final)
            if place < 0:
                return row, np.int64(line)
            at = _U(place)
        row += 1
    return row, np.int64(at)
