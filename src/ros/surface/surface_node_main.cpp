#include "ros/live/run_node.h"
#include "ros/surface/surface_node.h"

int main(int argc, char** argv) {
  return particle_surface_tracker::run_node<particle_surface_tracker::SurfaceNode>(argc, argv, "implicit_surface");
}
