#include "ale/layer_remap.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "discretisation/mesh_topology.hpp"
#include "materials/guarded_law.hpp"

namespace mudline {

namespace {

constexpr int rings = 3;         // of elements around those of a material, onto which its fields are continued
constexpr double narrow = 0.04;  // a direction in which points spread by less than the root of this has no slope

/// A plane for each column, fitted to rows of a table.
class Planes {
 public:
  Planes(const std::vector<std::array<double, place_size>>& places, const std::vector<const double*>& rows, int columns)
      : columns_(columns), mean_(columns, 0.0), slope_(2 * columns, 0.0) {
    const double share = 1.0 / static_cast<double>(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (int d = 0; d < place_size; ++d) centre_[d] += share * places[i][d];
      for (int c = 0; c < columns; ++c) mean_[c] += share * rows[i][c];
    }
    double xx = 0, xy = 0, yy = 0;
    std::vector<double> by(2 * columns, 0.0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double x = places[i][0] - centre_[0], y = places[i][1] - centre_[1];
      xx += x * x;
      xy += x * y;
      yy += y * y;
      for (int c = 0; c < columns; ++c) {
        by[2 * c] += x * (rows[i][c] - mean_[c]);
        by[2 * c + 1] += y * (rows[i][c] - mean_[c]);
      }
    }
    // along the principal directions of the places, as far as these spread
    const double middle = 0.5 * (xx + yy), radius = std::hypot(0.5 * (xx - yy), xy),
                 angle = 0.5 * std::atan2(2 * xy, xx - yy);
    for (int k = 0; k < 2; ++k) {
      const double spread = k == 0 ? middle + radius : middle - radius;
      if (!(spread > narrow * (middle + radius)) || !(spread > 0)) continue;
      ++slopes_;
      const double e[2] = {k == 0 ? std::cos(angle) : -std::sin(angle), k == 0 ? std::sin(angle) : std::cos(angle)};
      for (int c = 0; c < columns; ++c) {
        const double along = (e[0] * by[2 * c] + e[1] * by[2 * c + 1]) / spread;
        slope_[2 * c] += along * e[0];
        slope_[2 * c + 1] += along * e[1];
      }
    }
  }
  bool resolved() const { return slopes_ == place_size; }
  void add(const std::array<double, place_size>& at, double* to) const {
    for (int c = 0; c < columns_; ++c)
      to[c] += mean_[c] + slope_[2 * c] * (at[0] - centre_[0]) + slope_[2 * c + 1] * (at[1] - centre_[1]);
  }

