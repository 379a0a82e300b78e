"""Where the program sphdrop is."""

from __future__ import annotations

import shutil
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILT = ROOT / "build/release/src/sphdrop"
HELP = "default: build/release/src/sphdrop, or the installed one"


def default_program() -> Path:
    """The one that was built here; of an installed tree, where this file lies in share/sphdrop/cases, the one in its bin; else
    that of the path. The first of them if there is none."""
    on_path = shutil.which("sphdrop")
    candidates = [BUILT, ROOT.parents[1] / "bin" / "sphdrop", *([Path(on_path)] if on_path else [])]
    return next((path for path in candidates if path.is_file()), BUILT)
