#include "checks/deck_checks.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "checks/setup.hpp"
#include "checks/supports.hpp"
#include "core/entry.hpp"
#include "core/text.hpp"
#include "core/told.hpp"
#include "discretisation/agree.hpp"
#include "discretisation/mesh_topology.hpp"
#include "simulation/filter.hpp"

namespace mudline {

namespace {

/// What the conditions of a stage prescribe at one time.
class Prescribed {
 public:
  Prescribed(const Model& model, const Stage& stage)
      : model_(model), stage_(stage), n_(model.space().dofs()->num_overlap_dofs()), owner_(n_, -1), value_(n_, 0.0) {}

  /// Adds a condition by its number; fails where its value is no number, or another one's is different.
  void add(std::size_t number, double t_old, double t_end, const Section& conditions) {
    const Condition& condition = *model_.conditions()[number];
    Constraints mine(n_);
    condition.prescribe(t_old, t_end, model_.store().committed(), mine);
    for (int i = 0; i < n_; ++i) {
      if (!mine.given(i)) continue;
      const double value = mine.value(i), scale = std::max({std::abs(value), std::abs(value_[i]), 1e-12});
      if (!std::isfinite(value))
        conditions.fail("its value is not finite" + told(t_end, " at t = %.6g s") + " in stage '" + stage_.name +
                            "'; allowed: finite numbers",
                        condition.name);
      if (owner_[i] >= 0 && std::abs(value - value_[i]) > 1e-9 * scale)
        conditions.fail("contradicts '" + model_.conditions()[owner_[i]]->name +
                            "' on a shared node: " + model_.space().field(model_.space().dofs()->field_of(i)).name +
                            told(value_[i], " is prescribed as %.6g") + told(value, " and as %.6g") + " in stage '" +
                            stage_.name + "'",
                        condition.name);
      owner_[i] = static_cast<int>(number);
      value_[i] = value;
    }
  }

