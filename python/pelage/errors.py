"""What the library throws: exceptions with the place of the fault where there is one."""

from __future__ import annotations


class Error(Exception):
    """A fault; its text is "FILE:LINE:COLUMN: what, and what to do", in one line.

    kind:    "usage", "input", "numerics", "output" or "cancelled", after the exit codes of the command line
    file:    that the fault lies in, or None
    line:    of it, from 1, or None
    column:  of it, from 1, or None
    """

    kind = ""

    def __init__(self, text: str, file: str | None = None, line: int | None = None, column: int | None = None):
        super().__init__(text)
        self.file, self.line, self.column = file, line, column


class UsageError(Error, ValueError):
    """An unknown name, or a value or text that means nothing."""

    kind = "usage"


class InputError(Error, ValueError):
    """A file that cannot be read, or a shape that cannot be used."""

    kind = "input"


class NumericsError(Error, ArithmeticError):
    """The computation failed: fields that blow up, a system that is not solved, too little memory."""

    kind = "numerics"


class OutputError(Error):
    """A file that cannot be written."""

    kind = "output"


class Cancelled(Error):
    """A progress function has returned False."""

    kind = "cancelled"


_CLASSES = {2: UsageError, 3: InputError, 4: NumericsError, 5: OutputError, 130: Cancelled}


def error_of(code: int, text: str, file: str, line: int, column: int) -> Error:
    """The exception for a fault of the library; `code` is the exit code that the command line has for it."""
    return _CLASSES.get(code, Error)(text, file or None, line or None, column or None)
