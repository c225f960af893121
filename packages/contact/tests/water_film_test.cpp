// Water between the soil's surface and a body.
#include <gtest/gtest.h>

#include <cmath>

#include "contact_model.hpp"
#include "core/tests/input_error.hpp"

namespace mudline {
namespace {

constexpr double eps = 1e6, viscosity = 1e-3, pi = 3.14159265358979323846;

std::string film(const std::string& entries = "", const std::string& method = "surface quadrature") {
  return contact_parameters(method, eps) + text_parameter("drainage", "film") + number_parameter("sealing gap", 10) +
         number_parameter("film viscosity", viscosity) +
         "<Parameter name=\"residual aperture\" type=\"double\" value=\"1e-9\"/>\n" + entries;
}

/// Flow into the film at a node.
double inflow(ContactModel& model, const NodalView& residual, int node) {
  const int dof = model.space.node_dof(1)(node);
  return dof < 0 ? 0 : residual(dof);
}

/// Sets pore pressures of the state at the start of a step and at its end.
template <class F>
void set_pressure(ContactModel& model, State& state, F&& pressure) {
  for (int node = 0; node < model.mesh.num_nodes(); ++node)
    if (const int dof = model.space.node_dof(1)(node); dof >= 0)
      state.value(dof) = pressure(model.mesh.coordinates()(node, 0), model.mesh.coordinates()(node, 1));
}

double total(ContactModel& model, const NodalView& residual) {
  double sum = 0;
  for (int node = 0; node < model.mesh.num_nodes(); ++node) sum += inflow(model, residual, node);
  return sum;
}

const std::string tilted_bowl =
    text_parameter("type", "sphere") + text_parameter("extent", "full") + number_parameter("diameter", 3.0);

TEST(WaterFilm, TangentOfForcesAndFlows) {
  const std::string body =
      body_xml("b", tilted_bowl,
               text_parameter("type", "free") +
                   "<Parameter name=\"freedom\" type=\"Array(string)\" value=\"{x, y, rotation}\"/>\n",
               "0.1, -0.02",
               number_parameter("mass", 50) + number_parameter("moment of inertia", 3) +
                   array_parameter("centre of mass", "0.1, 0.4"));
  for (const char* method : {"surface quadrature", "nodes"})
    for (const Support support : {Support::vertices, Support::all_nodes})
      for (const double cavitation : {-100.0, -1e5}) {  // with and without vapour
        ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 4, 1, -0.5, 1, 1, 0), body,
                           film(number_parameter("cavitation pressure", cavitation), method), {},
                           "frictionless penalty", support);
        set_pressure(model, model.store.committed(), [](double x, double) { return -200 - 300 * x; });
        model.begin(1);
        set_pressure(model, model.store.trial(), [](double x, double) { return -300 + 400 * x * x; });
        deform(model, 0.004);
        for (const Moved moved : {Moved::soil, Moved::pressures, Moved::body})
          EXPECT_LT(jacobian_error(model, moved), 1e-6) << method << " " << static_cast<int>(moved);
        int open = 0, closed = 0;
        const PointView& rows = model.points(model.store.trial());
        for (std::size_t row = 0; row < rows.extent(0); ++row) ++(rows(row, 0) > 0 ? open : closed);
        EXPECT_GT(open, 0);
        EXPECT_GT(closed, 0);
      }
}

