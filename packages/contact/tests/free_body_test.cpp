// A body with unknowns in contact: its share of force, moment and tangent.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/laws/impact_share.hpp"
#include "contact_model.hpp"

namespace mudline {
namespace {

constexpr double eps = 1e6;

std::string friction(double coefficient) {
  return "<ParameterList name=\"friction\">\n" + text_parameter("type", "coulomb") +
         number_parameter("coefficient", coefficient) + "</ParameterList>\n";
}

std::string free_motion(const std::string& directions) {
  return text_parameter("type", "free") + "<Parameter name=\"freedom\" type=\"Array(string)\" value=\"{" + directions +
         "}\"/>\n";
}

/// A cylinder whose lowest point is at y; its centre of mass is not at its middle.
std::string cylinder(double y, const std::string& directions) {
  return body_xml(
      "b", text_parameter("type", "sphere") + text_parameter("extent", "full") + number_parameter("diameter", 1.0),
      free_motion(directions), "0, " + std::to_string(y),
      number_parameter("mass", 50) + number_parameter("moment of inertia", 3) +
          array_parameter("centre of mass", "0.1, 0.4"));
}

/// Rotates and shifts the body in the trial state.
void place(ContactModel& model, double x, double y, double angle) {
  const BodyUnknowns& unknowns = model.bodies_["b"]->unknowns();
  const double value[body_directions] = {x, y, angle};
  for (int k = 0; k < unknowns.count; ++k)
    model.store.trial().value(unknowns.dof[k]) = value[unknowns.direction[k]] / unknowns.scale[k];
}

TEST(FreeBody, TurningAboutTheMiddleOfACylinderChangesNothing) {
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 8, 1, -1, 2, 1, 0.3),
                     cylinder(-0.05, "x, y, rotation"), contact_parameters("surface quadrature", eps));
  model.begin(1);
  const NodalView before = model.residual();
  const double angle = 0.7, arm[2] = {0.1, 0.4 - 0.5};  // centre of mass from the middle
  place(model, std::cos(angle) * arm[0] - std::sin(angle) * arm[1] - arm[0],
        std::sin(angle) * arm[0] + std::cos(angle) * arm[1] - arm[1], angle);
  const NodalView after = model.residual();
  const BodyUnknowns& unknowns = model.bodies_["b"]->unknowns();
  double size = 0;
  for (std::size_t i = 0; i < before.extent(0); ++i) size = std::max(size, std::abs(before(i)));
  EXPECT_GT(size, 100);
  for (std::size_t i = 0; i < before.extent(0); ++i)
    if (static_cast<int>(i) != unknowns.dof[2]) {
      EXPECT_NEAR(before(i), after(i), 1e-9 * size) << i;
    }
  // normal forces pass through the middle: the moment about the centre of mass is that of the whole force
  const double fx = -after(unknowns.dof[0]), fy = -after(unknowns.dof[1]);
  const double lever[2] = {std::cos(angle) * arm[0] - std::sin(angle) * arm[1],
                           std::sin(angle) * arm[0] + std::cos(angle) * arm[1]};
  EXPECT_NEAR(-after(unknowns.dof[2]) / unknowns.scale[2], -lever[0] * fy + lever[1] * fx, 1e-9 * size);
}

TEST(FreeBody, GetsWhatTheSoilGets) {
  ContactModel model(Geometry::plane_strain, strip(Cells::tri6, 8, 1, -1, 2, 1, 0.1), cylinder(-0.05, "x, y, rotation"),
                     contact_parameters("surface quadrature", eps) + friction(0.4), {}, "penalty");
  model.step(1);
  model.begin(1);
  place(model, 0.002, -0.003, 0.01);
  const NodalView f = model.residual();
  double sum[2] = {0, 0}, size = 0;
  for (int node = 0; node < model.mesh.num_nodes(); ++node)
    for (int i = 0; i < 2; ++i) {
      sum[i] += f(model.dof(node, i));
      size += std::abs(f(model.dof(node, i)));
    }
  const BodyUnknowns& unknowns = model.bodies_["b"]->unknowns();
  EXPECT_GT(std::abs(sum[0]), 1e-3 * size);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(sum[i], -f(unknowns.dof[i]), 1e-12 * size);
}

