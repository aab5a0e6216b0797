# cpack: a Debian package of what cmake --install leaves (scripts/package).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME orthostat)
set(CPACK_PACKAGE_VENDOR "The Orthostat authors")
set(CPACK_PACKAGE_CONTACT "The Orthostat authors <orthostat@localhost>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Orthostat computes the displacement of orthotropic solids at rest under load:
wood, muscle, plants, bone, composites. A program, a C library with its headers,
and a package for Python, over Trilinos, MUMPS, METIS and parallel HDF5.")
if(ORTHOSTAT_NATIVE)
  string(APPEND CPACK_DEBIAN_PACKAGE_DESCRIPTION
         "\n.\nThis build is for the processor of the machine that made it, and may not run on others.")
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
# What program and library are linked to, dpkg-shlibdeps finds; what they start, and what Python wants, it cannot know.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS openmpi-bin)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-cffi-backend, python3-numpy, python3-matplotlib")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "paraview, gmsh, python3-mpi4py")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY "=")
include(CPack)
