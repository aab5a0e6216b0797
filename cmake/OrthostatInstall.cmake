# cmake --install: the library, its headers, the program, and the files by which other projects find them.
include(CMakePackageConfigHelpers)

install(TARGETS orthostat EXPORT OrthostatTargets)
if(TARGET orthostat_program)
  install(TARGETS orthostat_program)
  install(PROGRAMS scripts/plot-cost scripts/plot-effects scripts/plot-scale scripts/plot-verify DESTINATION ${CMAKE_INSTALL_DATADIR}/orthostat)
  install(PROGRAMS examples/cluster/orthostat.sbatch DESTINATION ${CMAKE_INSTALL_DATADIR}/orthostat)
  install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/orthostat)
endif()
install(DIRECTORY include/orthostat DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

set(orthostat_cmake_folder "${CMAKE_INSTALL_LIBDIR}/cmake/Orthostat")
install(EXPORT OrthostatTargets NAMESPACE Orthostat:: DESTINATION ${orthostat_cmake_folder})
configure_package_config_file(cmake/OrthostatConfig.cmake.in "${CMAKE_CURRENT_BINARY_DIR}/OrthostatConfig.cmake"
                              INSTALL_DESTINATION ${orthostat_cmake_folder})
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/OrthostatConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/OrthostatConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/OrthostatConfigVersion.cmake"
              cmake/OrthostatDependencies.cmake DESTINATION ${orthostat_cmake_folder})

pkg_search_module(ORTHOSTAT_MPI mpi-c ompi-c mpich)

# pkg-config. Programs that use the shared library link nothing of what stands below it; the static one brings it all.
set(orthostat_pc_below)
foreach(below IN ITEMS Trilinos MUMPS METIS YAML JSON ZLIB)
  get_target_property(libraries Orthostat::${below} INTERFACE_LINK_LIBRARIES)
  list(APPEND orthostat_pc_below ${libraries})
endforeach()
list(APPEND orthostat_pc_below ${LAPACK_LIBRARIES} -lm)
list(JOIN orthostat_pc_below " " orthostat_pc_below)
if(BUILD_SHARED_LIBS)
  set(orthostat_pc_fields "Requires.private: ${ORTHOSTAT_HDF5_MODULE_NAME}\nLibs.private: ${orthostat_pc_below}")
else()
  set(orthostat_pc_requires " ${ORTHOSTAT_HDF5_MODULE_NAME}")
  set(orthostat_pc_libs " ${orthostat_pc_below}")
endif()
set(orthostat_pc_folder "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig")
file(RELATIVE_PATH orthostat_pc_prefix "${orthostat_pc_folder}" "${CMAKE_INSTALL_PREFIX}")
configure_file(cmake/orthostat.pc.in "${CMAKE_CURRENT_BINARY_DIR}/orthostat.pc" @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/orthostat.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
