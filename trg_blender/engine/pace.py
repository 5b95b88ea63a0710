"""How often a running render speaks: drawing Blender's interface costs as much as samples do."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

FIRST_PICTURE_S = 0.3
PICTURE_INTERVAL_S = 1.0
PICTURE_SHARE = 10.0
"""A picture is shown at most for a tenth of the time."""
LINE_INTERVAL_S = 0.25
BACKGROUND_LINE_INTERVAL_S = 1.0
"""Without a window each line lands in the log."""


@dataclass(slots=True)
class Pace:
    """When the next line and the next picture are due."""

    background: bool
    _next_line: float = field(default_factory=time.monotonic)
    _next_picture: float = field(default_factory=lambda: time.monotonic() + FIRST_PICTURE_S)

    def wants_line(self) -> bool:
        """True when a line is due; the next one is then an interval away."""
        now = time.monotonic()
        if now < self._next_line:
            return False
        self._next_line = now + (BACKGROUND_LINE_INTERVAL_S if self.background else LINE_INTERVAL_S)
        return True

    def wants_picture(self) -> bool:
        """True when somebody may be looking and a picture is due."""
        return not self.background and time.monotonic() >= self._next_picture

    def picture_took(self, seconds: float) -> None:
        """Sets the next picture's time by what the last one cost."""
        self._next_picture = time.monotonic() + max(PICTURE_INTERVAL_S, PICTURE_SHARE * seconds)
