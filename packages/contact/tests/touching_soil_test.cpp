#include <gtest/gtest.h>

#include "contact/contact_laws.hpp"
#include "contact_model.hpp"
#include "core/tests/input_error.hpp"

namespace mudline {
namespace {

constexpr double eps = 1e6, depth = 0.01, pore = 1.5e3;

std::string reading_friction(const std::string& entries) {
  return "<ParameterList name=\"friction\">\n" + text_parameter("type", "reading") + entries + "</ParameterList>\n";
}
std::string reading_normal_law(double per_pore_pressure) {
  return "<ParameterList name=\"normal law\">\n" + text_parameter("type", "reading") +
         number_parameter("per pore pressure", per_pore_pressure) + "</ParameterList>\n";
}
const std::string total = text_parameter("on", "total");

/// A plate 1 cm deep in the soil that moves to the right by half a metre per second.
const std::string plate =
    body_xml("b",
             text_parameter("type", "polyline") + text_parameter("extent", "full") + array_parameter("x", "-10, 10") +
                 array_parameter("y", "0, 0"),
             text_parameter("type", "prescribed displacement") + text_parameter("x", "0.5*t"), "0, -0.01");

void fill_pressure(ContactModel& model) {
  for (int node = 0; node < model.mesh.num_nodes(); ++node)
    if (const int p = model.space.node_dof(1)(node); p >= 0) model.store.committed().value(p) = pore;
}

/// Temperature 3 + 2 x at the vertices, pore pressure, and the stresses of two points of element e: p' = 1000 (e + 1).
void fill(ContactModel& model) {
  fill_pressure(model);
  State& state = model.store.committed();
  for (int node = 0; node < model.mesh.num_nodes(); ++node) {
    const int warm = model.space.node_dof(model.space.find("temperature"))(node);
    if (warm >= 0) state.value(warm) = 3 + 2 * model.mesh.coordinates()(node, 0);
  }
  const PointView& stress = state.arrays[model.store.find("soil/effective stress")];
  for (std::size_t row = 0; row < stress.extent(0); ++row)
    for (int i = 0; i < 3; ++i) stress(row, i) = -1000 * (row / 2 + 1.0) * (row % 2 ? 1.5 : 0.5) + 300 * (i - 1);
}

TEST(TouchingSoil, IsWhatTheLawsOfABodySee) {
  for (const char* method : {"nodes", "surface quadrature"})
    for (const Cells cells : {Cells::quad9, Cells::quad4}) {
      ContactModel model(
          Geometry::plane_strain, strip(cells, 4, 1, 0, 2, 1, 0), plate,
          contact_parameters(method, eps) + reading_normal_law(0.4) +
              reading_friction(total + number_parameter("per normal", 0.01) +
                               number_parameter("per pore pressure", 0.1) + number_parameter("per degree", 7) +
                               number_parameter("per mean stress", 0.2) + number_parameter("per strength", 0.3)),
          {}, "penalty", Support::vertices, true);
      fill(model);
      model.begin(1);
      model.residual();
      const State& trial = model.store.trial();
      const PointView &points = model.points(trial), &shear = trial.arrays[model.store.find("contact/c/friction")];
      const int per_side = static_cast<int>(points.extent(0)) / 4;
      for (int row = 0; row < static_cast<int>(points.extent(0)); ++row) {
        const int element = row / per_side;
        const double pressure = eps * depth + 0.4 * pore;
        EXPECT_NEAR(points(row, 1), pressure, 1e-8);
        const double rest =
            std::abs(shear(row, 0)) - 0.01 * pressure - 0.1 * pore - 0.2 * 1000 * (element + 1) - 0.3 * 2000;
        const double left = 0.5 * element, per_metre = 7 * 2 + 0.3 * 500;  // of temperature and strength
        EXPECT_GE(rest, 7 * 3 + per_metre * left - 1e-8) << method << row;
        EXPECT_LE(rest, 7 * 3 + per_metre * (left + 0.5) + 1e-8) << method << row;
        EXPECT_EQ(shear(row, 3), 1);
      }
      double mean = 0, area = 0;
      for (std::size_t row = 0; row < points.extent(0); ++row) {
        mean += points(row, 5) * std::abs(shear(row, 0));
        area += points(row, 5);
      }
      EXPECT_NEAR(mean / area,
                  0.01 * (eps * depth + 0.4 * pore) + 0.1 * pore + 0.2 * 2500 + 0.3 * 2500 + 7 * (3 + 2 * 1.0), 1e-7);
      model.view.flow = false;  // the heat of friction has no derivatives
      EXPECT_LT(jacobian_error(model), 1e-6);
      EXPECT_LT(jacobian_error(model, Moved::pressures), 1e-6);
    }
}

/// Two cells one on the other, which overlap by 1 cm; the set "slave" is of the upper one.
GlobalMesh two_cells() {
  GlobalMesh mesh;
  mesh.coordinates = {{-1, -1}, {2, -1}, {2, 0}, {-1, 0}, {0, -depth}, {1, -depth}, {1, 1}, {0, 1}};
  mesh.blocks.push_back({"soil", CellShape::quad4, {0, 1, 2, 3, 4, 5, 6, 7}});
  mesh.side_sets["slave"].push_back({0, 1, 0});
  mesh.side_sets["master"].push_back({0, 0, 2});
  return mesh;
}

std::string two_sides(const std::string& more) {
  return text_parameter("slave", "slave") + text_parameter("master", "master") + number_parameter("penalty", eps) +
         text_parameter("enforcement", "penalty") + more;
}

TEST(TouchingSoil, IsWhatTheLawsOfTwoSurfacesSee) {
  for (const std::string type : {"node to segment", "mortar"}) {
    ContactModel model(Geometry::plane_strain, two_cells(), plate,
                       two_sides(reading_friction(
                           total + number_parameter("per pore pressure", 0.1) + number_parameter("per degree", 7) +
                           number_parameter("per mean stress", 0.2) + number_parameter("per strength", 0.3))),
                       {}, type, Support::vertices, true);
    fill(model);
    model.begin(1);
    for (int node = 0; node < model.mesh.num_nodes(); ++node)
      if (model.mesh.coordinates()(node, 1) > -0.5 * depth - 0.5 && model.mesh.coordinates()(node, 1) != 0)
        model.store.trial().coordinates(node, 0) += 0.1;
    model.residual();
    const bool mortar = type == "mortar";
    const PointView& rows =
        model.store.trial().arrays[model.store.find(mortar ? "contact/c/sides" : "contact/c/points")];
    const PointView& shear =
        model.store.trial().arrays[model.store.find(mortar ? "contact/c/sides" : "contact/c/friction")];
    for (int row = 0; row < 2; ++row) {
      EXPECT_NEAR(rows(row, 1), eps * depth, 1e-6) << type;
      EXPECT_NEAR(std::abs(shear(row, mortar ? 2 : 0)),
                  0.1 * pore + 7 * (3 + 2 * row) + 0.2 * 2000 + 0.3 * (2000 + 500 * row), 1e-6)
          << type << row;
    }
    model.view.flow = false;  // the heat of friction has no derivatives
    EXPECT_LT(jacobian_error(model), 1e-6);
    EXPECT_LT(jacobian_error(model, Moved::pressures), 1e-6);
  }
}

TEST(TouchingSoil, PorePressureInTheNormalLawOfTwoSurfaces) {
  for (const std::string type : {"node to segment", "mortar"}) {
    const bool mortar = type == "mortar";
    const std::string quiet = mortar ? "" : text_parameter("impact", "interpolated");
    ContactModel model(Geometry::plane_strain, two_cells(), plate, two_sides(quiet + reading_normal_law(0.4)), {},
                       type);
    fill_pressure(model);
    model.begin(1);
    model.residual();
    const PointView& rows =
        model.store.trial().arrays[model.store.find(mortar ? "contact/c/sides" : "contact/c/points")];
    for (int row = 0; row < 2; ++row) EXPECT_NEAR(rows(row, 1), eps * depth + 0.4 * pore, 1e-8) << type;
    EXPECT_LT(jacobian_error(model), 1e-6);
    EXPECT_LT(jacobian_error(model, Moved::pressures), 1e-6);
  }
}

TEST(TouchingSoil, SmoothedPressureBetweenTwoSurfaces) {
  const std::string smoothed = "<ParameterList name=\"normal law\">\n" + text_parameter("type", "smoothed") +
                               number_parameter("depth", 2 * depth) + "</ParameterList>\n";
  for (const std::string type : {"node to segment", "mortar"}) {
    const std::string quiet = type == "mortar" ? "" : text_parameter("impact", "interpolated");
    ContactModel model(Geometry::plane_strain, two_cells(), plate, two_sides(quiet + smoothed), {}, type);
    model.begin(1);
    model.residual();
    const bool mortar = type == "mortar";
    const PointView& rows =
        model.store.trial().arrays[model.store.find(mortar ? "contact/c/sides" : "contact/c/points")];
    EXPECT_NEAR(rows(0, 1), 0.25 * eps * depth, 1e-6) << type;
    EXPECT_LT(jacobian_error(model), 1e-6);
  }
}

TEST(TouchingSoil, WhatAContactCannotTellIsRefused) {
  const auto message = [](GlobalMesh mesh, const std::string& type, const std::string& entries, bool warm) {
    return input_error(
        [&] { ContactModel(Geometry::plane_strain, mesh, plate, entries, {}, type, Support::vertices, warm); });
  };
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  const GlobalMesh flat = strip(Cells::quad4, 4, 1, 0, 2, 1, 0);
  const auto with = [](const char* entry) { return reading_friction(total + number_parameter(entry, 0.1)); };
  has(message(flat, "penalty", contact_parameters("nodes", eps) + with("per degree"), false),
      "contacts/c/friction/type: this law reads the soil's temperature");
  has(message(flat, "penalty", contact_parameters("nodes", eps) + with("per mean stress"), false),
      "contacts/c/friction/type: this law reads the soil's effective stress");
  has(message(flat, "penalty", contact_parameters("nodes", eps) + with("per strength"), false),
      "contacts/c/friction/type: this law reads the soil's undrained strength");
  for (const char* type : {"node to segment", "mortar"})
    has(message(two_cells(), type, two_sides(with("per degree")), false),
        "contacts/c/friction/type: this law reads the soil's temperature");
}

}  // namespace
}  // namespace mudline
