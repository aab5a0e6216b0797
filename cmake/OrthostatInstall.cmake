include(CMakePackageConfigHelpers)

install(TARGETS orthostat EXPORT OrthostatTargets)
if(TARGET orthostat_program)
  install(TARGETS orthostat_program)
endif()
install(DIRECTORY include/orthostat DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
