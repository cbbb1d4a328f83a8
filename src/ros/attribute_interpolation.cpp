#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "particle_attributes.h"
#include "particle_surface_tracker/core/particle_grid.h"

namespace particle_surface_tracker {
namespace {

constexpr double kRadius = 2.0;  // [r]

/// The particles around a vertex, with their weights.
struct Neighbors {
  std::vector<std::uint32_t> particles;
  std::vector<double> weights;
};

void find_neighbors(const ParticleGrid& grid, const Vec3d& vertex, double radius, Neighbors& neighbors) {
  neighbors.particles.clear();
  neighbors.weights.clear();
  const Vec3d reach = Vec3d::Constant(radius);
  grid.for_each_range(grid.cell_of(vertex - reach), grid.cell_of(vertex + reach),
                      [&](std::uint32_t begin, std::uint32_t end) {
                        for (std::uint32_t n = begin; n != end; ++n) {
                          const Vec3d offset = Vec3d(grid.x()[n], grid.y()[n], grid.z()[n]) - vertex;
                          const double nearness = 1.0 - offset.squaredNorm() / (radius * radius);
                          if (nearness <= 0.0) continue;
                          neighbors.particles.push_back(grid.index()[n]);
                          neighbors.weights.push_back(nearness * nearness * nearness);
                        }
                      });
}

float mean(const ParticleAttributes::Attribute& attribute, std::size_t component, const Neighbors& neighbors,
           std::size_t nearest) {
  const auto value_of = [&](std::size_t particle) {
    return attribute.values[particle * attribute.components + component];
  };
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t n = 0; n < neighbors.particles.size(); ++n) {
    const float value = value_of(neighbors.particles[n]);
    // Without a value it does not count.
    if (std::isnan(value)) continue;
    sum += neighbors.weights[n] * value;
    weights += neighbors.weights[n];
  }
  return weights > 0.0 ? static_cast<float>(sum / weights) : value_of(nearest);
}

}  // namespace

std::vector<InterpolatedField> interpolate(const ParticleAttributes& particles, const std::vector<Vec3f>& vertices,
                                           double r) {
  std::vector<InterpolatedField> result;
  if (particles.attributes.empty()) return result;
  for (const ParticleAttributes::Attribute& attribute : particles.attributes) {
    InterpolatedField at_vertices;
    at_vertices.name = attribute.name;
    at_vertices.components = static_cast<std::uint32_t>(attribute.components);
    at_vertices.values.resize(vertices.size() * attribute.components);
    result.push_back(std::move(at_vertices));
  }
  const ParticleGrid grid(particles.positions, r);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertices.size(), 256), [&](const auto& range) {
    Neighbors neighbors;
    for (std::size_t v = range.begin(); v != range.end(); ++v) {
      const Vec3d place = vertices[v].cast<double>();
      find_neighbors(grid, place, kRadius * r, neighbors);
      const std::size_t nearest = neighbors.particles.empty() ? grid.nearest(place) : neighbors.particles.front();
      for (std::size_t a = 0; a < result.size(); ++a) {
        const std::size_t components = result[a].components;
        for (std::size_t c = 0; c < components; ++c) {
          result[a].values[v * components + c] = mean(particles.attributes[a], c, neighbors, nearest);
        }
      }
    }
  });
  return result;
}

}  // namespace particle_surface_tracker
