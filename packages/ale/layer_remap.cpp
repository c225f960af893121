#include "ale/layer_remap.hpp"

#include <Teuchos_LAPACK.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/told.hpp"
#include "discretisation/mesh_topology.hpp"
#include "materials/guarded_law.hpp"
#include "tensor/mat.hpp"

namespace mudline {

namespace {

constexpr int rings = 3;         // number of rings of elements around a material onto which its fields are continued
constexpr double narrow = 0.04;  // least variance for which a slope is fitted, as a share of the largest

/// Second moments of places about their centre: their principal directions and the spread along each, the largest
/// first.
struct Spread {
  double along[3] = {};
  Point direction[3] = {};

  Spread(int dim, const Mat<double, 3>& moments) {
    double matrix[9], values[3], work[24];  // column by column; eigenvalues ascend
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) matrix[dim * j + i] = moments[i][j];
    int info = 0;
    Teuchos::LAPACK<int, double>().SYEV('V', 'U', dim, matrix, dim, values, work, 24, &info);
    if (info != 0) throw std::runtime_error("the principal directions of a patch of elements are not found");
    for (int k = 0; k < dim; ++k) {
      const int from = dim - 1 - k;
      along[k] = values[from];
      for (int i = 0; i < dim; ++i) direction[k][i] = matrix[dim * from + i];
    }
  }
};

/// Coordinates in a patch of elements, in units of the patch's own extent in each principal direction, so that patches
/// of flat elements become isotropic.
class PatchMetric {
 public:
  PatchMetric(int dim, const std::vector<Point>& places) : dim_(dim) {
    const double share = 1.0 / static_cast<double>(places.size());
    for (const Point& x : places)
      for (int d = 0; d < dim; ++d) centre_[d] += share * x[d];
    Mat<double, 3> moments = {};
    for (const Point& place : places) {
      const Point x = place - centre_;
      for (int d = 0; d < dim; ++d)
        for (int k = 0; k < dim; ++k) moments[d][k] += share * x[d] * x[k];
    }
    const Spread spread(dim, moments);
    for (int k = 0; k < dim; ++k)
      if (spread.along[k] > 0)
        for (int d = 0; d < dim; ++d) axis_[k][d] = spread.direction[k][d] / std::sqrt(spread.along[k]);
  }
  /// Scaled coordinates of a place [-].
  Point operator()(const Point& place) const {
    const Point x = place - centre_;
    Point result{};
    for (int k = 0; k < dim_; ++k)
      for (int d = 0; d < dim_; ++d) result[k] += axis_[k][d] * x[d];
    return result;
  }

 private:
  int dim_;
  Point centre_{};
  Point axis_[3] = {};
};

/// A linear function for each column, fitted to rows of a table.
class Planes {
 public:
  Planes(int dim, const std::vector<Point>& places, const std::vector<const double*>& rows, int columns)
      : dim_(dim), columns_(columns), mean_(columns, 0.0), slope_(dim * columns, 0.0) {
    const double share = 1.0 / static_cast<double>(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (int d = 0; d < dim; ++d) centre_[d] += share * places[i][d];
      for (int c = 0; c < columns; ++c) mean_[c] += share * rows[i][c];
    }
    Mat<double, 3> moments = {};
    std::vector<double> by(dim * columns, 0.0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Point x = places[i] - centre_;
      for (int d = 0; d < dim; ++d)
        for (int k = 0; k < dim; ++k) moments[d][k] += x[d] * x[k];
      for (int c = 0; c < columns; ++c)
        for (int d = 0; d < dim; ++d) by[dim * c + d] += x[d] * (rows[i][c] - mean_[c]);
    }
    // slopes along the principal directions in which the places spread enough
    const Spread spread(dim, moments);
    for (int k = 0; k < dim; ++k) {
      if (!(spread.along[k] > narrow * spread.along[0]) || !(spread.along[k] > 0)) continue;
      ++slopes_;
      const Point& e = spread.direction[k];
      for (int c = 0; c < columns; ++c) {
        double along = 0;
        for (int d = 0; d < dim; ++d) along += e[d] * by[dim * c + d];
        along /= spread.along[k];
        for (int d = 0; d < dim; ++d) slope_[dim * c + d] += along * e[d];
      }
    }
  }
  bool resolved() const { return slopes_ == dim_; }
  void add(const Point& at, double* to) const {
    for (int c = 0; c < columns_; ++c) {
      double value = mean_[c];
      for (int d = 0; d < dim_; ++d) value += slope_[dim_ * c + d] * (at[d] - centre_[d]);
      to[c] += value;
    }
  }

