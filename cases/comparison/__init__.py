"""The comparison of the cases with theory and paper. Its modules use those of cases/ and the reader in io/."""

import sys
from pathlib import Path

for _folder in (Path(__file__).resolve().parents[1], Path(__file__).resolve().parents[2] / "io"):
    if str(_folder) not in sys.path:
        sys.path.insert(0, str(_folder))
