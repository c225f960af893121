#include "ale/surface_transfer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "algebra/raw_communicator.hpp"

namespace mudline {

namespace {

std::vector<double> flat(const std::vector<Point>& places, int dimension) {
  std::vector<double> result;
  for (const Point& place : places) result.insert(result.end(), place.begin(), place.begin() + dimension);
  return result;
}

constexpr double inwards = 1e-3;  // share of the way from a row to the middle of its side

double bounded(const StateVariable& variable, double value) { return std::clamp(value, variable.low, variable.high); }

/// Values given at ascending places `s` of a path, transferred to the ascending places `to`; `length`: that of the path
/// [m].
std::vector<double> transferred(Transfer rule, const std::vector<double>& s, const std::vector<double>& values,
                                const std::vector<double>& to, double length) {
  const auto between = [](const std::vector<double>& at, const std::vector<double>& of, double place) {
    const auto after = std::upper_bound(at.begin(), at.end(), place) - at.begin();
    if (after == 0) return of.front();
    if (after == static_cast<std::ptrdiff_t>(at.size())) return of.back();
    const double t = (place - at[after - 1]) / (at[after] - at[after - 1]);
    return (1 - t) * of[after - 1] + t * of[after];
  };
  /// Ends of the parts of the path that belong to the rows.
  const auto limits = [&](const std::vector<double>& at) {
    std::vector<double> result{0};
    for (std::size_t i = 1; i < at.size(); ++i) result.push_back(0.5 * (at[i - 1] + at[i]));
    result.push_back(length);
    return result;
  };
  std::vector<double> result;
  if (rule == Transfer::total) {
    const std::vector<double> parts = limits(s), new_parts = limits(to);
    std::vector<double> sums{0};
    for (double value : values) sums.push_back(sums.back() + value);
    for (std::size_t i = 0; i < to.size(); ++i)
      result.push_back(between(parts, sums, new_parts[i + 1]) - between(parts, sums, new_parts[i]));
    return result;
  }
  for (double place : to) {
    if (rule == Transfer::value) {
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

SurfaceTransfer::SurfaceTransfer(const Ale& before, const Side& old, const Side& now)
    : mesh_(before.mesh()), comm_(*mesh_.mesh().comm()), dimension_(mesh_.dimension()), x_(mesh_.gather(old.x)) {
  const std::string& surface = old.points.side_set();
  const Rows rows_before(old), rows_now(now);
  if (dimension_ == 3) {
    for (const SurfaceFace& face : before.surfaces().faces)
      if (face.sets.count(surface)) faces_.push_back(face);
    face_locator_.emplace(faces_, x_);
    old_areas_ = all_gather(comm_, rows_before.areas);
    areas_ = rows_now.areas;
    origins_ = origins(rows_before, rows_now);
    return;
  }
  std::vector<CurvedSide> sides;
  for (const MeshPath& path : before.paths()) {
    if (!path.sets.count(surface)) continue;
    double s = 0;
    for (int i = 0; i + path.stride < static_cast<int>(path.nodes.size()); i += path.stride) {
      const int a = path.nodes[i], b = path.nodes[i + path.stride];
      const double chord = std::hypot(x_[b][0] - x_[a][0], x_[b][1] - x_[a][1]);
      sides_.push_back({static_cast<int>(lengths_.size()), s, s + chord});
      sides.push_back(path.side(i));
      s += chord;
    }
    lengths_.push_back(s);
  }
  side_locator_.emplace(std::move(sides), x_);
  std::size_t first = 0;
  from_ = along(all_gather(comm_, flat(rows_before.places, 2)));
  to_ = along(all_gather(comm_, flat(rows_now.places, 2), &first));
  mine_ = static_cast<int>(first / 2);
  end_ = mine_ + static_cast<int>(rows_now.places.size());
}

std::vector<double> SurfaceTransfer::column_of(const PointView& rows, int column) const {
  std::vector<double> values;
  for (std::size_t row = 0; row < rows.extent(0); ++row) values.push_back(rows(row, column));
  return all_gather(comm_, values);
}

SurfaceTransfer::Row SurfaceTransfer::locate(const Point& place, int number) const {
  SideLocator::Place there;
  side_locator_->approach(place, there);
  const PathSide& side = sides_[there.side];
  return {side.path, side.from + 0.5 * (1 + there.xi[0]) * (side.to - side.from), number};
}

std::vector<std::vector<SurfaceTransfer::Row>> SurfaceTransfer::along(const std::vector<double>& places) const {
  std::vector<std::vector<Row>> result(lengths_.size());
  for (std::size_t i = 0; i + 2 <= places.size(); i += 2) {
    const Row row = locate({places[i], places[i + 1], 0}, static_cast<int>(i / 2));
    result[row.path].push_back(row);
  }
  for (auto& rows : result) std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.s < b.s; });
  return result;
}

SurfaceTransfer::Rows::Rows(const Side& side)
    : places(side.points.places(side.x)), areas(side.points.areas(side.x)), inside(places) {
  const std::vector<long long>& ids = side.points.ids();
  for (std::size_t first = 0, last = 0; first < places.size(); first = last) {
    const auto number = [&](std::size_t row) { return ids[row] / SurfacePoints::most_points_of_side; };
    Point middle{};
    for (last = first; last < places.size() && number(last) == number(first); ++last) middle += places[last];
    middle = 1.0 / static_cast<double>(last - first) * middle;
    for (std::size_t row = first; row < last; ++row) inside[row] += inwards * (middle - places[row]);
  }
}

void SurfaceTransfer::transfer(const std::vector<StateVariable>& variables, const PointView& old,
                               const PointView& now) const {
  if (dimension_ == 3) return transfer_in_space(variables, old, now);
  int column = 0;
  for (const StateVariable& variable : variables)
    for (int c = 0; c < variable.components; ++c, ++column) {
      const std::vector<double> values = column_of(old, column);
      for (std::size_t p = 0; p < from_.size(); ++p) {
        if (from_[p].empty()) continue;
        std::vector<double> s, of, places;
        for (const Row& row : from_[p]) {
          s.push_back(row.s);
          of.push_back(values[row.number]);
        }
        for (const Row& row : to_[p]) places.push_back(row.s);
        const std::vector<double> made = transferred(variable.transfer, s, of, places, lengths_[p]);
        for (std::size_t i = 0; i < to_[p].size(); ++i)
          if (to_[p][i].number >= mine_ && to_[p][i].number < end_)
            now(to_[p][i].number - mine_, column) = bounded(variable, made[i]);
      }
    }
}

namespace {

/// Weights of the values at places of a face that give the value of their least-squares linear function at another
/// place; weights of the mean where the places do not determine a function.
std::vector<double> fit_weights(const std::vector<FacePlace>& places, const FacePlace& at) {
  const std::size_t count = places.size();
  FacePlace mean{};
  for (const FacePlace& place : places)
    for (int i = 0; i < 2; ++i) mean[i] += place[i] / static_cast<double>(count);
  double a = 0, b = 0, c = 0;
  for (const FacePlace& place : places) {
    const double u = place[0] - mean[0], v = place[1] - mean[1];
    a += u * u;
    b += u * v;
    c += v * v;
  }
  const double det = a * c - b * b, u = at[0] - mean[0], v = at[1] - mean[1];
  std::vector<double> weights(count, 1.0 / static_cast<double>(count));
  if (!(det > 1e-6 * (a + c) * (a + c))) return weights;
  for (std::size_t i = 0; i < count; ++i) {
    const double p = places[i][0] - mean[0], q = places[i][1] - mean[1];
    weights[i] += ((c * u - b * v) * p + (a * v - b * u) * q) / det;
  }
  return weights;
}

}  // namespace

SurfacePlace SurfaceTransfer::face_of(const Point& place, const Point& inside) const {
  const SurfacePlace there = face_locator_->nearest(place);
  const double u = there.xi[0], v = there.xi[1];
  const bool triangle = is_simplex(faces_[there.face].shape);
  const double to_edge = triangle ? std::min({u, v, 1 - u - v}) : 1 - std::max(std::abs(u), std::abs(v));
  if (to_edge > 1e-6) return there;
  SurfacePlace own = face_locator_->nearest(inside);
  const double middle = is_simplex(faces_[own.face].shape) ? 1.0 / 3 : 0.0;
  for (double& xi : own.xi) xi = middle + (xi - middle) / (1 - inwards);
  return own;
}

std::vector<SurfaceTransfer::Origin> SurfaceTransfer::origins(const Rows& old, const Rows& now) const {
  const std::vector<double> from = all_gather(comm_, flat(old.places, 3)),
                            inside = all_gather(comm_, flat(old.inside, 3));
  const int count = static_cast<int>(from.size() / 3);
  const auto old_place = [&](int row) { return Point{from[3 * row], from[3 * row + 1], from[3 * row + 2]}; };
  std::vector<std::vector<int>> rows(faces_.size());
  std::vector<FacePlace> xi;
  for (int row = 0; row < count; ++row) {
    const SurfacePlace there = face_of(old_place(row), {inside[3 * row], inside[3 * row + 1], inside[3 * row + 2]});
    rows[there.face].push_back(row);
    xi.push_back(there.xi);
  }
  std::vector<Origin> result;
  for (std::size_t i = 0; i < now.places.size(); ++i) {
    const Point& place = now.places[i];
    Origin origin{0, false, {}};
    double least = 1e300;
    for (int row = 0; row < count; ++row) {
      const double off = distance(place, old_place(row));
      if (off >= least) continue;
      least = off;
      origin.nearest = row;
    }
    origin.same = least <= 1e-9 * std::sqrt(now.areas[i]);
    const SurfacePlace there = face_locator_->nearest(place);
    const std::vector<int>& near = rows[there.face];
    std::vector<FacePlace> places;
    for (int row : near) places.push_back(xi[row]);
    const std::vector<double> weights = fit_weights(places, there.xi);
    if (!origin.same)
      for (std::size_t k = 0; k < near.size(); ++k) origin.weights.emplace_back(near[k], weights[k]);
    if (origin.weights.empty()) origin.weights.emplace_back(origin.nearest, 1.0);
    result.push_back(std::move(origin));
  }
  return result;
}

void SurfaceTransfer::transfer_in_space(const std::vector<StateVariable>& variables, const PointView& old,
                                        const PointView& now) const {
  int column = 0;
  for (const StateVariable& variable : variables)
    for (int c = 0; c < variable.components; ++c, ++column) {
      const bool is_total = variable.transfer == Transfer::total;
      std::vector<double> values = column_of(old, column);
      double total = 0;
      if (is_total)
        for (std::size_t row = 0; row < values.size(); ++row) {
          total += values[row];
          values[row] /= std::max(old_areas_[row], 1e-300);
        }
      std::vector<double> made;
      for (const Origin& origin : origins_) {
        double sum = 0, least = 1e300, most = -1e300;
        for (const auto& [row, weight] : origin.weights) {
          sum += weight * values[row];
          least = std::min(least, values[row]);
          most = std::max(most, values[row]);
        }
        made.push_back(variable.transfer == Transfer::nearest ? values[origin.nearest] : std::clamp(sum, least, most));
      }
      double scale = 1;
      if (is_total) {
        const auto sum = [&] { return mesh_.sum(std::accumulate(made.begin(), made.end(), 0.0)); };
        for (std::size_t row = 0; row < made.size(); ++row) made[row] *= areas_[row];
        if (sum() == 0) made = areas_;  // a density of zero is spread evenly
        scale = total / sum();
      }
      for (std::size_t row = 0; row < made.size(); ++row) now(row, column) = bounded(variable, scale * made[row]);
    }
}

}  // namespace mudline
