#pragma once

namespace particle_surface_tracker {

/// A number without rounding error: the sum of some doubles that do not overlap, smallest first, none of them 0
/// (Shewchuk 1997, "Adaptive Precision Floating-Point Arithmetic"). Exact as long as no product leaves the range of
/// doubles.
template <int kCapacity>
class Expansion {
 public:
  Expansion() {}  // NOLINT: parts beyond the count are never read, and setting them would cost more than the sum.

  int count() const { return count_; }
  double operator[](int n) const { return parts_[n]; }

  void append(double part) {
    if (part != 0.0) parts_[count_++] = part;
  }

  /// Adds one double.
  void add(double addend) {
    const int old_count = count_;
    count_ = 0;
    for (int n = 0; n < old_count; ++n) {
      const double sum = addend + parts_[n];
      const double virtual_part = sum - addend;
      append((addend - (sum - virtual_part)) + (parts_[n] - virtual_part));
      addend = sum;
    }
    append(addend);
  }

  int sign() const { return count_ == 0 ? 0 : (parts_[count_ - 1] > 0.0 ? 1 : -1); }

 private:
  int count_ = 0;
  double parts_[kCapacity];
};

/// a − b.
inline Expansion<2> exact_difference(double a, double b) {
  Expansion<2> result;
  result.add(a);
  result.add(-b);
  return result;
}

template <int kLeft, int kRight>
Expansion<kLeft + kRight> operator+(const Expansion<kLeft>& left, const Expansion<kRight>& right) {
  Expansion<kLeft + kRight> sum;
  for (int n = 0; n < left.count(); ++n) sum.append(left[n]);
  for (int n = 0; n < right.count(); ++n) sum.add(right[n]);
  return sum;
}

template <int kLeft, int kRight>
Expansion<kLeft + kRight> operator-(const Expansion<kLeft>& left, const Expansion<kRight>& right) {
  Expansion<kLeft + kRight> difference;
  for (int n = 0; n < left.count(); ++n) difference.append(left[n]);
  for (int n = 0; n < right.count(); ++n) difference.add(-right[n]);
  return difference;
}

/// The two halves of the digits of a double.
struct SplitDouble {
  double high;
  double low;

  explicit SplitDouble(double value) {
    const double scaled = 134217729.0 * value;  // 2²⁷ + 1
    high = scaled - (scaled - value);
    low = value - high;
  }
};

/// Rounding error of left · right, which has been rounded to `product`.
inline double product_error(const SplitDouble& left, const SplitDouble& right, double product) {
  return ((left.high * right.high - product) + left.high * right.low + left.low * right.high) + left.low * right.low;
}

template <int kLeft, int kRight>
Expansion<2 * kLeft * kRight> operator*(const Expansion<kLeft>& left, const Expansion<kRight>& right) {
  Expansion<2 * kLeft * kRight> result;
  for (int i = 0; i < left.count(); ++i) {
    const SplitDouble split_left(left[i]);
    for (int j = 0; j < right.count(); ++j) {
      const double product = left[i] * right[j];
      result.add(product_error(split_left, SplitDouble(right[j]), product));
      result.add(product);
    }
  }
  return result;
}

}  // namespace particle_surface_tracker
