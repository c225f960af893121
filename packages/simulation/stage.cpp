#include "simulation/stage.hpp"

#include <algorithm>

#include "core/guarded.hpp"
#include "core/told.hpp"

namespace mudline {

void Stage::parameters(Parameters& p) {
  p.choice("type", type,
           {{"geostatic", Type::geostatic}, {"quasi-static", Type::quasi_static}, {"dynamic", Type::dynamic}},
           "geostatic: equilibrium of given stresses and pore pressures, displacements reset; quasi-static: no "
           "inertia; dynamic");
  if (p.documenting() || type != Type::geostatic)
    p.required("duration", duration, "s", positive(),
               "time the stage lasts, at most where it has 'ends when' (a geostatic stage takes none)");
  p.add("conditions", wanted_conditions_, "names of the boundary conditions that act; absent: all; {none} or {}: none");
  p.add("contacts", wanted_contacts_,
        "names of the contacts that act; absent: all in dynamic and quasi-static stages; {none} or {}: none");
  p.choice("initial rates", initial_rates,
           {{"automatic", InitialRates::automatic},
            {"keep", InitialRates::keep},
            {"zero", InitialRates::zero},
            {"consistent", InitialRates::consistent}},
           "dynamic, at the begin. automatic: those of the stage before (rest at the start of a run), but zero after a "
           "stage without inertia whose rates do not go on under the loads and motions of this one; keep: those of the "
           "stage before; zero; consistent: velocities as by automatic, accelerations and pressure rates from the "
           "equations of motion, for first steps short against the time a wave takes through an element");
  p.add("mesh motion", mesh_motion, "the mesh moves against the soil in this stage, where the deck says how");
  p.add("allow folded elements", allow_folded,
        "go on when the mesh folds (a scaled Jacobian of 0 or less); otherwise the run ends there, its state saved");
  p.add("reset displacements", reset_displacements, "set the displacements to zero at the end of the stage");
  p.add("balance tolerance", balance_tolerance, "m", non_negative(),
        "geostatic: the run ends with an error when equilibrium needs larger displacements than this; 0: no limit");
  p.passes_on("integrator", "time integrator; see the integrator types");
  p.passes_on("time step", "size of the steps");
  p.passes_on(
      "ends when",
      "what ends the stage before its duration, by name: the first one that is reached; see the stage end types");
  p.passes_on("strength reduction",
              "quasi-static: the strengths of the soil are divided by a growing factor until no equilibrium is found");
  p.passes_on("motions",
              "motions of bodies, by name, that hold in this stage instead of their own; see the motion types");
}

std::unique_ptr<Stage> Stage::read(const Section& section, const Registry<TimeIntegrator>& integrators,
                                   const std::vector<std::string>& conditions,
                                   const std::vector<std::string>& contacts) {
  auto stage = std::unique_ptr<Stage>(new Stage);
  stage->name = section.name();
  if (!section.has_parameter("type"))
    section.fail("required parameter 'type' is missing; known stage types: geostatic, quasi-static, dynamic");
  Parameters p(section);
  stage->parameters(p);
  p.finish();

  const auto select = [&](const std::string& what, const std::vector<std::string>& wanted,
                          const std::vector<std::string>& known) {
    if (!section.has_parameter(what)) return known;
    std::vector<std::string> chosen;
    if (wanted == std::vector<std::string>{"none"}) return chosen;
    for (const auto& name : wanted)
      if (std::find(known.begin(), known.end(), name) == known.end())
        section.fail("'" + name + "' is not defined in '" + (what == "contacts" ? "contacts" : "boundary conditions") +
                         "'" + suggestion(name, known),
                     what);
    for (const auto& name : known)
      if (std::find(wanted.begin(), wanted.end(), name) != wanted.end()) chosen.push_back(name);
    return chosen;
  };
  stage->conditions = select("conditions", stage->wanted_conditions_, conditions);
  stage->contacts = select(
      "contacts", stage->wanted_contacts_,
      stage->type == Type::geostatic && !section.has_parameter("contacts") ? std::vector<std::string>{} : contacts);
  const bool reduces = section.has_section("strength reduction");
  if (reduces && stage->type != Type::quasi_static)
    section.fail("a stage with a strength reduction looks for equilibrium: its type must be 'quasi-static'; given '" +
                     section.text("type") + "'",
                 "type");
  if (stage->type != Type::geostatic && section.has_parameter("balance tolerance"))
    section.fail("only a geostatic stage finds a balance; given '" + section.text("type") + "'", "balance tolerance");
  if (stage->type != Type::dynamic && section.has_parameter("initial rates"))
    section.fail("only a dynamic stage starts with rates; given '" + section.text("type") + "'", "initial rates");
  if (stage->type == Type::geostatic) {
    if (section.has_parameter("reset displacements") && !stage->reset_displacements)
      section.fail("a geostatic stage always sets the displacements to zero", "reset displacements");
    stage->duration = 0;
    stage->reset_displacements = true;
    if (section.has_section("integrator")) section.fail("a geostatic stage has no integrator", "integrator");
    for (const char* entry : {"time step", "ends when"})
      if (section.has_section(entry)) section.fail("a geostatic stage takes no time and has no steps", entry);
    return stage;
  }
  const bool dynamic = stage->type == Type::dynamic;
  if (section.has_section("integrator")) {
    stage->integrator_ = integrators.create(section.section("integrator"));
    if (stage->integrator_->dynamic() != dynamic)
      section.section("integrator")
          .fail(dynamic ? "a dynamic stage needs an integrator with inertia (generalised alpha, newmark, hht alpha)"
                        : "a quasi-static stage takes the integrator 'theta'",
                "type");
  } else {
    // the defaults come from the registered types themselves
    Teuchos::ParameterList list("integrator");
    list.set("type", std::string(dynamic ? "generalised alpha" : "theta"));
    auto none = std::make_shared<Sources>();
    stage->integrator_ = integrators.create(Section(list, none, std::make_shared<FunctionLibrary>(), ""));
  }
  if (!section.has_section("time step")) section.fail("required section 'time step' is missing");
  const Section steps = section.section("time step");
  Parameters control(steps);
  stage->control.parameters(control);
  control.finish();
  stage->control.check(steps);
  stage->control.complete(stage->duration);
  if (stage->control.initial > stage->duration)
    steps.fail("the first step, " + readable(stage->control.initial, "s") +
                   ", must not be longer than the stage's duration, " + readable(stage->duration, "s"),
               "initial");
  if (reduces) stage->read_reduction(section.section("strength reduction"), steps);
  return stage;
}

void Stage::read_reduction(const Section& section, const Section& steps) {
  Parameters p(section);
  strength_reduction.parameters(p);
  p.finish();
  const double rate = strength_reduction.rate(duration), resolution = strength_reduction.resolution;
  if (steps.has_parameter("minimum"))
    steps.fail("the smallest step of a strength reduction follows from its 'resolution'", "minimum");
  if (control.initial * rate < resolution * (1 - 1e-9))
    steps.fail("the factor of the strength reduction grows by " + told(control.initial * rate, "%.3g") +
                   " in the first step; allowed: its resolution of " + told(resolution, "%.3g") + " or more",
               "initial");
  // a step that fails is cut unless the factor grows by less than the resolution in it
  control.minimum = control.cut * resolution / rate;
}

TimeScheme Stage::scheme(int step) const {
  if (type != Type::geostatic) return integrator_->scheme(step);
  TimeScheme scheme;
  scheme.inertia = scheme.flow = false;
  scheme.incremental = true;
  return scheme;
}

}  // namespace mudline
