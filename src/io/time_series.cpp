#include "particle_surface_tracker/io/time_series.h"

#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "file_bytes.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

constexpr const char* kHead = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
constexpr const char* kTail = "</Collection>\n</VTKFile>\n";

/// The file that a line of the list names; empty if it names none.
std::string file_in(const std::string& line) {
  constexpr std::string_view kBefore = "file=\"";
  const std::size_t found = line.find(kBefore);
  if (found == std::string::npos) return {};
  const std::size_t begin = found + kBefore.size();
  return line.substr(begin, line.find('"', begin) - begin);
}

}  // namespace

TimeSeries::TimeSeries(const std::string& folder) : path_((std::filesystem::path(folder) / "frames.pvd").string()) {}

TimeSeries::TimeSeries(const std::string& folder, std::uint64_t next) : TimeSeries(folder) {
  std::istringstream lines(read_file(path_));
  for (std::string line; std::getline(lines, line);) {
    unsigned long long frame = 0;
    if (std::sscanf(file_in(line).c_str(), "frame_%llu.", &frame) == 1 && frame < next) lines_.push_back(line + '\n');
  }
  if (lines_.empty()) throw InputError(fmt::format("'{}' has no frame before frame {}", path_, next));
}

void TimeSeries::add(const std::string& file, std::int64_t stamp_ns) {
  constexpr std::int64_t kSecond = 1000000000;
  // As text, because a double does not hold all digits of a stamp.
  lines_.push_back(fmt::format("<DataSet timestep=\"{}.{:09}\" part=\"0\" file=\"{}\"/>\n", stamp_ns / kSecond,
                               stamp_ns % kSecond, file));
  std::string xml = kHead;
  for (const std::string& line : lines_) xml += line;
  write_file_whole(path_, xml + kTail);
}

}  // namespace particle_surface_tracker
