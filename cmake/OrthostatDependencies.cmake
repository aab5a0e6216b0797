# Finds what Orthostat stands on, and says in words what to install when something is missing.
find_package(PkgConfig REQUIRED)
find_package(MPI REQUIRED COMPONENTS C)

function(orthostat_missing what package)
  message(FATAL_ERROR "Orthostat needs ${what}, which was not found. On Debian or Ubuntu: apt-get install ${package} "
                      "(scripts/setup installs everything).")
endfunction()

# Imported target Orthostat::<name> from one header and some libraries.
function(orthostat_find name what package header libraries)
  find_path(ORTHOSTAT_${name}_INCLUDE ${header} PATH_SUFFIXES trilinos)
  set(found)
  foreach(library IN LISTS libraries)
    string(REGEX REPLACE "^trilinos_" "" unprefixed ${library}) # Debian puts the project's name in front
    find_library(ORTHOSTAT_${name}_${library} NAMES ${library} ${unprefixed})
    if(NOT ORTHOSTAT_${name}_${library})
      orthostat_missing("${what} (library ${library})" ${package})
    endif()
    mark_as_advanced(ORTHOSTAT_${name}_${library})
    list(APPEND found ${ORTHOSTAT_${name}_${library}})
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
               "trilinos_ml;trilinos_amesos;trilinos_aztecoo;trilinos_epetra")
orthostat_find(MUMPS "MUMPS" libmumps-dev dmumps_c.h "dmumps")
orthostat_find(YAML "libyaml" libyaml-dev yaml.h "yaml")
orthostat_find(JSON "Jansson" libjansson-dev jansson.h "jansson")
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
