#pragma once

#include <random>

#include "materials/point/material_point.hpp"

namespace mudline {

/// Reproducible random initial states and strain increments for a law.
class Sampler {
 public:
  /// `in_plane`: the law refuses the shears yz and xz, so they stay zero.
  Sampler(const Skeleton& law, unsigned seed, bool in_plane);

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  /// A point that the law accepts; where the law refuses, the deviator is reduced repeatedly.
  InitialPoint point();
  Six increment(double smallest, double largest);
  /// A random rotation, row-major; about z in the plane.
  std::array<double, 9> rotation();
  /// Number of points that the law refused even without a deviator.
  int refused() const { return refused_; }
  const std::string& refusal() const { return refusal_; }

 private:
  InitialPoint draw(double deviator);

  const Skeleton& law_;
  bool in_plane_;
  std::mt19937_64 engine_;
  std::vector<double> state_;
  int refused_ = 0;
  std::string refusal_;
};

}  // namespace mudline
