#include "simulation/model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ale/penetration_mesh.hpp"
#include "core/entry.hpp"
#include "core/guarded.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
#include "discretisation/agree.hpp"
#include "framework/first_act.hpp"
#include "integrator/overlap.hpp"
#include "integrator/time_error.hpp"
#include "physics/soil_points.hpp"
#include "physics/soil_stress.hpp"
#include "simulation/output/mesh_parts_file.hpp"

namespace mudline {

const std::vector<std::string>& deck_sections() {
  static const std::vector<std::string> names{
      "variables", "mesh",        "functions", "materials", "physics", "bodies", "boundary conditions",
      "contacts",  "mesh motion", "stages",    "start",     "solver",  "output", "plausibility",
      "plugins"};
  return names;
}

namespace {

Section required_section(const Section& deck, const std::string& name) {
  if (!deck.has_section(name)) deck.fail("required section '" + name + "' is missing");
  return deck.section(name);
}

/// Named sublists only: a stray parameter in a collection is an error.
std::vector<Section> collection(const Section& section) {
  section.allow_parameters({});
  std::vector<Section> result;
  for (const std::string& name : section.section_names()) result.push_back(section.section(name));
  return result;
}

/// The sets of the mesh that the deck's contacts need.
ContactSets contact_sets(const Section& deck) {
  ContactSets sets;
  const Section contacts = deck.section("contacts");
  for (const std::string& name : contacts.section_names()) {
    const Section contact = contacts.section(name);
    if (contact.has_parameter("surface")) sets.surfaces.push_back(contact.text("surface"));
    if (!contact.has_parameter("slave") || !contact.has_parameter("master")) continue;
    sets.pairs.emplace_back(contact.text("slave"), contact.text("master"));
  }
  for (const auto& pair : sets.pairs) sets.surfaces.push_back(pair.first);
  return sets;
}

/// Errors that a physics, maybe of a plugin, throws are reported as errors of its section.
template <class Action>
void call_physics(const Section& entry, Action&& action) {
  guarded(entry, "type", "the physics cannot be used", [&] { action(entry); });
}

}  // namespace

MeshRecipe mesh_recipe(const Section& deck, const Registries& registries) {
  MeshRecipe recipe(registries.mesh_sources, required_section(deck, "mesh"), contact_sets(deck));
  if (auto* around_body = dynamic_cast<PenetrationMesh*>(&recipe.source()))
    around_body->read_body(deck.section("bodies"), {registries.contours, registries.surfaces, registries.motions});
  return recipe;
}

void Model::read_mesh(RCP<const Comm> comm, const Section& deck, const Registries& registries,
                      const MeshOrigin& origin) {
  std::unique_ptr<MeshRecipe> recipe;
  agree(*comm, [&] { recipe = std::make_unique<MeshRecipe>(mesh_recipe(deck, registries)); });
  if (origin.remeshed) {
    remeshed_ = origin.remeshed;
    GlobalMesh whole = remeshed_->mesh;
    whole.contacts = recipe->contacts();
    mesh_ = std::make_unique<Mesh>(comm, recipe->geometry(), std::move(whole));
  } else {
    mesh_ = origin.parts_file.empty() ? make_mesh(comm, *recipe) : read_mesh_parts(comm, *recipe, origin.parts_file);
  }
}

Model::Model(RCP<const Comm> comm, const Section& deck, const Registries& registries, const MeshOrigin& origin) {
  deck.allow_parameters({});
  deck.allow_sections(deck_sections());
  read_mesh(comm, deck, registries, origin);
  read_materials(deck, registries);
  read_bodies(deck, registries);
  read_physics(deck, registries);
  read_conditions(deck, registries);
  read_contacts(deck, registries);
  read_mesh_motion(deck, registries);
  read_stages(deck, registries);
  read_solver(deck, registries);

  std::vector<Term*> terms;
  for (const auto& term : terms_) terms.push_back(term.get());
  for (const auto& condition : conditions_)
    if (condition->term()) terms.push_back(condition->term());
  for (const auto& [name, contact] : contacts_) terms.push_back(contact.get());
  store_ = std::make_unique<StateStore>(*space_);
  for (const auto& [name, body] : bodies_) {
    body->declare_state(*store_);
    body->set_active(false);  // until the first stage
  }
  system_ = std::make_unique<StepSystem>(*space_, *store_, terms, *solver_,
                                         [this](const StepView& view) { return block_data(view); });
  if (ale_)
    if (const std::string problem = ale_->problem(*store_); !problem.empty()) deck.section("mesh motion").fail(problem);
  if (!remeshed_) initialise(deck);
}

void Model::initialise(const Section& deck) {
  const Section physics = deck.section("physics");
  for (std::size_t i = 0; i < physics_.size(); ++i)
    call_physics(physics.section(physics.section_names()[i]),
                 [&](const Section& entry) { physics_[i]->initialise(*store_, entry); });
}

void Model::read_materials(const Section& deck, const Registries& registries) {
  for (const Section& section : collection(deck.section("materials")))
    materials_.push_back(SoilMaterial::read(
        section, {registries.skeletons, registries.fluids, registries.permeabilities, registries.properties}));
}

void Model::read_physics(const Section& deck, const Registries& registries) {
  const Section section = required_section(deck, "physics");
  std::vector<Field> fields;
  const std::vector<Section> entries = collection(section);
  if (entries.empty())
    section.fail("at least one physics is needed; known physics types: " + join(registries.physics.names()));
  for (const Section& entry : entries) {
    physics_.push_back(registries.physics.create(entry));
    std::vector<Field> own;
    call_physics(entry, [&](const Section&) {
      physics_.back()->check_mesh(*mesh_, entry);
      own = physics_.back()->fields();
    });
    for (const Field& field : own) {
      const auto same =
          std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == field.name; });
      if (same == fields.end())
        fields.push_back(field);
      else if (same->components != field.components || same->support != field.support ||
               same->time_order != field.time_order)
        entry.fail("its field '" + field.name + "' is declared differently by another physics", "type");
    }
  }
  Bodies all, free;
  for (const auto& [name, body] : bodies_) {
    all.push_back(body);
    if (body->may_be_free()) free.push_back(body);
  }
  if (!free.empty())
    fields.push_back({"body motion", "m", "N", RigidBody::unknowns_per_body(mesh_->geometry()), Support::apart, 2,
                      static_cast<int>(free.size())});
  space_ = std::make_unique<Space>(*mesh_, fields);
  for (std::size_t i = 0; i < free.size(); ++i)
    free[i]->bind(*space_, space_->find("body motion"), static_cast<int>(i));
  block_data_ = [](const StepView&) { return BlockData{}; };
  const Section materials = deck.section("materials");
  PhysicsContext context{*space_, materials_, materials, terms_, shared_, conserved_, block_data_};
  for (std::size_t i = 0; i < physics_.size(); ++i)
    call_physics(entries[i], [&](const Section& entry) { physics_[i]->build(context, entry); });
  soil_ = shared_.find<Soil>();
  if (!all.empty()) terms_.push_back(std::make_unique<BodyPaths>(all));
  if (free.empty()) return;
  terms_.push_back(std::make_unique<BodyInertia>(free));
  terms_.push_back(std::make_unique<BodyLoads>(free));
}