 private:
  const Model& model_;
  const Stage& stage_;
  int n_;
  std::vector<int> owner_;  // number of the condition that prescribes an unknown; -1: none
  std::vector<double> value_;
};

/// Refuses conditions that prescribe different values of one unknown in a stage, or a value that is no number.
void check_contradictions(const Model& model, const Section& deck) {
  double time = 0;
  for (const auto& stage : model.stages()) {
    for (double fraction : {0.5, 1.0})
      agree(*model.space().dofs()->comm(), [&] {
        const double t_end = time + fraction * stage->duration, t_old = t_end - 1e-3 * stage->duration;
        Prescribed prescribed(model, *stage);
        for (std::size_t c = 0; c < model.conditions().size(); ++c)
          if (Setup::acts(model.conditions()[c]->name, *stage))
            prescribed.add(c, t_old, t_end, deck.section("boundary conditions"));
      });
    time += stage->duration;
  }
}

/// Evaluates the functions of a condition at the middle of each side of its set, at times of a stage: a value that is
/// not finite fails.
void evaluate_loads(const Model& model, const Section& condition, double begin, double duration) {
  const auto set = model.mesh().side_sets().find(condition.text("set"));
  if (set == model.mesh().side_sets().end()) return;
  constexpr int moments = 32;
  for (const std::string& name : condition.parameter_names()) {
    const auto given = Setup::function(condition, name);
    if (!given || given->is_constant()) continue;
    const Function function = given->within(any(), condition.origin(name), condition.dimension());
    const int last = function.steady() ? 0 : moments;
    for (const Side& side : set->second) {
      const Point middle = middle_of(model.mesh(), side);
      for (int k = 0; k <= last; ++k) function(begin + duration * k / moments, middle);
    }
  }
}

/// Refuses loads and flows on surfaces that are not finite at some time.
void check_loads(const Model& model, const Section& deck) {
  double time = 0;
  for (const auto& stage : model.stages()) {
    agree(*model.mesh().comm(), [&] {
      for (const std::string& name : stage->conditions) {
        const Section condition = deck.section("boundary conditions").section(name);
        if (condition.has_parameter("set")) evaluate_loads(model, condition, time, stage->duration);
      }
    });
    time += stage->duration;
  }
}

/// Refuses motions that a stage cannot give.
void check_motions(const Model& model, const Section& deck) {
  const Section stages = deck.section("stages"), contacts = deck.section("contacts");
  std::map<std::string, std::shared_ptr<const BodyMotion>> before;
  for (const auto& stage : model.stages()) {
    const Section section = stages.section(stage->name);
    const bool geostatic = stage->type == Stage::Type::geostatic;
    if (geostatic && section.has_section("motions"))
      section.fail("bodies rest in a geostatic stage, which takes no time: it has no 'motions'", "motions");
    for (const auto& [name, body] : model.bodies()) {
      const auto motion = model.motion_in(*stage, name);
      const bool anew = std::exchange(before[name], motion) != motion;
      if (!motion || !motion->released()) continue;
      Point velocity{}, spin{};
      if (anew && stage->type != Stage::Type::dynamic && motion->released()->initial_velocity(velocity, spin)) {
        const bool own = motion == body->own_motion();
        const Section entry =
            own ? deck.section("bodies").section(name).section("motion") : section.section("motions").section(name);
        entry.fail("body '" + name + "' would start with this in stage '" + stage->name +
                       "', which is quasi-static: without inertia it has no effect, and later stages that go on with "
                       "the motion do not give it again; allowed where a dynamic stage sets the body free (give this "
                       "stage another motion in its 'motions', or its type 'dynamic')",
                   entry.has_parameter("initial velocity") ? "initial velocity" : "initial spin");
      }
      if (stage->type == Stage::Type::dynamic) {
        if (body->properties().mass <= 0)
          section.fail("body '" + name + "' is released in this dynamic stage: it needs a 'mass' greater than 0");
        continue;
      }
      const bool touched =
          std::any_of(stage->contacts.begin(), stage->contacts.end(), [&, body = name](const std::string& contact) {
            return contacts.section(contact).has_parameter("body") && contacts.section(contact).text("body") == body;
          });
      if (!touched)
        section.fail("body '" + name +
                     "' is released in this quasi-static stage, but no contact that acts in it could hold the body; "
                     "name the motion 'held'");
    }
  }
}

/// Whether two side sets have a side in common. Collective.
bool share_a_side(const Mesh& mesh, const std::string& one, const std::string& other) {
  if (one == other) return true;
  std::set<std::tuple<int, int, int>> sides;
  for (const Side& side : mesh.side_sets().at(one)) sides.insert({side.block, side.element, side.side});
  const std::vector<Side>& others = mesh.side_sets().at(other);
  return on_any_rank(*mesh.comm(), std::any_of(others.begin(), others.end(), [&](const Side& side) {
    return sides.count({side.block, side.element, side.side}) > 0;
  }));
}

/// Whether two contacts press the same sides with the same body, or the same two surfaces, either way round.
/// Collective.
bool press_alike(const Mesh& mesh, const ContactPartners& one, const ContactPartners& other) {
  const auto share = [&](const std::string& a, const std::string& b) { return share_a_side(mesh, a, b); };
  if (one.body || other.body) return one.body == other.body && share(one.surface, other.surface);
  return (share(one.surface, other.surface) && share(one.opposite, other.opposite)) ||
         (share(one.surface, other.opposite) && share(one.opposite, other.surface));
}

std::string partners_text(const ContactPartners& partners) {
  return "surface '" + partners.surface + "' with " +
         (partners.body ? "body '" + partners.body->name() : "surface '" + partners.opposite) + "'";
}

/// Refuses two contacts of one stage that press the same sides with the same body or surface: the soil would feel twice
/// the traction. Collective.
void check_pairs(const Model& model, const Section& deck) {
  for (const auto& stage : model.stages()) {
    std::map<std::string, ContactPartners> before;
    for (const auto& [name, contact] : model.contacts()) {
      if (std::find(stage->contacts.begin(), stage->contacts.end(), name) == stage->contacts.end()) continue;
      const ContactPartners partners = contact->partners();
      for (const auto& [other, taken] : before) {
        if (!press_alike(model.mesh(), partners, taken)) continue;
        const std::string text = partners_text(partners), first = partners_text(taken);
        deck.section("contacts")
            .fail("presses " + text + " in stage '" + stage->name + "', as contact '" + other + "' does" +
                      (text == first ? "" : " on some of the same sides, " + first) +
                      ": the traction would count twice; allowed: one of them in a stage",
                  name);
      }
      before.emplace(name, partners);
    }
  }
}

/// Refuses a mesh in several parts of which one has no condition or contact that could hold it in any stage.
void check_parts(const Model& model, const Section& deck, const MeshParts& parts) {
  if (parts.places.size() < 2) return;
  std::vector<std::string> holding;
  for (const auto& condition : model.conditions()) {
    if (condition->may_hold()) return;  // it may hold any part
    if (!condition->holds().empty()) holding.push_back(condition->holds());
  }
  for (const auto& entry : model.contacts()) {
    const Section contact = deck.section("contacts").section(entry.first);
    for (const char* surface : {"surface", "slave", "master"})
      if (contact.has_parameter(surface)) holding.push_back(contact.text(surface));
  }
  std::vector<char> held(parts.places.size(), 0);
  for (const std::string& set : holding) {
    const auto touched = parts.of_set.find(set);
    if (touched == parts.of_set.end()) continue;
    for (int part : touched->second) held[part] = 1;
  }
  for (std::size_t part = 0; part < parts.places.size(); ++part)
    if (!held[part])
      deck.section("mesh").fail("the mesh is in " + std::to_string(parts.places.size()) +
                                " parts that have no common nodes, and nothing could hold the one at " +
                                place_text(parts.places[part], model.mesh().dimension()) +
                                ": no displacement is prescribed on it and no contact has a surface of it");
}

/// Refuses supports in stages in which the mesh moves: their forces belong to nodes.
void check_in_situ(const Model& model, const Section& deck) {
  if (model.ale() == nullptr) return;
  for (const auto& stage : model.stages())
    for (const auto& condition : model.conditions())
      if (stage->type != Stage::Type::geostatic && stage->mesh_motion && condition->supports() &&
          Setup::acts(condition->name, *stage))
        deck.section("stages")
            .section(stage->name)
            .fail("'" + condition->name +
                      "' holds nodes, which must not move against the soil: leave it out of this stage, or give the "
                      "stage 'mesh motion' = false",
                  "conditions");
}

/// Refuses stages without inertia in which something is free to move.
void check_supports(Model& model, const Section& deck, const MeshParts& parts) {
  if (!model.soil()) return;
  const Supports supports(model, parts);
  double time = 0;
  bool pressed_in = false;
  for (const auto& stage : model.stages()) {
    const bool dynamic = stage->type == Stage::Type::dynamic;
    const bool plugin_may_hold = std::any_of(
        model.conditions().begin(), model.conditions().end(),
        [&](const auto& condition) { return condition->may_hold() && Setup::acts(condition->name, *stage); });
    const std::string problem = dynamic || plugin_may_hold ? "" : supports.missing(*stage, time, pressed_in);
    if (!problem.empty())
      deck.section("stages")
          .section(stage->name)
          .fail(problem + ": nothing that acts in this stage holds it, and the stage has no inertia");
    pressed_in = pressed_in || stage->duration > 0;
    time += stage->duration;
  }
}

/// Refuses contact laws that read the undrained strength of a soil that has none. Collective.
void check_read_strengths(const Model& model) {
  for (const auto& [name, contact] : model.contacts()) {
    const ContactPartners partners = contact->partners();
    if (!partners.strength_reader) continue;
    double without = -1;  // number of a material
    for (const Side& side : model.mesh().side_sets().at(partners.surface)) {
      const SoilBlock& b = model.soil()->blocks[side.block];
      const SoilPoints points(*model.soil(), b, model.store().committed());
      for (int row = side.element * b.points; row < (side.element + 1) * b.points; ++row)
        if (!points.soil_state(row).undrained_strength)
          without = std::max<double>(without, points.material_number(row));
    }
    without = max_over_ranks(*model.mesh().comm(), without);
    if (without < 0) continue;
    const SoilMaterial& material = *model.soil()->materials[static_cast<std::size_t>(without)];
    partners.strength_reader->fail("this law reads the undrained strength of the soil at '" + partners.surface +
                                       "'; the law '" + material.law + "' of material '" + material.name +
                                       "' has none; 'coulomb' takes such soil with a 'drained coefficient'",
                                   "type");
  }
}

/// Refuses contacts that read the pore pressure of soil which is not saturated under suction. Collective.
void check_read_pressures(const Model& model, const Section& deck) {
  for (const auto& [name, contact] : model.contacts()) {
    const ContactPartners partners = contact->partners();
    if (!partners.pressure_reader) continue;
    double drying = 0;
    for (const Side& side : model.mesh().side_sets().at(partners.surface))
      if (model.soil()->blocks[side.block].dries) drying = 1;
    if (max_over_ranks(*model.mesh().comm(), drying) == 0) continue;
    const std::string why =
        "friction on the effective traction, films and laws that read the pore pressure are for saturated soil; that "
        "at '";
    deck.section("contacts")
        .section(name)
        .fail(why + partners.surface + "' has a 'retention'. Allowed: friction 'on' = total, without a film", "type");
  }
}

/// Nodes of soil that is saturated at all suctions, by local node.
std::vector<char> saturated_nodes(const Model& model) {
  std::vector<char> result(model.mesh().num_nodes(), 0);
  for (const SoilBlock& b : model.soil()->blocks)
    for (int e = 0; e < (b.dries ? 0 : b.elements); ++e)
      for (int a = 0; a < b.u.nodes; ++a) result[b.nodes(e, a)] = 1;
  return result;
}

/// Refuses pore pressures that from the start let water into saturated soil which a geostatic start holds by suction:
/// the soil would swell by as much water as the suction's end asks for. Collective.
void check_suction(const Model& model, const Section& deck) {
  const Soil& soil = *model.soil();
  if (soil.pressure < 0 || soil.excess || !Setup::starts_geostatic(deck)) return;
  const auto first = std::find_if(model.stages().begin(), model.stages().end(),
                                  [](const auto& stage) { return stage->type != Stage::Type::geostatic; });
  if (first == model.stages().end()) return;
  const std::vector<char> saturated = saturated_nodes(model);
  const State& state = model.store().committed();
  const auto& dof = soil.space->node_dof(soil.pressure);
  constexpr double limit = 1000;  // [Pa] 0.1 m of water
  for (const auto& condition : model.conditions()) {
    if (!Setup::acts(condition->name, **first)) continue;
    Constraints held(model.space().dofs()->num_overlap_dofs());
    condition->prescribe(0, 1e-6 * (*first)->duration, state, held);
    std::string problem;
    double most = limit;
    for (int node = 0; node < model.mesh().num_nodes(); ++node) {
      if (dof(node) < 0 || !held.given(dof(node)) || !saturated[node]) continue;
      const double before = state.value(dof(node)), given = held.value(dof(node));
      if (before > -limit || given - before <= most) continue;
      most = given - before;
      problem = "prescribes the pore pressure " + number_text(given) + " Pa at " +
                place_text(model.mesh().place(node), model.mesh().dimension()) + ", where the start has a suction of " +
                number_text(-before) +
                " Pa above its water level: saturated soil would draw in water and swell. Allowed: type 'seepage face' "
                "(open to the air, no water enters), a value that begins at this suction and changes with time, or a "
                "'retention' of the material";
    }
    agree(*model.mesh().comm(), [&] {
      if (!problem.empty()) deck.section("boundary conditions").fail(problem, condition->name);
    });
  }
}

/// Refuses conditions and contacts that no stage lists, and bodies and properties that nothing uses.
void check_unused(const Model& model, const Section& deck) {
  const Section conditions = deck.section("boundary conditions"), contacts = deck.section("contacts");
  // A list that an overlay or the command line replaces may leave out names on purpose.
  const auto listed = [&](const char* list, std::vector<std::string> Stage::*names, const std::string& name,
                          const std::string& source) {
    return std::any_of(model.stages().begin(), model.stages().end(), [&](const auto& stage) {
      const std::vector<std::string>& of_stage = (*stage).*names;
      const Section section = deck.section("stages").section(stage->name);
      return std::find(of_stage.begin(), of_stage.end(), name) != of_stage.end() ||
             (section.has_parameter(list) && apart(section.source(list), source));
    });
  };
  for (const auto& material : model.materials())
    for (const std::string& group : material->unused())
      deck.section("materials").section(material->name).fail("no physics of this model uses these properties", group);
  for (const auto& condition : model.conditions())
    if (!listed("conditions", &Stage::conditions, condition->name, conditions.source(condition->name)))
      conditions.fail("no stage lists this condition in its 'conditions'", condition->name);
  for (const auto& [name, contact] : model.contacts())
    if (!listed("contacts", &Stage::contacts, name, contacts.source(name)))
      contacts.fail(
          "this contact acts in no stage; name it in the 'contacts' of one (absent: all, but in geostatic stages)",
          name);
  const std::vector<const char*> users{"contacts", "mesh motion", "output"};
  for (const auto& [name, body] : model.bodies()) {
    const bool released =
        std::any_of(model.stages().begin(), model.stages().end(), [&, body = name](const auto& stage) {
          const auto motion = model.motion_in(*stage, body);
          return motion && motion->released();
        });
    const bool named = std::any_of(users.begin(), users.end(), [&, body = name](const char* user) {
      return mentions(deck.section(user).list(), body);
    });
    if (!released && !named)
      deck.section("bodies").fail("no contact, mesh motion or probe names this body, and no stage releases it", name);
  }
}

/// Refuses probes at nodes that remeshing would lose, and probes at rest outside the mesh, whose nearest node is not
/// what the author means. A point of a body may enter the soil later.
void check_probes(const Model& model, const OutputSettings& output, const Section& deck) {
  const Bounds& box = model.mesh().bounds();
  const double slack = 1e-6 * box.extent();
  const Ale* ale = model.ale();
  for (const ProbeSettings& probe : output.probes)
    if (probe.at_node && ale && ale->remeshing())
      deck.section("output").section("probes").fail(
          "a node is lost when the mesh is remeshed ('mesh motion/remeshing'); give the probe 'moves with' a body or "
          "nothing",
          probe.name);
  for (const ProbeSettings& probe : output.probes) {
    const auto& at = probe.point;
    for (int i = 0; probe.moves_with.empty() && i < model.mesh().dimension(); ++i)
      if (at[i] < box.low[i] - slack || at[i] > box.high[i] + slack)
        deck.section("output").section("probes").fail(std::string(axis_names[i]) + " = " + number_text(at[i]) +
                                                          " lies outside the mesh, which reaches from " +
                                                          number_text(box.low[i]) + " to " + number_text(box.high[i]),
                                                      probe.name);
  }
}

/// Refuses an error estimate without soil, from whose stresses it is computed, and adaptive remeshing without an
/// estimate.
void check_error_estimate(const Model& model, const OutputSettings& output, const Section& deck) {
  if (output.error_estimate && !model.soil())
    deck.section("output").fail("the model has no soil whose stresses could be looked at", "error estimate");
  if (output.error_estimate) model.soil()->require_saturated(deck.section("output"), "error estimate");
  const Ale* ale = model.ale();
  if (ale && ale->remeshing() && ale->remeshing()->adaptive() && !output.error_estimate)
    deck.section("mesh motion")
        .section("remeshing")
        .fail(
            "'adaptive' takes the sizes from the error estimate; it needs output/error estimate = true, and aims at "
            "output/target error",
            "size");
}

}  // namespace

void check_deck(Model& model, const Section& deck) {
  check_contradictions(model, deck);
  check_loads(model, deck);
  check_motions(model, deck);
  check_pairs(model, deck);
  check_in_situ(model, deck);
  if (model.space().find("displacement") >= 0) {
    const MeshParts parts = mesh_parts(model.mesh());
    check_read_strengths(model);
    check_read_pressures(model, deck);
    check_suction(model, deck);
    check_parts(model, deck, parts);
    check_supports(model, deck, parts);
  }
  check_unused(model, deck);
}

void check_output(const Model& model, const OutputSettings& output, const Section& deck) {
  check_probes(model, output, deck);
  for (const FilterSettings& filter : output.filters)
    Filter::check(model, filter, deck.section("output").section("filters").section(filter.name));
  check_error_estimate(model, output, deck);
}

}  // namespace mudline
