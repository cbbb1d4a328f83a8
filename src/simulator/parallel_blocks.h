#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

namespace particle_surface_tracker::simulator {

/// Particles per task. Fixed, so that sums are split in the same way for any number of threads.
inline constexpr std::size_t block_size = 512;

inline std::size_t block_count(std::size_t particles) {
  return (particles + block_size - 1) / block_size;
}

/// Calls visit(block, begin, end) for blocks of particles, in parallel.
template <class Visit>
void for_each_block(std::size_t particles, const Visit& visit) {
  tbb::parallel_for(std::size_t{0}, block_count(particles), [&](std::size_t block) {
    visit(block, block * block_size, std::min(particles, (block + 1) * block_size));
  });
}

/// Calls visit(i) for all particles, in parallel.
template <class Visit>
void for_each_particle(std::size_t particles, const Visit& visit) {
  for_each_block(particles, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) visit(i);
  });
}

/// The sum of term(i) over all particles, in an order that does not depend on the threads.
template <class Term>
double sum_over_particles(std::size_t particles, const Term& term) {
  std::vector<double> sums(block_count(particles), 0.0);
  for_each_block(particles, [&](std::size_t block, std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += term(i);
    sums[block] = sum;
  });
  double total = 0.0;
  for (const double sum : sums) total += sum;
  return total;
}

}  // namespace particle_surface_tracker::simulator
