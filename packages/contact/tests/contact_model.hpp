#pragma once

#include <Tpetra_Core.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include "bodies/tests/rigid_body_deck.hpp"
#include "contact/contact.hpp"
#include "framework/closed_sides.hpp"
#include "framework/first_act.hpp"
#include "framework/surface_points.hpp"
#include "physics/register.hpp"
#include "reading_laws.hpp"

namespace mudline {

enum class Cells { quad9, tri6, quad4 };

/// Nodes of the one or two cells whose lower left node is (a, b) on a grid with so many columns.
inline std::vector<long long> cell_nodes(Cells cells, int a, int b, int columns) {
  const auto n = [=](int i, int j) { return static_cast<long long>(b + j) * columns + a + i; };
  if (cells == Cells::quad4) return {n(0, 0), n(1, 0), n(1, 1), n(0, 1)};
  if (cells == Cells::quad9) return {n(0, 0), n(2, 0), n(2, 2), n(0, 2), n(1, 0), n(2, 1), n(1, 2), n(0, 1), n(1, 1)};
  return {n(0, 0), n(2, 0), n(0, 2), n(1, 0), n(1, 1), n(0, 1), n(2, 0), n(2, 2), n(0, 2), n(2, 1), n(1, 2), n(1, 1)};
}

/// nx by ny cells over [x0, x0 + width] x [-depth, 0] with the side set "surface" on top. Inner nodes and those of the
/// top are displaced by about `distort` fifths of a cell.
inline GlobalMesh strip(Cells cells, int nx, int ny, double x0, double width, double depth, double distort) {
  GlobalMesh mesh;
  const int order = cells == Cells::quad4 ? 1 : 2, columns = order * nx + 1, rows = order * ny + 1;
  const double hx = width / (columns - 1), hy = depth / (rows - 1);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double wave = 0.2 * distort * order * std::sin(1.3 * i + 2.1 * j);
      const double dx = i == 0 || i == columns - 1 ? 0 : wave * hx, dy = j == 0 ? 0 : wave * hy;
      mesh.coordinates.push_back({x0 + i * hx + dx, (j - rows + 1) * hy + dy});
    }
  GlobalMesh::Block block{"soil",
                          cells == Cells::quad9  ? CellShape::quad9
                          : cells == Cells::tri6 ? CellShape::tri6
                                                 : CellShape::quad4,
                          {}};
  long long element = 0;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      for (long long node : cell_nodes(cells, order * i, order * j, columns)) block.nodes.push_back(node);
      element += cells == Cells::tri6 ? 2 : 1;
      if (j == ny - 1) mesh.side_sets["surface"].push_back({0, element - 1, cells == Cells::tri6 ? 1 : 2});
    }
  mesh.blocks.push_back(block);
  return mesh;
}

/// Cells of a box in space, with the side set "surface" on top. `cells`, `lower`, `upper`: as in a deck.
inline GlobalMesh box_in_space(const std::string& cell, const std::string& cells, const std::string& lower,
                               const std::string& upper, double distortion = 0) {
  Deck deck;
  deck.overlay("<ParameterList name=\"deck\">\n<ParameterList name=\"mesh\">\n" + text_parameter("type", "box") +
                   text_parameter("geometry", geometry_in_space) + text_parameter("cell", cell) +
                   "<Parameter name=\"cells\" type=\"Array(int)\" value=\"" + cells + "\"/>\n" +
                   array_parameter("lower", lower) + array_parameter("upper", upper) +
                   number_parameter("distortion", distortion) + "</ParameterList>\n</ParameterList>\n",
               "deck.xml");
  Registry<MeshSource> sources{"mesh"};
  register_mesh_sources(sources);
  GlobalMesh mesh = sources.create(deck.root().section("mesh"))->generate();
  mesh.side_sets["surface"] = mesh.side_sets.at("top");
  return mesh;
}

/// Mesh section of a deck in space, so that points have three coordinates.
inline std::string space_xml() { return section_xml("mesh", text_parameter("geometry", geometry_in_space)); }

