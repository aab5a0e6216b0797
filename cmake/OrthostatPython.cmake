# The Python package, which calls the shared library: in <build>/python as it is installed.
option(ORTHOSTAT_PYTHON "Make the Python package, where Python 3 with cffi and numpy is found" ON)

# Debian's own Python first: it is the one that has Debian's packages.
find_program(ORTHOSTAT_PYTHON3 python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(ORTHOSTAT_PYTHON3 python3)
mark_as_advanced(ORTHOSTAT_PYTHON3)
set(orthostat_python OFF)
if(ORTHOSTAT_PYTHON AND BUILD_SHARED_LIBS AND ORTHOSTAT_PYTHON3)
  execute_process(COMMAND ${ORTHOSTAT_PYTHON3} -c "import cffi, numpy, sys; print('%d.%d' % sys.version_info[:2])"
                  RESULT_VARIABLE failed OUTPUT_VARIABLE orthostat_python_version ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed)
    message(STATUS "No Python package: ${ORTHOSTAT_PYTHON3} has no cffi or numpy (apt-get install python3-cffi python3-numpy)")
  else()
    set(orthostat_python ON)
  endif()
endif()
if(NOT orthostat_python)
  return()
endif()

set(orthostat_python_folder "${CMAKE_BINARY_DIR}/python/orthostat")
set(orthostat_soname "liborthostat.so.${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
file(GLOB orthostat_python_sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/python/orthostat/*.py")
file(GLOB orthostat_python_headers CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/include/orthostat/*.h")

# Where the library is, seen from the package: as built here, and as installed in PREFIX/lib/python*/*-packages/orthostat.
set(orthostat_python_library "../../${orthostat_soname}")
configure_file(cmake/location.py.in "${orthostat_python_folder}/_location.py" @ONLY)
set(orthostat_python_library "../../../../${CMAKE_INSTALL_LIBDIR}/${orthostat_soname}")
configure_file(cmake/location.py.in "${CMAKE_BINARY_DIR}/python/installed/_location.py" @ONLY)

set(orthostat_python_made)
foreach(source IN LISTS orthostat_python_sources)
  get_filename_component(name ${source} NAME)
  add_custom_command(OUTPUT "${orthostat_python_folder}/${name}"
                     COMMAND ${CMAKE_COMMAND} -E copy "${source}" "${orthostat_python_folder}/${name}" DEPENDS "${source}")
  list(APPEND orthostat_python_made "${orthostat_python_folder}/${name}")
endforeach()
list(TRANSFORM MPI_C_INCLUDE_DIRS PREPEND "-I" OUTPUT_VARIABLE orthostat_python_flags)
add_custom_command(OUTPUT "${orthostat_python_folder}/_declarations.py"
                   COMMAND ${ORTHOSTAT_PYTHON3} "${CMAKE_CURRENT_SOURCE_DIR}/python/declare" ${CMAKE_C_COMPILER}
                           "${CMAKE_CURRENT_SOURCE_DIR}/include" "${orthostat_python_folder}/_declarations.py"
                           ${orthostat_python_flags}
                   DEPENDS python/declare ${orthostat_python_headers} VERBATIM)
add_custom_target(orthostat_python ALL DEPENDS ${orthostat_python_made} "${orthostat_python_folder}/_declarations.py")
add_dependencies(orthostat_python orthostat)
