"""The recipe by which Spack builds mudline and what it links; docs/developer_guide.md says how it is used."""
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Mudline(CMakePackage):
    """Large-deformation dynamics of saturated porous media on Trilinos: piles, anchors and penetrometers in soil."""

    license("BSD-3-Clause")

    version("0.2.0")

    variant("gmsh", default=True, description="Meshes from Gmsh's files and geometries (GPL)")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("cli11", type="build")
    depends_on("googletest+gmock", type="test")

    depends_on("mpi")
    depends_on("trilinos@13.2:+mpi+tpetra+belos+muelu+ifpack2+amesos2+nox cxxstd=17")
    depends_on("mumps+mpi")
    depends_on("metis")
    depends_on("hdf5+mpi")
    depends_on("tinyxml2")
    depends_on("muparser")
    depends_on("gmsh", when="+gmsh")

    depends_on("python@3.9:", type=("build", "run"))
    with default_args(type="run"):
        depends_on("py-numpy")
        depends_on("py-h5py")
        depends_on("py-matplotlib")

    def cmake_args(self):
        return [self.define_from_variant("MUDLINE_GMSH", "gmsh"), self.define("MUDLINE_TESTS", self.run_tests)]
