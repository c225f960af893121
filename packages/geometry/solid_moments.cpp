#include "geometry/solid_moments.hpp"

#include "tensor/mat.hpp"

namespace mudline {

Point SolidMoments::centroid() const { return volume == 0 ? Point{} : 1 / volume * first; }

std::array<Point, 3> SolidMoments::inertia() const {
  const Point c = centroid();
  std::array<Point, 3> about{}, result{};
  double trace = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) about[i][j] = second[i][j] - volume * c[i] * c[j];
    trace += about[i][i];
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result[i][j] = (i == j ? trace : 0.0) - about[i][j];
  return result;
}

void SolidMoments::add(const SolidMoments& other, double factor) {
  volume += factor * other.volume;
  first += factor * other.first;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) second[i][j] += factor * other.second[i][j];
}

void SolidMoments::add_block(const Point& centre, const Point& lengths, double factor) {
  const double part = factor * lengths[0] * lengths[1] * lengths[2];
  volume += part;
  first += part * centre;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) second[i][j] += part * centre[i] * centre[j];
    second[i][i] += part * lengths[i] * lengths[i] / 12;
  }
}

void SolidMoments::add_side(const Point& at, const Point& area) {
  // div x = 3, div (x_i x) = 4 x_i, div (x_i x_j x) = 5 x_i x_j
  const double flux = dot(at, area);
  volume += flux / 3;
  first += flux / 4 * at;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) second[i][j] += flux / 5 * at[i] * at[j];
}

SolidMoments SolidMoments::placed(const Mat<double, 3>& rotation, const Point& shift) const {
  SolidMoments result;
  result.volume = volume;
  Point turned{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) turned[i] += rotation[i][k] * first[k];
  result.first = turned + volume * shift;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double sum = volume * shift[i] * shift[j] + turned[i] * shift[j] + shift[i] * turned[j];
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) sum += rotation[i][k] * second[k][l] * rotation[j][l];
      result.second[i][j] = sum;
    }
  return result;
}

}  // namespace mudline
