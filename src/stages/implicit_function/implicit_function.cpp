#include "particle_surface_tracker/stages/implicit_function.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "cell_prediction.h"
#include "coarse_signs.h"
#include "field_sampler.h"
#include "node_lattice.h"

namespace particle_surface_tracker {

namespace {

/// Cells of Δx_φ along an edge of a cell of the particle grid.
int cells_per_particle_cell(const Parameters& parameters) {
  return static_cast<int>(std::clamp(std::floor(1.0 / parameters.dx_phi + 1e-9), 1.0, double{implicit::kLargestRatio}));
}

}  // namespace

namespace implicit {

namespace {

/// What trilinear interpolation between coarse nodes is off by, mostly [r]: a little more to evaluate at once is
/// cheaper than coming back to many blocks for a node or two.
constexpr double kPredictionError = 0.03;

/// Next to a bubble that fits between the coarse nodes φ̃ is no deeper than this below zero [r].
constexpr double kShallowDepth = 0.5;

/// Evaluates what is requested, then the missing corners of mixed cells, until every mixed cell has values at all
/// corners.
void evaluate_until_closed(const FieldSampler& sampler, double spacing, NodeLattice& lattice) {
  for (std::vector<std::uint32_t> blocks = lattice.blocks_with_requests(); !blocks.empty();
       blocks = lattice.blocks_with_requests()) {
    sampler.evaluate(lattice, blocks, spacing);
    for (const std::uint32_t block : lattice.blocks_with_cells_around(blocks)) {
      const NodeMask mixed = lattice.mixed_cells(block);
      if (any(mixed)) lattice.request_corners(block, mixed);
    }
  }
}

/// The values at the corners of the mixed cells; everything else is background.
openvdb::FloatGrid::Ptr make_field(NodeLattice& lattice, double spacing, double outside) {
  using Leaf = openvdb::FloatTree::LeafNodeType;
  const std::vector<NodeMask> active = lattice.corners_of_mixed_cells();
  auto field = openvdb::FloatGrid::create(static_cast<float>(outside));
  field->setName("phi_tilde");
  field->setTransform(openvdb::math::Transform::createLinearTransform(spacing));
  for (std::uint32_t index = 0; index < active.size(); ++index) {
    if (!any(active[index])) continue;
    const NodeBlock& block = lattice.blocks()[index];
    const openvdb::Coord origin(8 * block.coord[0], 8 * block.coord[1], 8 * block.coord[2]);
    auto* leaf = new Leaf(origin, static_cast<float>(outside), /*active*/ false);
    field->tree().addLeaf(leaf);
    Leaf::NodeMaskType mask;
    for (int x = 0; x < 8; ++x) mask.getWord<openvdb::Index64>(x) = active[index][x];
    leaf->setValueMask(mask);
    float* values = leaf->buffer().data();
    for (auto node = mask.beginOn(); node; ++node) values[node.pos()] = block.values[node.pos()];
  }
  return field;
}

}  // namespace

}  // namespace implicit

double implicit_function_cell_size(const Parameters& parameters) {
  return cells_per_particle_cell(parameters) * parameters.dx_phi * parameters.particle_spacing;
}

ImplicitSurface evaluate_implicit_function(const ParticleGrid& particles, const Parameters& parameters) {
  using namespace implicit;
  const double r = parameters.particle_spacing;
  const int ratio = cells_per_particle_cell(parameters);
  ImplicitSurface surface;
  surface.dx = parameters.dx_phi * r;
  const FieldSampler sampler(particles, parameters);
  NodeLattice coarse = guess_coarse_signs(particles, r);
  evaluate_until_closed(sampler, particles.cell_size(), coarse);
  NodeLattice fine(/*presume_outside*/ false);
  fine.blocks().reserve(4 * coarse.blocks().size());
  request_predicted_cells(coarse, ratio, kPredictionError * r, fine);
  const int reach = static_cast<int>(std::ceil(r / surface.dx - 1e-9));
  request_around_stray_particles(particles, coarse, ratio, reach, fine);
  request_around_shallow_nodes(coarse, ratio, kShallowDepth * r, fine);
  share_values(coarse, ratio, fine);
  evaluate_until_closed(sampler, surface.dx, fine);
  surface.field = make_field(fine, surface.dx, parameters.influence_radius * r);
  return surface;
}

double implicit_function_at(const ParticleGrid& particles, const Vec3d& position, const Parameters& parameters) {
  const double radius = parameters.influence_radius * parameters.particle_spacing;
  double sum_k = 0.0;
  Vec3d sum_kd = Vec3d::Zero();
  Vec3d sum_gd = Vec3d::Zero();
  Eigen::Matrix3d sum_gdd = Eigen::Matrix3d::Zero();
  const Vec3d reach = Vec3d::Constant(radius * (1.0 + 1e-9));
  particles.for_each_range(particles.cell_of(position - reach), particles.cell_of(position + reach),
                           [&](std::uint32_t begin, std::uint32_t end) {
                             for (std::uint32_t n = begin; n < end; ++n) {
                               const Vec3d d = Vec3d(particles.x()[n], particles.y()[n], particles.z()[n]) - position;
                               const double u = 1.0 - d.squaredNorm() / (radius * radius);
                               if (u <= 0.0) continue;
                               sum_k += u * u * u;
                               sum_kd += u * u * u * d;
                               sum_gd += u * u * d;
                               sum_gdd += u * u * d * d.transpose();
                             }
                           });
  if (sum_k == 0.0) return radius;
  const Vec3d m = sum_kd / sum_k;
  const Eigen::Matrix3d gradient = 6.0 / (radius * radius * sum_k) * (sum_gdd - m * sum_gd.transpose());
  const Eigen::Matrix3d symmetric = 0.5 * (gradient + gradient.transpose());
  const double eigenvalue =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric, Eigen::EigenvaluesOnly).eigenvalues().z();
  const double gamma = std::clamp(
      (parameters.eigenvalue_high - eigenvalue) / (parameters.eigenvalue_high - parameters.eigenvalue_low), 0.0, 1.0);
  const double factor = gamma * gamma * gamma - 3.0 * gamma * gamma + 3.0 * gamma;
  return m.norm() - parameters.surface_radius * parameters.particle_spacing * factor;
}

}  // namespace particle_surface_tracker
