#include "filled_body.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/core/mesh_measures.h"

namespace particle_surface_tracker {

FilledBody fill_body(const TriangleMesh& mesh, std::size_t particle_count) {
  openvdb::initialize();
  const double volume = measure_mesh(mesh.positions(), mesh.triangles()).volume;
  const double r = std::cbrt(volume / static_cast<double>(particle_count));
  std::vector<openvdb::Vec3s> points;
  for (const Vec3f& p : mesh.positions()) points.emplace_back(p.x(), p.y(), p.z());
  std::vector<openvdb::Vec3I> triangles;
  for (const auto& [a, b, c] : mesh.triangles()) triangles.emplace_back(a, b, c);
  const auto transform = openvdb::math::Transform::createLinearTransform(r);
  // Off the lattice of φ, as the particles of a simulation are.
  transform->postTranslate(openvdb::Vec3d(0.37, 0.21, 0.13) * r);
  constexpr float whole_interior = std::numeric_limits<float>::max();
  const auto distance = openvdb::tools::meshToSignedDistanceField<openvdb::FloatGrid>(*transform, points, triangles, {},
                                                                                      2.0f, whole_interior);
  std::vector<Vec3f> positions;
  std::vector<std::uint32_t> ids;
  for (auto node = distance->cbeginValueOn(); node; ++node) {
    if (*node >= -0.1 * r || !node.isVoxelValue()) continue;
    const openvdb::Vec3d p = transform->indexToWorld(node.getCoord());
    positions.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
    ids.push_back(static_cast<std::uint32_t>(ids.size()));
  }
  FilledBody body;
  body.mesh = mesh;
  body.particles = make_particle_frame(0, std::move(positions), std::move(ids));
  body.parameters.particle_spacing = r;
  return body;
}

ParticleFrame next_frame(const ParticleFrame& particles) {
  constexpr double angle = 0.03;
  const Eigen::AngleAxisd turn(angle, Vec3d(1.0, 2.0, 3.0).normalized());
  std::vector<Vec3f> positions;
  for (const Vec3f& p : particles.positions) positions.push_back((turn * p.cast<double>()).cast<float>());
  return make_particle_frame(0, std::move(positions), particles.ids);
}

}  // namespace particle_surface_tracker