struct Case {
  Geometry geometry;
  Cells cells;
  const char* method;
  double coefficient;
  double lift;          // [m] after the first step: opens most of the points
  double alpha_f = -1;  // negative: without inertia
  double damping = 0;   // [s/m]
};

class EveryFreeBody : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(
    FreeBody, EveryFreeBody,
    testing::Values(Case{Geometry::plane_strain, Cells::quad9, "surface quadrature", 0, 0},
                    Case{Geometry::plane_strain, Cells::quad9, "surface quadrature", 0.02, 0},    // slides
                    Case{Geometry::plane_strain, Cells::tri6, "nodes", 50, 0},                    // sticks
                    Case{Geometry::plane_strain, Cells::quad4, "surface quadrature", 0.2, 0.03},  // opens
                    Case{Geometry::plane_strain, Cells::quad9, "surface quadrature", 0.2, 0, 0.5},
                    Case{Geometry::plane_strain, Cells::tri6, "surface quadrature", 0.2, 0.03, 0.4},
                    Case{Geometry::axisymmetric, Cells::quad9, "surface quadrature", 0.2, 0, 0.3},
                    Case{Geometry::axisymmetric, Cells::tri6, "surface quadrature", 0.2, 0.03, 0.5},
                    Case{Geometry::axisymmetric, Cells::quad9, "nodes", 0.02, 0},
                    Case{Geometry::axisymmetric, Cells::tri6, "surface quadrature", 50, 0},
                    Case{Geometry::axisymmetric, Cells::quad4, "surface quadrature", 0.2, 0.03},
                    Case{Geometry::plane_strain, Cells::quad9, "surface quadrature", 0.2, 0, -1, 30},
                    Case{Geometry::plane_strain, Cells::tri6, "nodes", 0, 0.03, -1, 10},  // opens
                    Case{Geometry::plane_strain, Cells::quad9, "surface quadrature", 0.02, 0, 0.5, 100},
                    Case{Geometry::plane_strain, Cells::tri6, "surface quadrature", 0.2, 0.03, 0.4, 20},
                    Case{Geometry::axisymmetric, Cells::quad9, "surface quadrature", 0.2, 0, 0.3, 100},
                    Case{Geometry::axisymmetric, Cells::tri6, "surface quadrature", 0, 0.03, 0.5,
                         1e4}));  // as it never pulls

TEST_P(EveryFreeBody, JacobianIsTheDifferencedResidual) {
  const Case c = GetParam();
  const bool plane = c.geometry == Geometry::plane_strain;
  const std::string body = plane ? cylinder(-0.06, "x, y, rotation")
                                 : body_xml("b", text_parameter("type", "sphere") + number_parameter("diameter", 1.0),
                                            free_motion("y"), "0, -0.06", number_parameter("mass", 50));
  ContactModel model(c.geometry, strip(c.cells, 5, 1, plane ? -1 : 0, plane ? 2 : 1, 1, 0.2), body,
                     contact_parameters(c.method, eps) + (c.coefficient > 0 ? friction(c.coefficient) : "") +
                         (c.damping > 0 ? number_parameter("damping", c.damping) : ""),
                     {}, "penalty");
  model.begin(1);
  model.residual();
  model.store.accept();
  model.begin(1);
  if (c.alpha_f >= 0) model.set_inertia(c.alpha_f);
  deform(model, 0.002);
  place(model, 0.004, -0.005 + c.lift, 0.02);
  for (int i = 0; i < model.space.dofs()->num_overlap_dofs(); ++i)
    if (model.space.dofs()->field_of(i) == 1) model.store.trial().value(i) = 100;
  for (const Moved moved : {Moved::soil, Moved::body})
    EXPECT_LT(jacobian_error(model, moved), 1e-6) << static_cast<int>(moved);
  if (c.coefficient == 0) return;
  const PointView& rows = model.store.trial().arrays[model.store.find("contact/c/friction")];
  const PointView& points = model.points(model.store.trial());
  int slides = 0, active = 0, opened = 0, closed = 0;
  for (std::size_t i = 0; i < rows.extent(0); ++i) {
    slides += rows(i, 3) > 0;
    active += points(i, 2) > 0;
    opened += points(i, 2) == 0 && model.points(model.store.committed())(i, 2) > 0;
    closed += points(i, 2) > 0 && model.points(model.store.committed())(i, 2) == 0;
  }
  EXPECT_GT(active, 0);
  if (c.coefficient > 1) {
    EXPECT_EQ(slides, 0);
  }
  if (c.coefficient < 0.1) {
    EXPECT_GE(2 * slides, active);
  }
  if (c.lift > 0) {
    EXPECT_GT(opened, 0);
  }
  if (c.alpha_f >= 0 && c.lift == 0) {
    EXPECT_GT(closed, 0);
  }
}

