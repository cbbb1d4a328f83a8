# Makes the target OpenVDB::openvdb: by OpenVDB's own find module where the distribution ships it, else by hand.

if(NOT TARGET OpenVDB::openvdb)
  file(GLOB _openvdb_modules /usr/lib/*/cmake/OpenVDB)
  list(APPEND CMAKE_MODULE_PATH ${_openvdb_modules})
  find_package(OpenVDB QUIET MODULE)
endif()

if(NOT TARGET OpenVDB::openvdb)
  find_path(OPENVDB_INCLUDE openvdb/openvdb.h)
  find_library(OPENVDB_LIBRARY openvdb)
  find_library(OPENVDB_HALF_LIBRARY NAMES Imath-3_1 Imath Half)
  if(OPENVDB_INCLUDE AND OPENVDB_LIBRARY AND OPENVDB_HALF_LIBRARY)
    add_library(OpenVDB::openvdb UNKNOWN IMPORTED)
    set_target_properties(OpenVDB::openvdb PROPERTIES IMPORTED_LOCATION ${OPENVDB_LIBRARY}
      INTERFACE_INCLUDE_DIRECTORIES ${OPENVDB_INCLUDE} INTERFACE_LINK_LIBRARIES "${OPENVDB_HALF_LIBRARY};TBB::tbb")
  endif()
endif()

include(FindPackageHandleStandardArgs)
if(TARGET OpenVDB::openvdb)
  set(OpenVDBTarget_READY TRUE)
endif()
find_package_handle_standard_args(OpenVDBTarget REQUIRED_VARS OpenVDBTarget_READY)
