#pragma once

#include <random>

#include "materials/point/material_point.hpp"

namespace mudline {

/// Random states that a law may start from and random strain increments, repeatable.
class Sampler {
 public:
  /// `in_plane`: the law refuses the shears yz and xz, so they stay zero.
  Sampler(const Skeleton& law, unsigned seed, bool in_plane);

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  /// A point that the law accepts: where it refuses, the deviator is drawn smaller and smaller.
  InitialPoint point();
  Six increment(double smallest, double largest);
  /// Row-major; about z when in the plane.
  std::array<double, 9> rotation();
  /// Points that the law refused even without a deviator.
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