void Model::read_conditions(const Section& deck, const Registries& registries) {
  for (const Section& entry : collection(deck.section("boundary conditions"))) {
    conditions_.push_back(registries.conditions.create(entry));
    conditions_.back()->name = entry.name();
    guarded(entry, "type", "the boundary condition cannot be used", [&] {
      conditions_.back()->bind({*space_, shared_}, entry);
    });
    if (auto* holds = face<HoldsOnOpenSides>(*conditions_.back())) on_open_sides_.push_back(holds);
  }
}

void Model::read_bodies(const Section& deck, const Registries& registries) {
  for (const Section& entry : collection(deck.section("bodies")))
    bodies_[entry.name()] =
        RigidBody::read(entry, mesh_->geometry(), {registries.contours, registries.surfaces, registries.motions});
  const Section stages = deck.section("stages");
  for (const std::string& stage : stages.section_names())
    for (const Section& entry : collection(stages.section(stage).section("motions")))
      stage_motions_[{stage, entry.name()}] = body(entry.name(), entry, "").read_motion(entry, registries.motions);
}

BlockData Model::block_data(const StepView& view) const {
  BlockData data = block_data_(view);
  if (contacts_.empty()) return data;
  data.joined.assign(mesh_->num_nodes(), 0);
  for (const auto& [name, contact] : contacts_) contact->mark_pressed(*view.trial, data.joined);
  data.joined.resize(mesh_->num_owned_nodes());
  return data;
}

