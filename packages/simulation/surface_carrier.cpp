#include "simulation/surface_carrier.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/raw_communicator.hpp"

namespace mudline {

namespace {

std::vector<double> flat(const std::vector<Point>& places, int dimension) {
  std::vector<double> result;
  for (const Point& place : places) result.insert(result.end(), place.begin(), place.begin() + dimension);
  return result;
}

enum class Kind { linear, nearest, total };

Kind kind_of(const std::string& unit) {
  if (unit == "-") return Kind::nearest;
  const bool sum = unit == "J" || unit == "N" || unit == "N m" || unit == "m2" || unit == "m3";
  return sum ? Kind::total : Kind::linear;
}

/// Values given at ascending places s, taken to other ascending places of a path of some length.
std::vector<double> carried(Kind kind, const std::vector<double>& s, const std::vector<double>& values,
                            const std::vector<double>& to, double length) {
  const auto between = [](const std::vector<double>& at, const std::vector<double>& of, double place) {
    const auto after = std::upper_bound(at.begin(), at.end(), place) - at.begin();
    if (after == 0) return of.front();
    if (after == static_cast<std::ptrdiff_t>(at.size())) return of.back();
    const double t = (place - at[after - 1]) / (at[after] - at[after - 1]);
    return (1 - t) * of[after - 1] + t * of[after];
  };
  /// Limits between the parts of the path that belong to the rows.
  const auto limits = [&](const std::vector<double>& at) {
    std::vector<double> result{0};
    for (std::size_t i = 1; i < at.size(); ++i) result.push_back(0.5 * (at[i - 1] + at[i]));
    result.push_back(length);
    return result;
  };
  std::vector<double> result;
  if (kind == Kind::total) {
    const std::vector<double> parts = limits(s), new_parts = limits(to);
    std::vector<double> sums{0};
    for (double value : values) sums.push_back(sums.back() + value);
    for (std::size_t i = 0; i < to.size(); ++i)
      result.push_back(between(parts, sums, new_parts[i + 1]) - between(parts, sums, new_parts[i]));
    return result;
  }
  for (double place : to) {
    if (kind == Kind::linear) {
      result.push_back(between(s, values, place));
      continue;
    }
    const auto after = std::lower_bound(s.begin(), s.end(), place) - s.begin();
    const bool last = after == static_cast<std::ptrdiff_t>(s.size());
    result.push_back(values[last || (after > 0 && place - s[after - 1] < s[after] - place) ? after - 1 : after]);
  }
  return result;
}

}  // namespace

SurfaceCarrier::SurfaceCarrier(const Ale& before, const Positions& x, const std::string& surface)
    : comm_(*before.mesh().mesh().comm()), dimension_(before.mesh().dimension()), x_(x) {
  for (const MeshPath& path : before.paths()) {
    if (!path.sets.count(surface)) continue;
    double s = 0;
    for (int i = 0; i + path.stride < static_cast<int>(path.nodes.size()); i += path.stride) {
      const int a = path.nodes[i], b = path.nodes[i + path.stride];
      const double chord = std::hypot(x[b][0] - x[a][0], x[b][1] - x[a][1]);
      sides_.push_back(
          {static_cast<int>(lengths_.size()), {a, b, path.stride == 2 ? path.nodes[i + 1] : -1}, s, s + chord});
      s += chord;
    }
    lengths_.push_back(s);
  }
}

SurfaceCarrier::Row SurfaceCarrier::locate(double x, double y, int number) const {
  Row row{0, 0, number};
  double least = 1e300;
  for (const PathSide& side : sides_) {
    const auto [xi, distance] = nearest_on_side(side.nodes, x_, {x, y});
    if (distance >= least) continue;
    least = distance;
    row.path = side.path;
    row.s = side.from + 0.5 * (1 + xi) * (side.to - side.from);
  }
  return row;
}

std::vector<std::vector<SurfaceCarrier::Row>> SurfaceCarrier::along(const std::vector<double>& places) const {
  std::vector<std::vector<Row>> result(lengths_.size());
  for (std::size_t i = 0; i + 2 <= places.size(); i += 2) {
    const Row row = locate(places[i], places[i + 1], static_cast<int>(i / 2));
    result[row.path].push_back(row);
  }
  for (auto& rows : result) std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.s < b.s; });
  return result;
}

void SurfaceCarrier::carry(const ArrayInfo& info, const PointView& old, const std::vector<Point>& old_places,
                           const PointView& now, const std::vector<Point>& new_places) const {
  if (dimension_ == 3) {
    carry_in_space(old, old_places, now, new_places);
    return;
  }
  std::size_t first = 0;
  const auto from = along(of_all_ranks(comm_, flat(old_places, 2))),
             to = along(of_all_ranks(comm_, flat(new_places, 2), &first));
  const int mine = static_cast<int>(first / 2), end = mine + static_cast<int>(new_places.size());
  int column = 0;
  for (const StateVariable& variable : info.variables)
    for (int c = 0; c < variable.components; ++c, ++column) {
      std::vector<double> values;
      for (std::size_t row = 0; row < old.extent(0); ++row) values.push_back(old(row, column));
      values = of_all_ranks(comm_, values);
      for (std::size_t p = 0; p < from.size(); ++p) {
        if (from[p].empty()) continue;
        std::vector<double> s, of, places;
        for (const Row& row : from[p]) {
          s.push_back(row.s);
          of.push_back(values[row.number]);
        }
        for (const Row& row : to[p]) places.push_back(row.s);
        const std::vector<double> made = carried(kind_of(variable.unit), s, of, places, lengths_[p]);
        for (std::size_t i = 0; i < to[p].size(); ++i)
          if (to[p][i].number >= mine && to[p][i].number < end) now(to[p][i].number - mine, column) = made[i];
      }
    }
}

void SurfaceCarrier::carry_in_space(const PointView& old, const std::vector<Point>& old_places, const PointView& now,
                                    const std::vector<Point>& new_places) const {
  const std::vector<double> from = of_all_ranks(comm_, flat(old_places, 3));
  std::vector<std::size_t> row_at;  // (new row) the old one at its place
  for (const Point& place : new_places) {
    double least = 1e300;
    std::size_t row = 0;
    for (std::size_t i = 0; i + 3 <= from.size(); i += 3) {
      const double off = distance(place, {from[i], from[i + 1], from[i + 2]});
      if (off >= least) continue;
      least = off;
      row = i / 3;
    }
    row_at.push_back(row);
  }
  for (std::size_t column = 0; column < old.extent(1); ++column) {
    std::vector<double> values;
    for (std::size_t row = 0; row < old.extent(0); ++row) values.push_back(old(row, column));
    values = of_all_ranks(comm_, values);
    for (std::size_t row = 0; row < row_at.size(); ++row) now(row, column) = values[row_at[row]];
  }
}

}  // namespace mudline
