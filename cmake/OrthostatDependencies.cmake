# Finds what Orthostat stands on, and says in words what to install when something is missing.
find_package(PkgConfig REQUIRED)
find_package(MPI REQUIRED COMPONENTS C)

function(orthostat_missing what package)
  message(FATAL_ERROR "Orthostat needs ${what}, which was not found. On Debian or Ubuntu: apt-get install ${package} "
                      "(scripts/setup installs everything).")
endfunction()

# Where a library may be beside CMAKE_PREFIX_PATH, which Spack sets: by the variables of environment modules (METIS_ROOT,
# METIS_DIR, METIS_HOME, TACC_METIS_DIR) and of EasyBuild (EBROOTMETIS).
function(orthostat_places name places)
  string(TOUPPER ${name} upper)
  set(found "${${upper}_ROOT}" "${${upper}_DIR}")
  foreach(variable IN ITEMS ${upper}_ROOT ${upper}_DIR ${upper}_HOME ${upper}_PATH ${upper}DIR EBROOT${upper} TACC_${upper}_DIR OLCF_${upper}_ROOT)
    list(APPEND found "$ENV{${variable}}")
  endforeach()
  list(REMOVE_ITEM found "")
  set(${places} ${found} PARENT_SCOPE)
endfunction()

# Imported target Orthostat::<name> from one header and some libraries. MODULE: the name that modules know it by.
function(orthostat_find name what package header libraries)
  cmake_parse_arguments(PARSE_ARGV 5 given "" "MODULE" "ALSO")
  set(module ${name})
  if(given_MODULE)
    set(module ${given_MODULE})
  endif()
  orthostat_places(${module} places)
  find_path(ORTHOSTAT_${name}_INCLUDE ${header} HINTS ${places} PATH_SUFFIXES include include/trilinos trilinos)
  set(found)
  foreach(library IN LISTS libraries)
    string(REGEX REPLACE "^trilinos_" "" unprefixed ${library}) # Debian puts the project's name in front
    find_library(ORTHOSTAT_${name}_${library} NAMES ${library} ${unprefixed} NAMES_PER_DIR HINTS ${places} PATH_SUFFIXES lib lib64)
    if(NOT ORTHOSTAT_${name}_${library})
      orthostat_missing("${what} (library ${library})" ${package})
    endif()
    mark_as_advanced(ORTHOSTAT_${name}_${library})
    list(APPEND found ${ORTHOSTAT_${name}_${library}})
  endforeach()
  foreach(library IN LISTS given_ALSO) # what a static library of other builds stands on; shared ones bring it
    string(REGEX REPLACE "^trilinos_" "" unprefixed ${library})
    find_library(ORTHOSTAT_${name}_${library} NAMES ${library} ${unprefixed} NAMES_PER_DIR HINTS ${places} PATH_SUFFIXES lib lib64)
    mark_as_advanced(ORTHOSTAT_${name}_${library})
    list(GET found 0 first)
    if(ORTHOSTAT_${name}_${library} AND first MATCHES "\\.a$")
      list(APPEND found ${ORTHOSTAT_${name}_${library}})
    endif()
  endforeach()
  if(NOT ORTHOSTAT_${name}_INCLUDE)
    orthostat_missing("${what} (header ${header})" ${package})
  endif()
  mark_as_advanced(ORTHOSTAT_${name}_INCLUDE)
  add_library(Orthostat::${name} INTERFACE IMPORTED)
  set_target_properties(Orthostat::${name} PROPERTIES INTERFACE_LINK_LIBRARIES "${found}"
                        INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${ORTHOSTAT_${name}_INCLUDE}"
                        INTERFACE_INCLUDE_DIRECTORIES "${ORTHOSTAT_${name}_INCLUDE}")
endfunction()

orthostat_find(METIS "METIS" libmetis-dev metis.h "metis")
find_package(LAPACK QUIET)
if(NOT LAPACK_FOUND)
  orthostat_missing("LAPACK" liblapack-dev)
