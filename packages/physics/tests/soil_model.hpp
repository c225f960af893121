#pragma once

#include <Tpetra_Core.hpp>

#include <memory>
#include <string>
#include <vector>

#include "core/deck.hpp"
#include "core/tests/deck_text.hpp"
#include "physics/register.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Saturated elastic soil in a box with its terms, conditions and initial state, made from a deck as a model does, for
/// direct evaluation. Confined modulus 12 MPa, shear modulus 4 MPa, porosity 0.4, mobility 1e-8 m2/(Pa s), water of
/// 1000 kg/m3.
struct SoilModel {
  explicit SoilModel(const std::string& conditions = "", const std::string& physics = "",
                     const std::string& mesh = box("plane strain"),
                     const std::string& materials = sand("", "", "sand")) {
    deck.overlay(
        section_xml("deck",
                    section_xml("mesh", text_parameter("type", "box") + mesh) + section_xml("materials", materials) +
                        section_xml("physics", section_xml("ground", text_parameter("type", "biot") + physics)) +
                        section_xml("boundary conditions", conditions)),
        "deck.xml");
    register_mesh_sources(sources);
    register_materials(skeletons, fluids, permeabilities);
    register_physics(physics_types);
    register_conditions(condition_types);
    const Section root = deck.root();
    this->mesh = make_mesh(Tpetra::getDefaultComm(), sources, root.section("mesh"));
    for (const std::string& name : root.section("materials").section_names())
      soils.push_back(
          SoilMaterial::read(root.section("materials").section(name), {skeletons, fluids, permeabilities, properties}));
    const Section ground = root.section("physics").section("ground");
    biot = physics_types.create(ground);
    space = std::make_unique<Space>(*this->mesh, biot->fields());
    const Section materials_section = root.section("materials");
    PhysicsContext context{*space, soils, materials_section, terms, shared, conserved, block_data};
    biot->build(context, ground);
    soil = shared.find<Soil>();
    for (const std::string& name : root.section("boundary conditions").section_names()) {
      const Section entry = root.section("boundary conditions").section(name);
      named[name] = condition_types.create(entry);
      named[name]->name = name;
      named[name]->bind({*space, shared}, entry);
    }
    store = std::make_unique<StateStore>(*space);
    for (const auto& term : terms) term->declare_state(*store);
    for (const auto& [name, condition] : named)
      if (condition->term()) condition->term()->declare_state(*store);
    biot->initialise(*store, ground);
    store->begin();
    for (NodalView* v : {&value, &rate, &acceleration}) *v = NodalView("level", space->dofs()->num_overlap_dofs());
    Kokkos::deep_copy(value, store->committed().value);
    start_view();
  }

  /// 2 x 3 nine-node cells over [1, 3] x [0, 3].
  static std::string box(const std::string& geometry) {
    return text_parameter("geometry", geometry) + text_parameter("cell", "quad9") +
           integers_parameter("cells", "2, 3") + array_parameter("lower", "1, 0") + array_parameter("upper", "3, 3");
  }
  static std::string sand(const std::string& more, const std::string& fluid = "", const std::string& name = "sand") {
    return section_xml(
        name, more + number_parameter("porosity", 0.4) + number_parameter("grain density", 2600) +
                  section_xml("skeleton", text_parameter("type", "linear elastic") +
                                              number_parameter("Young's modulus", 1e7) +
                                              number_parameter("Poisson's ratio", 0.25)) +
                  section_xml("fluid", text_parameter("type", "water") + number_parameter("bulk modulus", 2e9) +
                                           number_parameter("unit weight", 1e4) + fluid) +
                  section_xml("permeability",
                              text_parameter("type", "constant") + number_parameter("hydraulic conductivity", 1e-4)));
  }

  void start_view() {
    State& trial = store->trial();
    view.dt = view.time_end = 1;
    view.value_old = store->committed().value;
    view.value_end = trial.value;
    view.value = value;
    view.rate = view.velocity = rate;
    view.acceleration = acceleration;
    view.x_old = store->committed().coordinates;
    view.x_end = trial.coordinates;
    view.momentum = view.balance = {1, trial.coordinates, 1};
    view.sensitivity.assign(2, Sensitivity());
    view.inertia = view.flow = true;
    view.committed = &store->committed();
    view.trial = &trial;
  }

  Term& term(const std::string& name) {
    for (const auto& term : terms)
      if (term->name() == name) return *term;
    throw std::logic_error("no term " + name);
  }
  /// Residual of a term by dof, with the coordinates of the trial state.
  NodalView residual(Term& of) {
    NodalView f("f", space->dofs()->num_overlap_dofs());
    of.begin(view);
    failures = of.residual(view, f);
    return f;
  }
  int u(int node, int component) const { return space->node_dof(0)(node) + component; }
  int p(int node) const { return space->node_dof(1)(node); }
  double x(int node, int component) const { return mesh->coordinates()(node, component); }
  /// Sum of f over the nodes of a set: of a displacement component, or of the pore pressure (2).
  double sum(const NodalView& f, int component, const std::string& set = "") const {
    double total = 0;
    for (int node = 0; node < mesh->num_nodes(); ++node) {
      const auto& nodes = set.empty() ? std::vector<int>{node} : mesh->nodes_of_set(set);
      if (!std::binary_search(nodes.begin(), nodes.end(), node)) continue;
      const int dof = component < 2 ? u(node, component) : p(node);
      if (dof >= 0) total += f(dof);
    }
    return total;
  }
  /// Sets level values of the pore pressure, or rates of the displacement, by position.
  template <class F>
  void set_pressure(const NodalView& where, F&& f) {
    for (int node = 0; node < mesh->num_nodes(); ++node)
      if (p(node) >= 0) where(p(node)) = f(x(node, 0), x(node, 1));
  }
  template <class F>
  void set_motion(const NodalView& where, F&& f) {
    for (int node = 0; node < mesh->num_nodes(); ++node)
      for (int i = 0; i < 2; ++i) where(u(node, i)) = f(x(node, 0), x(node, 1))[i];
  }
  /// Unknowns that a condition prescribes in a step from t_old to t_end [s] from the committed state.
  Constraints prescribed(const std::string& name, double t_old = 0, double t_end = 1) const {
    const int n = space->dofs()->num_overlap_dofs();
    Constraints to(n);
    named.at(name)->prescribe(t_old, t_end, store->committed(), to);
    return to;
  }

  Deck deck;
  Registry<MeshSource> sources{"mesh source"};
  Registry<Skeleton> skeletons{"skeleton"};
  Registry<Fluid> fluids{"fluid"};
  Registry<Permeability> permeabilities{"permeability"};
  Registry<Properties> properties{"property group"};
  Registry<Physics> physics_types{"physics"};
  Registry<Condition> condition_types{"condition"};
  std::unique_ptr<Mesh> mesh;
  Materials soils;
  Shared shared;
  std::vector<Conserved> conserved;
  std::unique_ptr<Physics> biot;
  std::unique_ptr<Space> space;
  std::vector<std::unique_ptr<Term>> terms;
  std::shared_ptr<Soil> soil;
  std::function<BlockData(const StepView&)> block_data;
  std::map<std::string, std::unique_ptr<Condition>> named;
  std::unique_ptr<StateStore> store;
  NodalView value, rate, acceleration;
  StepView view{};
  int failures = 0;
};

}  // namespace mudline
