# SPDX-License-Identifier: BSD-3-Clause
# spack repo add packaging/spack && spack dev-build orthostat@0.1.0      (in the folder of the sources)
from spack.package import *


class Orthostat(CMakePackage):
    """Static poses of orthotropic solids on tetrahedral meshes: a program, a C library, and a package for Python."""

    license("BSD-3-Clause")
    version("0.1.0")
    variant("python", default=True, description="Make the Python package")
    variant("exodus", default=True, description="Read Exodus II meshes")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.18:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("mpi")
    depends_on("trilinos@13.2:16 +mpi +shared +epetra +aztecoo +ml +amesos")  # 17 has none of these four
    depends_on("mumps +mpi")
    depends_on("metis@5:")
    depends_on("hdf5 +mpi")
    depends_on("netcdf-c@4.8: +mpi", when="+exodus")
    depends_on("lapack")
    depends_on("libyaml")
    depends_on("jansson")
    depends_on("zlib-api")
    extends("python", when="+python")
    depends_on("py-cffi", when="+python", type=("build", "run"))
    depends_on("py-numpy", when="+python", type=("build", "run"))

    def cmake_args(self):
        # Spack compiles for its own target.
        args = [self.define("BUILD_TESTING", False), self.define("ORTHOSTAT_NATIVE", False),
                self.define_from_variant("ORTHOSTAT_PYTHON", "python"),
                self.define_from_variant("ORTHOSTAT_EXODUS", "exodus")]
        if self.spec.satisfies("+python"):
            args.append(self.define("ORTHOSTAT_PYTHON3", self.spec["python"].command.path))
        return args

    def setup_run_environment(self, env):
        if self.spec.satisfies("+python"):
            env.prepend_path("PYTHONPATH", self.prefix.lib.python3.join("dist-packages"))
