#include "simulation/filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "algebra/raw_communicator.hpp"
#include "core/told.hpp"
#include "discretisation/shapes.hpp"
#include "framework/coordinates.hpp"
#include "integrator/overlap.hpp"
#include "simulation/pressed_sides.hpp"

namespace mudline {

namespace {

using Three = std::array<double, 3>;

/// A quadratic in xi from -1 to 1 by its values at the ends and in the middle.
double at_place(const Three& values, double xi) {
  return values[2] + 0.5 * xi * (values[1] - values[0]) + xi * xi * (0.5 * (values[0] + values[1]) - values[2]);
}

double slope_at(const Three& values, double xi) {
  return 0.5 * (values[1] - values[0]) + 2 * xi * (0.5 * (values[0] + values[1]) - values[2]);
}

Three component(const std::array<Point, 3>& at, int i) { return {at[0][i], at[1][i], at[2][i]}; }

/// Adds the places between -1 and 1 at which the quadratic has this value.
void add_places(const Three& values, double value, std::vector<double>& to) {
  const double c = values[2] - value, b = 0.5 * (values[1] - values[0]), a = 0.5 * (values[0] + values[1]) - values[2];
  const double root = b * b - 4 * a * c;
  if (root < 0) return;
  // the form that does not cancel; a straight side has a = 0
  const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));
  for (const auto& [over, under] : {std::pair{q, a}, std::pair{c, q}})
    if (const double xi = over / under; under != 0 && xi > -1 && xi < 1) to.push_back(xi);
}

/// How far the middle one of three values lies from their straight line by least squares; `before`, `after`: distances.
double off_line(double before, double after, const Three& values) {
  const double both = before + after;
  const Three bend{1 / (before * both), -1 / (before * after), 1 / (after * both)};  // 0 for every straight line
  double product = 0, square = 0;
  for (int i = 0; i < 3; ++i) {
    product += bend[i] * values[i];
    square += bend[i] * bend[i];
  }
  return std::abs(bend[1] * product / square);
}

}  // namespace

Filter::Filter(const Model& model, FilterSettings settings)
    : model_(model), settings_(std::move(settings)), body_(*model.bodies().at(settings_.body)), area_(own_area()) {}

void Filter::check(const Model& model, const FilterSettings& settings, const Section& section,
                   const std::string& entry) {
  const RigidBody& body = model.body(settings.body, section, "body");
  if (model.mesh().dimension() != 2) section.fail("only a body in the plane or in axisymmetry has filters", "body");
  if (!(model.soil() && model.soil()->pressure >= 0)) section.fail("the model has no pore pressure", entry);
  const bool touches = std::any_of(model.contacts().begin(), model.contacts().end(),
                                   [&](const auto& contact) { return contact.second->partners().body == &body; });
  if (!touches) section.fail("body '" + settings.body + "' has no contact", "body");
  if (Filter(model, settings).area_ > 0) return;
  double lowest = std::numeric_limits<double>::max(), highest = -lowest;
  for (const PlanePoint& x : body.contour().sample(1e-2 * settings.height)) {
    lowest = std::min(lowest, x[1]);
    highest = std::max(highest, x[1]);
  }
  section.fail("no surface of body '" + settings.body + "' lies between " + told(settings.bottom(), "%.4g") + " and " +
                   told(settings.top(), "%.4g m") + " above its reference point; it reaches from " +
                   told(lowest, "%.4g") + " to " + told(highest, "%.4g m"),
               entry);
}

double Filter::own_area() const {
  const std::vector<PlanePoint> points = body_.contour().sample(1e-4 * settings_.height);
  Sums sums;
  for (std::size_t i = 1; i < points.size(); ++i) {
    WallSide chord{};
    chord.at = {Point{points[i - 1][0], points[i - 1][1], 0}, Point{points[i][0], points[i][1], 0}};
    chord.at[2] = 0.5 * (chord.at[0] + chord.at[1]);
    chord.height = component(chord.at, 1);
    add(chord, sums);
  }
  return sums.area;
}

void Filter::add(const WallSide& side, Sums& to) const {
  static const QuadratureRule rule = cell_quadrature(CellShape::line3, 5);
  std::vector<double> ends{-1, 1};
  add_places(side.height, settings_.bottom(), ends);
  add_places(side.height, settings_.top(), ends);
  std::sort(ends.begin(), ends.end());
  const Three x = component(side.at, 0), y = component(side.at, 1);
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double middle = 0.5 * (ends[i - 1] + ends[i]), half = 0.5 * (ends[i] - ends[i - 1]);
    const double height = at_place(side.height, middle);
    if (height < settings_.bottom() || height > settings_.top()) continue;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double xi = middle + half * rule.points[q][0], radius = at_place(x, xi);
      const double area = rule.weights[q] * half * std::hypot(slope_at(x, xi), slope_at(y, xi)) *
                          measure(model_.mesh().geometry(), &radius);
      const double rough = 0.5 * ((1 - xi) * side.roughness[0] + (1 + xi) * side.roughness[1]);
      to.area += area;
      to.pressure += area * at_place(side.pressure, xi);
      to.excess += area * at_place(side.excess, xi);
      to.squared_roughness += area * rough * rough;
    }
  }
}

