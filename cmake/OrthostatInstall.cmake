# cmake --install: the library, its headers, the program, and the files by which other projects find them.
include(CMakePackageConfigHelpers)

install(TARGETS orthostat EXPORT OrthostatTargets)
if(TARGET orthostat_program)
  install(TARGETS orthostat_program)
  install(PROGRAMS scripts/plot-cost scripts/plot-verify DESTINATION ${CMAKE_INSTALL_DATADIR}/orthostat)
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

configure_file(cmake/orthostat.pc.in "${CMAKE_CURRENT_BINARY_DIR}/orthostat.pc" @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/orthostat.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
