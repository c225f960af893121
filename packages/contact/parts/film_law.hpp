#pragma once

#include "contact/contact_rule.hpp"
#include "contact/point_data.hpp"
#include "tensor/mat.hpp"

namespace mudline {

/// Water between a side and the target in a step. A point's film is as thick as the gap g where that is wide: its
/// thickness is (g + sqrt(g^2 + 4 a^2))/2 with the aperture a that rough surfaces leave where they meet. Where the pore
/// pressure p is below that of cavitation, p_c, the share 1 - (p_c - p)/softness of the film is water, the rest vapour.
struct SideFilm {
  bool acts = false;     // its pressure is the pore pressure of the soil's surface
  bool flows = false;    // its water moves: it comes from the soil or flows along the film
  double viscosity = 0;  // [Pa s]
  double softness = 0;   // [Pa]
  double aperture = 0;   // [m]
  Point weight{};        // [N/m3] of the water
};

/// Thickness of the film [m].
template <class T>
T film_thickness(const T& gap, double aperture) {
  const T root = square_root(gap * gap + 4 * aperture * aperture);
  return value(gap) > 0 ? 0.5 * (gap + root) : T(2 * aperture * aperture) / (root - gap);
}

/// Water of a film at a point.
template <class T>
struct FilmWater {
  /// `gap_old`, `area_old`: at the start of the step, and so is the area through which the water flows along the film.
  FilmWater(const SideFilm& film, const PointHistory& old, const T& gap, double gap_old, const T& area, double area_old,
            const T& pore_pressure, double dt) {
    const T thickness = film_thickness(gap, film.aperture);
    const T lack = old.cavitation - pore_pressure;
    vapour = value(lack) > 0 ? thickness * lack * (1 / film.softness) : T(0.0);
    water = thickness - vapour;
    if (!film.flows) return;
    const double water_old = (film_thickness(gap_old, film.aperture) - old.vapour) * area_old;
    growth = (water * area - water_old) * (1 / dt);
    const T open = value(water) > 0 ? water : T(0.0);
    conduction = open * open * open * (area_old / (12 * film.viscosity));
  }
  T water, vapour;                 // [m] of the film's thickness
  T growth{0.0}, conduction{0.0};  // [m3/s], [m5/(Pa s)] where the film flows
};

/// Gradients [1/m] of the pore pressure's shape functions at point c, along the side as it was at the start of the
/// step.
template <int D>
void pressure_slopes(const ContactRule& rule, int c, const SideCoordinates& x_old, int pressure_nodes, Point* slope) {
  const bool corners = pressure_nodes < rule.nodes;
  const double* dP = corners ? &rule.corner_slope(c, 0) : &rule.shape_slope(c, 0);
  SideMap<D> map;
  map.compute(rule.nodes, &rule.shape(c, 0), &rule.shape_slope(c, 0), [&](int a, int i) { return x_old[a][i]; });
  constexpr int K = D - 1;
  Mat<double, K> metric, inverse;
  for (int k = 0; k < K; ++k)
    for (int l = 0; l < K; ++l) {
      metric[k][l] = 0;
      for (int i = 0; i < D; ++i) metric[k][l] += map.along[k][i] * map.along[l][i];
    }
  if constexpr (K == 1)
    invert(metric, metric[0][0], inverse);
  else
    invert(metric, determinant(metric), inverse);
  for (int a = 0; a < pressure_nodes; ++a) {
    slope[a] = {};
    for (int k = 0; k < K; ++k)
      for (int l = 0; l < K; ++l)
        for (int i = 0; i < D; ++i) slope[a][i] += inverse[k][l] * dP[K * a + l] * map.along[k][i];
  }
}

/// Overload that takes the dimension from the side's shape.
inline void pressure_slopes(const ContactRule& rule, int c, const SideCoordinates& x_old, int pressure_nodes,
                            Point* slope) {
  if (dimension(rule.side) == 1)
    pressure_slopes<2>(rule, c, x_old, pressure_nodes, slope);
  else
    pressure_slopes<3>(rule, c, x_old, pressure_nodes, slope);
}

}  // namespace mudline
