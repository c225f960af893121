#include "physics/solid/point_surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "discretisation/shapes.hpp"
#include "framework/coordinates.hpp"
#include "physics/mixture.hpp"
#include "tensor/midpoint_rule.hpp"

namespace mudline {

namespace {

/// The elements of a block in one configuration.
template <class C>
class Configuration {
 public:
  static constexpr int D = C::dim;
  Configuration(const SoilBlock& b, const ConstCoordinateView& x) : b_(b), x_(x) {}

  Point place(int e, int q) const { return b_.place(e, q, x_); }
  /// J = dx / d xi; returns its determinant.
  double jacobian(int e, int q, double (&J)[D][D]) const {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        J[i][j] = 0;
        for (int a = 0; a < b_.u.nodes; ++a) J[i][j] += x_(b_.nodes(e, a), i) * b_.u.dN(q, a, j);
      }
    return determinant(J);
  }
  /// Root of the area or cube root of the volume of an element, over the order of its cell [m].
  double length(int e) const {
    double measure = 0, J[D][D];
    for (int q = 0; q < b_.points; ++q) measure += b_.u.weights(q) * jacobian(e, q, J);
    return std::pow(std::max(measure, 0.0), 1.0 / D) / order(b_.shape);
  }

 private:
  const SoilBlock& b_;
  const ConstCoordinateView& x_;
};

/// The motion of a step at one point; none where it turns the element inside out, which no step may do.
template <class C>
void write_motion(const Configuration<C>& old, const Configuration<C>& now, int e, int q, double* row) {
  constexpr int D = C::dim;
  double *deformation = row + Surroundings::deformation, *rotation = row + Surroundings::rotation;
  for (int i = 0; i < 9; ++i) deformation[i] = rotation[i] = i % 4 == 0 ? 1.0 : 0.0;
  const Point x = now.place(e, q), x_old = old.place(e, q);
  std::copy_n(x.data(), 3, row + Surroundings::place);
  double J[D][D], back[D][D], F[D][D], sum[D][D], inverse[D][D], H[D][D];
  const double det = old.jacobian(e, q, J), hoop = C::hoop ? x[0] / x_old[0] : 1.0;
  if (!(det > 0) || !(hoop > 0)) return;
  invert(J, det, back);
  if (!(now.jacobian(e, q, J) > 0)) return;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      F[i][j] = 0;
      for (int k = 0; k < D; ++k) F[i][j] += J[i][k] * back[k][j];
      sum[i][j] = F[i][j] + (i == j ? 1.0 : 0.0);
    }
  // the gradient on the midpoint configuration, H = 2 (F - 1) (F + 1)^-1
  const double size = determinant(sum);
  if (!(size > 0)) return;
  invert(sum, size, inverse);
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      H[i][j] = 0;
      for (int k = 0; k < D; ++k) H[i][j] += 2 * (F[i][k] - (i == k ? 1.0 : 0.0)) * inverse[k][j];
    }
  MidpointRule<D> motion;
  motion.evaluate(H, C::hoop ? 2 * (hoop - 1) / (hoop + 1) : 0.0, true);
  if constexpr (D == 2) deformation[8] = hoop;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      deformation[3 * i + j] = F[i][j];
      rotation[3 * i + j] = motion.rotation[i][j];
    }
}

}  // namespace

void write_surroundings(const Soil& soil, const SoilBlock& b, const StepView& view, int first, int last,
                        const PointView& to) {
  const auto& numbers = soil.space->mesh().blocks()[b.block].global_ids;
  const int warm = place_of_scalar(b, soil.temperature);
  const int begin = static_cast<int>(b.dofs.extent(1)) - (b.scalars - warm) * b.p.nodes;  // of the temperature's dofs
  with_coordinates(soil.geometry, [&](auto coordinates) {
    const Configuration<decltype(coordinates)> old(b, view.x_old), now(b, view.x_end);
    for (int e = first; e < last; ++e) {
      const double length = now.length(e);
      for (int q = 0; q < b.points; ++q) {
        double* row = &to((e - first) * b.points + q, 0);
        std::fill_n(row, Surroundings::size, std::numeric_limits<double>::quiet_NaN());
        write_motion(old, now, e, q, row);
        row[Surroundings::length] = length;
        row[Surroundings::element] = static_cast<double>(numbers[e] + 1);
        row[Surroundings::point] = q + 1;
        if (warm < 0) continue;
        double before = 0, after = 0;
        for (int a = 0; a < b.p.nodes; ++a) {
          const int dof = b.dofs(e, begin + a);
          before += b.p.N(q, a) * view.value_old(dof);
          after += b.p.N(q, a) * view.value_end(dof);
        }
        row[Surroundings::temperature] = before;
        row[Surroundings::temperature + 1] = after - before;
      }
    }
  });
}

}  // namespace mudline
