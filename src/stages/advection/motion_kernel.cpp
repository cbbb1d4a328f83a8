#include "motion_kernel.h"

#include <algorithm>
#include <cstring>

#include "core/per_instruction_set.h"

// The bodies are inlined into one function per set of instructions; every lane does the same operations in the same
// order in all of them.
#define PST_INLINE __attribute__((always_inline)) inline

namespace particle_surface_tracker {

namespace {

struct Four {
  using Floats = float __attribute__((vector_size(16)));
  using Ints = std::int32_t __attribute__((vector_size(16)));
  static constexpr int count = 4;
};

struct Eight {
  using Floats = float __attribute__((vector_size(32)));
  using Ints = std::int32_t __attribute__((vector_size(32)));
  static constexpr int count = 8;
};

struct Sixteen {
  using Floats = float __attribute__((vector_size(64)));
  using Ints = std::int32_t __attribute__((vector_size(64)));
  static constexpr int count = 16;
};

template <class Lanes>
PST_INLINE void load(const float* from, Lanes& lanes) {
  std::memcpy(&lanes, from, sizeof(lanes));
}

template <class Lanes, class Value>
PST_INLINE void store(const Lanes& lanes, Value* to) {
  std::memcpy(to, &lanes, sizeof(lanes));
}

/// As many values as there are lanes, or fewer where the array ends.
template <class Floats>
PST_INLINE void load_within(const float* values, std::size_t first, std::size_t size, Floats& lanes) {
  if (first + sizeof(lanes) / sizeof(float) <= size) {
    load(values + first, lanes);
  } else {
    lanes = Floats{};
    std::memcpy(&lanes, values + first, (size - first) * sizeof(float));
  }
}

template <class Width>
PST_INLINE std::size_t select_near(const Coordinates& particles, std::size_t begin, std::size_t end,
                                   const GroupBox& box, std::uint32_t* near) {
  using Floats = typename Width::Floats;
  std::size_t count = 0;
  for (std::size_t first = begin; first < end; first += Width::count) {
    Floats squared[3];
    for (int axis = 0; axis < 3; ++axis) {
      Floats place;
      load_within(particles.axis[axis], first, particles.size, place);
      place -= box.origin[axis];
      const Floats below = box.lower[axis] - place;
      const Floats above = place - box.upper[axis];
      const Floats farther = below > above ? below : above;
      const Floats beyond = farther > 0.0f ? farther : Floats{};
      squared[axis] = beyond * beyond;
    }
    std::int32_t is_near[Width::count];
    store(squared[0] + squared[1] + squared[2] < box.squared_reach, is_near);
    // Writes every particle and steps on only where it counts: cheaper than branches that are hard to predict.
    const std::size_t lanes = std::min<std::size_t>(Width::count, end - first);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      near[count] = static_cast<std::uint32_t>(first + lane);
      count += static_cast<std::size_t>(-is_near[lane]);
    }
  }
  return count;
}

/// Sums for the lanes from `first` on. Two passes, so that each keeps its sums in registers.
template <class Width>
PST_INLINE void sum_lanes(const NearParticle* particles, std::size_t count, float inverse_squared_radius,
                          float* weights, int first, MotionBatch& batch) {
  using Floats = typename Width::Floats;
  using Sums = MotionSums;
  Floats x, y, z;
  load(&batch.vertex[0][first], x);
  load(&batch.vertex[1][first], y);
  load(&batch.vertex[2][first], z);

  typename Width::Ints neighbors{};
  Floats weight{}, ox{}, oy{}, oz{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
  for (std::size_t i = 0; i < count; ++i) {
    const NearParticle& p = particles[i];
    const Floats dx = p.position[0] - x;
    const Floats dy = p.position[1] - y;
    const Floats dz = p.position[2] - z;
    const Floats s = 1.0f - (dx * dx + dy * dy + dz * dz) * inverse_squared_radius;
    const auto inside = s > 0.0f;
    const Floats clipped = inside ? s : Floats{};
    const Floats w = clipped * clipped * clipped;
    store(w, weights + i * Width::count);
    neighbors -= inside;
    weight += w;
    const Floats wx = w * dx;
    const Floats wy = w * dy;
    const Floats wz = w * dz;
    ox += wx;
    oy += wy;
    oz += wz;
    xx += wx * dx;
    xy += wx * dy;
    xz += wx * dz;
    yy += wy * dy;
    yz += wy * dz;
    zz += wz * dz;
  }
  store(neighbors, &batch.neighbors[first]);
  const Floats* const offsets[] = {&weight, &ox, &oy, &oz, &xx, &xy, &xz, &yy, &yz, &zz};
  for (int k = 0; k < Sums::displacement; ++k) store(*offsets[k], &batch.sums[k][first]);

  Floats u[3] = {};
  Floats cross[9] = {};
  Floats squared{};
  for (std::size_t i = 0; i < count; ++i) {
    const NearParticle& p = particles[i];
    Floats w;
    load(weights + i * Width::count, w);
    const Floats wx = w * (p.position[0] - x);
    const Floats wy = w * (p.position[1] - y);
    const Floats wz = w * (p.position[2] - z);
    for (int a = 0; a < 3; ++a) {
      u[a] += w * p.displacement[a];
      cross[3 * a] += wx * p.displacement[a];
      cross[3 * a + 1] += wy * p.displacement[a];
      cross[3 * a + 2] += wz * p.displacement[a];
    }
    squared += w * p.squared_displacement;
  }
  for (int a = 0; a < 3; ++a) store(u[a], &batch.sums[Sums::displacement + a][first]);
  for (int k = 0; k < 9; ++k) store(cross[k], &batch.sums[Sums::cross + k][first]);
  store(squared, &batch.sums[Sums::squared][first]);
}

/// A symmetric 3 × 3 matrix per lane, its cofactors and its determinant.
template <class Floats>
struct Symmetric {
  Floats xx, xy, xz, yy, yz, zz;

  PST_INLINE void add_to_diagonal(float value) {
    xx += value;
    yy += value;
    zz += value;
  }

  PST_INLINE void cofactors(Symmetric& c) const {
    c.xx = yy * zz - yz * yz;
    c.xy = xz * yz - xy * zz;
    c.xz = xy * yz - xz * yy;
    c.yy = xx * zz - xz * xz;
    c.yz = xy * xz - xx * yz;
    c.zz = xx * yy - xy * xy;
  }

  PST_INLINE void determinant(const Symmetric& cofactors, Floats& result) const {
    result = xx * cofactors.xx + xy * cofactors.xy + xz * cofactors.xz;
  }

  PST_INLINE void multiply(const Floats (&v)[3], Floats (&result)[3]) const {
    result[0] = xx * v[0] + xy * v[1] + xz * v[2];
    result[1] = xy * v[0] + yy * v[1] + yz * v[2];
    result[2] = xz * v[0] + yz * v[1] + zz * v[2];
  }
};

template <class Width>
PST_INLINE void fit_lanes(const PlainFit& bounds, int first, MotionBatch& batch) {
  using Floats = typename Width::Floats;
  using Sums = MotionSums;
  Floats mean[Sums::size];
  for (int k = 0; k < Sums::size; ++k) load(&batch.sums[k][first], mean[k]);
  const Floats scale = 1.0f / mean[0];
  for (Floats& value : mean) value *= scale;
  const Floats d[3] = {mean[1], mean[2], mean[3]};
  const Floats u[3] = {mean[10], mean[11], mean[12]};

  Symmetric<Floats> cofactors;
  Symmetric<Floats> covariance = {mean[4] - d[0] * d[0], mean[5] - d[0] * d[1], mean[6] - d[0] * d[2],
                                  mean[7] - d[1] * d[1], mean[8] - d[1] * d[2], mean[9] - d[2] * d[2]};

  // More than the smallest variance in all directions: positive leading minors.
  Symmetric<Floats> shifted = covariance;
  shifted.add_to_diagonal(-bounds.smallest_variance);
  shifted.cofactors(cofactors);
  Floats determinant;
  shifted.determinant(cofactors, determinant);
  auto is_plain = (shifted.xx > 0.0f) & (cofactors.zz > 0.0f) & (determinant > 0.0f);

  shifted = covariance;
  shifted.add_to_diagonal(bounds.smallest_variance);
  shifted.cofactors(cofactors);
  shifted.determinant(cofactors, determinant);
  Floats solved[3];
  cofactors.multiply(d, solved);
  const Floats leverage = 1.0f + (d[0] * solved[0] + d[1] * solved[1] + d[2] * solved[2]) / determinant;

  // A = cov(u, d) cov(d, d)⁻¹, one row for each component of u.
  covariance.cofactors(cofactors);
  covariance.determinant(cofactors, determinant);
  const Floats inverse = 1.0f / determinant;
  Floats unexplained = mean[Sums::squared] - (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  Floats squared_gradient{};
  for (int a = 0; a < 3; ++a) {
    Floats cross[3];
    Floats row[3];
    for (int b = 0; b < 3; ++b) cross[b] = mean[Sums::cross + 3 * a + b] - u[a] * d[b];
    cofactors.multiply(cross, row);
    for (int b = 0; b < 3; ++b) row[b] *= inverse;
    squared_gradient += row[0] * row[0] + row[1] * row[1] + row[2] * row[2];
    unexplained -= row[0] * cross[0] + row[1] * cross[1] + row[2] * cross[2];
    const Floats correction = -(row[0] * d[0] + row[1] * d[1] + row[2] * d[2]);
    store(u[a], &batch.average[a][first]);
    store(correction, &batch.correction[a][first]);
  }
  is_plain &= squared_gradient <= bounds.largest_squared_gradient;
  const Floats misfit = (unexplained > 0.0f ? unexplained : Floats{}) * leverage;
  store(misfit, &batch.squared_misfit[first]);
  store(is_plain, &batch.is_plain[first]);
}

template <class Width>
PST_INLINE void sum_all(const NearParticle* particles, std::size_t count, float inverse_squared_radius, float* weights,
                        MotionBatch& batch) {
  for (int first = 0; first < batch.used; first += Width::count) {
    if (Width::count == 16 && batch.used <= first + Eight::count) {
      sum_lanes<Eight>(particles, count, inverse_squared_radius, weights, first, batch);
    } else {
      sum_lanes<Width>(particles, count, inverse_squared_radius, weights, first, batch);
    }
  }
}

template <class Width>
PST_INLINE void fit_all(const PlainFit& bounds, MotionBatch& batch) {
  for (int first = 0; first < batch.used; first += Width::count) fit_lanes<Width>(bounds, first, batch);
}

#define PST_MOTION_KERNEL(name, Width, target)                                                           \
  target std::size_t select_##name(const Coordinates& particles, std::size_t begin, std::size_t end,     \
                                   const GroupBox& box, std::uint32_t* near) {                           \
    return select_near<Width>(particles, begin, end, box, near);                                         \
  }                                                                                                      \
  target void sum_##name(const NearParticle* particles, std::size_t count, float inverse_squared_radius, \
                         float* weights, MotionBatch& batch) {                                           \
    sum_all<Width>(particles, count, inverse_squared_radius, weights, batch);                            \
  }                                                                                                      \
  target void fit_##name(const PlainFit& bounds, MotionBatch& batch) {                                   \
    fit_all<Width>(bounds, batch);                                                                       \
  }

PST_MOTION_KERNEL(baseline, Four, )
PST_MOTION_KERNEL(avx2, Eight, __attribute__((target("avx2"))))
PST_MOTION_KERNEL(avx512, Sixteen, __attribute__((target("avx512f"))))

}  // namespace

const MotionKernel& active_motion_kernel() {
  static constexpr PerInstructionSet<MotionKernel> kernels = {{select_baseline, sum_baseline, fit_baseline},
                                                              {select_avx2, sum_avx2, fit_avx2},
                                                              {select_avx512, sum_avx512, fit_avx512}};
  return kernels.active();
}

}  // namespace particle_surface_tracker
