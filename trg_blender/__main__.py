"""`python -m trg_blender` is `trg`."""

import sys

from .cli import main

if __name__ == "__main__":
    sys.exit(main())
