#include "contact/parts/initial_gap.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cstdio>

#include "core/log.hpp"
#include "framework/surface_points.hpp"

namespace mudline {

void InitialGap::parameters(Parameters& p) {
  p.choice("initial gap", start_,
           {{"as placed", Start::as_placed}, {"closed", Start::closed}, {"in-situ stress", Start::in_situ_stress}},
           "Gaps and penetrations when the contact first acts. as placed: those of the geometry; closed: points no "
           "farther than the closing distance from the body, outside or in it, count as just touching, without any "
           "strain; in-situ stress: these points start with the traction that the soil's stress has on its "
           "surface, with friction also along it");
  p.add("closing distance", distance_, "m", non_negative(),
        "Initial gap closed or in-situ stress: distance from the body up to which points are taken; 0: a tenth of the "
        "side's longest edge");
}

void InitialGap::check(const Section& section) const {
  if (!adjusts() && section.has_parameter("closing distance"))
    section.fail("has a meaning only with 'initial gap' = closed or in-situ stress; here it is as placed",
                 "closing distance");
}

void InitialGap::declare_state(StateStore& store, const std::string& prefix, std::shared_ptr<const SurfacePoints> at) {
  if (!adjusts()) return;
  array_ =
      store.declare(ArrayInfo::on_surface(prefix + "initial gap", {{"offset", 1, "m"}}, std::move(at)).not_shown());
}

void FirstTouch::close(double gap, double pressure) {
  least_gap = closed > 0 ? std::min(least_gap, gap) : gap;
  largest_gap = closed > 0 ? std::max(largest_gap, gap) : gap;
  least_pressure = std::min(least_pressure, pressure);
  largest_pressure = std::max(largest_pressure, pressure);
  ++closed;
}

FirstTouch FirstTouch::everywhere(const Comm& comm) const {
  constexpr double none = 1e300;
  const double sums[] = {points, closed, deep, pulled, beyond};
  const double most[] = {closed > 0 ? -least_gap : -none,
                         closed > 0 ? largest_gap : -none,
                         deepest,
                         reach,
                         -least_pressure,
                         largest_pressure};
  double sum[5], largest[6];
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 5, sums, sum);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 6, most, largest);
  FirstTouch all;
  all.points = sum[0], all.closed = sum[1], all.deep = sum[2], all.pulled = sum[3], all.beyond = sum[4];
  all.least_gap = -largest[0], all.largest_gap = largest[1], all.deepest = largest[2], all.reach = largest[3];
  all.least_pressure = -largest[4], all.largest_pressure = largest[5];
  return all;
}

void FirstTouch::tell(const std::string& contact, bool pressed) const {
  char text[320], more[120] = "";
  if (closed == 0) {
    std::snprintf(text, sizeof text,
                  "contact '%s': no point of the surface is nearer to the body than the closing distance, %.3g m: no "
                  "gap was closed",
                  contact.c_str(), reach);
    log::warn(text);
  } else {
    if (pressed)
      std::snprintf(more, sizeof more, "; pressed by the soil with %.4g to %.4g Pa", least_pressure, largest_pressure);
    std::snprintf(text, sizeof text, "  contact '%s': %.0f of %.0f points start closed, from gaps of %.3g to %.3g m%s",
                  contact.c_str(), closed, points, least_gap, largest_gap, more);
    log::info(text);
  }
  if (pulled > 0) {
    std::snprintf(text, sizeof text,
                  "contact '%s': at %.0f points the soil's stress is tension, which contact does not carry; they start "
                  "without pressure",
                  contact.c_str(), pulled);
    log::warn(text);
  }
  if (beyond > 0) {
    std::snprintf(
        text, sizeof text,
        "contact '%s': at %.0f points the soil's stress is more than the normal law gives; they start without "
        "pressure",
        contact.c_str(), beyond);
    log::warn(text);
  }
  if (deep > 0) {
    std::snprintf(
        text, sizeof text,
        "contact '%s': %.0f points lie in the body by up to %.3g m, more than the closing distance of %.3g m, "
        "and press for it; give a larger 'closing distance', or move the body or the mesh",
        contact.c_str(), deep, deepest, reach);
    log::warn(text);
  }
}

}  // namespace mudline