endif()
add_library(Orthostat::LAPACK INTERFACE IMPORTED)
set_target_properties(Orthostat::LAPACK PROPERTIES INTERFACE_LINK_LIBRARIES LAPACK::LAPACK)
orthostat_find(Trilinos "Trilinos (Epetra, AztecOO, ML, Amesos)"
               "libtrilinos-epetra-dev libtrilinos-aztecoo-dev libtrilinos-ml-dev libtrilinos-amesos-dev" ml_include.h
               "trilinos_ml;trilinos_amesos;trilinos_aztecoo;trilinos_epetra"
               ALSO trilinos_ifpack trilinos_epetraext trilinos_galeri trilinos_teuchoscomm trilinos_teuchosparameterlist
                    trilinos_teuchoscore)
orthostat_find(MUMPS "MUMPS" libmumps-dev dmumps_c.h "dmumps" ALSO mumps_common pord scalapack)
orthostat_find(YAML "libyaml" libyaml-dev yaml.h "yaml" MODULE LIBYAML)
orthostat_find(JSON "Jansson" libjansson-dev jansson.h "jansson" MODULE JANSSON)
orthostat_find(ZLIB "zlib" zlib1g-dev zlib.h "z")

# Debian has parallel HDF5 under names of its own, beside a serial one; elsewhere it is the HDF5 that is found first.
pkg_search_module(ORTHOSTAT_HDF5 IMPORTED_TARGET hdf5-openmpi hdf5-mpich hdf5-mpi)
if(ORTHOSTAT_HDF5_FOUND)
  add_library(Orthostat::HDF5 ALIAS PkgConfig::ORTHOSTAT_HDF5)
else()
  set(HDF5_PREFER_PARALLEL TRUE)
  find_package(HDF5 COMPONENTS C)
  if(NOT HDF5_FOUND OR NOT HDF5_IS_PARALLEL)
    orthostat_missing("parallel HDF5" libhdf5-openmpi-dev)
  endif()
  add_library(Orthostat::HDF5 INTERFACE IMPORTED)
  set_target_properties(Orthostat::HDF5 PROPERTIES INTERFACE_LINK_LIBRARIES "${HDF5_C_LIBRARIES}"
                        INTERFACE_INCLUDE_DIRECTORIES "${HDF5_C_INCLUDE_DIRS}")
endif()

# netCDF, if there is one over a parallel HDF5: with a serial one a second HDF5 would come into the process. Debian has it in
# folders of its own.
add_library(Orthostat::NetCDF INTERFACE IMPORTED)
set(orthostat_exodus OFF)
if(NOT DEFINED ORTHOSTAT_EXODUS OR ORTHOSTAT_EXODUS)
  orthostat_places(NETCDF places)
  find_path(ORTHOSTAT_NetCDF_INCLUDE netcdf_meta.h HINTS ${places} "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/netcdf/mpi" PATH_SUFFIXES include)
  find_library(ORTHOSTAT_NetCDF_library NAMES netcdf_mpi netcdf NAMES_PER_DIR HINTS ${places} PATH_SUFFIXES lib lib64)
  mark_as_advanced(ORTHOSTAT_NetCDF_INCLUDE ORTHOSTAT_NetCDF_library)
  if(ORTHOSTAT_NetCDF_INCLUDE AND ORTHOSTAT_NetCDF_library)
    file(STRINGS "${ORTHOSTAT_NetCDF_INCLUDE}/netcdf_meta.h" orthostat_parallel REGEX "NC_HAS_PARALLEL4[ \t]+1")
  endif()
  if(orthostat_parallel)
    set(orthostat_exodus ON)
    set_target_properties(Orthostat::NetCDF PROPERTIES INTERFACE_LINK_LIBRARIES "${ORTHOSTAT_NetCDF_library}"
                          INTERFACE_INCLUDE_DIRECTORIES "${ORTHOSTAT_NetCDF_INCLUDE}")
  else()
    message(STATUS "Exodus II files will not be read: no netCDF over a parallel HDF5 (Debian: libnetcdf-mpi-dev)")
  endif()
endif()
