"""sphdrop-sweep: a table of parameters -> runs -> one table of results, with figures."""

import sys
from pathlib import Path

CASES = Path(__file__).resolve().parents[1]
for folder in (CASES, CASES.parent / "io"):
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))