 private:
  int columns_, slopes_ = 0;
  std::array<double, place_size> centre_{};
  std::vector<double> mean_, slope_;
};

}  // namespace

void continue_rows(const PointTransfer& t, std::vector<double>& table, std::vector<char>& known) {
  const int points = t.block.points;
  for (int ring = 2; ring < 2 + rings; ++ring) {
    std::vector<int> pending(known.size(), -1);  // place among those that get a value
    std::vector<std::size_t> found;
    std::vector<double> sums, qualities;  // of the best planes, the mean of which is taken
    std::vector<int> planes_used;
    for (const auto& patch : t.patches.patches()) {
      std::vector<std::size_t> to;
      std::vector<const double*> rows;
      std::vector<std::array<double, place_size>> places, there;
      for (int e : patch.elements)
        for (int q = 0; q < points; ++q) {
          const std::size_t row = t.mesh.first_row(e, points) + q;
          const auto place = Recovery::position(t.mesh.elements()[e], t.block, q, t.x_old);
          if (known[row] != 0) rows.push_back(&table[row * t.columns]);
          if (known[row] != 0) places.push_back(place);
          if (known[row] == 0) to.push_back(row);
          if (known[row] == 0) there.push_back(place);
        }
      if (rows.empty() || to.empty()) continue;
      const Planes planes(places, rows, t.columns);
      if (!planes.resolved() && ring < 1 + rings) continue;  // better ones come with the next ring
      const double quality = (planes.resolved() ? 1.0 : 1e-3) * static_cast<double>(rows.size());
      for (std::size_t i = 0; i < to.size(); ++i) {
        if (pending[to[i]] < 0) {
          pending[to[i]] = static_cast<int>(found.size());
          found.push_back(to[i]);
          sums.resize(found.size() * t.columns, 0.0);
          qualities.push_back(0);
          planes_used.push_back(0);
        }
        const int k = pending[to[i]];
        double* sum = &sums[static_cast<std::size_t>(k) * t.columns];
        if (quality < qualities[k]) continue;
        if (quality > qualities[k]) {
          std::fill_n(sum, t.columns, 0.0);
          planes_used[k] = 0;
        }
        qualities[k] = quality;
        ++planes_used[k];
        planes.add(there[i], sum);
      }
    }
    for (std::size_t k = 0; k < found.size(); ++k) {
      for (int c = 0; c < t.columns; ++c) table[found[k] * t.columns + c] = sums[k * t.columns + c] / planes_used[k];
      known[found[k]] = static_cast<char>(ring);
    }
    // ghosts are at the edge of what is known here: their own ranks know better
    t.mesh.fill_points(t.block.block, points, t.columns, table);
    std::vector<double> rings_of(known.begin(), known.end());
    t.mesh.fill_points(t.block.block, points, 1, rings_of);
    known.assign(rings_of.begin(), rings_of.end());
  }
}

std::vector<StateVariable> LayerRemap::variables_of(int material, const SoilTable& table) const {
  std::vector<StateVariable> result;
  int column = 0, width = 0;  // of the law's columns in the table
  for (const StateVariable& v : table.variables) {
    const bool of_law = column >= table.law && column < table.origin;
    if (of_law) width += v.components;
    column += v.components;
    if (!of_law) result.push_back(v);
    if (column != table.origin) continue;
    const auto& own = soil_.materials[material]->skeleton->state_variables();
    result.insert(result.end(), own.begin(), own.end());
    for (int c = soil_.materials[material]->skeleton->state_size(); c < width; ++c)
      result.push_back({"unused", 1, "-"});
  }
  return result;
}

std::vector<char> LayerRemap::carry_origin(const PointTransfer& t, const SoilTable& table) const {
  const std::size_t rows = t.old.size() / t.columns;
  std::vector<double> old(rows * place_size);
  for (std::size_t row = 0; row < rows; ++row)
    for (int d = 0; d < place_size; ++d) old[row * place_size + d] = t.old[row * t.columns + table.origin + 1 + d];
  std::vector<double> now = old;
  const std::vector<StateVariable> place{{"x", 1, "m"}, {"y", 1, "m"}};
  remap_.transfer({t.mesh, t.block, t.patches, t.x_old, t.x_new, place, place_size, old, now});
  std::vector<char> material(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    Point start{};
    for (int d = 0; d < place_size; ++d)
      start[d] = t.now[row * t.columns + table.origin + 1 + d] = now[row * place_size + d];
    material[row] = static_cast<char>(soil_.material_at(t.block, start));
    t.now[row * t.columns + table.origin] = material[row];
  }
  return material;
}

std::string LayerRemap::start(const PointTransfer& t, const SoilTable& table, int material, int element,
                              int row) const {
  double* now = &t.now[static_cast<std::size_t>(row) * t.columns];
  const SoilMaterial& soil = *soil_.materials[material];
  InitialPoint point;
  for (int d = 0; d < place_size; ++d) point.position[d] = now[table.origin + 1 + d];
  point.position[2] = 0;
  point.height = soil_.height(point.position);
  std::copy_n(now + table.stress, 6, point.stress.begin());
  point.void_ratio = now[table.void_ratio];
  std::vector<double> state(std::max(1, soil.skeleton->state_size()), 0.0);
  const std::string reason = start_guarded(*soil.skeleton, point, state.data());
  std::copy_n(state.begin(), soil.skeleton->state_size(), now + table.law);
  if (reason.empty()) return "";
  const auto place =
      Recovery::position(t.mesh.elements()[element], t.block, row - t.mesh.first_row(element, t.block.points), t.x_new);
  return "the law of material '" + soil.name + "', which the soil at " + place_text({place[0], place[1], 0}, 2) +
         " has become part of, cannot start there: " + reason;
}

LayerRemap::Version LayerRemap::version_of(int material, const PointTransfer& t, const SoilTable& table,
                                           const std::vector<char>& was) const {
  const int points = t.block.points;
  Version result;
  std::vector<double> old = t.old;
  std::vector<char> known(was.size(), 0);
  for (std::size_t row = 0; row < was.size(); ++row) known[row] = was[row] == material;
  continue_rows(t, old, known);
  for (std::size_t i = table.void_ratio; i < old.size(); i += t.columns) result.void_ratio.push_back(old[i]);
  result.now = old;
  const std::vector<StateVariable> variables = variables_of(material, table);
  remap_.transfer({t.mesh, t.block, t.patches, t.x_old, t.x_new, variables, t.columns, old, result.now});
  result.near.assign(was.size(), 1);
  const PointLocator locator(t.mesh, t.x_old);
  for (int e : t.mesh.own_elements(t.block.block))
    for (int q = 0; q < points; ++q) {
      const std::size_t row = t.mesh.first_row(e, points) + q;
      if (was[row] == material) continue;
      const auto reached = [&](int element) {
        for (int p = 0; p < points; ++p) {
          const char ring = known[t.mesh.first_row(element, points) + p];
          if (ring == 0 || ring > rings) return false;  // the outermost ring serves the fits of the others
        }
        return true;
      };
      result.near[row] =
          known[row] != 0 &&
          reached(locator.find(Recovery::position(t.mesh.elements()[e], t.block, q, t.x_new), e).element);
    }
  return result;
}

LayerChanges LayerRemap::transfer(const PointTransfer& t, const SoilTable& table) const {
  LayerChanges result;
  const int points = t.block.points;
  for (std::size_t row = 0; row < t.old.size() / t.columns; ++row)
    result.was.push_back(static_cast<char>(t.old[row * t.columns + table.origin]));
  result.is = carry_origin(t, table);
  std::map<int, Version> versions;
  for (int material : t.block.made_of) versions[material] = version_of(material, t, table, result.was);
  for (std::size_t row = 0; row < result.was.size(); ++row)
    for (int material : t.block.made_of) {
      const Version& version = versions.at(material);
      result.ratios.before.push_back(version.void_ratio[row]);
      result.ratios.after.push_back(version.now[row * t.columns + table.void_ratio]);
    }
  for (int e : t.mesh.own_elements(t.block.block))
    for (int q = 0; q < points; ++q) {
      const int row = t.mesh.first_row(e, points) + q, material = result.is[row];
      const std::size_t first = static_cast<std::size_t>(row) * t.columns;
      const Version& version = versions.at(material);
      t.now[first + table.origin] = material;
      result.changed += result.was[row] != material;
      for (int c = 0; c < t.columns && version.near[row]; ++c)
        if (c < table.origin || c > table.origin + place_size) t.now[first + c] = version.now[first + c];
      if (version.near[row]) continue;
      ++result.started;
      const std::string problem = start(t, table, material, e, row);
      if (result.problem.empty()) result.problem = problem;
    }
  return result;
}

}  // namespace mudline
