# Libraries that the layers above ros need. Each is listed with its reason in the README.

# Not where ROS is turned off: catkin does more than look whether it is there.
if(NOT DEFINED PST_WITH_ROS OR PST_WITH_ROS)
  # Before catkin is asked for the first time: it keeps the environment that it finds then, in which tests in Python
  # import our messages from here.
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/devel/lib/python3/dist-packages)
  find_package(catkin QUIET)
endif()
set(PST_CATKIN_FOUND ${catkin_FOUND})

find_package(Eigen3 3.3 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(assimp REQUIRED)
find_package(CGAL REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json 3 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(OpenVDBTarget REQUIRED)
