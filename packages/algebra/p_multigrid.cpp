#include "algebra/p_multigrid.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/amg.hpp"
#include "algebra/nodal_chebyshev.hpp"
#include "algebra/node_matrix.hpp"
#include "algebra/smoothed_cycle.hpp"
#include "algebra/tpetra_compat.hpp"

namespace mudline {

namespace {

/// Stretched elements leave errors that are smooth in one direction only, so a wider part of the spectrum is smoothed.
/// From a stretch of three to one on, this is worth the additional products.
NodalChebyshev::Settings smoothing(double aspect_ratio) {
  constexpr double stretched = 4;  // a box of six tetrahedra, stretched three to one, has 3.9
  return aspect_ratio > stretched ? NodalChebyshev::Settings{6, 30} : NodalChebyshev::Settings{2, 10};
}

using IdVectors = Tpetra::MultiVector<GlobalOrdinal>;

/// The vertices among the owned displacement nodes, numbered densely: node -> coarse node, or -1.
struct Vertices {
  std::vector<int> owned;             // owned node of each owned vertex
  RCP<const Map> nodes, coarse_dofs;  // global displacement nodes; dofs of the linear space
};

Vertices find_vertices(const FieldLayout& field, const BlockData& data, const RCP<const Comm>& comm) {
  Vertices result;
  for (int i = 0; i < field.num_owned; ++i)
    if (data.parents[i].empty()) result.owned.push_back(i);
  result.nodes = make_map({field.node_ids.begin(), field.node_ids.begin() + field.num_owned}, comm);
  result.coarse_dofs = make_dense_map(result.owned.size() * field.components, comm);
  return result;
}

/// The first coarse dof (-1 for nodes that are not vertices) and the constrained components of every owned node and
/// every parent of one.
struct NodeTable {
  RCP<const Map> nodes;
  RCP<IdVectors> columns;
  GlobalOrdinal coarse_dof(GlobalOrdinal node) const { return get(node, 0); }
  bool constrained(GlobalOrdinal node, int component) const { return get(node, 1 + component) != 0; }
  GlobalOrdinal get(GlobalOrdinal node, int column) const {
    return columns->getLocalViewHost(Tpetra::Access::ReadOnly)(nodes->getLocalElement(node), column);
  }
};

NodeTable exchange_nodes(const FieldLayout& field, const BlockData& data, const Vertices& vertices,
                         const std::vector<char>& constrained) {
  const int components = field.components;
  IdVectors owned(vertices.nodes, 1 + components);
  {
    const auto values = owned.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (int i = 0; i < field.num_owned; ++i) {
      values(i, 0) = -1;
      for (int c = 0; c < components; ++c) values(i, 1 + c) = constrained[components * i + c];
    }
    for (std::size_t v = 0; v < vertices.owned.size(); ++v)
      values(vertices.owned[v], 0) = vertices.coarse_dofs->getGlobalElement(static_cast<int>(components * v));
  }
  std::vector<GlobalOrdinal> needed;
  for (const auto& parents : data.parents) needed.insert(needed.end(), parents.begin(), parents.end());
  std::sort(needed.begin(), needed.end());
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  NodeTable table;
  table.nodes = make_map(needed, vertices.nodes->getComm());
  table.columns = rcp(new IdVectors(table.nodes, 1 + components));
  table.columns->doImport(owned, Import(vertices.nodes, table.nodes), Tpetra::INSERT);
  return table;
}

/// Interpolation from the linear to the given space. Constrained dofs are left out of it: their rows hold at most the
/// vertex itself, so that they stay isolated in the coarse matrix.
RCP<CrsMatrix> make_prolongator(const RCP<const Map>& fine, const FieldLayout& field, const BlockData& data,
                                const Vertices& vertices, const std::vector<char>& constrained) {
  const NodeTable table = exchange_nodes(field, data, vertices, constrained);
  const int components = field.components;
  std::size_t most = 1;
  for (const auto& parents : data.parents) most = std::max(most, parents.size());
  const auto prolongator = rcp(new CrsMatrix(fine, most));
  std::size_t vertex = 0;
  for (int i = 0; i < field.num_owned; ++i) {
    const auto& parents = data.parents[i];
    for (int c = 0; c < components; ++c) {
      const GlobalOrdinal row = fine->getGlobalElement(components * i + c);
      if (parents.empty()) {
        const GlobalOrdinal column = vertices.coarse_dofs->getGlobalElement(static_cast<int>(components * vertex)) + c;
        const double one = 1;
        prolongator->insertGlobalValues(row, 1, &one, &column);
        continue;
      }
      if (constrained[components * i + c]) continue;
      for (const GlobalOrdinal parent : parents) {
        if (table.constrained(parent, c)) continue;
        const GlobalOrdinal column = table.coarse_dof(parent) + c;
        const double weight = 1.0 / static_cast<double>(parents.size());
        prolongator->insertGlobalValues(row, 1, &weight, &column);
      }
    }
    if (parents.empty()) ++vertex;
  }
  prolongator->fillComplete(vertices.coarse_dofs, fine);
  return prolongator;
}

/// Mean of the owned and all other vertices' coordinates, and the root mean square of their distance from it [m].
struct Extent {
  std::vector<double> centre;
  double radius;
};

Extent extent_of(const MultiVector& points) {
  const int dimension = static_cast<int>(points.getNumVectors());
  Extent extent{std::vector<double>(dimension), 0};
  points.meanValue(extent.centre);
  std::vector<double> norm(dimension);
  points.norm2(norm);
  const auto count = static_cast<double>(points.getGlobalLength());
  for (int i = 0; i < dimension; ++i) extent.radius += norm[i] * norm[i] / count - extent.centre[i] * extent.centre[i];
  extent.radius = std::sqrt(extent.radius);
  return extent;
}

/// Translations and the rotations about the centre of the domain, scaled to the size of a translation.
void add_rigid_modes(AmgInput& input, const Vertices& vertices, const BlockData& data) {
  const std::size_t count = vertices.owned.size();
  const int dimension = input.equations;
  input.coordinates = rcp(new MultiVector(make_dense_map(count, vertices.coarse_dofs->getComm()), dimension));
  {
    const auto points = input.coordinates->getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t v = 0; v < count; ++v)
      for (int i = 0; i < dimension; ++i) points(v, i) = data.coordinates[dimension * vertices.owned[v] + i];
  }
  const Extent extent = extent_of(*input.coordinates);
  input.null_space = rcp(new MultiVector(vertices.coarse_dofs, dimension == 2 ? 3 : 6));
  const auto points = input.coordinates->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto modes = input.null_space->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t v = 0; v < count; ++v) {
    const auto row = [&](int i) { return dimension * v + i; };
    for (int i = 0; i < dimension; ++i) modes(row(i), i) = 1;
    int mode = dimension;
    for (int i = 0; i < dimension; ++i)  // rotation in the plane of the directions i and j
      for (int j = i + 1; j < dimension; ++j, ++mode) {
        modes(row(i), mode) = -(points(v, j) - extent.centre[j]) / extent.radius;
        modes(row(j), mode) = (points(v, i) - extent.centre[i]) / extent.radius;
      }
  }
}

}  // namespace