TEST(WaterFilm, TheGapsGrowthIsDrawnFromTheSoilAndItsPressureActsOnBoth) {
  for (const Geometry geometry : {Geometry::plane_strain, Geometry::axisymmetric}) {
    ContactModel model(geometry, strip(Cells::quad9, 4, 1, 0, 2, 1, 0), plate_xml(0.01, -0.02), film());
    set_pressure(model, model.store.committed(), [](double, double) { return -700.0; });
    model.begin(0.5);
    set_pressure(model, model.store.trial(), [](double, double) { return -700.0; });
    const NodalView f = model.residual();
    const double area = geometry == Geometry::axisymmetric ? pi * 4 : 2;
    EXPECT_NEAR(total(model, f), 0.02 * area, 1e-12);
    double force = 0;
    for (int node = 0; node < model.mesh.num_nodes(); ++node) force -= f(model.dof(node, 1));
    EXPECT_NEAR(force, 700 * area, 1e-9);  // the film pulls the soil up
    model.store.accept();
    Report values;
    model.contact->histories(model.view, values);
    EXPECT_NEAR(values.at("contact/c/film water").value, 0.02 * area, 1e-12);
    EXPECT_EQ(values.at("contact/c/film vapour").value, 0);
    EXPECT_NEAR(values.at("contact/c/film force y").value, -700 * area, 1e-9);
    EXPECT_NEAR(values.at("contact/c/reaction y").value, -700 * area, 1e-9);
  }
}

TEST(WaterFilm, WhatPressesActsOnTopOfThePorePressure) {
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 2, 1, 0), plate_xml(-0.003), film());
  const auto pore = [](double, double) { return 500.0; };
  set_pressure(model, model.store.committed(), pore);
  model.begin(1);
  set_pressure(model, model.store.trial(), pore);
  const NodalView f = model.residual();
  EXPECT_NEAR(total(model, f), 0, 1e-15);  // closed: no water passes
  EXPECT_NEAR(model.points(model.store.trial())(0, 1), eps * 0.003 + 500, 1e-8);
}

TEST(WaterFilm, VapourTakesWhatTheSoilDoesNotGive) {
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 2, 1, 0), plate_xml(0.01, -0.02),
                     film(number_parameter("cavitation pressure", -1e4)));
  model.begin(0.5);
  // the film is now 2 cm thick and half of it is vapour: its water is still the 1 cm of the start, and none flows
  set_pressure(model, model.store.trial(), [](double, double) { return -1e4 - 250; });
  EXPECT_NEAR(total(model, model.residual()), 0, 1e-12);
  model.store.accept();
  model.begin(0.5);  // the next step starts from that water
  set_pressure(model, model.store.trial(), [](double, double) { return 0.0; });
  EXPECT_NEAR(total(model, model.residual()), (0.03 - 0.01) / 0.5 * 2, 1e-12);
}

TEST(WaterFilm, WaterAtRestFlowsNowhereAlongASlope) {
  const double weight = 9810;
  for (const bool heavy : {true, false}) {
    GlobalMesh mesh = strip(Cells::quad9, 4, 1, 0, 2, 1, 0);
    for (auto& x : mesh.coordinates) x[1] += 0.2 * x[0];
    const std::string plane = text_parameter("type", "polyline") + text_parameter("extent", "full") +
                              array_parameter("x", "-5, 5") + array_parameter("y", "-0.99, 1.01");
    ContactModel model(Geometry::plane_strain, mesh, body_xml("b", plane, text_parameter("type", "held"), "0, 0"),
                       film(), {}, "frictionless penalty", Support::vertices, false, [&](int, double) {
                         return Point{0, heavy ? -weight : 0, 0};
                       });
    const auto rest = [&](double, double y) { return -weight * y; };
    set_pressure(model, model.store.committed(), rest);
    model.begin(1);
    set_pressure(model, model.store.trial(), rest);
    const NodalView f = model.residual();
    double largest = 0;
    for (int node = 0; node < model.mesh.num_nodes(); ++node)
      largest = std::max(largest, std::abs(inflow(model, f, node)));
    const double gap = 0.01 / std::hypot(1, 0.2), slope = 0.2 / std::hypot(1, 0.2);
    const double flow = std::pow(gap, 3) / (12 * viscosity) * weight * slope;  // down the plane, out at its end
    if (heavy)
      EXPECT_LT(largest, 1e-9 * flow);
    else
      EXPECT_NEAR(largest, flow, 1e-9 * flow);
  }
}

}  // namespace
}  // namespace mudline
