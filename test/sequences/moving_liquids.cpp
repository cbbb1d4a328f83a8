#include "sequences/moving_liquids.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <stdexcept>
#include <utility>

#include "particle_surface_tracker/tracker/make_implicit_surface.h"
#include "support/parameters.h"

namespace particle_surface_tracker::test {

namespace {

constexpr double kSpacing = 0.03;         // [m]
constexpr double kInterval = 1.0 / 60.0;  // [s]
constexpr std::int64_t kIntervalNs = 16666667;
constexpr double kGravity = 9.81;  // [m/s²]
constexpr int kFrames = 40;
constexpr std::uint32_t kSeed = 20171;

/// Numbers that are the same with every standard library.
class Random {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / static_cast<double>(std::mt19937::max());
  }
  Vec3d within_cube(double half_width) {
    const double x = uniform(-half_width, half_width), y = uniform(-half_width, half_width);
    return {x, y, uniform(-half_width, half_width)};
  }

 private:
  std::mt19937 engine_{kSeed};
};

struct Drop {
  std::uint32_t id;
  Vec3d position;
  Vec3d velocity;
};

/// Particles that come and go.
class Spray {
 public:
  void add(const Vec3d& position, const Vec3d& velocity) { drops_.push_back({next_id_++, position, velocity}); }

  /// Calls move(drop) for all; those for which it returns false vanish.
  void move(const std::function<bool(Drop&)>& move) {
    drops_.erase(std::remove_if(drops_.begin(), drops_.end(), [&](Drop& drop) { return !move(drop); }), drops_.end());
  }

  ParticleFrame frame(std::size_t number) const {
    std::vector<Vec3f> positions;
    std::vector<std::uint32_t> ids;
    for (const Drop& drop : drops_) {
      positions.push_back(drop.position.cast<float>());
      ids.push_back(drop.id);
    }
    return make_particle_frame(static_cast<std::int64_t>(number) * kIntervalNs, std::move(positions), std::move(ids));
  }

