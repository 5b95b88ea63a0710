"""What a reader raises when a file is not what its format says."""

from __future__ import annotations


class FormatError(Exception):
    """A damaged or foreign file: nothing of it may enter a scene."""

    def __init__(self, file: str, offset: int, expected: str) -> None:
        super().__init__(f"{file}: at byte {offset}: expected {expected}")
        self.file = file
        """as the caller named it"""
        self.offset = offset
        """in bytes from the start of the file"""
        self.expected = expected
        """one phrase that completes 'expected ...'"""
