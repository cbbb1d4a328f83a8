#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/particle_frame.h"
#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker::test {

/// A sphere from an octahedron whose triangles are split in four `levels` times: closed, manifold, outward.
TriangleMesh make_sphere(const Vec3d& center, double radius, int levels);

/// A torus around the z axis: `rings` × `sides` vertices.
TriangleMesh make_torus(const Vec3d& center, double ring_radius, double tube_radius, int rings, int sides);

/// An axis-aligned box of 8 vertices and 12 triangles.
TriangleMesh make_box(const Vec3d& lower, const Vec3d& upper);

/// Several meshes as one.
TriangleMesh joined(const std::vector<TriangleMesh>& parts);

/// The mesh with every triangle turned round.
TriangleMesh turned(const TriangleMesh& mesh);

/// Nodes (i + ½) r of the cubic grid for which inside(position) holds, each moved by up to `jitter` r along every axis.
/// Ids count up; the jitter depends on `seed` and the node only.
template <typename Inside>
ParticleFrame fill_with_particles(const Vec3d& lower, const Vec3d& upper, double r, double jitter, std::uint32_t seed,
                                  Inside&& inside);

/// A number in [−1, 1) that depends on nothing but the arguments.
double hash_noise(std::uint32_t seed, std::int32_t i, std::int32_t j, std::int32_t k, std::uint32_t axis);

template <typename Inside>
ParticleFrame fill_with_particles(const Vec3d& lower, const Vec3d& upper, double r, double jitter, std::uint32_t seed,
                                  Inside&& inside) {
  const Eigen::Vector3i first = (lower / r).array().floor().cast<int>();
  const Eigen::Vector3i last = (upper / r).array().ceil().cast<int>();
  std::vector<Vec3f> positions;
  for (int i = first.x(); i <= last.x(); ++i) {
    for (int j = first.y(); j <= last.y(); ++j) {
      for (int k = first.z(); k <= last.z(); ++k) {
        const Vec3d node = Vec3d(i + 0.5, j + 0.5, k + 0.5) * r;
        if (!inside(node)) continue;
        const Vec3d offset(hash_noise(seed, i, j, k, 0), hash_noise(seed, i, j, k, 1), hash_noise(seed, i, j, k, 2));
        positions.push_back((node + jitter * r * offset).template cast<float>());
      }
    }
  }
  std::vector<std::uint32_t> ids(positions.size());
  for (std::uint32_t n = 0; n < ids.size(); ++n) ids[n] = n;
  return make_particle_frame(0, std::move(positions), std::move(ids));
}

}  // namespace particle_surface_tracker::test