PMultigrid::PMultigrid(const CrsMatrix& matrix, const FieldBlocks& blocks, int f, const FieldLayout& field,
                       const BlockData& data)
    : map_(blocks.map(f)) {
  const Vertices vertices = find_vertices(field, data, map_->getComm());
  const auto smoothed = [&](const RCP<NodeMatrix>& a, const RCP<CrsMatrix>& prolongator,
                            const std::vector<char>& joined) {
    const auto smoother = rcp(new NodalChebyshev(a, smoothing(data.aspect_ratio), joined));
    cycle_ = rcp(new SmoothedCycle(a, smoother, cycle_, prolongator));
  };
  AmgInput input;
  input.equations = field.components;
  add_rigid_modes(input, vertices, data);
  RCP<CrsMatrix> prolongator;
  RCP<NodeMatrix> fine;
  if (vertices.coarse_dofs->getGlobalNumElements() != map_->getGlobalNumElements()) {
    prolongator = make_prolongator(map_, field, data, vertices, blocks.isolated(matrix, f));
    fine = blocks.node_block(matrix, f, f);
    input.matrix = galerkin_product(*prolongator, *fine);
  } else {
    input.matrix = blocks.block(matrix, f, f);
  }
  cycle_ = amg_cycle(input);
  if (field.components == 3) {
    std::vector<char> joined;
    for (const int node : vertices.owned)
      if (!data.joined.empty()) joined.push_back(data.joined[node]);
    smoothed(rcp(new NodeMatrix(*input.matrix, field.components)), Teuchos::null, joined);
  }
  if (!prolongator.is_null()) smoothed(fine, prolongator, data.joined);
}

void PMultigrid::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double, double) const {
  cycle_->apply(x, y);
}

}  // namespace mudline
