# cmake --install: the library, its headers, the program, and the files by which other projects find them.
include(CMakePackageConfigHelpers)

install(TARGETS orthostat EXPORT OrthostatTargets)
if(TARGET orthostat_program)
  install(TARGETS orthostat_program)
  install(PROGRAMS scripts/plot-cost scripts/plot-effects scripts/plot-mesh scripts/plot-scale
          scripts/plot-sweep scripts/plot-verify DESTINATION ${CMAKE_INSTALL_DATADIR}/orthostat)
  install(PROGRAMS examples/cluster/orthostat.sbatch DESTINATION ${CMAKE_INSTALL_DATADIR}/orthostat)
  install(FILES scripts/picture_numbers.py scripts/plotting.py DESTINATION ${CMAKE_INSTALL_DATADIR}/orthostat)
  install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/orthostat)
  install(CODE "execute_process(COMMAND \"${CMAKE_CURRENT_SOURCE_DIR}/scripts/help-files\" \"$<TARGET_FILE:orthostat_program>\"
                  \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}\" RESULT_VARIABLE failed)
    if(failed)
      message(WARNING \"Without man pages and completion of bash: scripts/help-files failed\")
    endif()")
endif()
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY include/orthostat DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

# Python looks for packages in lib/python3/dist-packages of /usr, and in lib/python3.X/dist-packages of /usr/local; of other
# prefixes it is told by PYTHONPATH. Which it is, is known when it is installed.
if(orthostat_python)
  install(CODE "set(orthostat_python_version ${orthostat_python_version})
    set(orthostat_python_made \"${CMAKE_BINARY_DIR}/python\")")
  install(CODE [[
    set(folder "lib/python3/dist-packages/orthostat")
    if(CMAKE_INSTALL_PREFIX STREQUAL "/usr/local")
      set(folder "lib/python${orthostat_python_version}/dist-packages/orthostat")
    endif()
    file(INSTALL DESTINATION "${CMAKE_INSTALL_PREFIX}/${folder}" TYPE DIRECTORY FILES "${orthostat_python_made}/orthostat/"
         FILES_MATCHING PATTERN "*.py" PATTERN "_location.py" EXCLUDE PATTERN "__pycache__" EXCLUDE)
    file(INSTALL DESTINATION "${CMAKE_INSTALL_PREFIX}/${folder}" TYPE FILE FILES
         "${orthostat_python_made}/installed/_location.py")
  ]])
endif()

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
set(orthostat_pc_targets Trilinos MUMPS METIS YAML JSON ZLIB)
if(orthostat_exodus)
  list(APPEND orthostat_pc_targets NetCDF)
endif()
foreach(below IN LISTS orthostat_pc_targets)
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
