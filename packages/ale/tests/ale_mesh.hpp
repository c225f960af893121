#pragma once

#include <Tpetra_Core.hpp>

#include <cmath>
#include <memory>
#include <vector>

#include "ale/ghosted_mesh.hpp"
#include "core/deck.hpp"
#include "physics/soil.hpp"
#include "tensor/mat.hpp"

namespace mudline::testing {

/// Leaves out the nodes that no element of the only block has.
inline void drop_unused_nodes(GlobalMesh& mesh) {
  std::vector<long long> number(mesh.coordinates.size(), -1);
  for (long long node : mesh.blocks[0].nodes) number[node] = 0;
  long long next = 0;
  for (std::size_t node = 0; node < number.size(); ++node) {
    if (number[node] < 0) continue;
    mesh.coordinates[next] = mesh.coordinates[node];
    number[node] = next++;
  }
  mesh.coordinates.resize(next);
  for (long long& node : mesh.blocks[0].nodes) node = number[node];
}

/// A box of n by n cells, or of triangles that halve them, with inner vertices scattered.
inline std::unique_ptr<Mesh> box(CellShape shape, int n, double distortion = 0.2, double width = 1.0,
                                 Teuchos::RCP<const Teuchos::Comm<int>> comm = Tpetra::getDefaultComm()) {
  GlobalMesh global;
  const int columns = 2 * n + 1;
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < columns; ++i) global.coordinates.push_back({width * i / (columns - 1.0), j / (columns - 1.0)});
  const auto id = [=](int i, int j) { return static_cast<long long>(j) * columns + i; };
  GlobalMesh::Block block{"soil", shape, {}};
  for (int j = 0; j < columns - 1; j += 2)
    for (int i = 0; i < columns - 1; i += 2) {
      const auto add = [&](std::initializer_list<long long> nodes) {
        block.nodes.insert(block.nodes.end(), nodes.begin(), nodes.begin() + num_nodes(shape));
      };
      if (shape == CellShape::quad9) {
        add({id(i, j), id(i + 2, j), id(i + 2, j + 2), id(i, j + 2), id(i + 1, j), id(i + 2, j + 1), id(i + 1, j + 2),
             id(i, j + 1), id(i + 1, j + 1)});
      } else {
        add({id(i, j), id(i + 2, j), id(i, j + 2), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
        add({id(i + 2, j), id(i + 2, j + 2), id(i, j + 2), id(i + 2, j + 1), id(i + 1, j + 2), id(i + 1, j + 1)});
      }
    }
  for (int j = 2; j < columns - 2; j += 2)
    for (int i = 2; i < columns - 2; i += 2)
      for (int d = 0; d < 2; ++d)
        global.coordinates[id(i, j)][d] += distortion / n * std::sin(1.3 * i + 2.1 * j + d) * (d == 0 ? width : 1.0);
  const int per_cell = shape == CellShape::quad9 ? 1 : 2;
  for (int k = 0; k < n; ++k) {
    global.side_sets["bottom"].push_back({0, k * per_cell, 0});
    global.side_sets["top"].push_back(
        {0, ((n - 1) * n + k) * per_cell + per_cell - 1, shape == CellShape::quad9 ? 2 : 1});
  }
  // middle nodes between their ends, centres between all
  const int nodes = num_nodes(shape), corners = num_corners(shape);
  if (order(shape) == 2)
    for (std::size_t e = 0; e < block.nodes.size(); e += nodes)
      for (int s = 0; s < corners; ++s)
        for (int d = 0; d < 2; ++d) {
          const auto &a = global.coordinates[block.nodes[e + s]],
                     &b = global.coordinates[block.nodes[e + (s + 1) % corners]];
          global.coordinates[block.nodes[e + corners + s]][d] = 0.5 * (a[d] + b[d]);
        }
  if (shape == CellShape::quad9)
    for (std::size_t e = 0; e < block.nodes.size(); e += nodes)
      for (int d = 0; d < 2; ++d) {
        double sum = 0;
        for (int s = 0; s < 4; ++s) sum += 0.25 * global.coordinates[block.nodes[e + s]][d];
        global.coordinates[block.nodes[e + 8]][d] = sum;
      }
  global.blocks.push_back(block);
  drop_unused_nodes(global);
  return std::make_unique<Mesh>(std::move(comm), Geometry::plane_strain, std::move(global));
}

/// A box, one metre high and `width` wide, of n by n by n cells, or of the six tetrahedra of each, with inner vertices
/// scattered.
inline std::unique_ptr<Mesh> cube(CellShape shape, int n, double distortion = 0.15, double width = 1.0) {
  Deck deck;
  const std::string cells = std::to_string(n);
  deck.overlay(
      "<ParameterList name=\"deck\"><ParameterList name=\"mesh\">"
      "<Parameter name=\"type\" type=\"string\" value=\"box\"/>"
      "<Parameter name=\"geometry\" type=\"string\" value=\"three-dimensional\"/>"
      "<Parameter name=\"cell\" type=\"string\" value=\"" +
          std::string(name(shape)) + "\"/><Parameter name=\"cells\" type=\"Array(int)\" value=\"{" + cells + ", " +
          cells + ", " + cells + "}\"/><Parameter name=\"upper\" type=\"Array(double)\" value=\"{" +
          std::to_string(width) + ", " + std::to_string(width) +
          ", 1.0}\"/>"
          "<Parameter name=\"distortion\" type=\"double\" value=\"" +
          std::to_string(distortion) + "\"/></ParameterList></ParameterList>",
      "cube.xml");
  Registry<MeshSource> sources("mesh");
  register_mesh_sources(sources);
  return make_mesh(Tpetra::getDefaultComm(), sources, deck.root().section("mesh"));
}

/// What the remap needs of a soil block: quadrature and place in the mesh.
inline SoilBlock points_of(const Mesh& mesh, int degree = 2) {
  SoilBlock block;
  block.block = 0;
  block.shape = mesh.blocks()[0].shape;
  block.u = tabulate(block.shape, cell_quadrature(block.shape, degree));
  block.elements = mesh.blocks()[0].num_elements;
  block.points = block.u.points;
  return block;
}

/// Grains [m3] of a block at x, by the points' own volumes; void ratios in a column of a table.
inline double grains(const GhostedMesh& mesh, const SoilBlock& block, const Positions& x, Geometry geometry,
                     const std::vector<double>& table, int columns = 1, int column = 0) {
  double sum = 0;
  for (int e : mesh.block_elements(block.block)) {
    const auto& nodes = mesh.elements()[e].nodes;
    for (int q = 0; q < block.points; ++q) {
      Mat<double, 3> j = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
      double r = 0;
      for (int i = 0; i < mesh.dimension(); ++i)
        for (int k = 0; k < mesh.dimension(); ++k) {
          j[i][k] = 0;
          for (int a = 0; a < block.u.nodes; ++a) j[i][k] += x[nodes[a]][i] * block.u.dN(q, a, k);
        }
      for (int a = 0; a < block.u.nodes; ++a) r += block.u.N(q, a) * x[nodes[a]][0];
      double det = 0;
      for (int k = 0; k < 3; ++k)
        det += j[0][k] * (j[1][(k + 1) % 3] * j[2][(k + 2) % 3] - j[1][(k + 2) % 3] * j[2][(k + 1) % 3]);
      const double around = geometry == Geometry::axisymmetric ? 2 * std::acos(-1.0) * r : 1.0;
      const std::size_t row = mesh.first_row(e, block.points) + q;
      sum += block.u.weights(q) * det * around / (1 + table[row * columns + column]);
    }
  }
  return sum;
}

}  // namespace mudline::testing
