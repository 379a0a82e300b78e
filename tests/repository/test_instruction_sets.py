"""The program for several instruction sets: which it takes, that each gives the same bits, that no other code is for it.

The release build has the launcher, with stand-ins for what it starts, and the sweeps for AVX2 beside its own. With
SPHDROP_LONG_TESTS=1 in the environment the Debian package of the preset `package` is built, unpacked and run too, which
takes minutes.
"""

from __future__ import annotations

import functools
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from repository import ROOT, build_folder
from test_include_rules import includes_of, program_files

sys.path.insert(0, str(ROOT / "tests/support"))
from running_program import LONG, MPIEXEC, PROGRAM, little_case, state_hash  # noqa: E402

WIDTHS = {"x86-64": 2, "x86-64-v3": 4, "x86-64-v4": 8}
V3 = {"cx16", "lahf_lm", "popcnt", "pni", "ssse3", "sse4_1", "sse4_2", "avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe"}
V4 = V3 | {"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"}


@functools.cache
def of_this_processor() -> tuple[str, ...]:
    """The instruction sets that it has, by the names that the kernel gives their parts; the least first."""
    flags = set(re.findall(r"\w+", Path("/proc/cpuinfo").read_text(encoding="ascii").partition("flags")[2].partition("\n")[0]))
    return ("x86-64", *(("x86-64-v3",) if flags >= V3 else ()), *(("x86-64-v4",) if flags >= V4 else ()))


