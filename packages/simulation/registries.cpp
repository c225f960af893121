#include "simulation/registries.hpp"
#include "simulation/branch.hpp"

#include "ale/ale.hpp"
#include "ale/penetration_mesh.hpp"
#include "core/function_types.hpp"
#include "geometry/path_shape.hpp"
#include "integrator/step_control.hpp"
#include "simulation/output_settings.hpp"
#include "simulation/plugin.hpp"
#include "simulation/results/cone_test.hpp"
#include "simulation/run_start.hpp"
#include "simulation/stage.hpp"

namespace mudline {

void register_all(Registries& r) {
  register_mesh_sources(r.mesh_sources);
  r.mesh_sources.add<PenetrationMesh>("penetration", "plane soil around a body in the ground, or under one above it");
  register_materials(r.skeletons, r.fluids, r.permeabilities);
  register_properties(r.properties);
  register_physics(r.physics);
  register_conditions(r.conditions);
  register_contours(r.contours);
  register_surfaces(r.surfaces);
  register_motions(r.motions);
  register_contact(r.contacts);
  register_friction(r.frictions);
  register_normal_laws(r.normal_laws);
  register_interior_motions(r.interior_motions);
  register_remaps(r.remaps);
  register_time_integrators(r.integrators);
  register_stage_ends(r.stage_ends);
  register_linear_solvers(r.linear_solvers);
  register_point_tests(r.point_tests);
  r.observers.add<ConeTest>("cone penetration test",
                            "net cone resistance, pore pressure ratio, cone factor and consolidation of a cone");
}

namespace {

/// A fixed section of the deck, documented like a registered type.
template <class Declare>
EntryDoc fixed(const std::string& kind, const std::string& summary, Declare&& declare) {
  Parameters p;
  declare(p);
  return {"section", kind, summary, p.docs(), p.sections()};
}

template <class Registered>
void append(std::vector<EntryDoc>& to, const Registered& registry) {
  for (EntryDoc& entry : registry.document()) to.push_back(std::move(entry));
}

}  // namespace

std::vector<EntryDoc> document_all(const Registries& r) {
  std::vector<EntryDoc> docs;
  docs.push_back(fixed("deck", "the root of a deck, with all its sections", [](Parameters& p) {
    std::string base;
    p.add(
        "based on", base,
        "a deck of the program's own, which `mudline template` prints and over which this one is laid: clay, or those "
        "of `mudline new`");
  }));
  docs.push_back(fixed("variables",
                       "numbers, texts and bools, by names of your own; other values name them: 2*D in numbers, {D} in "
                       "texts",
                       [](Parameters&) {}));
  append(docs, r.mesh_sources);
  Registry<FunctionDefinition> functions("function");
  register_functions(functions);
  append(docs, functions);
  docs.push_back(fixed("materials", "the soil of mesh regions; one named section each",
                       [](Parameters& p) { SoilMaterial::document(p); }));
  append(docs, r.skeletons);
  append(docs, r.fluids);
  append(docs, r.permeabilities);
  append(docs, r.properties);
  append(docs, r.physics);
  docs.push_back(
      fixed("bodies", "rigid bodies; one named section each", [](Parameters& p) { RigidBody::document(p); }));
  append(docs, r.contours);
  Registry<PathPiece> pieces("contour piece");
  register_path_pieces(pieces);
  append(docs, pieces);
  append(docs, r.surfaces);
  append(docs, r.motions);
  append(docs, r.conditions);
  append(docs, r.contacts);
  append(docs, r.frictions);
  append(docs, r.normal_laws);
  docs.push_back(fixed("mesh motion", "how the mesh moves against the soil (ALE); absent: it goes with it",
                       [](Parameters& p) { Ale::document(p); }));
  append(docs, r.interior_motions);
  append(docs, r.remaps);
  docs.push_back(fixed("stages", "what happens in time, in order; one named section each",
                       [](Parameters& p) { Stage::document(p); }));
  docs.push_back(fixed("strength reduction", "how a stage reduces strengths to find the factor of safety",
                       [](Parameters& p) { StrengthReduction().parameters(p); }));
  docs.push_back(fixed("time step", "size of a stage's steps", [](Parameters& p) { StepControl().parameters(p); }));
  append(docs, r.integrators);
  append(docs, r.stage_ends);
  docs.push_back(fixed("start", "the end of a stage of another run, from which this one goes on; absent: a new start",
                       [](Parameters& p) { RunStart().parameters(p); }));
  docs.push_back(fixed("branches",
                       "other runs that go on from the end of a stage of this one, in the order of the deck; one named "
                       "section each",
                       [](Parameters& p) { Branch::document(p); }));
  docs.push_back(fixed("solver", "tolerances of the steps", [](Parameters& p) {
    StepTolerances().parameters(p);
    NewtonOptions newton;
    p.section("newton", newton, "nonlinear iterations");
  }));
  append(docs, r.linear_solvers);
  append(docs, r.point_tests);
  docs.push_back(
      fixed("output", "what is written, where and how often", [](Parameters& p) { OutputSettings().parameters(p); }));
  docs.push_back(fixed("filter", "mean pore pressure over a ring of a body's surface, or a strip in the plane",
                       [](Parameters& p) { FilterSettings().parameters(p); }));
  append(docs, r.observers);
  docs.push_back(
      fixed("plugins", "shared libraries that bring further types", [](Parameters& p) { document_plugins(p); }));
  return docs;
}

}  // namespace mudline
