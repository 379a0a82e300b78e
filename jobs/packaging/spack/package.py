# A recipe for Spack. Put it into the repository packages/sphdrop of a Spack repository of your own.
from spack.package import *


class Sphdrop(CMakePackage):
    """Droplet impact on elastic beams by smoothed particle hydrodynamics, in two dimensions, distributed by MPI, with the
    same bits on any number of ranks."""

    homepage = "https://example.org/sphdrop"
    git = "https://example.org/sphdrop.git"

    version("main", branch="main")

    variant("tests", default=False, description="build the tests and benchmarks")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("mpi@3:")
    depends_on("hdf5@1.10:+mpi")
    depends_on("metis@5.1:")
    depends_on("xxhash@0.8:")
    depends_on("eigen@3.4:")
    depends_on("fmt@9:")
    depends_on("cli11@2:")
    depends_on("toml11@3.7:3")
    depends_on("googletest", when="+tests")
    depends_on("benchmark", when="+tests")
    depends_on("python@3.11:", type="run")
    depends_on("py-numpy", type="run")
    depends_on("py-h5py", type="run")
    depends_on("py-matplotlib", type="run")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define_from_variant("SPHDROP_TESTS", "tests"),
            self.define("SPHDROP_BENCHMARKS", self.spec.satisfies("+tests")),
            # Spack's compiler wrappers choose the instruction set of the target.
            self.define("SPHDROP_ARCH", ""),
        ]
