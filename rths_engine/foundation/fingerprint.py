"""A digest of everything that a compiled function consists of, and of nothing else.

The walk starts at the function and follows the names in its bytecode: functions that it calls, constants that it reads, and
named tuples that it can receive. Sentences, docstrings, labels, bounds and comments are not compiled, so they do not change
the digest.
"""

from __future__ import annotations

import builtins
import dis
import hashlib
import sys
from collections.abc import Callable, Iterator
from functools import cache
from types import CodeType, ModuleType
from typing import Any, TypeGuard

import numpy as np

OWN = __name__.partition(".")[0]


def fingerprint(function: Callable[..., Any], *more: object) -> str:
    """Hex SHA-256 of a function, of everything that it reaches, and of `more`. Raises NameError for a name defined later."""
    digest = hashlib.sha256(repr(more).encode())
    for line in sorted(Walk(function).lines):
        digest.update(line.encode() + b"\n")
    return digest.hexdigest()


class Walk:
    """`lines` describe each function, constant and named tuple reached from `function`; `tuples` are the named tuples."""

    def __init__(self, function: Callable[..., Any]):
        self.own = {OWN, function.__module__.partition(".")[0]}
        self.lines: set[str] = set()
        self.tuples: set[type] = set()
        self._met: set[int] = set()
        self._walk("", function)

    def _walk(self, place: str, value: Any) -> None:
        value = getattr(value, "py_func", value)  # the Python function behind a compiled function
        if hasattr(value, "__code__"):
            self._function(place, value)
        elif is_named_tuple(value):
            self._tuple(value)
        elif isinstance(value, np.ndarray):
            self.lines.add(f"{place} = {value.dtype.str} {value.shape} {value.tobytes().hex()}")
        elif isinstance(value, ModuleType) or callable(value):
            self.lines.add(f"{place} is {getattr(value, '__name__', value)}")
        else:
            self.lines.add(f"{place} = {value!r}")

    def _function(self, place: str, function: Any) -> None:
        name = f"{function.__module__}.{function.__qualname__}"
        self.lines.add(f"{place} is {name}")
        if id(function) in self._met:
            return
        self._met.add(id(function))
        self.lines.add(f"{name}{function.__defaults__!r}: {'; '.join(_instructions(function.__code__))}")
        for cell, held in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
            self._walk(f"{name}.{cell}", held.cell_contents)
        for code in _codes(function.__code__):
            self._names(name, code, function.__globals__)
        for held in function.__globals__.values():  # an argument can be any named tuple of the module
            if is_named_tuple(held):
                self._tuple(held)

    def _names(self, name: str, code: CodeType, scope: dict[str, Any]) -> None:
        modules = []
        for operation, read in _steps(code):
            if operation != "LOAD_GLOBAL" or hasattr(builtins, read):
                continue
            if read not in scope:
                raise NameError(f"{name} uses {read}, but is compiled before {read} is defined")
            value = scope[read]
            self._walk(f"{name}.{read}", value)
            if isinstance(value, ModuleType) and value.__name__.partition(".")[0] in self.own:
                modules.append(value)
        for module in modules:
            for attribute in code.co_names:
                if hasattr(module, attribute):
                    self._walk(f"{module.__name__}.{attribute}", getattr(module, attribute))

    def _tuple(self, kind: Any) -> None:
        if kind in self.tuples:
            return
        self.tuples.add(kind)
        self.lines.add(f"{kind.__module__}.{kind.__qualname__}: {kind._fields!r}")
        for held in vars(sys.modules[kind.__module__]).values():  # a field can be any named tuple of the module
            if is_named_tuple(held):
                self._tuple(held)


def is_named_tuple(value: Any) -> TypeGuard[type]:
    """Whether the value is a class of named tuples."""
    return isinstance(value, type) and issubclass(value, tuple) and hasattr(value, "_fields")


def _codes(code: CodeType) -> Iterator[CodeType]:
    """The code object and the code objects nested in it, such as comprehensions."""
    yield code
    for held in code.co_consts:
        if isinstance(held, CodeType):
            yield from _codes(held)


@cache
def _steps(code: CodeType) -> tuple[tuple[str, Any], ...]:
    """Name and argument of each instruction. Entry points share most of their code, which is taken apart once."""
    return tuple((step.opname, step.argval) for step in dis.get_instructions(code))


@cache
def _instructions(code: CodeType) -> tuple[str, ...]:
    """Each instruction with its constant or name, not with the index of the constant, which changes with a docstring."""
    found = [repr(code.co_varnames[: code.co_argcount])]
    for operation, held in _steps(code):
        inner = f"({'; '.join(_instructions(held))})" if isinstance(held, CodeType) else repr(held)
        found.append(f"{operation} {inner}")
    return tuple(found)
