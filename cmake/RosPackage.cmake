# The catkin side of the package.

# Before find_package: catkin caches its environment at the first configure, and a Python rostest imports messages from here.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/devel/lib/python3/dist-packages)

find_package(catkin REQUIRED COMPONENTS message_generation rosbag_storage roslz4 sensor_msgs std_msgs)

add_message_files(FILES TrackedMesh.msg)
generate_messages(DEPENDENCIES std_msgs)

# Packages that use our headers also compile OpenVDB's, and call it and TBB from there.
find_library(PST_OPENVDB_LIBRARY openvdb)
find_library(PST_TBB_LIBRARY tbb)
set(PST_HEADERS_LIBRARIES ${PST_OPENVDB_LIBRARY} ${PST_TBB_LIBRARY})

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES ${PROJECT_NAME} ${PROJECT_NAME}_ros
  CATKIN_DEPENDS message_runtime rosbag_storage roslz4 sensor_msgs std_msgs
  DEPENDS EIGEN3 PST_HEADERS)

set(PST_LIB_DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
set(PST_BIN_DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
set(PST_INCLUDE_DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION}/${PROJECT_NAME})

install(DIRECTORY config DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
