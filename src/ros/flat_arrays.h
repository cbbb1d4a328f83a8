#pragma once

#include <vector>

namespace particle_surface_tracker {

/// The numbers of triples in one array, as messages carry them.
template <typename Number, typename Triple>
std::vector<Number> flat(const std::vector<Triple>& triples) {
  std::vector<Number> numbers;
  numbers.reserve(3 * triples.size());
  for (const Triple& triple : triples) numbers.insert(numbers.end(), {triple[0], triple[1], triple[2]});
  return numbers;
}

}  // namespace particle_surface_tracker