 private:
  int dim_, columns_, slopes_ = 0;
  Point centre_{};
  std::vector<double> mean_, slope_;
};

}  // namespace

void continue_rows(const PointTransfer& t, std::vector<double>& table, std::vector<char>& known) {
  const GhostedMesh& mesh = t.before.mesh;
  const SoilBlock& block = t.before.block;
  const int points = block.points;
  for (int ring = 2; ring < 2 + rings; ++ring) {
    std::vector<int> pending(known.size(), -1);  // index in found; -1: the row gets no value in this ring
    std::vector<std::size_t> found;
    std::vector<double> sums, qualities;  // of the best planes of a row, whose mean is taken
    std::vector<int> planes_used;
    for (const auto& patch : t.patches.patches()) {
      std::vector<std::size_t> to;
      std::vector<const double*> rows;
      std::vector<Point> all, places, there;
      for (int e : patch.elements) {
        const auto& nodes = mesh.elements()[e].nodes;
        const bool touches = std::count(nodes.begin(), nodes.begin() + num_corners(block.shape), patch.node) > 0;
        for (int q = 0; q < points; ++q) {
          const std::size_t row = mesh.first_row(e, points) + q;
          const Point place = t.before.place(e, q);
          all.push_back(place);
          if (known[row] != 0) rows.push_back(&table[row * t.columns]);
          if (known[row] != 0) places.push_back(place);
          if (known[row] == 0 && touches) to.push_back(row);  // a row's owner has the patches of all its corners
          if (known[row] == 0 && touches) there.push_back(place);
        }
      }
      if (rows.empty() || to.empty()) continue;
      const PatchMetric metric(mesh.dimension(), all);
      for (std::vector<Point>* some : {&places, &there})
        for (Point& place : *some) place = metric(place);
      const Planes planes(mesh.dimension(), places, rows, t.columns);
      if (!planes.resolved() && ring < 1 + rings) continue;  // the next ring gives better ones
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
    // Ghosts lack patches here: their owners' values are taken.
    mesh.fill_points(block.block, points, t.columns, table);
    std::vector<double> rings_of(known.begin(), known.end());
    mesh.fill_points(block.block, points, 1, rings_of);
    known.assign(rings_of.begin(), rings_of.end());
  }
}

SoilTable SoilTable::of(const StateStore& store, const SoilBlock& b) {
  SoilTable table;
  for (int handle = 0; handle < store.num_arrays(); ++handle) {
    if (store.info(handle).block != b.block) continue;
    if (handle == b.stress) table.stress = table.columns;
    if (handle == b.void_ratio) table.void_ratio = table.columns;
    if (handle == b.law) table.law = table.columns;
    if (handle == b.origin) table.origin = table.columns;
    if (handle == b.conductivity) table.conductivity = table.columns;
    if (handle == b.permeability) table.permeability = table.columns;
    for (const StateVariable& variable : store.info(handle).variables) {
      table.columns += variable.components;
      table.variables.push_back(variable);
    }
  }
  return table;
}

PointView SoilTable::rows(const StateStore& store, const State& state, const SoilBlock& b) {
  const int count = b.elements * b.points;
  PointView table("points", count, of(store, b).columns);
  int column = 0;
  for (int handle = 0; handle < store.num_arrays(); ++handle) {
    if (store.info(handle).block != b.block) continue;
    const PointView& rows = state.arrays[handle];
    for (std::size_t c = 0; c < rows.extent(1); ++c, ++column)
      for (int i = 0; i < count; ++i) table(i, column) = rows(i, c);
  }
  return table;
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

std::vector<char> LayerRemap::transfer_origin(const PointTransfer& t, const SoilTable& table) const {
  const int dim = t.before.mesh.dimension();
  const std::size_t rows = t.now.size() / t.columns;
  std::vector<double> old;
  for (std::size_t first = table.origin + 1; first < t.old.size(); first += t.columns)
    old.insert(old.end(), &t.old[first], &t.old[first] + dim);
  std::vector<double> now = t.moved() ? old : std::vector<double>(rows * dim);
  const std::vector<StateVariable> place{{"place at the start", dim, "m"}};
  remap_.transfer({t.before, t.after, t.patches, place, dim, old, now});
  std::vector<char> material(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    Point start{};
    for (int d = 0; d < dim; ++d) start[d] = t.now[row * t.columns + table.origin + 1 + d] = now[row * dim + d];
    material[row] = static_cast<char>(soil_.material_at(t.after.block, start));
    t.now[row * t.columns + table.origin] = material[row];
  }
  return material;
}

std::string LayerRemap::start(const PointTransfer& t, const SoilTable& table, int material, int row) const {
  double* now = &t.now[static_cast<std::size_t>(row) * t.columns];
  const SoilMaterial& soil = *soil_.materials[material];
  InitialPoint point;
  point.position = {};
  for (int d = 0; d < t.before.mesh.dimension(); ++d) point.position[d] = now[table.origin + 1 + d];
  point.height = soil_.height(point.position);
  std::copy_n(now + table.stress, 6, point.stress.begin());
  point.void_ratio = now[table.void_ratio];
  std::vector<double> state(std::max(1, soil.skeleton->state_size()), 0.0);
  const std::string reason = start_guarded(*soil.skeleton, point, state.data());
  std::copy_n(state.begin(), soil.skeleton->state_size(), now + table.law);
  if (table.conductivity < 0 || !reason.empty()) return reason;
  return soil.permeability->numbers_at(point.position, now + table.conductivity);
}

LayerRemap::Version LayerRemap::version_of(int material, const PointTransfer& t, const SoilTable& table,
                                           const std::vector<char>& was) const {
  Version result;
  std::vector<double> old = t.old;
  std::vector<char> known(was.size(), 0);
  for (std::size_t row = 0; row < was.size(); ++row) known[row] = was[row] == material;
  continue_rows(t, old, known);
  for (std::size_t i = table.void_ratio; i < old.size(); i += t.columns) result.void_ratio.push_back(old[i]);
  result.now = t.moved() ? old : std::vector<double>(t.now.size());
  const std::vector<StateVariable> variables = variables_of(material, table);
  remap_.transfer({t.before, t.after, t.patches, variables, t.columns, old, result.now});
  result.near.assign(t.now.size() / t.columns, 1);
  const PointLocator locator(t.before.mesh, t.before.x);
  const auto reached = [&](int element) {
    const int points = t.before.block.points, first = t.before.mesh.first_row(element, points);
    return std::all_of(&known[first], &known[first] + points, [](char ring) {
      return ring != 0 && ring <= rings;  // the outermost ring serves the fits of the others
    });
  };
  const GhostedMesh& mesh = t.after.mesh;
  const SoilBlock& block = t.after.block;
  int found = t.before.mesh.block_elements(t.before.block.block).front();
  for (int e : mesh.own_elements(block.block))
    for (int q = 0; q < block.points; ++q) {
      const std::size_t row = mesh.first_row(e, block.points) + q;
      if (t.moved() && was[row] == material) continue;
      found = locator.find(t.after.place(e, q), t.moved() ? e : found).element;
      result.near[row] = (!t.moved() || known[row] != 0) && reached(found);
    }
  return result;
}

LayerChanges LayerRemap::transfer(const PointTransfer& t, const SoilTable& table) const {
  LayerChanges result;
  for (std::size_t row = 0; row < t.old.size() / t.columns; ++row)
    result.was.push_back(static_cast<char>(t.old[row * t.columns + table.origin]));
  if (!t.moved()) remap_.transfer(t);  // stress and void ratio from which a law may start anew
  result.is = transfer_origin(t, table);
  std::map<int, Version> versions;
  for (int material : t.after.block.made_of) versions[material] = version_of(material, t, table, result.was);
  for (std::size_t row = 0; row < result.was.size(); ++row)
    for (int material : t.after.block.made_of) result.ratios.before.push_back(versions.at(material).void_ratio[row]);
  for (std::size_t first = table.void_ratio; first < t.now.size(); first += t.columns)
    for (int material : t.after.block.made_of) result.ratios.after.push_back(versions.at(material).now[first]);
  const GhostedMesh& mesh = t.after.mesh;
  const SoilBlock& block = t.after.block;
  for (int e : mesh.own_elements(block.block))
    for (int q = 0; q < block.points; ++q) {
      const int row = mesh.first_row(e, block.points) + q, material = result.is[row];
      const std::size_t first = static_cast<std::size_t>(row) * t.columns;
      const Version& version = versions.at(material);
      t.now[first + table.origin] = material;
      result.changed += t.moved() && result.was[row] != material;
      if (version.near[row])
        for (int c = 0; c < t.columns; ++c)
          if (c < table.origin || c > table.origin + t.before.mesh.dimension())
            t.now[first + c] = version.now[first + c];
      if (version.near[row]) continue;
      ++result.started;
      const std::string at = place_text(t.after.place(e, q), t.before.mesh.dimension()),
                        name = soil_.materials[material]->name, problem = start(t, table, material, row);
      if (result.where.empty()) result.where = "material '" + name + "' at " + at;
      if (result.problem.empty() && !problem.empty())
        result.problem = "the law of material '" + name + "', which the soil at " + at +
                         " has become part of, cannot start there: " + problem;
    }
  return result;
}

}  // namespace mudline
