"""What the tests of the repository share: its root, its tracked files, its text, its build."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PRODUCTS = {".git", "build", "results", "__pycache__"}


def tracked_files() -> list[Path]:
    """Relative to the root. Without git, as in an unpacked archive, all files but what a build or a run left."""
    listing = subprocess.run(
        ["git", "-c", "safe.directory=*", "-C", str(ROOT), "ls-files", "-z"], capture_output=True, check=False
    )
    if listing.returncode == 0 and listing.stdout:
        paths = [Path(os.fsdecode(name)) for name in listing.stdout.split(b"\0") if name]
        return sorted(path for path in paths if (ROOT / path).is_file())
    found = (path.relative_to(ROOT) for path in ROOT.rglob("*") if path.is_file())
    return sorted(path for path in found if not PRODUCTS & set(path.parts))


def text_of(path: Path) -> str:
    return (ROOT / path).read_text(encoding="utf-8")


def code_of(path: Path) -> str:
    """A C++ file's text without its comments."""
    return re.sub(r"//[^\n]*|/\*.*?\*/", " ", text_of(path), flags=re.DOTALL)


def build_folder() -> Path:
    return Path(os.environ["SPHDROP_BUILD"])


def program_output(*arguments: str) -> str:
    """What sphdrop prints, given arguments."""
    command = [os.environ["SPHDROP_PROGRAM"], *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(command)} ends with {done.returncode}:\n{done.stderr}")
    return done.stdout