/// A soil strip, one body and one contact, which the test takes through steps as a stepper would. `warm`: with
/// temperature, effective stress and undrained strength.
struct ContactModel {
  ContactModel(Geometry geometry, GlobalMesh global, const std::string& bodies, const std::string& contact_parameters,
               std::function<double(int, int)> stiffness = {}, const std::string& type = "frictionless penalty",
               Support pressure = Support::vertices, bool warm = false,
               std::function<Point(int, double)> water_weight = {},
               std::function<std::array<double, 6>(const Point&)> stress = {})
      : deck((geometry == Geometry::space ? space_xml() : std::string()) + bodies +
             "<ParameterList name=\"contacts\">\n<ParameterList name=\"c\">\n" + text_parameter("type", type) +
             contact_parameters + "</ParameterList>\n</ParameterList>\n"),
        bodies_{{"b", deck.body("b", geometry)}},
        mesh(Tpetra::getDefaultComm(), geometry, std::move(global)),
        space(mesh, fields(geometry, pressure, warm)),
        store(space),
        assembler(space.dofs()) {
    if (bodies_["b"]->may_be_free()) bodies_["b"]->bind(space, 2, 0);
    register_contact(registry);
    register_friction(frictions);
    register_normal_laws(normal_laws);
    frictions.add<ReadingFriction>("reading", "Friction that reads the soil");
    frictions.add<ThrowingFriction>("throwing", "Friction that cannot answer");
    normal_laws.add<ReadingNormalLaw>("reading", "Pressure that reads the soil");
    if (warm)  // a stress at two points per element
      store.declare(ArrayInfo::at_points("soil/effective stress", {{"effective stress", 6, "Pa"}}, mesh, 0, 2));
    std::function<double(const State&, int, int, const Point&)> strength;
    if (warm) strength = [](const State&, int, int, const Point& at) { return 2000 + 500 * at[0]; };
    contact = registry.create(
        deck.deck.root().section("contacts").section("c"),
        {space, bodies_, frictions, normal_laws, std::move(stiffness), std::move(water_weight),
         [stress](const State&, int, int, const Point& at) { return stress(at); }, std::move(strength)});
    bodies_["b"]->declare_state(store);
    contact->declare_state(store);
    contact->sparsity(assembler);
    assembler.finalise();
  }

  /// Takes the arrays to a mesh that moved: its nodes were at x_old.
  void follow(const ConstCoordinateView& x_old) {
    for (int handle = 0; handle < store.num_arrays(); ++handle)
      if (const ArrayInfo& info = store.info(handle); info.surface)
        info.surface->follow(info.variables, x_old, store.committed().coordinates, store.committed().arrays[handle]);
  }

  std::vector<Field> fields(Geometry geometry, Support pressure, bool warm) {
    std::vector<Field> result{{"displacement", "m", "N", vector_components, Support::all_nodes, 2},
                              {"pore pressure", "Pa", "m3/s", 1, pressure, 1}};
    if (bodies_["b"]->may_be_free())
      result.push_back({"body motion", "m", "N", RigidBody::unknowns_per_body(geometry), Support::apart, 2, 1});
    if (warm) result.push_back({"temperature", "degC", "W", 1, Support::vertices, 1});
    return result;
  }

  /// Starts a step of length dt from the committed state; the soil stays where it is until move() is called.
  void begin(double dt) {
    store.begin();
    State& trial = store.trial();
    trial.time = store.committed().time + dt;
    view.time_old = store.committed().time;
    view.time_end = trial.time;
    view.dt = dt;
    view.value_old = store.committed().value;
    view.value_end = trial.value;
    view.x_old = store.committed().coordinates;
    view.x_end = trial.coordinates;
    view.flow = true;
    view.inertia = false;
    view.end_weight = 1;
    view.sensitivity.assign(4, Sensitivity());
    view.committed = &store.committed();
    view.trial = &trial;
    for (const auto& [name, body] : bodies_) body->advance(view);
    contact->begin(view);
  }
  /// Residual of the contact by overlap dof, this rank's part. With inertia: its alpha level less the share of F_n.
  NodalView residual() {
    NodalView f("f", space.dofs()->num_overlap_dofs());
    failures = contact->residual(view, f);
    for (std::size_t i = 0; i < f.extent(0); ++i) f(i) *= weight();
    contact->correction(view, f);
    return f;
  }
  /// Weight of the end of the step.
  double weight() const { return view.inertia ? view.end_weight : 1.0; }
  /// Makes the steps dynamic, with this weight of the start of the step.
  void set_inertia(double alpha_f) {
    view.inertia = true;
    view.end_weight = 1 - alpha_f;
  }
  /// Starts a stage: the contact reads what it needs of the committed state.
  void first_act() { dynamic_cast<FirstActs&>(*contact).first_act(store.committed()); }
  Report step(double dt) {
    begin(dt);
    residual();
    store.accept();
    Report values;
    contact->histories(view, values);
    return values;
  }
  int dof(int node, int component) const { return space.node_dof(0)(node) + component; }
  const PointView& points(const State& state) const { return state.arrays[store.find("contact/c/points")]; }

  BodyDeck deck;
  std::map<std::string, std::shared_ptr<RigidBody>> bodies_;
  Mesh mesh;
  Space space;
  StateStore store;
  Assembler assembler;
  ContactRegistry registry{"contact"};
  Registry<Friction> frictions{"friction"};
  Registry<NormalLaw> normal_laws{"normal law"};
  std::unique_ptr<Contact> contact;
  StepView view{};
  int failures = 0;
};

