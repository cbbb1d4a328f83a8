#include "gamma_nodes.h"

#include <algorithm>

#include "lattice_parts.h"

namespace particle_surface_tracker::remeshing {

namespace {

/// Distances are measured up to the diagonal of a cell; beyond it only the sign matters [cells].
constexpr double kReach = 1.75;

}  // namespace

GammaNodes::GammaNodes(const MeshLattice& lattice, const std::vector<openvdb::Coord>& nodes,
                       const std::vector<float>& gamma)
    : lattice_(lattice), nodes_(nodes), gamma_(gamma) {
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const bool inside = gamma[n] < 0.0f;
    inside_.emplace(nodes[n], inside);
    if (inside != (lattice.winding_number(nodes[n]) >= 1)) changed_.push_back(nodes[n]);
  }
}

bool GammaNodes::has_changed(const openvdb::Coord& node) const {
  return std::binary_search(changed_.begin(), changed_.end(), node);
}

bool GammaNodes::is_matched(const openvdb::Coord& node) const {
  return std::binary_search(nodes_.begin(), nodes_.end(), node);
}

bool GammaNodes::is_inside(const openvdb::Coord& node) {
  const auto [place, is_new] = inside_.emplace(node, false);
  if (is_new) place->second = lattice_.winding_number(node) >= 1;
  return place->second;
}

unsigned GammaNodes::inside_corners(const openvdb::Coord& cell) {
  unsigned inside = 0;
  for (int corner = 0; corner < kCellCorners; ++corner) {
    if (is_inside(corner_of(cell, corner))) inside |= 1u << corner;
  }
  return inside;
}

void GammaNodes::measure(std::vector<openvdb::Coord> nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const auto take_known = [&](const openvdb::Coord& node) {
    if (values_.count(node) > 0) return true;
    const auto matched = std::lower_bound(nodes_.begin(), nodes_.end(), node);
    if (matched == nodes_.end() || *matched != node) return false;
    values_.emplace(node, gamma_[static_cast<std::size_t>(matched - nodes_.begin())]);
    return true;
  };
  nodes.erase(std::remove_if(nodes.begin(), nodes.end(), take_known), nodes.end());
  const std::vector<float> distances = signed_distances(lattice_, nodes, kReach * lattice_.h());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const double distance = std::abs(static_cast<double>(distances[n]));
    values_.emplace(nodes[n], is_inside(nodes[n]) ? -distance : distance);
  }
}

}  // namespace particle_surface_tracker::remeshing