double Model::constrained_modulus(int block, int element) const {
  const SoilBlock& b = soil_->blocks[block];
  const SoilPoints points(*soil_, b, store_->committed());
  double sum = 0;
  for (int q = 0; q < b.points; ++q) sum += points.constrained_modulus(element * b.points + q) / b.points;
  return sum;
}

void Model::read_contacts(const Section& deck, const Registries& registries) {
  const Section section = deck.section("contacts");
  if (!section.section_names().empty() && !soil_) section.fail("contacts need a physics with soil");
  for (const Section& entry : collection(section)) {
    const ContactContext context{*space_,
                                 bodies_,
                                 registries.frictions,
                                 registries.normal_laws,
                                 [this](int block, int element) { return constrained_modulus(block, element); },
                                 [this](int block, double time) { return soil_->water_weight(block, time); },
                                 [this](const State& state, int block, int element, const Point& at) {
                                   return total_stress(*soil_, state, block, element, at);
                                 },
                                 [this](const State& state, int block, int element, const Point& at) {
                                   return undrained_strength(*soil_, state, block, element, at);
                                 },
                                 remeshed_ != nullptr};
    contacts_.emplace_back(entry.name(), registries.contacts.create(entry, context));
    if (const auto* seals = face<ClosesSides>(*contacts_.back().second)) sealing_.emplace_back(entry.name(), seals);
  }
  const auto rough = [](const auto& contact) { return contact.second->partners().shear; };
  if (soil_) soil_->choose_strain(std::any_of(contacts_.begin(), contacts_.end(), rough));
}

void Model::read_mesh_motion(const Section& deck, const Registries& registries) {
  if (!deck.has_section("mesh motion")) return;
  const Section section = deck.section("mesh motion");
  if (!soil_) section.fail("mesh motion needs a physics with soil");
  ale_ = std::make_unique<Ale>(*space_, *soil_, bodies_, section,
                               MeshMotionRegistries{registries.interior_motions, registries.remaps}, remeshed_.get());
}

void Model::read_stages(const Section& deck, const Registries& registries) {
  const Section section = required_section(deck, "stages");
  std::vector<std::string> conditions, contacts;
  for (const auto& condition : conditions_) conditions.push_back(condition->name);
  for (const auto& [name, contact] : contacts_) contacts.push_back(name);
  for (const Section& entry : collection(section)) {
    stages_.push_back(Stage::read(entry, registries.integrators, conditions, contacts));
    for (const Section& end : collection(entry.section("ends when"))) {
      stages_.back()->ends.push_back(registries.stage_ends.create(end));
      stages_.back()->ends.back()->name = end.name();
      guarded(end, "type", "it cannot end the stage", [&] { stages_.back()->ends.back()->bind(*this, end); });
    }
    if (stages_.back()->strength_reduction.acts()) check_strengths(entry.section("strength reduction"));
    if (stages_.back()->control.error_tolerance > 0 && !TimeError::has_meaning(*space_, stages_.back()->scheme(0)))
      entry.section("time step")
          .fail(
              "nothing is integrated in time here: there is neither inertia nor a field with a rate, as the pore "
              "pressure",
              "error tolerance");
  }
  if (stages_.empty()) section.fail("at least one stage is needed");
}

void Model::check_strengths(const Section& section) const {
  const std::string reducible = "mohr-coulomb, drucker-prager, tresca, von mises";
  bool found = false;
  for (const auto& material : soil_ ? soil_->materials : std::vector<std::shared_ptr<const SoilMaterial>>()) {
    const Strengths strengths = material->skeleton->strengths();
    found = found || strengths == Strengths::reducible;
    if (strengths == Strengths::unknown)
      section.fail("the law '" + material->law + "' of material '" + material->name +
                   "' has no strengths that could be divided by a factor; allowed: " + reducible +
                   ", and elastic laws beside them");
  }
  if (!found) section.fail("no soil of the deck has a strength; needed: a material with one of " + reducible);
}

