#include "particle_surface_tracker/core/parameters.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <numeric>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

namespace {

using Field =
    std::variant<double Parameters::*, int Parameters::*, AdvectionMethod Parameters::*, ProjectionMethod Parameters::*,
                 MatchingSolver Parameters::*, DetectionMethod Parameters::*, MatchingFrames Parameters::*,
                 TopologyMode Parameters::*, StretchedDetail Parameters::*, SelfIntersections Parameters::*>;

struct Entry {
  ParameterInfo info;
  Field field;

  /// The same with a slider that ends before what is valid does.
  Entry with_slider_to(double maximum) const {
    Entry entry = *this;
    entry.info.slider_maximum = maximum;
    return entry;
  }
};

constexpr double kTiny = std::numeric_limits<double>::min();

Entry real(double Parameters::*field, std::string name, std::string symbol, std::string unit, double minimum,
           double maximum, bool needs_reset, std::string text) {
  ParameterInfo info{std::move(name), std::move(symbol), std::move(unit), std::move(text)};
  info.minimum = minimum;
  info.maximum = info.slider_maximum = maximum;
  info.needs_reset = needs_reset;
  return {std::move(info), field};
}

Entry integer(int Parameters::*field, std::string name, double minimum, double maximum, std::string text) {
  ParameterInfo info{std::move(name), "", "", std::move(text), ParameterInfo::Type::kInteger};
  info.minimum = minimum;
  info.maximum = info.slider_maximum = maximum;
  return {std::move(info), field};
}

Entry choice(Field field, std::string name, std::vector<std::string> choices, std::string text) {
  ParameterInfo info{std::move(name), "", "", std::move(text), ParameterInfo::Type::kChoice};
  info.choices = std::move(choices);
  return {std::move(info), field};
}

std::vector<Entry> make_entries() {
  using P = Parameters;
  return {
      real(&P::particle_spacing, "particle_spacing", "r", "m", kTiny, 1e6, true,
           "Distance between neighbouring particles at rest; all other lengths are multiples of it."),
      choice(
          &P::advection, "advection", {"average", "affine"},
          "How vertices follow the particles: weighted average as in the paper, or a first-order fit that is exact for "
          "rigid motion."),
      real(&P::advection_radius, "advection_radius", "", "r", 0.5, 8.0, false,
           "Influence radius of the poly6 kernel that weighs the particles around a vertex."),
      real(&P::max_displacement, "max_displacement", "", "r", 0.1, 1e6, false,
           "A particle that moves farther in one frame counts as gone and born again.")
          .with_slider_to(50.0),
      integer(&P::affine_min_neighbors, "affine_min_neighbors", 1, 100,
              "The affine fit widens its radius until it holds this many particles."),
      real(&P::affine_max_radius, "affine_max_radius", "", "r", 0.5, 16.0, false,
           "Largest radius of the affine fit; at least advection_radius."),
      real(&P::affine_rank_threshold, "affine_rank_threshold", "", "r^2", 0.0, 1.0, false,
           "Directions in which the particles around a vertex spread less than this variance are not fitted."),
      real(&P::affine_max_residual, "affine_max_residual", "", "r", 1e-3, 100.0, false,
           "Where the displacements around a vertex depart from the affine fit by more than this (root "
           "mean square), the fit gives way to the average, wholly at twice this.")
          .with_slider_to(0.5),
      real(&P::affine_max_stretch, "affine_max_stretch", "", "", 0.0, 1.0, false,
           "The affine fit stretches by at most this fraction in one frame."),
      real(&P::dx_phi, "dx_phi", "dx_phi", "r", 0.1, 1.0, true, "Cell size of the implicit function phi."),
      real(&P::influence_radius, "influence_radius", "R", "r", 1.5, 8.0, true,
           "Radius within which particles are averaged for the implicit function."),
      real(&P::surface_radius, "surface_radius", "r_bar", "r", 0.5, 2.0, true,
           "Distance from the averaged position at which phi is 0."),
      real(&P::eigenvalue_low, "eigenvalue_low", "t_low", "", 0.0, 10.0, true,
           "Largest eigenvalue of the averaged position's gradient below which the surface radius is not attenuated."),
      real(&P::eigenvalue_high, "eigenvalue_high", "t_high", "", 0.0, 10.0, true,
           "Largest eigenvalue from which on the surface radius is attenuated to 0."),
      real(&P::band_factor, "band_factor", "", "", 1.0, 10.0, false,
           "The distance field reaches this times the largest distance between mesh and isosurface of the frame "
           "before."),
      real(&P::max_reach, "max_reach", "", "r", 2.0, 64.0, false,
           "A vertex that is farther from the isosurface than this has lost it and is flagged."),
      choice(&P::projection, "projection", {"two_step", "one_step"},
             "How vertices are projected: in two steps as in the paper, or by its equation 1 for comparison."),
      real(&P::epsilon, "epsilon", "epsilon", "", 0.01, 1.0, false,
           "Part of the distance to the isosurface that one step of the projection travels."),
      real(&P::projection_tolerance, "projection_tolerance", "", "dx_phi", 1e-6, 0.5, false,
           "The projection has found the isosurface when |phi| is below this."),
      integer(&P::projection_max_steps, "projection_max_steps", 1, 100000, "Most steps of one projection.")
          .with_slider_to(500),
      real(&P::tau, "tau", "tau", "r", 1e-3, 100.0, false,
           "A projection that moves a vertex farther than this is taken for a change of topology.")
          .with_slider_to(4.0),
      choice(&P::topology, "topology", {"keep", "match"},
             "Whether the mesh splits and merges as the particles do, or keeps its connectivity."),
      real(&P::dx_gamma, "dx_gamma", "dx_Gamma", "r", 0.1, 4.0, true,
           "Cell size of the voxelisation Gamma of the mesh, in which changes of topology are flagged."),
      choice(&P::detection, "detection", {"tau", "tau_and_signs"},
             "What is taken for a change of topology: vertices that jump, as in the paper, or also places where mesh "
             "and implicit surface disagree about inside and outside, such as new drops and bubbles."),
      real(&P::matching_reach, "matching_reach", "", "r", 0.0, 1e3, false,
           "Topology matching changes Gamma this far from what is flagged, and farther where that is not enough; 0: "
           "everywhere.")
          .with_slider_to(20.0),
      choice(&P::matching_frames, "matching_frames", {"flagged", "every"},
             "Topology is matched where something is flagged, or around the whole surface in every frame."),
      choice(&P::matching_solver, "matching_solver", {"sor", "pcg"},
             "Solver of topology matching: successive over-relaxation as in the paper, or preconditioned conjugate "
             "gradients."),
      real(&P::beta, "beta", "beta", "dx_Gamma", 1e-9, 1.0, false,
           "The SOR solver of topology matching ends when its largest step is below this."),
      choice(&P::self_intersections, "self_intersections", {"keep", "remesh"},
             "Triangles that cross each other within a cell of Gamma stay, or their cells are made anew; what "
             "crosses more widely is always made anew."),
      real(&P::split_length, "split_length", "", "dx_Gamma", 0.5, 1e6, false,
           "A longer edge is split, if it has also grown by split_growth.")
          .with_slider_to(10.0),
      real(&P::split_growth, "split_growth", "", "", 1.0, 1e6, false,
           "An edge is split only if it is longer than this times the edges that its vertices had at birth.")
          .with_slider_to(10.0),
      real(&P::collapse_length, "collapse_length", "", "dx_Gamma", 0.0, 0.25, false,
           "A shorter edge is collapsed, if it has also shrunk by collapse_shrinkage."),
      real(&P::collapse_shrinkage, "collapse_shrinkage", "", "", 0.0, 0.5, false,
           "An edge is collapsed only if it is shorter than this times the edges that its vertices had at birth."),
      real(&P::remeshed_length, "remeshed_length", "", "dx_Gamma", 0.0, 0.75, false,
           "Between vertices that re-meshing made, which carry no detail, every shorter edge is collapsed."),
      real(&P::fold_angle, "fold_angle", "", "deg", 90.0, 180.0, false,
           "An edge is collapsed if the normals of its triangles differ by more than this, and by 20 degrees more than "
           "at birth."),
      real(&P::sliver_angle, "sliver_angle", "", "deg", 0.0, 30.0, false,
           "A triangle with a smaller angle is removed, if that angle has also shrunk to half of what it was at "
           "birth."),
      choice(&P::stretched_detail, "stretched_detail", {"keep", "thin"},
             "What becomes of delta where the surface is drawn out: it stays, as in the paper, or shrinks as the area "
             "grows, so that detail keeps its volume."),
      real(&P::delta_half_life, "delta_half_life", "", "s", 0.0, 1e9, false,
           "Time in which the distance delta between mesh and isosurface halves, so that old detail "
           "fades; 0 keeps it.")
          .with_slider_to(60.0),
  };
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = make_entries();
  return all;
}

/// Number of single-character edits between two words, to suggest the name that was meant.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substitute = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substitute, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

const Entry& find_entry(const std::string& name) {
  const Entry* nearest = &entries().front();
  for (const Entry& entry : entries()) {
    if (entry.info.name == name) return entry;
    if (edit_distance(entry.info.name, name) < edit_distance(nearest->info.name, name)) nearest = &entry;
  }
  throw ParameterError(fmt::format("there is no parameter '{}'; the nearest name is '{}'", name, nearest->info.name));
}

void check_range(const ParameterInfo& info, double value) {
  if (value >= info.minimum && value <= info.maximum) return;
  if (info.minimum == kTiny) {
    throw ParameterError(fmt::format("{} is {}{}{}; it must be a positive number of at most {}", info.name, value,
                                     info.unit.empty() ? "" : " ", info.unit, info.maximum));
  }
  throw ParameterError(fmt::format("{} is {}{}{}; it must lie in [{}, {}]", info.name, value,
                                   info.unit.empty() ? "" : " ", info.unit, info.minimum, info.maximum));
}

template <typename Number>
Number parse_number(const ParameterInfo& info, const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw ParameterError(fmt::format("{} is '{}'; it must be {}", info.name, text,
                                     info.type == ParameterInfo::Type::kInteger ? "a whole number" : "a number"));
  }
  check_range(info, static_cast<double>(value));
  return value;
}

