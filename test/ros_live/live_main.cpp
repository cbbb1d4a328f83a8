// main() of the tests of nodelets in a manager of the program itself.

#include "ros_live/live_node_test.h"

int main(int argc, char** argv) {
  return particle_surface_tracker::test::run_live_tests(argc, argv);
}
