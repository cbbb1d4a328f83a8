#include "parameter_agreement.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

void require_agreement(const Parameters& checkpoint, const Parameters& given, Agreement agreement, bool any_spacing) {
  std::vector<std::string> differences;
  for (const ParameterInfo& info : parameter_table()) {
    if (any_spacing && info.name == "particle_spacing") continue;
    if (agreement == Agreement::kWhatNeedsReset && !info.needs_reset) continue;
    const std::string before = get_parameter(checkpoint, info.name);
    const std::string now = get_parameter(given, info.name);
    if (before != now) differences.push_back(fmt::format("{} is {} there and {} here", info.name, before, now));
  }
  if (differences.empty()) return;
  throw ParameterError(
      fmt::format("the checkpoint was written with other parameters: {}", fmt::join(differences, "; ")));
}

}  // namespace particle_surface_tracker