TEST(ImpactShare, DoesTheWorkThatTheSpringStoresOrGivesBack) {
  const double stiffness = 7;
  for (const double gap_old : {1e-6, 0.3})
    for (const double gap : {-1e-6, -0.2}) {
      const double stored = 0.5 * stiffness * gap * gap, advance = gap - gap_old;
      EXPECT_NEAR(end_share(gap_old, gap, 0) * stiffness * gap * advance, stored, 1e-15);
      // the same backwards
      EXPECT_NEAR(start_share(gap, gap_old, 0) * stiffness * gap * -advance, -stored, 1e-15);
    }
}

TEST(FreeBody, ImpactGivesTheSpringsEnergyBack) {
  // down through the flat surface and up again, in steps that end neither at the touch nor at the separation: no net
  // work
  ContactModel model(
      Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 2, 1, 0),
      body_xml("b", text_parameter("type", "polyline") + array_parameter("x", "0, 10") + array_parameter("y", "0, 0"),
               free_motion("y"), "0, 0", number_parameter("mass", 50)),
      contact_parameters("surface quadrature", eps));
  const int dof = model.bodies_["b"]->unknowns().dof[1];
  const double path[] = {0.013, -0.02, -0.031, -0.004, 0.007};
  double work = 0, before = 0, old_force = 0, stored = 0;
  for (const double y : path) {
    model.begin(1);
    if (before != 0) model.set_inertia(0.5);
    model.store.trial().value(dof) = y;
    // the stepper's interpolation
    NodalView now("now", model.space.dofs()->num_overlap_dofs());
    model.contact->residual(model.view, now);
    NodalView alpha("alpha", now.extent(0));
    alpha(dof) = 0.5 * (now(dof) + old_force);
    model.contact->correction(model.view, alpha);
    if (before != 0) work += alpha(dof) * (y - before);
    stored = 0.5 * eps * 2 * y * y * (y < 0);
    if (before != 0) {
      EXPECT_NEAR(work, stored, 1e-9) << y;
    }
    old_force = now(dof);
    before = y;
    model.store.accept();
  }
  EXPECT_EQ(stored, 0);
}

