#include "kernel.h"

namespace particle_surface_tracker::simulator {

double volume_on_grid(const Kernel& kernel, double spacing) {
  const int reach = static_cast<int>(std::ceil(kernel.radius() / spacing));
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      for (int k = -reach; k <= reach; ++k) sum += kernel.value(spacing * std::sqrt(i * i + j * j + k * k));
    }
  }
  return 1.0 / sum;
}

}  // namespace particle_surface_tracker::simulator
