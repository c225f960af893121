#include "contact/parts/drainage.hpp"

namespace mudline {

void Drainage::parameters(Parameters& p) {
  p.choice("drainage", kind_,
           {{"sealed", Kind::sealed}, {"drained", Kind::drained}, {"leaky", Kind::leaky}, {"film", Kind::film}},
           "sealed: where the surface touches, its prescribed pore pressure is released (no flow); drained: it stays "
           "prescribed; leaky: it is released, and water leaves through what it touches by 'conductance'; film: it is "
           "released, and water stands between the two, whose pressure acts on both: where the gap grows it comes from "
           "the surface's soil or from the open end of the gap");
  film.parameters(p);
  p.add("conductance", conductance_, "m/(Pa s)", non_negative(),
        "Leaky: flow out of the soil per difference of pore pressure and outside pressure");
  p.add("outside pressure", outside_, "Pa",
        "Leaky: water pressure beyond what it touches, a function of time and place");
  p.add("sealing gap", sealing_gap_, "-", non_negative(),
        "Gap, as a fraction of a side's length, up to which the side is still sealed");
}

void Drainage::check(const Section& section, bool pore_pressure) const {
  if (!has_film()) WaterFilm::refuse(section);
  for (const char* entry : {"drainage", "sealing gap"})
    if (!pore_pressure && section.has_parameter(entry))
      section.fail("has a meaning only in a model with the field 'pore pressure'", entry);
  if (leaks()) {
    if (!(conductance_ > 0)) section.fail("a leaky contact needs a conductance greater than 0", "conductance");
    return;
  }
  if (kind_ == Kind::drained && section.has_parameter("sealing gap"))
    section.fail("has no meaning with 'drainage' = drained, which seals nothing", "sealing gap");
  for (const char* entry : {"conductance", "outside pressure"})
    if (section.has_parameter(entry)) section.fail("has a meaning only with 'drainage' = leaky", entry);
}

}  // namespace mudline