std::vector<Filter::WallSide> Filter::touching(const State& state, const NodalView& excess) const {
  const Mesh& mesh = model_.mesh();
  const auto& dofs = model_.space().node_dof(model_.soil()->pressure);
  const BodyPlacement placement = body_.placement(state);
  std::vector<long long> ids;
  std::vector<double> numbers;  // of a side: coordinates of the three points, then both pressures there
  constexpr std::size_t per_side = 12;
  for (const auto& [name, contact] : model_.contacts()) {
    if (contact->partners().body != &body_) continue;
    for (const Side& side : pressed_sides(model_, *contact)) {
      const ElementBlock& block = mesh.blocks()[side.block];
      const std::vector<int>& local = side_nodes(block.shape, side.side);
      std::vector<int> nodes;
      for (int a : local) nodes.push_back(block.nodes(side.element, a));
      if (dofs(nodes[0]) < 0) continue;  // the soil there has no pore water
      for (int a = 0; a < 2; ++a) ids.push_back(mesh.node_ids()[nodes[a]]);
      const bool quadratic = nodes.size() > 2;
      std::array<Point, 3> at{place_of(state.coordinates, nodes[0]), place_of(state.coordinates, nodes[1])};
      at[2] = quadratic ? place_of(state.coordinates, nodes[2]) : 0.5 * (at[0] + at[1]);
      for (const Point& x : at) numbers.insert(numbers.end(), {x[0], x[1]});
      const auto add_values = [&](const auto& values) {
        const double first = values(dofs(nodes[0])), second = values(dofs(nodes[1]));
        const bool own = quadratic && dofs(nodes[2]) >= 0;
        numbers.insert(numbers.end(), {first, second, own ? values(dofs(nodes[2])) : 0.5 * (first + second)});
      };
      add_values(state.value);
      add_values(excess);
    }
  }
  ids = all_gather(*mesh.comm(), ids);
  numbers = all_gather(*mesh.comm(), numbers);
  std::vector<WallSide> result(ids.size() / 2);
  for (std::size_t s = 0; s < result.size(); ++s) {
    WallSide& side = result[s];
    side.ends = {ids[2 * s], ids[2 * s + 1]};
    const double* row = &numbers[per_side * s];
    for (int a = 0; a < 3; ++a) {
      side.at[a] = {row[2 * a], row[2 * a + 1], 0};
      side.height[a] = body_.height(placement, side.at[a]);
      side.pressure[a] = row[6 + a];
      side.excess[a] = row[9 + a];
    }
  }
  // the order, and so every bit of the sums, is the same on any number of ranks
  std::sort(result.begin(), result.end(), [](const WallSide& a, const WallSide& b) { return a.ends < b.ends; });
  return result;
}

void Filter::roughen(std::vector<WallSide>& sides) {
  struct Neighbour {
    double pressure, distance;
  };
  std::map<long long, std::vector<Neighbour>> around;
  for (const WallSide& side : sides)
    for (int a = 0; a < 2; ++a) around[side.ends[a]].push_back({side.pressure[1 - a], side.length()});
  for (WallSide& side : sides) {
    bool inner[2];
    for (int a = 0; a < 2; ++a) {
      const std::vector<Neighbour>& both = around[side.ends[a]];
      inner[a] = both.size() == 2;
      if (inner[a])
        side.roughness[a] =
            off_line(both[0].distance, both[1].distance, {both[0].pressure, side.pressure[a], both[1].pressure});
    }
    const double alone = 0.5 * std::abs(side.pressure[1] - side.pressure[0]);
    for (int a = 0; a < 2; ++a)
      if (!inner[a]) side.roughness[a] = inner[1 - a] ? side.roughness[1 - a] : alone;
  }
}

std::vector<Filter::Value> Filter::values(const std::vector<Filter>& filters, const State& state,
                                          const NodalView& excess) {
  std::map<std::string, std::vector<WallSide>> walls;  // by body
  std::vector<Value> result;
  for (const Filter& filter : filters) {
    const auto [wall, added] = walls.try_emplace(filter.settings_.body);
    if (added) {
      wall->second = filter.touching(state, excess);
      roughen(wall->second);
    }
    result.push_back(filter.value(wall->second));
  }
  return result;
}

Filter::Value Filter::value(const std::vector<WallSide>& wall) const {
  Sums sums;
  for (const WallSide& side : wall) add(side, sums);
  if (!(sums.area > 0)) return {};
  return {sums.pressure / sums.area, sums.excess / sums.area, std::sqrt(sums.squared_roughness / sums.area),
          sums.area / area_};
}

}  // namespace mudline
