#include "audience.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace particle_surface_tracker::simulator {

bool Audience::is_complete() const {
  if (expected_.empty()) return !present_.empty();
  return std::includes(present_.begin(), present_.end(), expected_.begin(), expected_.end());
}

std::string Audience::missing() const {
  if (expected_.empty()) return "any subscriber";
  std::vector<std::string> names;
  std::set_difference(expected_.begin(), expected_.end(), present_.begin(), present_.end(), std::back_inserter(names));
  return fmt::format("{}", fmt::join(names, " and "));
}

}  // namespace particle_surface_tracker::simulator
