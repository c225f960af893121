// What a contact of two deformable surfaces has in common with that of a body: film, drainage, initial gap, friction on
// the effective traction.
#include <gtest/gtest.h>

#include "contact_model.hpp"
#include "core/tests/input_error.hpp"

namespace mudline {
namespace {

constexpr double eps = 1e6, viscosity = 1e-3;

/// A box of cells below z = 0, with the side set "surface" on top.
GlobalMesh box(const std::string& cells, double half) {
  const std::string to = std::to_string(half);
  return box_in_space("hex8", cells, "-" + to + ", -" + to + ", -0.5", to + ", " + to + ", 0");
}

/// The master, and above it the slave, which hangs upside down at a gap; both meshes have their set "surface" at 0.
GlobalMesh pair(GlobalMesh master, const GlobalMesh& slave, int up, double gap) {
  const long long nodes = static_cast<long long>(master.coordinates.size());
  const long long per_element = num_nodes(master.blocks[0].shape);
  const long long elements = static_cast<long long>(master.blocks[0].nodes.size()) / per_element;
  for (auto x : slave.coordinates) {
    x[up - 1] = -x[up - 1];  // half a turn about the remaining axis, or about the axis out of the plane
    x[up] = gap - x[up];
    master.coordinates.push_back(x);
  }
  for (long long node : slave.blocks[0].nodes) master.blocks[0].nodes.push_back(nodes + node);
  auto sets = std::map<std::string, decltype(master.side_sets)::mapped_type>();
  sets["master"] = master.side_sets.at("surface");
  for (auto side : slave.side_sets.at("surface")) {
    side.element += elements;
    sets["slave"].push_back(side);
  }
  master.side_sets = {sets.begin(), sets.end()};
  return master;
}

const std::string plate_in_space =
    "<ParameterList name=\"bodies\">\n<ParameterList name=\"b\">\n" + array_parameter("position", "0, 0, 50") +
    "<ParameterList name=\"surface\">\n" + text_parameter("type", "box") + number_parameter("length x", 1) +
    number_parameter("length y", 1) + number_parameter("length z", 1) +
    "</ParameterList>\n<ParameterList name=\"motion\">\n" + text_parameter("type", "held") +
    "</ParameterList>\n</ParameterList>\n</ParameterList>\n";

/// Two blocks at a gap; the slave has a width of 1 m, in space 0.6 m.
struct Blocks : ContactModel {
  Blocks(Cells cells, double gap, const std::string& entries,
         std::function<std::array<double, 6>(const Point&)> stress = {}, Support support = Support::vertices,
         const std::string& type = "node to segment")
      : ContactModel(Geometry::plane_strain,
                     pair(strip(cells, 4, 1, -1.5, 3, 1, 0), strip(cells, 2, 1, -0.5, 1, 1, 0), 1, gap), plate_xml(50),
                     sides(entries), {}, type, support, false, {}, stress) {}
  Blocks(double gap, const std::string& entries, std::function<std::array<double, 6>(const Point&)> stress = {})
      : ContactModel(Geometry::space, pair(box("{3, 3, 1}", 0.8), box("{2, 2, 1}", 0.3), 2, gap), plate_in_space,
                     sides(entries), {}, "point to face", Support::vertices, false, {}, stress) {}
  static std::string sides(const std::string& more) {
    return text_parameter("slave", "slave") + text_parameter("master", "master") + number_parameter("penalty", eps) +
           number_parameter("capture distance", 0.5) + more;
  }
  template <class F>
  void set_pressure(State& state, F&& pressure) {
    for (int node = 0; node < mesh.num_nodes(); ++node)
      if (const int dof = space.node_dof(1)(node); dof >= 0) state.value(dof) = pressure(mesh.place(node));
  }
  /// Whether a node belongs to the upper block: nodes are numbered block after block.
  bool is_upper(int node) const {
    const long long first = mesh.dimension() == 3 ? 32 : mesh.num_nodes() == 16 ? 10 : 27;
    return mesh.node_ids()[node] >= first;
  }
  void lift(double up) {
    for (int node = 0; node < mesh.num_nodes(); ++node)
      if (is_upper(node)) store.trial().coordinates(node, mesh.dimension() - 1) += up;
  }
  /// Sums of the residual over the slave's and over the master's nodes, of a component or of the water (-1).
  std::array<double, 2> sums(const NodalView& f, int component) {
    std::array<double, 2> result{};
    for (int node = 0; node < mesh.num_nodes(); ++node) {
      const int at = component < 0 ? space.node_dof(1)(node) : dof(node, component);
      if (at >= 0) result[is_upper(node) ? 0 : 1] += f(at);
    }
    return result;
  }
};

std::string film(const std::string& entries = "") {
  return text_parameter("drainage", "film") + number_parameter("sealing gap", 10) +
         number_parameter("film viscosity", viscosity) +
         "<Parameter name=\"residual aperture\" type=\"double\" value=\"1e-9\"/>\n" + entries;
}

void expect_tangents(Blocks& model) {
  model.set_pressure(model.store.committed(), [](const Point& x) { return -200 - 300 * x[0]; });
  model.begin(1);
  model.set_pressure(model.store.trial(), [](const Point& x) { return -300 + 400 * x[0] * x[0]; });
  deform(model, 0.004);
  EXPECT_LT(jacobian_error(model), 1e-6);
  EXPECT_LT(jacobian_error(model, Moved::pressures), 1e-6);
  EXPECT_EQ(model.failures, 0);
}

TEST(PairFilm, TangentOfForcesAndFlows) {
  for (const double gap : {0.01, -0.01, 0.001})
    for (const double cavitation : {-100.0, -1e5}) {
      const std::string entries = film(number_parameter("cavitation pressure", cavitation));
      for (const Cells cells : {Cells::quad4, Cells::quad9})
        for (const Support support : {Support::vertices, Support::all_nodes}) {
          Blocks model(cells, gap, entries, {}, support);
          expect_tangents(model);
        }
      Blocks model(gap, entries);
      expect_tangents(model);
    }
}

void expect_growth(Blocks& model, double area) {
  const int up = model.mesh.dimension() - 1;
  const auto pore = [](const Point&) { return -700.0; };
  model.set_pressure(model.store.committed(), pore);
  model.begin(0.5);
  model.set_pressure(model.store.trial(), pore);
  model.lift(0.01);
  const NodalView f = model.residual();
  const auto water = model.sums(f, -1), force = model.sums(f, up);
  EXPECT_NEAR(water[0], 0.02 * area, 1e-12);  // the gap grows by 1 cm in half a second
  EXPECT_EQ(water[1], 0);
  EXPECT_NEAR(force[0], 700 * area, 1e-9);  // R = -f: the slave is pulled down, the master up
  EXPECT_NEAR(force[1], -700 * area, 1e-9);
  model.store.accept();
  Report values;
  model.contact->histories(model.view, values);
  EXPECT_NEAR(values.at("contact/c/film water").value, 0.02 * area, 1e-12);
  EXPECT_NEAR(values.at(std::string("contact/c/film force ") + axis_names[up]).value, -700 * area, 1e-9);
  EXPECT_NEAR(values.at(std::string("contact/c/force on slave ") + axis_names[up]).value, -700 * area, 1e-9);
}

TEST(PairFilm, TheGapsGrowthIsDrawnFromTheSlaveAndItsPressureActsOnBoth) {
  for (const Cells cells : {Cells::quad4, Cells::quad9}) {
    Blocks model(cells, 0.01, film());
    expect_growth(model, 1.0);
  }
  Blocks model(0.01, film());
  expect_growth(model, 0.36);
}

TEST(PairFilm, WrongEntriesAreNamed) {
  EXPECT_NE(input_error([] {
              Blocks(Cells::quad4, 0.01, film(text_parameter("enforcement", "augmented Lagrangian")));
            }).find("a film has no multipliers"),
            std::string::npos);
  EXPECT_NE(input_error([] {
              Blocks(Cells::quad4, 0.01, film(text_parameter("impact", "conserving")));
            }).find("a film takes energy"),
            std::string::npos);
  EXPECT_NE(input_error([] {
              Blocks(Cells::quad4, 0.01, number_parameter("film viscosity", 1));
            }).find("has a meaning only with 'drainage' = film"),
            std::string::npos);
}

void expect_effective_friction(Blocks& model) {
  const double pore = 4000, pressure = eps * 0.01;
  model.set_pressure(model.store.committed(), [](const Point&) { return 4000.0; });
  model.begin(1);
  model.set_pressure(model.store.trial(), [](const Point&) { return 4000.0; });
  for (int node = 0; node < model.mesh.num_nodes(); ++node)
    if (model.is_upper(node)) model.store.trial().coordinates(node, 0) += 0.1;
  const NodalView f = model.residual();
  const double area = model.mesh.dimension() == 2 ? 1.0 : 0.36;
  EXPECT_NEAR(model.sums(f, 0)[0], 0.3 * (pressure - pore) * area, 1e-6 * pressure);
  EXPECT_NEAR(model.sums(f, model.mesh.dimension() - 1)[0], -pressure * area, 1e-9 * pressure);
  deform(model, 1e-4);
  EXPECT_LT(jacobian_error(model), 1e-6);
  EXPECT_LT(jacobian_error(model, Moved::pressures), 1e-6);
}

TEST(PairFriction, IsOnTheTractionLessThePorePressureOfTheSlave) {
  const std::string coulomb = "<ParameterList name=\"friction\">\n" + text_parameter("type", "coulomb") +
                              number_parameter("coefficient", 0.3) + "</ParameterList>\n";
  Blocks plane(Cells::quad9, -0.01, coulomb);
  expect_effective_friction(plane);
  for (const Cells cells : {Cells::quad4, Cells::quad9})
    for (const Support support : {Support::vertices, Support::all_nodes}) {
      Blocks mortar(cells, -0.01, text_parameter("enforcement", "penalty") + coulomb, {}, support, "mortar");
      expect_effective_friction(mortar);
    }
  Blocks space(-0.01, coulomb);
  expect_effective_friction(space);
}

std::string in_situ(const std::string& more = "") {
  return text_parameter("initial gap", "in-situ stress") + number_parameter("closing distance", 0.02) + more;
}

void expect_in_situ(Blocks& model, bool film) {
  // the vertical stress is -(3 + x) kPa
  const double pore = film ? 400 : 0;
  model.set_pressure(model.store.committed(), [&](const Point&) { return pore; });
  model.first_act();
  const State& committed = model.store.committed();
  const PointView before = model.points(committed);
  std::vector<std::array<double, 2>> start;
  double total = 0, area = 0;
  for (std::size_t row = 0; row < before.extent(0); ++row) {
    start.push_back({before(row, 1), before(row, 3 + model.mesh.dimension() - 1)});
    total += start.back()[1];
    area += before(row, 3 + model.mesh.dimension());
  }
  EXPECT_NEAR(total, 3000 * area, 1e-8);
  model.begin(1);  // nothing moves: the contact finds the values of the first state
  model.residual();
  const PointView& after = model.points(model.store.trial());
  for (std::size_t row = 0; row < after.extent(0); ++row) {
    EXPECT_EQ(after(row, 2), 1);
    EXPECT_NEAR(after(row, 1), start[row][0], 1e-8);
    EXPECT_NEAR(after(row, 3 + model.mesh.dimension() - 1), start[row][1], 1e-8);
    EXPECT_NEAR(after(row, 0), -(start[row][0] - pore) / eps, 1e-15);
  }
  deform(model, 1e-4);
  EXPECT_LT(jacobian_error(model), 1e-6);
}

TEST(PairInitialGap, PressesWithTheTractionOfTheSlave) {
  const auto plane = [](const Point& x) { return std::array<double, 6>{-900, -1000 * (3 + x[0]), -700, 0, 0, 250}; };
  const auto space = [](const Point& x) { return std::array<double, 6>{-900, -700, -1000 * (3 + x[0]), 0, 250, 0}; };
  for (const double gap : {0.01, -0.01})
    for (const bool water : {false, true}) {
      for (const Cells cells : {Cells::quad4, Cells::quad9}) {
        Blocks model(cells, gap, in_situ(water ? film() : ""), plane);
        expect_in_situ(model, water);
      }
      Blocks model(gap, in_situ(water ? film() : ""), space);
      expect_in_situ(model, water);
    }
}

TEST(PairInitialGap, MultipliersCarryTheTraction) {
  const auto plane = [](const Point&) { return std::array<double, 6>{-900, -3000, -700, 0, 0, 0}; };
  Blocks model(Cells::quad9, 0.01, in_situ(text_parameter("enforcement", "augmented Lagrangian")), plane);
  model.first_act();
  model.begin(1);
  model.residual();
  const PointView& rows = model.points(model.store.trial());
  for (std::size_t row = 0; row < rows.extent(0); ++row) {
    EXPECT_NEAR(rows(row, 0), 0, 1e-15);
    EXPECT_NEAR(rows(row, 1), 3000, 1e-9);
  }
}

TEST(PairInitialGap, ClosedGapsCountFromTheStart) {
  Blocks model(Cells::quad4, 0.01,
               text_parameter("initial gap", "closed") + number_parameter("closing distance", 0.02));
  model.first_act();
  model.begin(1);
  model.lift(-0.004);
  model.residual();
  model.store.accept();
  Report values;
  model.contact->histories(model.view, values);
  EXPECT_NEAR(values.at("contact/c/maximum penetration").value, 0.004, 1e-15);
  EXPECT_NEAR(values.at("contact/c/force on slave y").value, eps * 0.004, 1e-12 * eps);
}

TEST(PairDrainage, SealsWhereTheSurfacesMeet) {
  for (const auto& [drainage, gap, vertices] :
       {std::tuple{"sealed", 0.01, 3u}, std::tuple{"sealed", 0.2, 0u}, std::tuple{"drained", 0.01, 0u}}) {
    Blocks model(Cells::quad4, gap, text_parameter("drainage", drainage));
    EXPECT_EQ(released(model, "slave").size(), vertices) << drainage << gap;
    EXPECT_TRUE(released(model, "master").empty());
  }
}

}  // namespace
}  // namespace mudline
