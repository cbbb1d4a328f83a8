#include "affine_motion.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace particle_surface_tracker {

namespace {

using Eigen::Matrix3d;

/// Of the unexplained motion, in single precision, per displacement.
constexpr double kRounding = 1e-3;

/// True if a symmetric matrix is positive definite, by its leading minors.
bool is_positive_definite(const Matrix3d& m) {
  return m(0, 0) > 0.0 && m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0) > 0.0 && m.determinant() > 0.0;
}

/// Moments about the neighbours' centroid.
struct CentralMoments {
  Vec3d offset;         // d̄
  Vec3d displacement;   // ū
  Matrix3d covariance;  // of d
  Matrix3d cross;       // of u with d: cross(a, b) = cov(u_a, d_b)
  double mean_square;   // of u
  double variance;      // of u, summed over its components
};

CentralMoments central_moments(const MotionSums& s) {
  CentralMoments m;
  const Eigen::Matrix<double, MotionSums::size, 1> mean =
      Eigen::Map<const Eigen::Matrix<float, MotionSums::size, 1>>(s.values.data()).cast<double>() / s.weight();
  m.offset = mean.segment<3>(MotionSums::offset);
  m.displacement = mean.segment<3>(MotionSums::displacement);
  const Eigen::Matrix<double, 6, 1> c = mean.segment<6>(MotionSums::covariance);
  m.covariance << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
  m.covariance -= m.offset * m.offset.transpose();
  m.cross = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(mean.data() + MotionSums::cross);
  m.cross -= m.displacement * m.offset.transpose();
  m.mean_square = mean[MotionSums::squared];
  m.variance = std::max(0.0, m.mean_square - m.displacement.squaredNorm());
  return m;
}

/// F = I + A where the neighbours spread in all directions.
Matrix3d full_gradient(const CentralMoments& m) {
  return Matrix3d::Identity() + m.cross * m.covariance.inverse();
}

/// The shortest rotation that turns direction a into direction b.
Matrix3d shortest_rotation(const Vec3d& a, const Vec3d& b) {
  return Eigen::Quaterniond::FromTwoVectors(a, b).toRotationMatrix();
}

/// F where the neighbours lie in a plane or on a line, or all in one place. What they do not tell is completed: the
/// normal of a sheet turns with it, and so does what surrounds a thread.
Matrix3d deficient_gradient(const CentralMoments& m, double smallest_variance, int& rank) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(m.covariance);
  const Vec3d variances = eigen.eigenvalues();
  rank = static_cast<int>((variances.array() > smallest_variance).count());
  const auto image = [&](int axis) -> Vec3d {
    const Vec3d direction = eigen.eigenvectors().col(axis);
    return direction + m.cross * direction / variances[axis];
  };
  if (variances[2] <= smallest_variance) return Matrix3d::Identity();
  const Vec3d longest = eigen.eigenvectors().col(2);
  if (variances[1] <= smallest_variance) return shortest_rotation(longest, image(2));
  const Vec3d middle = eigen.eigenvectors().col(1);
  const Vec3d normal = image(1).cross(image(2));
  if (normal.norm() < 1e-6) return Matrix3d::Identity();
  Matrix3d from;
  from << middle, longest, middle.cross(longest);
  Matrix3d to;
  to << image(1), image(2), normal.normalized();
  return to * from.transpose();
}

/// F with its stretches clamped to 1 ± limit and its rotation kept. Where nothing has to be clamped, F comes back as it
/// is.
Matrix3d clamp_stretches(const Matrix3d& f, double limit) {
  const Matrix3d c = f.transpose() * f;
  const double low = (1.0 - limit) * (1.0 - limit);
  const double high = (1.0 + limit) * (1.0 + limit);
  const bool within = f.determinant() > 0.0 && is_positive_definite(c - low * Matrix3d::Identity()) &&
                      is_positive_definite(high * Matrix3d::Identity() - c);
  if (within) return f;
  const Eigen::JacobiSVD<Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3d stretches = svd.singularValues();
  Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0.0) {
    u.col(2) *= -1.0;
    stretches[2] *= -1.0;
  }
  stretches = stretches.cwiseMax(1.0 - limit).cwiseMin(1.0 + limit);
  return u * stretches.asDiagonal() * svd.matrixV().transpose();
}

bool spreads_in_all_directions(const CentralMoments& m, double smallest_variance) {
  return is_positive_definite(m.covariance - smallest_variance * Matrix3d::Identity());
}

}  // namespace

bool is_motion_settled(const MotionSums& sums, double r, const Parameters& parameters) {
  if (!(sums.weight() > 0.0f)) return false;
  const CentralMoments m = central_moments(sums);
  return m.mean_square == 0.0 || spreads_in_all_directions(m, parameters.affine_rank_threshold * r * r);
}

Vec3d average_displacement(const MotionSums& s) {
  const float* u = &s.values[MotionSums::displacement];
  return s.reference.cast<double>() + Vec3d(u[0], u[1], u[2]) / static_cast<double>(s.weight());
}

AffineFit fit_affine_motion(const MotionSums& sums, double r, const Parameters& parameters) {
  if (!(sums.weight() > 0.0f)) return {};
  const CentralMoments m = central_moments(sums);
  const Vec3d average = sums.reference.cast<double>() + m.displacement;
  if (m.mean_square == 0.0) return {average, 1.0, 0.0, 3};  // rest stays exact
  const double smallest_variance = parameters.affine_rank_threshold * r * r;
  const bool full = spreads_in_all_directions(m, smallest_variance);
  int rank = 3;
  const Matrix3d fitted = full ? full_gradient(m) : deficient_gradient(m, smallest_variance, rank);
  const Matrix3d f = clamp_stretches(fitted, parameters.affine_max_stretch);
  const Matrix3d a = f - Matrix3d::Identity();

  // What the fit leaves unexplained: nothing where the particles move as one body, much where several bodies meet. It
  // weighs more where few particles settle the fit, and where the vertex lies far outside of them.
  const double unexplained =
      std::max(0.0, m.variance - 2.0 * a.cwiseProduct(m.cross).sum() + (a * m.covariance).cwiseProduct(a).sum());
  const Matrix3d regular = m.covariance + smallest_variance * Matrix3d::Identity();
  const double leverage = 1.0 + m.offset.dot(regular.inverse() * m.offset);
  const double factor = leverage * settling_factor(sums.neighbors);
  const double misfit = std::sqrt(unexplained * factor);

  // Three particles can always be fitted; that their distances stay the same tells that they are of one body. Green's
  // strain is 0 for every rotation.
  const Matrix3d strain = 0.5 * (f.transpose() * f - Matrix3d::Identity());
  const double strained = std::max(0.0, (strain * m.covariance).cwiseProduct(strain).sum());
  const double rounding = kRounding * kRounding * m.mean_square;
  const double unrigidness = std::sqrt(std::max(0.0, unexplained + strained - rounding) * factor);
  return {average - a * m.offset, trust_in_fit(misfit, r, parameters), unrigidness, rank};
}

}  // namespace particle_surface_tracker