 private:
  std::vector<Drop> drops_;
  std::uint32_t next_id_ = 0;
};

bool fly(Drop& drop) {
  drop.velocity.z() -= kInterval * kGravity;
  drop.position += kInterval * drop.velocity;
  return true;
}

/// Calls visit(place) for the places of a cubic grid, a little disturbed, that a body contains.
void fill(double half_width, Random& random, const std::function<bool(const Vec3d&)>& contains,
          const std::function<void(const Vec3d&)>& visit) {
  const int n = static_cast<int>(std::ceil(half_width / kSpacing));
  for (int x = -n; x <= n; ++x) {
    for (int y = -n; y <= n; ++y) {
      for (int z = -n; z <= n; ++z) {
        const Vec3d place = kSpacing * Vec3d(x, y, z);
        if (contains(place)) visit(place + random.within_cube(0.1 * kSpacing));
      }
    }
  }
}

std::vector<ParticleFrame> frames_of(Spray& spray, const std::function<void(std::size_t)>& advance) {
  std::vector<ParticleFrame> frames = {spray.frame(0)};
  for (std::size_t n = 1; n < kFrames; ++n) {
    advance(n);
    frames.push_back(spray.frame(n));
  }
  return frames;
}

std::vector<ParticleFrame> fountain() {
  constexpr int kWarmUp = 15;
  constexpr double kNozzle = 3.0 * kSpacing;
  Random random;
  Spray spray;
  const auto step = [&] {
    spray.move([](Drop& drop) { return fly(drop) && drop.position.z() > 0.0; });
    for (int n = 0; n < 56; ++n) {
      const double angle = random.uniform(0.0, 2.0 * std::acos(-1.0));
      const double radius = kNozzle * std::sqrt(random.uniform(0.0, 1.0));
      const Vec3d outward(std::cos(angle), std::sin(angle), 0.0);
      spray.add(radius * outward + Vec3d(0.0, 0.0, random.uniform(0.5, 2.5) * kSpacing),
                Vec3d(0.0, 0.0, 4.0) + 1.0 * (radius / kNozzle) * outward + random.within_cube(0.15));
    }
  };
  for (int n = 0; n < kWarmUp; ++n) step();
  return frames_of(spray, [&](std::size_t) { step(); });
}

std::vector<ParticleFrame> sheet() {
  Random random;
  Spray spray;
  const double radius = 24.0 * kSpacing;
  const auto contains = [&](const Vec3d& place) { return std::abs(place.z()) < 1e-9 && place.norm() <= radius; };
  fill(radius, random, contains, [&](const Vec3d& place) {
    const Vec3d outward(place.x(), place.y(), 0.0);
    spray.add(place, 1.2 * outward + random.within_cube(0.12));
  });
  return frames_of(spray, [&](std::size_t) { spray.move(fly); });
}

std::vector<ParticleFrame> squeeze() {
  constexpr double kRate = 1.6;  // Of the logarithm of the width [1/s].
  Random random;
  Spray spray;
  const double radius = 10.0 * kSpacing;
  fill(
      radius, random, [&](const Vec3d& place) { return place.norm() <= radius; },
      [&](const Vec3d& place) { spray.add(place, random.within_cube(0.05)); });
  const double wider = std::exp(kRate * kInterval), flatter = 1.0 / (wider * wider);
  return frames_of(spray, [&](std::size_t) {
    spray.move([&](Drop& drop) {
      drop.position = drop.position.cwiseProduct(Vec3d(wider, wider, flatter)) + kInterval * drop.velocity;
      return true;
    });
  });
}

std::vector<ParticleFrame> rain() {
  Random random;
  Spray spray;
  const double half_width = 14.0 * kSpacing, depth = 4.0 * kSpacing, radius = 2.6 * kSpacing;
  fill(
      half_width, random, [&](const Vec3d& place) { return place.z() <= 1e-9 && place.z() > -depth; },
      [&](const Vec3d& place) { spray.add(place, Vec3d::Zero()); });
  const auto add_drop = [&] {
    const Vec3d center(random.uniform(-0.8, 0.8) * half_width, random.uniform(-0.8, 0.8) * half_width, 14.0 * kSpacing);
    fill(
        radius, random, [&](const Vec3d& place) { return place.norm() <= radius; },
        [&](const Vec3d& place) { spray.add(place + center, Vec3d(0.0, 0.0, -1.5)); });
  };
  add_drop();
  return frames_of(spray, [&](std::size_t n) {
    spray.move([&](Drop& drop) {
      if (drop.velocity.z() == 0.0) return true;
      fly(drop);
      // In the pool it slows down, and spreads.
      if (drop.position.z() < 0.0) drop.velocity = 0.6 * drop.velocity + random.within_cube(0.3);
      if (drop.position.z() < -0.5 * depth) drop.velocity.setZero();
      return true;
    });
    if (n % 3 == 0) add_drop();
  });
}

std::vector<ParticleFrame> jets() {
  Random random;
  Spray spray;
  const double width = 2.6 * kSpacing, speed = 2.0;
  const double a_row = kSpacing / (speed * kInterval);  // Frames in which a jet moves by r.
  double from = 0.0;
  const auto emit = [&](double frames) {
    for (from += frames; from >= a_row;) {
      from -= a_row;
      for (const double side : {-1.0, 1.0}) {
        fill(
            width, random, [&](const Vec3d& place) { return std::abs(place.x()) < 1e-9 && place.norm() <= width; },
            [&](const Vec3d& place) {
              const Vec3d velocity = Vec3d(-side * speed, 0.0, 1.0) + random.within_cube(0.1);
              const Vec3d nozzle(side * 0.4, side * 0.7 * kSpacing, 0.0);
              spray.add(place + nozzle + from * kInterval * velocity, velocity);
            });
      }
    }
  };
  emit(3.0 * a_row);
  return frames_of(spray, [&](std::size_t) {
    spray.move(fly);
    emit(1.0);
  });
}

using Maker = std::vector<ParticleFrame> (*)();

const std::vector<std::pair<std::string, Maker>>& makers() {
  static const std::vector<std::pair<std::string, Maker>> all = {
      {"fountain", fountain}, {"sheet", sheet}, {"squeeze", squeeze}, {"rain", rain}, {"jets", jets}};
  return all;
}

}  // namespace

TriangleMesh implicit_mesh(const ParticleFrame& particles, double r) {
  const auto surface = make_implicit_surface(particles, parameters_with_spacing(r));
  return {surface->triangulation.vertices, surface->triangulation.triangles};
}

Sequence make_moving_liquid(const std::string& name) {
  for (const auto& [known, make] : makers()) {
    if (known != name) continue;
    Sequence sequence;
    sequence.spacing = kSpacing;
    sequence.frames = make();
    sequence.mesh = implicit_mesh(sequence.frames.front(), kSpacing);
    return sequence;
  }
  throw std::invalid_argument("there is no moving liquid '" + name + "'");
}

std::vector<std::string> moving_liquid_names() {
  std::vector<std::string> names;
  for (const auto& [name, make] : makers()) names.push_back(name);
  return names;
}

}  // namespace particle_surface_tracker::test
