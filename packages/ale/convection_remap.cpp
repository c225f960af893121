#include <algorithm>
#include <cmath>

#include "ale/remap.hpp"
#include "discretisation/element_map.hpp"

namespace mudline {

namespace {

/// Side [m] of the square or cube that the element fills: a triangle or a wedge half, a tetrahedron a sixth of it.
double size_of(const GhostedMesh::Element& element, const Positions& x) {
  const int corners = num_corners(element.shape);
  if (dimension(element.shape) == 3) {
    const CellShape shape = linear_partner(element.shape);
    const ElementMap map(shape, [&](int a) { return x[element.nodes[a]].data(); });
    return std::cbrt(std::abs(map.determinant(cell_centre(shape).data()) * reference_size(shape) * per_box(shape)));
  }
  double area2 = 0;
  for (int a = 0; a < corners; ++a) {
    const auto &p = x[element.nodes[a]], &q = x[element.nodes[(a + 1) % corners]];
    area2 += p[0] * q[1] - p[1] * q[0];
  }
  return std::sqrt(std::abs(corners == 3 ? area2 : 0.5 * area2));
}

/// Largest departure of a resolved field from the recovered one, as a share of the recovered field's range over the
/// element. Strains in a simplex are at most linear, so that the quadratic polynomials of the recovery can represent
/// them. A larger departure is scatter from point to point, as from the volumetric strains of undrained soil, which
/// vanish only in the mean. (Quadrilaterals and bricks have strain terms that the polynomials lack.)
constexpr double resolved = 0.5;
/// Motion after which scatter is removed, as a share of half an element: it would accumulate where points hardly move.
/// The departure of a resolved field is removed over the whole half.
constexpr double scatter_distance = 0.01;

/// The departure from the recovered field that a point of a simplex keeps. `rest`: the part that upwinding alone would
/// keep; `courant`: the point's motion in half elements; `change`: range of the recovered field over the element.
double without_scatter(double rest, double courant, double change) {
  const double within = std::clamp(rest, -resolved * change, resolved * change);
  return rest + std::min(1.0, courant / scatter_distance) * (within - rest);
}

/// The field recovered from a table plus the field recovered from the residual at the points (Tukey's twicing): a field
/// that elements hardly resolve, as a front few of them thick, is smoothed much less, and scatter from point to point
/// as before.
class TwiceRecovered {
 public:
  explicit TwiceRecovered(const PointTransfer& t)
      : first_(t.before.mesh, t.before.block, t.patches, t.before.x, t.old, t.columns),
        rest_(left_out(t, first_)),
        second_(t.before.mesh, t.before.block, t.patches, t.before.x, rest_, t.columns),
        more_(t.columns) {}
  void at(const MeshPlace& place, double* values) {
    first_.at(place, values);
    second_.at(place, more_.data());
    for (std::size_t c = 0; c < more_.size(); ++c) values[c] += more_[c];
  }
  const std::pair<double, double>& range(int element, int column) const { return first_.range(element, column); }

 private:
  static std::vector<double> left_out(const PointTransfer& t, const Recovery& recovered) {
    const GhostedMesh& mesh = t.before.mesh;
    const SoilBlock& block = t.before.block;
    std::vector<double> rest = t.old, here(t.columns);
    for (int e : mesh.block_elements(block.block))
      for (int q = 0; q < block.points; ++q) {
        recovered.at_point(e, q, here.data());
        const std::size_t row = static_cast<std::size_t>(mesh.first_row(e, block.points) + q) * t.columns;
        for (int c = 0; c < t.columns; ++c) rest[row + c] -= here[c];
      }
    // Recovery is incomplete in the outermost ghosts: their owners' values are taken.
    mesh.fill_points(block.block, block.points, t.columns, rest);
    return rest;
  }

