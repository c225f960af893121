#pragma once

// What the mesh tests share: a mesh from the text of a deck, and sums over its elements and sides.
#include <Teuchos_DefaultMpiComm.hpp>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/deck.hpp"
#include "core/tests/input_error.hpp"
#include "discretisation/mesh.hpp"

namespace mudline::mesh_test {

inline Teuchos::RCP<const Teuchos::Comm<int>> world() {
  return Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_WORLD));
}

inline std::string parameter(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
}

/// The section "mesh" with the given entries, of a deck that lies beside the test data.
inline Section mesh_section(const std::string& entries) {
  Deck deck;
  deck.overlay(
      "<ParameterList name=\"deck\"><ParameterList name=\"mesh\">" + entries + "</ParameterList></ParameterList>",
      std::string(MUDLINE_SOURCE_DIR) + "/packages/discretisation/tests/data/deck.xml");
  static std::vector<std::shared_ptr<Deck>> alive;  // a section refers to its deck's data
  alive.push_back(std::make_shared<Deck>(deck));
  return alive.back()->root().section("mesh");
}

inline std::unique_ptr<Mesh> make(const std::string& entries) {
  Registry<MeshSource> sources("mesh source");
  register_mesh_sources(sources);
  return make_mesh(world(), sources, mesh_section(entries));
}

inline std::string box(const std::string& cell, int nx, int ny, const std::string& more = "") {
  return parameter("type", "string", "box") + parameter("cell", "string", cell) +
         parameter("cells", "Array(int)", "{" + std::to_string(nx) + ", " + std::to_string(ny) + "}") +
         parameter("upper", "Array(double)", "{2.0, 1.0}") + more;
}

inline std::string gmsh(const std::string& file, const std::string& more = "") {
  return parameter("type", "string", "gmsh") + parameter("file", "string", file) + more;
}

/// Area of this rank's elements; of one region when named.
inline double area(const Mesh& mesh, const std::string& region = "") {
  double sum = 0;
  for (const ElementBlock& block : mesh.blocks()) {
    if (!region.empty() && block.region != region) continue;
    const ShapeTable table = tabulate(block.shape, cell_quadrature(block.shape, 5));
    for (int e = 0; e < block.num_elements; ++e)
      for (int q = 0; q < table.points; ++q) {
        double j[2][2] = {};
        for (int a = 0; a < table.nodes; ++a)
          for (int i = 0; i < 2; ++i)
            for (int d = 0; d < 2; ++d) j[i][d] += mesh.coordinates()(block.nodes(e, a), i) * table.dN(q, a, d);
        sum += table.weights(q) * (j[0][0] * j[1][1] - j[0][1] * j[1][0]);
      }
  }
  return sum;
}

/// Integral over this rank's sides of a set: length, and the outward normal (x, y).
inline std::array<double, 3> side_integral(const Mesh& mesh, const std::string& set) {
  std::array<double, 3> sum{};
  const QuadratureRule rule = line_quadrature(9);
  for (const Side& side : mesh.side_sets().at(set)) {
    const ElementBlock& block = mesh.blocks()[side.block];
    const auto nodes = side_nodes(block.shape, side.side);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      double N[3], dN[3], t[2] = {0, 0};
      evaluate_line(static_cast<int>(nodes.size()), rule.points[q][0], N, dN);
      for (std::size_t a = 0; a < nodes.size(); ++a)
        for (int d = 0; d < 2; ++d) t[d] += dN[a] * mesh.coordinates()(block.nodes(side.element, nodes[a]), d);
      sum[0] += rule.weights[q] * std::hypot(t[0], t[1]);
      sum[1] += rule.weights[q] * t[1];
      sum[2] -= rule.weights[q] * t[0];
    }
  }
  return sum;
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace mudline::mesh_test

#define EXPECT_CONTAINS(text, part) EXPECT_TRUE(mudline::mesh_test::contains(text, part)) << text