def call(*words: str | Path, code: int = 0, seconds: float = 120, **environment: str) -> subprocess.CompletedProcess[str]:
    known = {name: value for name, value in os.environ.items() if name not in ("SPHDROP_ARCH", "GLIBC_TUNABLES")}
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, timeout=seconds, env={**known, **environment})
    if done.returncode != code:
        raise AssertionError(f"{words} ends with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done


class VectorSources(unittest.TestCase):
    def test_they_are_those_that_see_the_width_of_vectors(self) -> None:
        """A source that was forgotten among them would have another width than those that it works with."""
        @functools.cache
        def sees_it(path: Path) -> bool:
            for mark, name in includes_of(path):
                if name == "experimental/simd" or name == "immintrin.h":
                    return True
                places = (Path(name), Path("src") / name) if mark == '"' else ()
                if any((ROOT / place).is_file() and sees_it(place) for place in places):
                    return True
            return False

        named = {Path(name) for name in os.environ["SPHDROP_VECTOR_SOURCES"].split(":")}
        seeing = {ROOT / path for path in program_files() if path.suffix == ".cpp" and sees_it(path)}
        self.assertEqual(named - {build_folder() / "io/build_info.cpp"}, seeing)
        self.assertGreater(len(seeing), 10)


    def test_they_have_no_masks(self) -> None:
        """clang 14 miscompiles those of std::experimental::simd for AVX-512, which no build of these tests would show."""
        mask = re.compile(r"simd_mask|\bmask_type\b|(?<![:\w])(?:where|(?:any|all|none|some)_of|popcount)\s*\(")
        self.assertTrue(mask.search("  where(is_far, x) = T(0.0);") and mask.search("if (none_of(near)) continue;"))
        self.assertFalse(mask.search("std::any_of(a, b, c)"))
        for path in program_files():
            text = (ROOT / path).read_text(encoding="utf-8")
            if "Pack" in text or "experimental/simd" in text:
                with self.subTest(path=path):
                    self.assertIsNone(mask.search(re.sub(r"//.*", "", text)))


@unittest.skipUnless("SPHDROP_LAUNCHER" in os.environ, "the processor cannot be asked here")
class Launcher(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = Path(folder.name) / "a tree"
        self.program = self.tree / "bin/sphdrop"
        self.program.parent.mkdir(parents=True)
        shutil.copy(os.environ["SPHDROP_LAUNCHER"], self.program)
        for arch in WIDTHS:
            stand_in = self.tree / "libexec/sphdrop" / arch / "sphdrop"
            stand_in.parent.mkdir(parents=True)
            stand_in.write_text(f'#!/bin/sh\nprintf "%s|" {arch} "$@"\nexit 5\n', encoding="ascii")
            stand_in.chmod(0o755)

    def test_takes_the_processors_best(self) -> None:
        self.assertEqual(call(self.program, "a b", "", "c", code=5).stdout, f"{of_this_processor()[-1]}|a b||c|")

    def test_is_found_through_a_link_and_by_name(self) -> None:
        link = self.tree / "elsewhere/sphdrop"
        link.parent.mkdir()
        link.symlink_to(self.program)
        self.assertEqual(call(link, code=5).stdout, f"{of_this_processor()[-1]}|")
        self.assertEqual(call("sphdrop", code=5, PATH=f"{link.parent}:{os.environ['PATH']}").stdout, f"{of_this_processor()[-1]}|")

    def test_a_lesser_processor_has_a_lesser_program(self) -> None:
        for lacking, best in (("AVX512VL", "x86-64-v3"), ("AVX512F", "x86-64-v3"), ("AVX2", "x86-64"), ("BMI2", "x86-64"), ("FMA", "x86-64")):
            with self.subTest(lacking=lacking):
                expected = min(best, of_this_processor()[-1], key=list(WIDTHS).index)
                tunables = f"glibc.cpu.hwcaps=-{lacking}"
                self.assertEqual(call(self.program, code=5, GLIBC_TUNABLES=tunables).stdout, f"{expected}|")
                if expected != "x86-64-v3":
                    done = call(self.program, code=2, GLIBC_TUNABLES=tunables, SPHDROP_ARCH="x86-64-v3")
                    self.assertEqual(done.stderr, "sphdrop: SPHDROP_ARCH=x86-64-v3: the processor does not have all of these instructions\n")

    def test_the_environment_chooses(self) -> None:
        for arch in of_this_processor():
            self.assertEqual(call(self.program, code=5, SPHDROP_ARCH=arch).stdout, f"{arch}|")
        self.assertEqual(call(self.program, code=5, SPHDROP_ARCH="").stdout, f"{of_this_processor()[-1]}|")

    def test_mistakes_are_told(self) -> None:
        done = call(self.program, code=2, SPHDROP_ARCH="avx")
        self.assertEqual(done.stderr, "sphdrop: SPHDROP_ARCH=avx: installed for x86-64 x86-64-v3 x86-64-v4\n")
        shutil.rmtree(self.tree / "libexec")
        done = call(self.program, code=1)
        self.assertRegex(done.stderr, rf"^sphdrop: cannot start .*/{of_this_processor()[-1]}/sphdrop: No such file or directory\n$")


class Bits(unittest.TestCase):
    """Of a drop that touches the beam, in the paper's scheme and in the two others."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.case = self.folder / "little.cfg"
        self.case.write_text(little_case(end=12e-6), encoding="utf-8")

    def run_case(self, program: str | Path, *, ranks: int = 1, mode: str = "paper", **environment: str) -> tuple[str, dict[str, object], str]:
        """The hash of the state, what run.json has of the build, and the history."""
        output = self.folder / "out"
        done = call(MPIEXEC, "-n", str(ranks), program, self.case, "--set", f'mode="{mode}"', "--output", output, **environment)
        build = json.loads((output / "run.json").read_text(encoding="utf-8"))["build"]
        self.assertIn(f"compiled for              {build['architecture']}, vectors of {build['vector_width']} doubles\n", done.stdout)
        return state_hash(done), build, (output / "history.csv").read_text(encoding="utf-8")

    @unittest.skipUnless("SPHDROP_FOR_V3" in os.environ and "x86-64-v3" in of_this_processor(), "not for this processor")
    def test_vectors_of_four_beside_the_builds_own(self) -> None:
        program = os.environ["SPHDROP_FOR_V3"]
        self.assertTrue(call(program, "--version").stdout.endswith(", x86-64-v3, vectors of 4 doubles\n"))
        for mode, numbers in {"paper": (1, 2), "modern": (2,), "fast": (2,)}.items():
            expected = self.run_case(PROGRAM, mode=mode)
            for ranks in numbers:
                with self.subTest(mode=mode, ranks=ranks):
                    found = self.run_case(program, mode=mode, ranks=ranks)
                    self.assertEqual((found[0], found[2]), (expected[0], expected[2]))
                    self.assertEqual((found[1]["architecture"], found[1]["vector_width"]), ("x86-64-v3", 4))

    @unittest.skipUnless(LONG and "SPHDROP_LAUNCHER" in os.environ, "takes minutes; SPHDROP_LONG_TESTS=1 runs it")
    def test_the_debian_package_at_all_widths(self) -> None:
        build = self.folder / "build"
        call("cmake", "--preset", "package", "-S", ROOT, "-B", build, seconds=120)
        call("cmake", "--build", build, "--parallel", str(os.cpu_count()), seconds=3000)
        call("cpack", "--config", build / "CPackConfig.cmake", "-B", self.folder, seconds=120)
        (package,) = self.folder.glob("sphdrop_*.deb")
        contents = call("dpkg-deb", "--contents", package).stdout
        needed = call("dpkg-deb", "--field", package, "Depends").stdout
        for path in ("usr/bin/sphdrop", *(f"usr/libexec/sphdrop/{arch}/sphdrop" for arch in WIDTHS)):
            self.assertIn(f" ./{path}\n", contents)
        for name in ("libfmt9", "libhdf5-openmpi-103", "libmetis5", "libopenmpi3"):
            self.assertIn(name, needed)
        call("dpkg-deb", "--extract", package, self.folder / "root")
        program = self.folder / "root/usr/bin/sphdrop"
        self.assertIn(f", {of_this_processor()[-1]}, ", call(program, "--version").stdout)
        for arch, registers in zip(WIDTHS, ({"xmm"}, {"xmm", "ymm"}, {"xmm", "ymm", "zmm"}), strict=True):
            code = call("objdump", "--disassemble", "--no-show-raw-insn", self.folder / f"root/usr/libexec/sphdrop/{arch}/sphdrop").stdout
            self.assertEqual(set(re.findall(r"%([xyz]mm)", code)), registers, arch)
        for mode in ("paper", "modern", "fast"):
            expected = self.run_case(PROGRAM, mode=mode)
            for arch in of_this_processor():
                for ranks in (1, 2):
                    with self.subTest(mode=mode, arch=arch, ranks=ranks):
                        found = self.run_case(program, mode=mode, ranks=ranks, SPHDROP_ARCH=arch)
                        self.assertEqual((found[0], found[2]), (expected[0], expected[2]))
                        self.assertEqual((found[1]["architecture"], found[1]["vector_width"]), (arch, WIDTHS[arch]))


if __name__ == "__main__":
    unittest.main()
