"""The film as a file: MP4 through ffmpeg where there is one, GIF through Pillow otherwise."""

from __future__ import annotations

import io
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

from PIL import Image


class AnimationError(Exception):
    """A film that could not be written; the text says why and what to do."""


def default_format() -> str:
    return "mp4" if shutil.which("ffmpeg") else "gif"


def write_gif(frames: Sequence[bytes], path: Path, rate: float) -> None:
    pictures = [Image.open(io.BytesIO(frame)).convert("RGB") for frame in frames]
    # One palette for all frames, or colours would flicker.
    palette = pictures[len(pictures) // 2].quantize(colors=255, dither=Image.Dither.NONE)
    indexed = [picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures]
    indexed[0].save(path, save_all=True, append_images=indexed[1:], duration=round(1000 / rate), loop=0, optimize=False)


def write_mp4(frames: Sequence[bytes], path: Path, rate: float) -> None:
    if not shutil.which("ffmpeg"):
        raise AnimationError("MP4 takes ffmpeg, which is not installed: apt-get install ffmpeg, or ask for gif")
    command = ["ffmpeg", "-loglevel", "error", "-y", "-f", "image2pipe", "-c:v", "mjpeg", "-framerate", str(rate), "-i", "-",
               # Players want even sizes and this pixel format.
               "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v", "libx264", "-crf", "20", "-pix_fmt", "yuv420p",
               "-movflags", "+faststart", str(path)]
    done = subprocess.run(command, input=b"".join(frames), capture_output=True, check=False)
    if done.returncode != 0:
        raise AnimationError(f"{path}: ffmpeg failed: {done.stderr.decode(errors='replace').strip()}")


def write_animation(frames: Sequence[bytes], path: Path, rate: float) -> None:
    """Frames are JPEGs of one size; `rate` in frames a second; the path's ending chooses the format."""
    {"gif": write_gif, "mp4": write_mp4}[path.suffix.removeprefix(".")](frames, path, rate)
