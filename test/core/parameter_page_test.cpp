// docs/parameters.md against the table of parameters. With PST_WRITE_DOCS=1 in the environment it is written afresh.

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/parameters.h"

namespace particle_surface_tracker {
namespace {

constexpr char kBegin[] = "<!-- Written by parameter_page_test from here -->\n";
constexpr char kEnd[] = "<!-- to here -->\n";

std::string default_of(const ParameterInfo& info) {
  return info.name == "particle_spacing" ? "required" : fmt::format("`{}`", get_parameter(Parameters(), info.name));
}

std::string range_of(const ParameterInfo& info) {
  if (info.type == ParameterInfo::Type::kChoice) return fmt::format("`{}`", fmt::join(info.choices, "`, `"));
  const bool above_zero = info.minimum == std::numeric_limits<double>::min();
  if (above_zero) return fmt::format("above 0, at most {}", info.maximum);
  const std::string slider =
      info.slider_maximum < info.maximum ? fmt::format("; slider to {}", info.slider_maximum) : "";
  return fmt::format("{} to {}{}", info.minimum, info.maximum, slider);
}

/// A bar would end the cell.
std::string in_cell(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string row_of(const ParameterInfo& info) {
  return fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", info.name, info.symbol, default_of(info), info.unit,
                     range_of(info), info.needs_reset ? "reset" : "live", in_cell(info.text));
}

std::string table() {
  std::string text =
      "| parameter | in the paper | default | unit | values | change | meaning |\n|---|---|---|---|---|---|---|\n";
  for (const ParameterInfo& info : parameter_table()) text += row_of(info);
  return text;
}

std::string content_of(const char* path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ParameterPage, HasTheTableOfTheLibrary) {
  const std::string page = content_of(PST_PARAMETER_PAGE);
  const std::size_t begin = page.find(kBegin), end = page.find(kEnd);
  ASSERT_NE(begin, std::string::npos) << PST_PARAMETER_PAGE;
  ASSERT_NE(end, std::string::npos) << PST_PARAMETER_PAGE;
  const std::string wanted = page.substr(0, begin) + kBegin + "\n" + table() + "\n" + page.substr(end);
  if (std::getenv("PST_WRITE_DOCS") != nullptr) std::ofstream(PST_PARAMETER_PAGE, std::ios::binary) << wanted;
  EXPECT_EQ(content_of(PST_PARAMETER_PAGE), wanted)
      << "to write it afresh: PST_WRITE_DOCS=1 ctest -R parameter_page_test";
}

TEST(ParameterPage, TellsWhatIsNeededOfEveryParameter) {
  for (const ParameterInfo& info : parameter_table()) {
    EXPECT_EQ(info.text.back(), '.') << info.name;
    EXPECT_LE(info.minimum, info.maximum) << info.name;
  }
}

}  // namespace
}  // namespace particle_surface_tracker
