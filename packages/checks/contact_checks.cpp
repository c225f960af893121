// Plausibility checks of contacts: penalties, friction, and loads beside them.
#include <algorithm>
#include <cmath>
#include <optional>

#include "checks/body_setup.hpp"

namespace mudline {

namespace {

/// Bearing pressure of a body at the soil's surface over the undrained strength, some ten.
constexpr double bearing_factor = 10;
/// Strength over modulus of a soil whose undrained strength is not known.
constexpr double strength_over_modulus = 0.01;

/// Judges a given penalty over the stiffness of the soil behind it, where the contact is enforced with (`augmented`) or
/// without multipliers.
void judge_penalty(const ContactSetup& of, bool augmented, const std::string& advice, const Judge& judge) {
  const double given = number_in(of.entry, "penalty", 0);
  const bool is_augmented = of.entry.has_parameter("enforcement") && of.entry.text("enforcement") != "penalty";
  if (!(given > 0) || !(of.soil.stiffness > 0) || is_augmented != augmented || of.entry.text("type") == "mortar")
    return;
  const double bears = of.soil.strength > 0
                           ? std::min(of.soil.stiffness, bearing_factor * of.soil.strength / (0.5 * of.soil.side))
                           : of.soil.stiffness;
  judge(given / bears,
        of.called() + ": its 'penalty' of " + readable(given, "Pa/m", 3) + " over what the soil behind it bears, " +
            readable(bears, "Pa/m", 3) + " (modulus over element height, or ten times the strength over half a side),",
        advice);
}

void penalty(const ContactSetup& of, const Judge& judge) {
  judge_penalty(of, false, "give it in Pa/m, or leave it out: 'penalty factor' times the modulus over the height",
                judge);
}

/// Multipliers make up for a soft penalty, but a softer one takes more augmentations.
void augmented_penalty(const ContactSetup& of, const Judge& judge) {
  judge_penalty(
      of, true,
      "give it in Pa/m, or leave it out; multipliers that make up for so soft a penalty take many rounds, and "
      "those for so stiff a one leave Newton's method little to go by",
      judge);
}

/// Judges an entry that the deck gives, as it stands.
void judge_given(const ContactSetup& of, const Section& section, const char* entry, const char* advice,
                 const Judge& judge) {
  if (section.has_parameter(entry)) judge(number_in(section, entry, 0), of.called() + ": its '" + entry + "'", advice);
}

/// Judges a length that the deck gives over the mean side of the surface.
void judge_over_side(const ContactSetup& of, const char* entry, const Judge& judge) {
  const double length = number_in(of.entry, entry, 0);
  if (length > 0 && of.soil.side > 0)
    judge(length / of.soil.side, of.called() + ": its '" + entry + "' over the mean side",
          "give it in m, or leave it out");
}

void penalty_factor(const ContactSetup& of, const Judge& judge) {
  judge_given(of, of.entry, "penalty factor",
              "below 1 the contact deforms more than the soil, far above 1000 Newton's method has a hard time", judge);
}

Section friction_of(const ContactSetup& of) { return of.entry.section("friction"); }

void friction(const ContactSetup& of, const Judge& judge) {
  for (const char* entry : {"coefficient", "kinetic coefficient"})
    if (friction_of(of).has_parameter(entry))
      judge(number_in(friction_of(of), entry, 0), of.called() + ": its friction's '" + entry + "'",
            "it is the tangent of the interface's angle: 20 degrees is 0.36");
}

/// Judges another coefficient of friction that the deck gives, "kinetic" or "residual", over the first one.
void judge_over_coefficient(const ContactSetup& of, const std::string& other, const char* advice, const Judge& judge) {
  const std::string entry = other + " coefficient";
  const double first = number_in(friction_of(of), "coefficient", 0);
  if (friction_of(of).has_parameter(entry) && first > 0)
    judge(number_in(friction_of(of), entry, 0) / first,
          of.called() + ": the " + other + " over the friction coefficient", advice);
}

void kinetic(const ContactSetup& of, const Judge& judge) {
  judge_over_coefficient(of, "kinetic", "sliding surfaces have the lower one", judge);
}

void residual(const ContactSetup& of, const Judge& judge) {
  judge_over_coefficient(of, "residual", "surfaces that have slid have the lower one", judge);
}

/// A function of the friction law where the deck gives it as a constant.
std::optional<double> constant_in(const ContactSetup& of, const char* entry) {
  if (!friction_of(of).has_parameter(entry)) return std::nullopt;
  Function value;
  Parameters(friction_of(of)).add(entry, value, "", "");
  return value.is_constant() ? std::optional<double>(value(0, {})) : std::nullopt;
}

/// Judges a function of the friction law that the deck gives as a constant.
void judge_constant(const ContactSetup& of, const char* entry, const char* advice, const Judge& judge) {
  if (const auto value = constant_in(of, entry)) judge(*value, of.called() + ": its '" + entry + "'", advice);
}

void adhesion(const ContactSetup& of, const Judge& judge) {
  const double value = constant_in(of, "adhesion").value_or(0.0);
  if (value > 0) judge(value, of.called() + ": its 'adhesion'", "give it in Pa (1 to 100 may be kPa)");
}

void adhesion_over_strength(const ContactSetup& of, const Judge& judge) {
  const double value = constant_in(of, "adhesion").value_or(0.0);
  if (value > 0 && of.soil.strength > 0)
    judge(value / of.soil.strength,
          of.called() + ": its 'adhesion' over the largest undrained strength at the surface, " +
              readable(of.soil.strength, "Pa", 3) + ",",
          "the soil shears before: give a share of the strength");
}

void cap(const ContactSetup& of, const Judge& judge) {
  judge_constant(of, "cap", "give it in Pa (1 to 100 may be kPa)", judge);
}

void alpha(const ContactSetup& of, const Judge& judge) {
  judge_constant(
      of, "alpha",
      "it is a share of the touching soil's undrained strength: the soil shears before an interface that is stronger",
      judge);
}

void tangential(const ContactSetup& of, const Judge& judge) {
  judge_given(of, friction_of(of), "tangential penalty factor", "what sticks should move by little against what slides",
              judge);
}

/// Whether a condition acts in a stage in which the contact does.
bool acts_beside(const ContactSetup& of, const std::string& condition) {
  const auto& stages = of.model.stages();
  return std::any_of(stages.begin(), stages.end(), [&](const auto& stage) {
    return Setup::acts(condition, *stage) && std::count(stage->contacts.begin(), stage->contacts.end(), of.name) > 0;
  });
}

/// Size [Pa] of a load of a condition as deep below the surface as the body is wide, or at the surface where the soil
/// carries the load along: the larger of the start and the end of the run.
double load_beside_body(const ContactSetup& of, const Section& condition, const char* component) {
  const int up = of.model.mesh().dimension() - 1;
  const StartingExtent extent(*of.partners.body);
  Point place = 0.5 * (extent.box.low + extent.box.high);
  if (of.model.mesh().geometry() == Geometry::axisymmetric) place[0] = 0;
  const bool follows = condition.has_parameter("position") && condition.text("position") == "present";
  place[up] = of.soil.top - (follows ? extent.shadow.width : 0.0);
  double end = 0;
  for (const auto& stage : of.model.stages()) end += stage->duration;
  const Function load = Setup::function(condition, component).value_or(Function());
  return std::max(std::abs(load(0, place)), std::abs(load(end, place)));
}

/// A load on the soil that also acts where the body covers it reduces the contact pressure, from which friction
/// follows.
void surcharge(const ContactSetup& of, const Judge& judge) {
  const Section conditions = of.deck.section("boundary conditions");
  const double coefficient = number_in(friction_of(of), "coefficient", 0);
  const bool known = of.soil.strength > 0;
  const double bears = known ? of.soil.strength : strength_over_modulus * of.soil.modulus;
  if (of.partners.body == nullptr || !(coefficient > 0) || !(bears > 0)) return;
  const char* up = of.model.mesh().dimension() == 3 ? "z" : "y";
  for (const std::string& name : conditions.section_names()) {
    const Section entry = conditions.section(name);
    const std::string type = entry.text("type");
    if ((type != "pressure" && type != "traction") || !entry.has_parameter("set") ||
        entry.text("set") != of.partners.surface || !acts_beside(of, name))
      continue;
    const double load = load_beside_body(of, entry, type == "pressure" ? "value" : up);
    judge(coefficient * load / bears,
          of.called() + ": condition '" + name + "' loads the soil with " + readable(load, "Pa", 3) +
              " also where the body covers it, and friction does not see that part of the effective stress: it lacks " +
              readable(coefficient * load, "Pa", 3) + ". Over the soil's " +
              (known ? "undrained strength, " : "strength, taken as a hundredth of its modulus, ") +
              readable(bears, "Pa", 3) + ", this",
          "let the load fade with depth, so that it acts beside the body alone: 'position' = present and a 'value' "
          "such as \"10e3 * min(1, max(0, 1 + " +
              std::string(up) + "/0.4))\"");
  }
}

void capture(const ContactSetup& of, const Judge& judge) { judge_over_side(of, "capture distance", judge); }

void advance(const ContactSetup& of, const Judge& judge) {
  judge_given(of, of.entry, "advance limit",
              "in a step of more than a side a body jumps over what it should touch; far below, steps are many", judge);
}

void gap_tolerance(const ContactSetup& of, const Judge& judge) { judge_over_side(of, "gap tolerance", judge); }

void sealing(const ContactSetup& of, const Judge& judge) {
  judge_given(of, of.entry, "sealing gap", "it is a share of a side, no length", judge);
}

void contact_damping(const ContactSetup& of, const Judge& judge) {
  const double value = number_in(of.entry, "damping", 0);
  if (value > 0)
    judge(value, of.called() + ": its 'damping'", "it is a time per length: the pressure grows by it times the speed");
}

}  // namespace

std::vector<Check<ContactSetup>> contact_checks() {
  return {
      {{"penalty", "-", {0.5, 1e5}, "a contact's given penalty over what the soil behind it bears per metre"}, penalty},
      {{"augmented penalty",
        "-",
        {0.02, 1e5},
        "as 'penalty', of a contact by augmented Lagrangian, whose multipliers make up for a soft one"},
       augmented_penalty},
      {{"penalty factor", "-", {0.3, 1e4}, "of a contact's automatic penalty"}, penalty_factor},
      {{"friction coefficient", "-", {0, 1}, "of a contact"}, friction},
      {{"kinetic friction", "-", {0, 1}, "kinetic over friction coefficient"}, kinetic},
      {{"residual friction", "-", {0, 1}, "residual over friction coefficient"}, residual},
      {{"friction alpha", "-", {0.05, 1.001}, "of a contact with friction"}, alpha},
      {{"adhesion", "Pa", {200, 1e6}, "of a contact with friction"}, adhesion},
      {{"adhesion over strength", "-", {0, 1.001}, "adhesion over the undrained strength at the surface"},
       adhesion_over_strength},
      {{"friction cap", "Pa", {200, 1e7}, "shear stress limit of a contact with friction"}, cap},
      {{"tangential penalty", "-", {0.01, 100}, "tangential penalty factor of friction"}, tangential},
      {{"load under friction",
        "-",
        {0, 0.1},
        "friction that a load on a body's surface takes away, over the soil's strength"},
       surcharge},
      {{"capture distance", "-", {0.5, 1000}, "of a contact over the mean side"}, capture},
      {{"advance limit", "-", {0.01, 4}, "of a contact, in sides"}, advance},
      {{"gap tolerance", "-", {0, 0.01}, "of a contact over the mean side"}, gap_tolerance},
      {{"sealing gap", "-", {0, 2}, "of a contact, in sides"}, sealing},
      {{"contact damping", "s/m", {0, 10}, "of a contact"}, contact_damping},
  };
}

}  // namespace mudline