/// Positions x, ascending, of the vertices on `set` whose pore pressure a drained condition on it leaves free in the
/// coming step.
inline std::vector<double> released(ContactModel& model, const std::string& set) {
  Deck deck;
  deck.overlay("<ParameterList name=\"deck\">\n<ParameterList name=\"drained\">\n" +
                   text_parameter("type", "pore pressure") + text_parameter("set", set) +
                   "</ParameterList>\n</ParameterList>\n",
               "deck.xml");
  Registry<Condition> conditions{"condition"};
  register_conditions(conditions);
  const Section section = deck.root().section("drained");
  const std::unique_ptr<Condition> drained = conditions.create(section);
  drained->bind({model.space, Shared()}, section);
  const int p = model.space.find("pore pressure"), n = model.space.dofs()->num_overlap_dofs();
  Constraints constraints(n);
  ClosedSides closed;
  dynamic_cast<const ClosesSides&>(*model.contact).close(model.store.committed(), closed);
  dynamic_cast<HoldsOnOpenSides&>(*drained).set_closed(closed);
  drained->prescribe(0, 1, model.store.committed(), constraints);
  std::vector<double> result;
  for (int node : model.mesh.nodes_of_set(set)) {
    const int dof = model.space.node_dof(p)(node);
    if (dof >= 0 && !constraints.mask(dof)) result.push_back(model.mesh.coordinates()(node, 0));
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// Random displacements of the trial coordinates, fixed seed; nodes of the axis stay on it.
inline void deform(ContactModel& model, double size) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int node = 0; node < model.mesh.num_nodes(); ++node)
    for (int i = 0; i < model.mesh.dimension(); ++i) {
      const double change = size * unit(random);
      if (i > 0 || model.mesh.coordinates()(node, 0) > 0) model.store.trial().coordinates(node, i) += change;
    }
}

/// Unknowns that jacobian_error() varies. They are varied apart, since forces are so much larger per metre than per
/// pascal that one hides the other.
enum class Moved { soil = 0, pressures = 1, body = 2 };

/// Largest difference of J d and the central difference of the residual, relative to the largest |J d|.
inline double jacobian_error(ContactModel& model, Moved moved = Moved::soil) {
  model.residual();
  model.assembler.begin(Kokkos::View<char*>("free", model.space.dofs()->num_overlap_dofs()));
  model.contact->jacobian(model.view, model.assembler, model.weight());
  model.assembler.end();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  Vector d(model.space.dofs()->owned()), product(model.space.dofs()->owned());
  const int n = model.space.dofs()->num_owned_dofs();
  {
    auto data = d.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (int i = 0; i < n; ++i)
      data(i, 0) = model.space.dofs()->field_of(i) == static_cast<int>(moved) ? unit(random) : 0.0;
    // inside a sharp body the axis is a ridge of the gap: its nodes do not leave it
    for (int node = 0; node < model.mesh.num_nodes(); ++node)
      if (model.mesh.coordinates()(node, 0) == 0) data(model.dof(node, 0), 0) = 0;
  }
  model.assembler.matrix()->apply(d, product);
  const auto data = d.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto move = [&](double h) {
    for (int node = 0; node < model.mesh.num_nodes(); ++node)
      for (int i = 0; i < model.mesh.dimension(); ++i)
        model.store.trial().coordinates(node, i) += h * data(model.dof(node, i), 0);
    for (int i = 0; i < n; ++i)
      if (model.space.dofs()->field_of(i) > 0) model.store.trial().value(i) += h * data(i, 0);
  };
  const double h = moved == Moved::pressures ? 1.0 : 1e-7;
  move(h);
  const NodalView plus = model.residual();
  move(-2 * h);
  const NodalView minus = model.residual();
  move(h);
  double error = 0, size = 0;
  const auto jd = product.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int i = 0; i < n; ++i) {
    error = std::max(error, std::abs((plus(i) - minus(i)) / (2 * h) - jd(i, 0)));
    size = std::max(size, std::abs(jd(i, 0)));
  }
  return size > 0 ? error / size : error;
}

/// A wide flat plate, its face at y, that moves down with the given speed.
inline std::string plate_xml(double y, double speed = 0) {
  return body_xml("b",
                  text_parameter("type", "polyline") + array_parameter("x", "0, 10") + array_parameter("y", "0, 0"),
                  text_parameter("type", "prescribed velocity") + number_parameter("velocity y", -speed),
                  "0, " + std::to_string(y));
}

/// penalty 0: automatic.
inline std::string contact_parameters(const std::string& method, double penalty, const std::string& body = "b") {
  return text_parameter("body", body) + text_parameter("surface", "surface") + text_parameter("method", method) +
         (penalty > 0 ? number_parameter("penalty", penalty) : std::string());
}

}  // namespace mudline
