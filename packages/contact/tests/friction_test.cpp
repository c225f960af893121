#include <gtest/gtest.h>

#include "contact/laws/slope_check.hpp"
#include "contact_model.hpp"
#include "core/tests/input_error.hpp"

namespace mudline {
namespace {

constexpr double eps = 1e6, depth = 0.01, pressing = eps * depth;

std::string coulomb(double coefficient, const std::string& more = "") {
  return "<ParameterList name=\"friction\">\n" + text_parameter("type", "coulomb") +
         number_parameter("coefficient", coefficient) + more + "</ParameterList>\n";
}

/// A plate that reaches `depth` into the surface y = 0 and moves by x(t), y(t).
std::string plate(const std::string& x, const std::string& y = "0") {
  return body_xml("b",
                  text_parameter("type", "polyline") + text_parameter("extent", "full") +
                      array_parameter("x", "-10, 10") + array_parameter("y", "0, 0"),
                  text_parameter("type", "prescribed displacement") + text_parameter("x", x) + text_parameter("y", y),
                  "0, " + std::to_string(-depth));
}

ContactModel on_strip(const std::string& body, const std::string& friction, Support pressure = Support::vertices) {
  return ContactModel(Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 2, 1, 0), body,
                      contact_parameters("surface quadrature", eps) + friction, {}, "penalty", pressure);
}

const PointView& shear_rows(ContactModel& model, const State& state) {
  return state.arrays[model.store.find("contact/c/friction")];
}

int sliding_points(ContactModel& model) {
  const PointView& rows = shear_rows(model, model.store.trial());
  int count = 0;
  for (std::size_t i = 0; i < rows.extent(0); ++i) count += rows(i, 3) > 0;
  return count;
}

void set_pressure(ContactModel& model, State& state, double p) {
  for (std::size_t i = 0; i < state.value.extent(0); ++i)
    if (model.space.dofs()->field_of(static_cast<int>(i)) == 1) state.value(i) = p;
}

TEST(Friction, SpringThenStrengthThenTheWayBack) {
  // the plate drags the soil to the right: stiffness eps, strength 0.35 * 10 kPa reached after 3.5 mm
  ContactModel model = on_strip(plate("0.001*t*(t<6) + 0.001*(12-t)*(t>=6)"), coulomb(0.35));
  for (int step = 1; step <= 12; ++step) {
    const auto values = model.step(1);
    const double stress = step <= 6 ? std::min(3.5e3, 1e3 * step) : 3.5e3 - 1e3 * (step - 6);
    const double heat = 2 * 3.5e3 * 1e-3 * std::max(0.0, std::min(step, 6) - 3.5);
    EXPECT_NEAR(shear_rows(model, model.store.committed())(0, 0), stress, 1e-8) << step;
    EXPECT_NEAR(values.at("contact/c/reaction x").value, -2 * stress, 1e-8);
    EXPECT_NEAR(values.at("contact/c/friction x").value, -2 * stress, 1e-8);
    EXPECT_NEAR(values.at("contact/c/reaction y").value, 2 * pressing, 1e-8);
    EXPECT_NEAR(values.at("contact/c/friction y").value, 0, 1e-8);
    EXPECT_EQ(values.at("contact/c/sliding points").value, (step > 3 && step <= 6) ? 12 : 0);
    EXPECT_NEAR(values.at("contact/c/friction heat").value, heat, 1e-9);
    // the body's work is stored in the springs or has become heat; the trapezoidal rule errs in the step that begins to
    // slide
    const double corner = step > 3 ? 2 * 0.5 * 0.5e3 * 0.5e-3 : 0;
    EXPECT_NEAR(values.at("contact/c/work").value, heat + 2 * stress * stress / (2 * eps) - corner, 1e-8) << step;
  }
}

TEST(Friction, StrengthFollowsEffectiveOrTotalTractionAdhesionAndCap) {
  const auto stress = [](const std::string& friction, double p, Support support = Support::vertices) {
    ContactModel model = on_strip(plate("0.1*t"), friction, support);
    model.begin(1);
    set_pressure(model, model.store.trial(), p);
    model.residual();
    return shear_rows(model, model.store.trial())(5, 0);
  };
  EXPECT_NEAR(stress(coulomb(0.3), 0), 0.3 * pressing, 1e-8);
  EXPECT_NEAR(stress(coulomb(0.3), 4e3), 0.3 * (pressing - 4e3), 1e-8);
  EXPECT_NEAR(stress(coulomb(0.3), 4e3, Support::all_nodes), 0.3 * (pressing - 4e3), 1e-8);
  EXPECT_NEAR(stress(coulomb(0.3), 2 * pressing), 0, 1e-8);
  EXPECT_NEAR(stress(coulomb(0.3), -0.5 * pressing), 0.3 * 1.5 * pressing, 1e-8);
  EXPECT_NEAR(stress(coulomb(0.3), -3 * pressing), 0.3 * 2 * pressing, 1e-8);  // suction counts up to the traction
  EXPECT_NEAR(stress(coulomb(0.3, text_parameter("on", "total")), 4e3), 0.3 * pressing, 1e-8);
  EXPECT_NEAR(stress(coulomb(0.3, number_parameter("adhesion", 500)), 4e3), 500 + 0.3 * (pressing - 4e3), 1e-8);
  EXPECT_NEAR(stress(coulomb(0.3, number_parameter("adhesion", 500)), 2 * pressing), 500, 1e-8);
  EXPECT_NEAR(stress(coulomb(0.3, number_parameter("cap", 700)), 0), 700, 1e-8);
  EXPECT_NEAR(stress(coulomb(0.3, text_parameter("cap", "700+100*y+0*x")), 0), 700, 1e-8);
}

TEST(Friction, TangentialPenaltyIsAMultipleOfTheNormalOne) {
  ContactModel model = on_strip(plate("0.001*t"), coulomb(0.5, number_parameter("tangential penalty factor", 0.25)));
  model.step(1);
  EXPECT_NEAR(shear_rows(model, model.store.committed())(0, 0), 0.25 * eps * 1e-3, 1e-8);
}

TEST(Friction, OpeningForgetsTheShearStressAndClosingCountsFromTouch) {
  // down at t = 0, up by two depths at t = 2, down again at t = 3; all the time 1 mm per step to the right
  ContactModel model = on_strip(plate("0.001*t", "0.02*(t>1.5)*(t<2.5)"), coulomb(0.9));
  model.step(1);
  EXPECT_NEAR(shear_rows(model, model.store.committed())(0, 0), 1e3, 1e-8);
  model.step(1);
  EXPECT_EQ(shear_rows(model, model.store.committed())(0, 0), 0);
  model.step(1);
  EXPECT_NEAR(shear_rows(model, model.store.committed())(0, 0), 0.5e3, 1e-8);
}

/// A law by itself.
std::unique_ptr<const Friction> law_of(const std::string& friction) {
  Registry<Friction> registry("friction");
  register_friction(registry);
  Deck deck;
  deck.overlay(section_xml("deck", friction), "deck.xml");
  return registry.create(deck.root().section("friction"));
}

TEST(Friction, AdhesionGrowsUpToItsNormalTraction) {
  const auto law = law_of(coulomb(0.3, number_parameter("adhesion", 40) + number_parameter("full adhesion at", 200)));
  const auto strength = [&](double normal) {
    FrictionPoint at;
    at.normal = normal;
    return law->strength(at);
  };
  EXPECT_EQ(strength(-10).value, 0);
  EXPECT_EQ(strength(0).value, 0);
  EXPECT_NEAR(strength(50).value, 10 + 15, 1e-12);
  EXPECT_NEAR(strength(50).slope, 0.2 + 0.3, 1e-12);
  EXPECT_NEAR(strength(200).value, 40 + 60, 1e-12);
  EXPECT_NEAR(strength(500).value, 40 + 150, 1e-12);
  EXPECT_NEAR(strength(500).slope, 0.3, 1e-12);
}

TEST(Friction, CoefficientFollowsTheSpeed) {
  const auto stress = [](double per_second) {
    ContactModel model =
        on_strip(plate(std::to_string(per_second) + "*t"),
                 coulomb(0.3, number_parameter("kinetic coefficient", 0.1) + number_parameter("decay speed", 0.1)));
    model.begin(2);
    model.residual();
    return shear_rows(model, model.store.trial())(5, 0);
  };
  for (double speed : {0.05, 0.1, 5.0})
    EXPECT_NEAR(stress(speed), (0.1 + 0.2 * std::exp(-speed / 0.1)) * pressing, 1e-8) << speed;
  const auto message = [](const std::string& more) {
    return input_error([&] { on_strip(plate("0"), coulomb(0.3, more)); });
  };
  EXPECT_NE(message(number_parameter("kinetic coefficient", 0.1)).find("needs a decay speed"), std::string::npos);
  EXPECT_NE(message(number_parameter("decay speed", 0.1)).find("only together with a 'kinetic coefficient'"),
            std::string::npos);
}

TEST(Friction, AdhesionFollowsTimeAndPlace) {
  const auto law = law_of(coulomb(0, text_parameter("adhesion", "100*(1 - 0.5*t) - 20*y")));
  const auto strength = [&](double time, double y) {
    FrictionPoint at;
    at.normal = 1e3;
    at.time = time;
    at.position = {0, y, 0};
    return law->strength(at).value;
  };
  EXPECT_NEAR(strength(0, 0), 100, 1e-12);
  EXPECT_NEAR(strength(1, -3), 110, 1e-12);
  EXPECT_EQ(strength(4, 0), 0);  // what would be negative
}

TEST(Friction, CoefficientFallsWithTheSlip) {
  const auto law =
      law_of(coulomb(0.5, number_parameter("residual coefficient", 0.2) + number_parameter("residual slip", 0.01)));
  EXPECT_TRUE(law->reads_slip());
  EXPECT_FALSE(law_of(coulomb(0.5))->reads_slip());
  for (const double slip : {0.0, 0.005, 0.01, 1.0}) {
    FrictionPoint at;
    at.normal = 2e3;
    at.slip = slip;
    const ShearStrength found = law->strength(at);
    EXPECT_NEAR(found.value, (0.2 + 0.3 * std::exp(-slip / 0.01)) * 2e3, 1e-9) << slip;
    EXPECT_NEAR(found.slope, found.value / 2e3, 1e-12);
  }
}

TEST(Friction, AlphaLimitsByTheSoilsStrengthAndGrowsWithTheSpeed) {
  const auto law =
      law_of(coulomb(0.5, text_parameter("alpha", "0.4 + 0.1*x") + number_parameter("rate coefficient", 0.2) +
                              number_parameter("reference speed", 1e-3)));
  EXPECT_TRUE(law->reads().undrained_strength);
  EXPECT_FALSE(law_of(coulomb(0.5))->reads().undrained_strength);
  const auto at = [&](double normal, double rate) {
    FrictionPoint point;
    point.normal = normal;
    point.rate = rate;
    point.position = {1, 0, 0};
    point.soil.undrained_strength = 10e3;
    return law->strength(point);
  };
  EXPECT_NEAR(at(4e3, 0).value, 2e3, 1e-9);
  EXPECT_NEAR(at(4e3, 0).slope, 0.5, 1e-12);
  EXPECT_NEAR(at(40e3, 0).value, 5e3, 1e-9);
  EXPECT_EQ(at(40e3, 0).slope, 0);
  EXPECT_NEAR(at(40e3, 1e-3).value, 5e3, 1e-9);
  EXPECT_NEAR(at(40e3, 0.1).value, 5e3 * 1.4, 1e-9);
  EXPECT_NEAR(at(40e3, 0.1).rate_slope, 5e3 * 0.2 / (0.1 * std::log(10.0)), 1e-6);
  EXPECT_EQ(slope_problem(*law), "");
}

TEST(Friction, SoilWithoutStrengthHasADrainedCoefficientOnTheEffectiveTraction) {
  const auto strength = [](const Friction& law, double normal) {
    FrictionPoint point;
    point.normal = normal;
    return law.strength(point);  // the undrained strength is not a number
  };
  TouchingSoil sand, clay;
  clay.undrained_strength = 5e3;
  const std::string drained = number_parameter("alpha", 0.5) + number_parameter("drained coefficient", 0.3);
  const auto effective = law_of(coulomb(1, drained)),
             total = law_of(coulomb(1, drained + text_parameter("on", "total")));
  EXPECT_TRUE(total->reads().strength_if_any);
  EXPECT_TRUE(total->reads().pore_pressure);
  EXPECT_FALSE(law_of(coulomb(1, number_parameter("alpha", 0.5)))->reads().strength_if_any);
  EXPECT_TRUE(total->effective_on(sand));
  EXPECT_FALSE(total->effective_on(clay));
  EXPECT_TRUE(effective->effective_on(sand));
  EXPECT_TRUE(effective->effective_on(clay));
  EXPECT_NEAR(strength(*total, 4e3).value, 1.2e3, 1e-9);
  EXPECT_NEAR(strength(*total, 4e3).slope, 0.3, 1e-12);
  EXPECT_EQ(strength(*total, -4e3).value, 0);
  EXPECT_NEAR(strength(*law_of(coulomb(1, drained + number_parameter("cap", 500))), 4e3).value, 500, 1e-9);
  EXPECT_EQ(slope_problem(*effective), "");
  EXPECT_EQ(slope_problem(*total), "");
}

TEST(Friction, EntriesThatGoTogether) {
  const auto message = [](const std::string& more) { return input_error([&] { law_of(coulomb(0.3, more)); }); };
  const auto has = [&](const std::string& more, const char* part) {
    EXPECT_NE(message(more).find(part), std::string::npos) << message(more);
  };
  has(number_parameter("residual coefficient", 0.1), "needs a residual slip greater than 0 m");
  has(number_parameter("residual slip", 0.1), "only together with a 'residual coefficient'");
  has(number_parameter("alpha", 0.5) + number_parameter("rate coefficient", 0.1), "needs a reference speed greater");
  has(number_parameter("alpha", 0.5) + number_parameter("reference speed", 0.1), "together with a 'rate coefficient'");
  has(number_parameter("rate coefficient", 0.1) + number_parameter("reference speed", 0.1), "together with 'alpha'");
  has(number_parameter("drained coefficient", 0.3), "has a meaning only together with 'alpha'");
  for (const char* entry : {"alpha", "adhesion", "cap"}) has(number_parameter(entry, -0.5), "must not be negative");
}

TEST(Friction, WhatALawThrowsComesOutOfTheContact) {
  ContactModel model = on_strip(plate("0.1*t"), section_xml("friction", text_parameter("type", "throwing")));
  model.begin(1);
  EXPECT_THROW(model.residual(), std::runtime_error);
}

struct Case {
  Geometry geometry;
  Cells cells;
  const char* method;
  Support pressure;
};

class EveryFriction : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(
    Friction, EveryFriction,
    testing::Values(Case{Geometry::plane_strain, Cells::quad9, "surface quadrature", Support::vertices},
                    Case{Geometry::plane_strain, Cells::tri6, "nodes", Support::all_nodes},
                    Case{Geometry::plane_strain, Cells::quad4, "surface quadrature", Support::all_nodes},
                    Case{Geometry::axisymmetric, Cells::quad9, "nodes", Support::vertices},
                    Case{Geometry::axisymmetric, Cells::tri6, "surface quadrature", Support::vertices},
                    Case{Geometry::axisymmetric, Cells::quad4, "nodes", Support::vertices}));

TEST_P(EveryFriction, JacobianIsTheDifferencedResidual) {
  const Case c = GetParam();
  const std::string cone = text_parameter("type", "cone") + number_parameter("diameter", 1.0) +
                           number_parameter("apex angle [deg]", 120) + number_parameter("tip radius", 0.3) +
                           number_parameter("shoulder radius", 0.2);
  const auto body = body_xml(
      "b", cone, text_parameter("type", "prescribed displacement") + text_parameter("y", "-0.02*t-0.06*(t>1.5)"));
  // a committed step gives a shear history; in the next step points stick, slide, touch for the first time, or open
  struct Law {
    double coefficient;
    std::string more;
  };
  int stuck = 0, sliding = 0, touched = 0;
  for (const auto& [coefficient, more] :
       {Law{50, ""},
        {0.05, ""},
        {0.5, number_parameter("adhesion", 2e3)},
        {0.5, number_parameter("adhesion", 2e3) + number_parameter("full adhesion at", 5e3)},
        {0.5, text_parameter("on", "total")},
        {0.5, number_parameter("kinetic coefficient", 0.1) + number_parameter("decay speed", 0.02)},
        {0.7, number_parameter("cap", 3e3)}})
    for (const double size : {2e-3, 2e-2}) {
      ContactModel model(c.geometry, strip(c.cells, 8, 4, 0, 0.8, 0.4, 0.3), body,
                         contact_parameters(c.method, eps) + coulomb(coefficient, more), {}, "penalty", c.pressure);
      model.step(1);
      model.begin(1);
      deform(model, size);
      set_pressure(model, model.store.trial(), 3e3);
      EXPECT_LT(jacobian_error(model), 1e-6) << coefficient << more << size;
      if (more.find("total") == std::string::npos && sliding_points(model) > 0 && more.empty()) {
        EXPECT_LT(jacobian_error(model, Moved::pressures), 1e-6) << coefficient << more << size;
      }
      const PointView &now = model.points(model.store.trial()), &old = model.points(model.store.committed());
      const PointView& shear = shear_rows(model, model.store.trial());
      for (std::size_t i = 0; i < now.extent(0); ++i) {
        stuck += now(i, 2) > 0 && shear(i, 3) == 0;
        sliding += shear(i, 3) > 0;
        touched += now(i, 2) > 0 && old(i, 2) == 0;
      }
    }
  EXPECT_GT(stuck, 0);
  EXPECT_GT(sliding, 0);
  EXPECT_GT(touched, 0);
}

TEST(Friction, RejectedAndRepeatedStepGivesTheSameBits) {
  ContactModel model = on_strip(plate("0.002*t", "-0.001*t"), coulomb(0.15));
  model.step(1);
  const auto attempt = [&] {
    model.begin(0.7);
    deform(model, 1e-3);
    model.residual();
    std::vector<double> rows;
    for (const PointView& array : {shear_rows(model, model.store.trial()), model.points(model.store.trial())})
      for (std::size_t i = 0; i < array.extent(0); ++i)
        for (std::size_t j = 0; j < array.extent(1); ++j) rows.push_back(array(i, j));
    return rows;
  };
  const auto first = attempt();
  // a longer attempt that fails in between
  model.begin(3);
  deform(model, 1e-2);
  model.residual();
  Kokkos::deep_copy(shear_rows(model, model.store.trial()), -7.0);
  EXPECT_EQ(attempt(), first);
  model.store.accept();
  EXPECT_GT(shear_rows(model, model.store.committed())(0, 1), 0);
}

TEST(Friction, DragOnAConeIsUpwardAndCountsAsReaction) {
  // a frictional cone pushed into the soil: mu cot(half angle) times the smooth force is added to it
  const auto reaction = [](const std::string& friction) {
    ContactModel model(Geometry::axisymmetric, strip(Cells::quad9, 20, 1, 0, 0.4, 1, 0),
                       body_xml("b",
                                text_parameter("type", "cone") + number_parameter("diameter", 1.0) +
                                    number_parameter("apex angle [deg]", 120),
                                text_parameter("type", "prescribed displacement") + text_parameter("y", "-0.1*t")),
                       contact_parameters("surface quadrature", eps) + friction, {}, "penalty");
    model.step(1);
    return model.step(1).at("contact/c/reaction y").value;
  };
  const double smooth = reaction("");
  EXPECT_NEAR(reaction(coulomb(0.2)) / smooth, 1 + 0.2 / std::tan(std::acos(-1.0) / 6) / 3, 2e-2);
}

TEST(Friction, WrongEntriesAreNamed) {
  const auto error = [](const std::string& friction, const std::string& type) {
    return input_error([&] {
      ContactModel(Geometry::plane_strain, strip(Cells::quad4, 4, 1, 0, 1, 1, 0), plate("0"),
                   contact_parameters("nodes", eps) + friction, {}, type);
    });
  };
  const auto has = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  has(error("<ParameterList name=\"friction\">\n" + text_parameter("type", "columb") + "</ParameterList>\n", "penalty"),
      "contacts/c/friction/type: unknown friction type 'columb' (did you mean 'coulomb'?)");
  has(error(coulomb(-0.1), "penalty"), "contacts/c/friction/coefficient");
  has(error(coulomb(0.1), "frictionless penalty"), "friction");
}

}  // namespace
}  // namespace mudline
