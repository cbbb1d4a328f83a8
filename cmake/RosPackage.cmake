# The catkin side of the package.

find_package(catkin REQUIRED COMPONENTS
  diagnostic_msgs diagnostic_updater dynamic_reconfigure message_generation nodelet pluginlib rosbag_storage roscpp
  roscpp_serialization roslz4 rostime sensor_msgs shape_msgs std_msgs std_srvs topic_tools visualization_msgs)

add_message_files(FILES InterpolatedField.msg ParticleSurface.msg TrackedMesh.msg TrackerStatus.msg)
add_service_files(FILES CheckpointFile.srv SaveMesh.srv)
generate_messages(DEPENDENCIES std_msgs)
generate_dynamic_reconfigure_options(cfg/Tracker.cfg)

# Packages that use our headers also compile OpenVDB's, and call it and TBB from there.
find_library(PST_OPENVDB_LIBRARY openvdb)
find_library(PST_TBB_LIBRARY tbb)
set(PST_HEADERS_LIBRARIES ${PST_OPENVDB_LIBRARY} ${PST_TBB_LIBRARY})

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES ${PROJECT_NAME} ${PROJECT_NAME}_ros ${PROJECT_NAME}_live
  CATKIN_DEPENDS diagnostic_updater dynamic_reconfigure message_runtime nodelet rosbag_storage roscpp roslz4 sensor_msgs
    shape_msgs std_msgs std_srvs topic_tools visualization_msgs
  DEPENDS EIGEN3 PST_HEADERS)

set(PST_LIB_DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
set(PST_BIN_DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
set(PST_INCLUDE_DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION}/${PROJECT_NAME})

install(DIRECTORY config examples launch rviz DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(FILES nodelet_plugins.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
