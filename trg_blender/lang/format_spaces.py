"""Where a space stands between two tokens of one line."""

from __future__ import annotations

from .format_pieces import Piece

_OPERAND_ENDS = frozenset(")]}")
_SIGNS = frozenset(("-", "+", "!", "++", "--"))
_STEPS = frozenset(("++", "--"))
_JOINED_AFTER = frozenset(("(", "[", ".", "::", "#"))
_JOINED_BEFORE = frozenset((")", "]", ",", ";", ".", "::", ":"))
_WORDS_BEFORE_VALUE = frozenset(("in",))


class Spacing:
    """Decides token by token, within one statement; remembers what the last token was."""

    def __init__(self) -> None:
        self.before: Piece | None = None
        self.sign = False
        """The last token is an operator in front of its operand."""
        self.overload = False
        """The last token is the operator of `.operator+`."""

    def take(self, piece: Piece) -> bool:
        """Note the next token; whether a space stands before it."""
        before, after_sign, after_overload = self.before, self.sign, self.overload
        self.overload = before is not None and before.text == "operator"
        self.sign = self._is_sign(piece) and not self.overload
        self.before = piece
        if before is None:
            return False
        return self._is_apart(before, piece, after_sign, after_overload)

    def after_body(self, closing: Piece) -> None:
        """Note that the body of a function ended."""
        self.before, self.sign, self.overload = closing, False, False

    def _is_sign(self, piece: Piece) -> bool:
        before = self.before
        if piece.kind != "op" or piece.text not in _SIGNS:
            return False
        if piece.text == "!" or before is None or self.sign:
            return True
        return not (self._ends_operand(before) or before.text in _STEPS)

    @staticmethod
    def _ends_operand(piece: Piece) -> bool:
        if piece.kind in ("number", "string"):
            return True
        if piece.kind == "name":
            return piece.text not in _WORDS_BEFORE_VALUE
        return piece.kind == "op" and piece.text in _OPERAND_ENDS

    def _is_apart(self, before: Piece, piece: Piece, after_sign: bool, after_overload: bool) -> bool:
        text, last = piece.text, before.text
        operator = piece.kind == "op"
        if before.kind == "op" and last in _JOINED_AFTER and not after_overload:
            return False
        if operator and text in _JOINED_BEFORE:
            return _would_merge(before, piece)
        if after_sign:
            return _would_merge(before, piece)
        if self.overload or (operator and text in _STEPS and not self.sign):
            return False
        if operator and text in ("(", "["):
            joined = self._ends_operand(before) or after_overload or last == "function"
            return not joined
        return True


def _would_merge(before: Piece, piece: Piece) -> bool:
    """Whether the two read as something else without a space: `- -x`, `1 .x`."""
    if piece.text == "." or piece.text[0] in "0123456789.":
        return before.kind == "number"
    return before.kind == "op" and before.text[-1] in "+-" and piece.text[0] == before.text[-1]