void Model::read_solver(const Section& deck, const Registries& registries) {
  const Section section = deck.section("solver");
  section.allow_sections({"linear solver", "newton"});
  Parameters p(section);
  tolerances_.parameters(p);
  p.passes_on(
      "linear solver",
      "solver of the linear systems; see the linear solver types; absent: direct, but block amg in three dimensions "
      "with more than 5000 unknowns, and in two with more than 20000 on several ranks");
  p.section("newton", newton_, "nonlinear iterations");
  p.finish();
  // Number of unknowns up to which a direct solver is as good. In the plane it factorises on one rank, for which the
  // others wait.
  const bool space = mesh_->dimension() == 3, alone = mesh_->comm()->getSize() == 1;
  const Tpetra::global_size_t small = space ? 5000 : 20000;
  const Section given = section.section("linear solver");
  const bool chosen = given.has_parameter("type") || (!space && !given.parameter_names().empty());
  const auto take = [&](const std::string& type) {
    const Section linear = section.section_of_type("linear solver", type);
    solver_ = registries.linear_solvers.create(linear);
    const std::string reason = solver_->prepare(space_->dofs());
    if (reason.empty() && (space || !alone)) log::info("linear solver: " + linear.text("type"));
    return reason;
  };
  const bool large = (space || !alone) && space_->dofs()->owned()->getGlobalNumElements() > small;
  if (!chosen && large && take("block amg").empty()) return;
  if (const std::string reason = take("direct"); !reason.empty()) section.section("linear solver").fail(reason, "type");
}

void Model::activate(const Stage& stage, bool fresh) {
  std::vector<Term*> active;
  for (const auto& term : terms_) active.push_back(term.get());
  for (auto& [name, contact] : contacts_) {
    if (std::find(stage.contacts.begin(), stage.contacts.end(), name) == stage.contacts.end()) continue;
    active.push_back(contact.get());
    if (auto* first = face<FirstActs>(*contact); first && fresh) first->first_act(store_->committed());
  }
  changed_motions_.clear();
  released_before_.clear();
  for (auto& [name, body] : bodies_) {
    const BodyUnknowns& unknowns = body->unknowns();
    for (int k = 0; k < unknowns.count; ++k)
      if (body->releases(unknowns.direction[k])) released_before_.push_back(unknowns.dof[k]);
    if (!body->set_motion(motion_in(stage, name))) continue;
    changed_motions_.insert(name);
    if (fresh) body->restart_clock(store_->committed());
  }
  const std::set<std::string> names(stage.conditions.begin(), stage.conditions.end());
  using Wanted = std::function<bool(const Condition&)>;
  const auto conditions = [&](const Wanted& wanted) {
    std::vector<Condition*> result;
    for (const auto& condition : conditions_)
      if (names.count(condition->name) && wanted(*condition)) result.push_back(condition.get());
    return result;
  };
  const auto terms = [&](const Wanted& wanted) {
    std::vector<Term*> result = active;
    for (Condition* condition : conditions(wanted))
      if (condition->term()) result.push_back(condition->term());
    return result;
  };
  if (fresh) {
    const auto stays = [&](const Condition& condition) { return active_conditions_.count(condition.name) > 0; };
    const auto new_support = [&](const Condition& condition) { return !stays(condition) && condition.supports(); };
    const auto new_other = [&](const Condition& condition) { return !stays(condition) && !condition.supports(); };
    // the forces on the sets of newly active conditions are the residual of all terms that stay active; supports take
    // the new loads too
    activate_conditions(stage, conditions(new_other), terms(stays));
    activate_conditions(stage, conditions(new_support), terms([&](const Condition& c) { return !new_support(c); }));
  }
  system_->activate(terms([](const Condition&) { return true; }));
  active_conditions_ = names;
  // the conditions hold the forces at the end of the stage before, with its strengths
  if (soil_) soil_->reduction_rate = stage.strength_reduction.rate(stage.duration);
}

