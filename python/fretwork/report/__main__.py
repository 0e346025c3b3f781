# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 -m fretwork.report DIR [-o FILE]"""

import sys

from .build import main

if __name__ == "__main__":
    sys.exit(main())