template <typename Choice>
Choice parse_choice(const ParameterInfo& info, const std::string& text) {
  const auto found = std::find(info.choices.begin(), info.choices.end(), text);
  if (found == info.choices.end()) {
    throw ParameterError(
        fmt::format("{} is '{}'; it must be one of: {}", info.name, text, fmt::join(info.choices, ", ")));
  }
  return static_cast<Choice>(found - info.choices.begin());
}

}  // namespace

const std::vector<ParameterInfo>& parameter_table() {
  static const std::vector<ParameterInfo> table = [] {
    std::vector<ParameterInfo> infos;
    for (const Entry& entry : entries()) infos.push_back(entry.info);
    return infos;
  }();
  return table;
}

std::string get_parameter(const Parameters& parameters, const std::string& name) {
  const Entry& entry = find_entry(name);
  return std::visit(
      [&](auto field) -> std::string {
        const auto value = parameters.*field;
        if constexpr (std::is_enum_v<decltype(value)>) {
          return entry.info.choices[static_cast<std::size_t>(value)];
        } else {
          return fmt::format("{}", value);
        }
      },
      entry.field);
}

void set_parameter(Parameters& parameters, const std::string& name, const std::string& value) {
  const Entry& entry = find_entry(name);
  std::visit(
      [&](auto field) {
        using Value = std::remove_reference_t<decltype(parameters.*field)>;
        if constexpr (std::is_enum_v<Value>) {
          parameters.*field = parse_choice<Value>(entry.info, value);
        } else {
          parameters.*field = parse_number<Value>(entry.info, value);
        }
      },
      entry.field);
}

void check_parameters(const Parameters& parameters) {
  for (const Entry& entry : entries()) {
    if (const auto* field = std::get_if<double Parameters::*>(&entry.field)) {
      check_range(entry.info, parameters.**field);
    } else if (const auto* count = std::get_if<int Parameters::*>(&entry.field)) {
      check_range(entry.info, parameters.**count);
    }
  }
  if (parameters.eigenvalue_low >= parameters.eigenvalue_high) {
    throw ParameterError(
        fmt::format("eigenvalue_low is {} and eigenvalue_high is {}; the first must be below the second",
                    parameters.eigenvalue_low, parameters.eigenvalue_high));
  }
  if (parameters.affine_max_radius < parameters.advection_radius) {
    throw ParameterError(
        fmt::format("affine_max_radius is {} r and advection_radius is {} r; the first must not be below "
                    "the second",
                    parameters.affine_max_radius, parameters.advection_radius));
  }
}

}  // namespace particle_surface_tracker