  Recovery first_;
  std::vector<double> rest_;  // (row of gather_points, column)
  Recovery second_;
  std::vector<double> more_;
};

}  // namespace

void ConvectionRemap::parameters(Parameters& p) {
  p.choice("scheme", scheme_, {{"upwind", Scheme::upwind}, {"incremental", Scheme::incremental}},
           "share of the recovered field itself: growing with the distance moved (and in triangles and tetrahedra soon "
           "all of it where points scatter about it by more than a field would), or none");
  p.add("limited", limited_, "no new extremum over the elements that a point leaves and enters");
}

void ConvectionRemap::transfer(const PointTransfer& t) const {
  const GhostedMesh& mesh = t.before.mesh;
  const SoilBlock& block = t.before.block;
  const Positions &x_old = t.before.x, &x_new = t.after.x;
  const Recovery recovered(mesh, block, t.patches, x_old, t.old, t.columns);
  const PointLocator locator(mesh, x_old);
  const ColumnBounds bounds(t.variables);
  std::vector<double> there(t.columns), here(t.columns), changes(t.columns);  // recovered values
  const bool scatters = scheme_ == Scheme::upwind && is_simplex(block.shape);
  for (int e : mesh.own_elements(block.block)) {
    const auto& element = mesh.elements()[e];
    bool moved = false;
    for (int a = 0; a < num_nodes(element.shape); ++a)
      moved = moved || x_new[element.nodes[a]] != x_old[element.nodes[a]];
    if (!moved) continue;
    const double size = size_of(element, x_old);
    if (scatters) recovered.changes(e, changes.data());
    for (int q = 0; q < block.points; ++q) {
      const auto from = Recovery::position(element, block, q, x_old), to = Recovery::position(element, block, q, x_new);
      const MeshPlace place = locator.find(to, e);
      const double courant = std::min(1.0, distance(to, from) / (0.5 * size));
      const double own = scheme_ == Scheme::upwind ? 1 - courant : 1.0;
      const std::size_t row = static_cast<std::size_t>(mesh.first_row(e, block.points) + q) * t.columns;
      recovered.at(place, there.data());
      recovered.at_point(e, q, here.data());
      for (int c = 0; c < t.columns; ++c) {
        double deviation = own * (t.old[row + c] - here[c]);
        if (scatters) deviation = without_scatter(deviation, courant, changes[c]);
        double value = there[c] + deviation;
        if (limited_) {
          const auto &left = recovered.range(e, c), &entered = recovered.range(place.element, c);
          value = std::clamp(value, std::min(left.first, entered.first), std::max(left.second, entered.second));
        }
        t.now[row + c] = std::clamp(value, bounds.low[c], bounds.high[c]);
      }
    }
  }
}

ColumnBounds::ColumnBounds(const std::vector<StateVariable>& variables) {
  for (const StateVariable& variable : variables) {
    low.insert(low.end(), variable.components, variable.low);
    high.insert(high.end(), variable.components, variable.high);
  }
}

void RecoveryRemap::transfer(const PointTransfer& t) const {
  TwiceRecovered recovered(t);
  const PointLocator locator(t.before.mesh, t.before.x);
  const ColumnBounds bounds(t.variables);
  std::vector<double> there(t.columns);
  const GhostedMesh& mesh = t.after.mesh;
  const SoilBlock& block = t.after.block;
  int guess = t.before.mesh.block_elements(t.before.block.block).front();
  for (int e : mesh.own_elements(block.block))
    for (int q = 0; q < block.points; ++q) {
      const MeshPlace place = locator.find(t.after.place(e, q), guess);
      guess = place.element;
      recovered.at(place, there.data());
      double* row = &t.now[static_cast<std::size_t>(mesh.first_row(e, block.points) + q) * t.columns];
      for (int c = 0; c < t.columns; ++c) {
        const auto& range = recovered.range(place.element, c);
        row[c] = std::clamp(std::clamp(there[c], range.first, range.second), bounds.low[c], bounds.high[c]);
      }
    }
}

void register_remaps(Registry<Remap>& registry) {
  registry.add<ConvectionRemap>("convection", "f + (x_new - x_old) . grad f with recovered gradients, limited");
}

}  // namespace mudline
