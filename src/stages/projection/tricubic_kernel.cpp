#include "tricubic_kernel.h"

#include <cmath>

#include "core/per_instruction_set.h"

// The body is inlined into one function per set of instructions; every lane does the same operations in the same order
// in all of them. Loops over lanes are innermost, so that the compiler turns each into registers of the width at hand.
#define PST_INLINE __attribute__((always_inline)) inline

namespace particle_surface_tracker {

namespace {

constexpr int kLanes = TricubicBatch::lanes;

using Lanes = TricubicBatch::Lanes;

struct Weights {
  alignas(64) std::array<Lanes, 4> value;
  alignas(64) std::array<Lanes, 4> slope;
};

/// Catmull–Rom weights of four nodes and their derivatives.
PST_INLINE void set_weights(const Lanes& place, Weights& w) {
  for (int l = 0; l < kLanes; ++l) {
    const float t = place[l];
    const float t2 = t * t;
    const float t3 = t2 * t;
    w.value[0][l] = 0.5f * (2.0f * t2 - t3 - t);
    w.value[1][l] = 0.5f * (3.0f * t3 - 5.0f * t2 + 2.0f);
    w.value[2][l] = 0.5f * (4.0f * t2 - 3.0f * t3 + t);
    w.value[3][l] = 0.5f * (t3 - t2);
    w.slope[0][l] = 0.5f * (4.0f * t - 3.0f * t2 - 1.0f);
    w.slope[1][l] = 0.5f * (9.0f * t2 - 10.0f * t);
    w.slope[2][l] = 0.5f * (8.0f * t - 9.0f * t2 + 1.0f);
    w.slope[3][l] = 0.5f * (3.0f * t2 - 2.0f * t);
  }
}

/// One weighted sum of four, for all lanes.
PST_INLINE void weigh(const std::array<Lanes, 4>& w, const Lanes* values, Lanes& result) {
  for (int l = 0; l < kLanes; ++l) {
    result[l] = (w[0][l] * values[0][l] + w[1][l] * values[1][l]) + (w[2][l] * values[2][l] + w[3][l] * values[3][l]);
  }
}

PST_INLINE void evaluate(TricubicBatch& batch, const StepLength& step_length) {
  Weights x;
  Weights y;
  Weights z;
  set_weights(batch.place[0], x);
  set_weights(batch.place[1], y);
  set_weights(batch.place[2], z);
  alignas(64) std::array<Lanes, 4> value_x;    // φ after the sums over z and y
  alignas(64) std::array<Lanes, 4> slope_y_x;  // ∂φ/∂y
  alignas(64) std::array<Lanes, 4> slope_z_x;  // ∂φ/∂z
  for (int i = 0; i < 4; ++i) {
    alignas(64) std::array<Lanes, 4> value_xy;
    alignas(64) std::array<Lanes, 4> slope_xy;
    for (int j = 0; j < 4; ++j) {
      const Lanes* row = &batch.nodes[16 * i + 4 * j];
      weigh(z.value, row, value_xy[j]);
      weigh(z.slope, row, slope_xy[j]);
    }
    weigh(y.value, value_xy.data(), value_x[i]);
    weigh(y.slope, value_xy.data(), slope_y_x[i]);
    weigh(y.value, slope_xy.data(), slope_z_x[i]);
  }
  weigh(x.value, value_x.data(), batch.value);
  weigh(x.slope, value_x.data(), batch.gradient[0]);
  weigh(x.value, slope_y_x.data(), batch.gradient[1]);
  weigh(x.value, slope_z_x.data(), batch.gradient[2]);
  for (int l = 0; l < kLanes; ++l) {
    const float gx = batch.gradient[0][l];
    const float gy = batch.gradient[1][l];
    const float gz = batch.gradient[2][l];
    batch.slope[l] = std::sqrt(gx * gx + gy * gy + gz * gz);
  }
  alignas(64) Lanes step;
  for (int l = 0; l < kLanes; ++l) {
    const float length = std::abs(batch.value[l]) < step_length.near_until ? step_length.near : step_length.far;
    step[l] = length * batch.value[l] / batch.slope[l];
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int l = 0; l < kLanes; ++l) batch.next[axis][l] = batch.place[axis][l] - step[l] * batch.gradient[axis][l];
  }
}

void evaluate_baseline(TricubicBatch& batch, const StepLength& step_length) {
  evaluate(batch, step_length);
}

__attribute__((target("avx2"))) void evaluate_avx2(TricubicBatch& batch, const StepLength& step_length) {
  evaluate(batch, step_length);
}

__attribute__((target("avx512f,prefer-vector-width=512"))) void evaluate_avx512(TricubicBatch& batch,
                                                                                const StepLength& step_length) {
  evaluate(batch, step_length);
}

}  // namespace

TricubicKernel active_tricubic_kernel() {
  static constexpr PerInstructionSet<TricubicKernel> kernels = {evaluate_baseline, evaluate_avx2, evaluate_avx512};
  return kernels.active();
}

}  // namespace particle_surface_tracker