void Model::activate_conditions(const Stage& stage, const std::vector<Condition*>& conditions,
                                const std::vector<Term*>& acting) {
  if (conditions.empty()) return;
  system_->activate(acting);
  const NodalView unbalanced = system_->static_residual();
  Constraints held(static_cast<int>(unbalanced.extent(0)));
  prescribe(stage, store_->committed().time, store_->committed().time, store_->committed(), held);
  for (std::size_t i = 0; i < unbalanced.extent(0); ++i)
    if (held.mask(i)) unbalanced(i) = 0;
  for (Condition* condition : conditions) condition->activate(store_->committed(), unbalanced);
}

std::shared_ptr<const BodyMotion> Model::motion_in(const Stage& stage, const std::string& name) const {
  const RigidBody& body = *bodies_.at(name);
  if (stage.type == Stage::Type::geostatic) return nullptr;
  // A body whose motion is always prescribed moves only in stages in which some contact acts; otherwise its motion has
  // no effect.
  if (stage.contacts.empty() && body.unknowns().count == 0) return nullptr;
  const auto other = stage_motions_.find({stage.name, name});
  return other == stage_motions_.end() ? body.own_motion() : other->second;
}

void Model::start_bodies(const Stage& stage) {
  if (stage.type != Stage::Type::dynamic) return;
  const auto starts = [&](const RigidBody& body) {
    if (!body.released()) return false;
    bool still = true;  // true also where the stage before left no accelerations
    for (int k = 0; k < body.unknowns().count; ++k)
      still = still && store_->committed().acceleration(body.unknowns().dof[k]) == 0;
    return still || changed_motions_.count(body.name()) > 0;
  };
  if (std::none_of(bodies_.begin(), bodies_.end(), [&](const auto& entry) { return starts(*entry.second); })) return;
  const NodalView unbalanced = system_->static_residual();
  for (const auto& [name, body] : bodies_)
    if (starts(*body)) set_free(*body, store_->committed(), unbalanced, changed_motions_.count(name) > 0);
}

std::vector<const Term*> Model::all_terms() const {
  std::vector<const Term*> terms;
  for (const auto& term : terms_) terms.push_back(term.get());
  for (const auto& condition : conditions_)
    if (condition->term()) terms.push_back(condition->term());
  for (const auto& [name, contact] : contacts_) terms.push_back(contact.get());
  return terms;
}

std::vector<std::pair<const Term*, std::string>> Model::named_terms() const {
  std::vector<std::pair<const Term*, std::string>> named;
  std::map<std::string, int> namesakes;
  for (const Term* term : all_terms()) {
    const int before = namesakes[term->name()]++;
    named.emplace_back(term, term->name() + (before > 0 ? "#" + std::to_string(before) : ""));
  }
  return named;
}

void Model::prescribe(const Stage& stage, double t_old, double t_end, const State& committed, Constraints& to) const {
  const auto named = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  ClosedSides closed;
  // without flow the pore pressure is prescribed everywhere, and closed sides release nothing
  if (stage.type != Stage::Type::geostatic)
    for (const auto& [name, contact] : sealing_)
      if (named(stage.contacts, name)) contact->close(committed, closed);
  for (HoldsOnOpenSides* condition : on_open_sides_) condition->set_closed(closed);
  for (const auto& condition : conditions_) {
    if (!named(stage.conditions, condition->name)) continue;
    condition->prescribe(t_old, t_end, committed, to);
    for (std::size_t i = 0; i < to.mask.extent(0); ++i)
      if (to.given(i) && !std::isfinite(to.value(i)))
        throw std::runtime_error("boundary condition '" + condition->name +
                                 "' prescribes a value that is not finite at t = " + number_text(t_end) + " s");
  }
  for (const auto& [name, body] : bodies_) body->prescribe(committed, t_old, t_end, to);
}

RigidBody& Model::body(const std::string& name, const Section& section, const std::string& entry) const {
  const auto found = bodies_.find(name);
  if (found != bodies_.end()) return *found->second;
  std::vector<std::string> known;
  for (const auto& [other, body] : bodies_) known.push_back(other);
  section.fail("unknown body '" + name + "'" + suggestion(name, known), entry);
}

std::size_t Model::index_of(const Stage& stage) const {
  const auto found = std::find_if(stages_.begin(), stages_.end(), [&](const auto& one) { return one.get() == &stage; });
  return static_cast<std::size_t>(found - stages_.begin());
}

}  // namespace mudline