TEST(FreeBody, DampingTakesWhatItReports) {
  // a plate of 2 m: over each step the mean normal force times damping times speed, never a pull
  for (const bool conserving : {false, true}) {
    ContactModel model(
        Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 2, 1, 0),
        body_xml("b", text_parameter("type", "polyline") + array_parameter("x", "0, 10") + array_parameter("y", "0, 0"),
                 free_motion("y"), "0, 0", number_parameter("mass", 50)),
        contact_parameters("surface quadrature", eps) + number_parameter("damping", 20) +
            text_parameter("impact", conserving ? "conserving" : "interpolated"));
    const int dof = model.bodies_["b"]->unknowns().dof[1];
    const double path[] = {0.013, -0.02, -0.031, -0.004, 0.007}, dt = 0.5;
    double heat = 0, before = 0, old_force = 0;
    for (const double y : path) {
      model.begin(dt);
      model.set_inertia(0.5);
      model.store.trial().value(dof) = y;
      NodalView now("now", model.space.dofs()->num_overlap_dofs()), correction("correction", now.extent(0));
      model.contact->residual(model.view, now);
      model.contact->correction(model.view, correction);
      const double rate = (before - y) / dt,
                   forces[2] = {2 * eps * std::max(-before, 0.0), 2 * eps * std::max(-y, 0.0)};
      const double start = conserving ? start_share(before, y, 0) : 0.5,
                   end = conserving ? end_share(before, y, 0) : 0.5;
      const double mean = start * forces[0] + end * forces[1], damping = std::max(20 * rate, -1.0) * mean;
      heat += damping * (before - y);
      // the force on the body is upwards; the residual has the opposite sign
      EXPECT_NEAR(0.5 * (now(dof) + old_force) + correction(dof), -(mean + damping), 1e-9 * eps) << y;
      old_force = now(dof);
      before = y;
      model.store.accept();
      Report values;
      model.contact->histories(model.view, values);
      EXPECT_NEAR(values.at("contact/c/damping heat").value, heat, 1e-9 * eps) << y;
      EXPECT_NEAR(values.at("contact/c/damping y").value, damping, 1e-9 * eps) << y;
      EXPECT_LE(-(mean + damping), 1e-9 * eps);
    }
    EXPECT_GT(heat, 0);
  }
}

TEST(FreeBody, WithoutInertiaGetsStiffnessFromTheNearestPoints) {
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 8, 1, -1, 2, 1, 0), cylinder(0.001, "y"),
                     contact_parameters("surface quadrature", eps));
  const auto stiffness = [&](bool inertia) {
    model.begin(1);
    model.view.inertia = inertia;
    model.residual();
    model.assembler.begin(Kokkos::View<char*>("free", model.space.dofs()->num_overlap_dofs()));
    model.contact->jacobian(model.view, model.assembler, 1.0);
    model.assembler.end();
    Vector diagonal(model.space.dofs()->owned());
    model.assembler.matrix()->getLocalDiagCopy(diagonal);
    return diagonal.getLocalViewHost(Tpetra::Access::ReadOnly)(model.bodies_["b"]->unknowns().dof[1], 0);
  };
  EXPECT_EQ(stiffness(true), 0);
  EXPECT_GT(stiffness(false), 1e-3 * eps);
  EXPECT_NE(model.contact->hint(model.view).find("touches nothing in contact 'c'"), std::string::npos);
}

TEST(FreeBody, TheTangentIsTheSameWhenAskedTwice) {
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 8, 1, -1, 2, 1, 0), cylinder(0.001, "y"),
                     contact_parameters("surface quadrature", eps));
  model.begin(1);
  model.residual();
  const int dof = model.bodies_["b"]->unknowns().dof[1];
  const auto stiffness = [&] {
    model.assembler.begin(Kokkos::View<char*>("free", model.space.dofs()->num_overlap_dofs()));
    model.contact->jacobian(model.view, model.assembler, 1.0);
    model.assembler.end();
    Vector diagonal(model.space.dofs()->owned());
    model.assembler.matrix()->getLocalDiagCopy(diagonal);
    return diagonal.getLocalViewHost(Tpetra::Access::ReadOnly)(dof, 0);
  };
  const double first = stiffness();
  EXPECT_GT(first, 0);
  EXPECT_EQ(first, stiffness());
  // each linearisation of a step without contact yet lets the body move farther
  model.view.linearisation = 1;
  EXPECT_NEAR(stiffness(), 0.1 * first, 1e-12 * first);
}

TEST(FreeBody, FarAwayMayComeHalfTheWay) {
  ContactModel model(Geometry::plane_strain, strip(Cells::quad4, 10, 1, -1, 2, 1, 0), cylinder(5, "y"),
                     contact_parameters("nodes", eps));
  model.store.committed().rate(model.bodies_["b"]->unknowns().dof[1]) = -10;
  const double limit = model.contact->step_limit(model.store.committed(), 1e-9);
  EXPECT_GT(10 * limit, 0.45 * 5);
  EXPECT_LT(10 * limit, 0.5 * 5 + 1e-6);
}

}  // namespace
}  // namespace mudline
