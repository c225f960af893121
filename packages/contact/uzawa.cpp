#include "contact/uzawa.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/log.hpp"
#include "framework/surface_points.hpp"

namespace mudline {

void EnforcementParameters::parameters(Parameters& p) {
  p.add("penalty", penalty, "Pa/m", non_negative(),
        "Pressure per penetration; 0: penalty factor times the soil's stiffness over element size");
  p.add("penalty factor", penalty_factor, "-", positive(),
        "Automatic penalty: multiple of constrained modulus over element height");
  p.choice("enforcement", enforcement,
           {{"penalty", Enforcement::penalty}, {"augmented Lagrangian", Enforcement::augmented_lagrangian}},
           "penalty: pressure = penalty times penetration; augmented Lagrangian: multipliers carry the pressure, found "
           "by repeated solves of a step "
           "(Uzawa) until the gap tolerance is met");
  p.add("gap tolerance", gap_tolerance, "m", non_negative(),
        "Augmented Lagrangian: largest gap of what touches, weighted by the multipliers' shapes, and stretch where it "
        "sticks; 0: a millionth of the "
        "surface's (the slave's) shortest side, and for the stretch a hundredth of the penetration that the "
        "penalty alone would leave under the largest pressure, where that is more");
  p.add("most augmentations", most_augmentations, "-", closed(1, 10000),
        "Augmented Lagrangian: solves of a step after the first; where these do not meet the gap tolerance, the step "
        "is cut");
}

void EnforcementParameters::check(const Section& section) const {
  if (penalty > 0 && section.has_parameter("penalty factor"))
    section.fail("scales the penalty that follows from the soil's stiffness, but 'penalty' gives one; take one out",
                 "penalty factor");
  if (augmented()) return;
  for (const char* entry : {"gap tolerance", "most augmentations"})
    if (section.has_parameter(entry))
      section.fail("has a meaning only with 'enforcement' = augmented Lagrangian; here it is penalty", entry);
}

int EnforcementParameters::declare_penalties(StateStore& store, const std::string& prefix, const Mesh& mesh,
                                             const std::string& surface) {
  const auto sides = std::make_shared<SurfacePoints>(mesh, surface, SurfacePoints::At::centre, 2);
  return store.declare(
      ArrayInfo::on_surface(prefix + "penalty", {{"penalty", 1, "Pa/m"}, {"factor", 1, "-"}}, sides).not_shown());
}

void EnforcementParameters::start_penalties(const ContactSurface& surface,
                                            const std::function<double(int, int)>& stiffness,
                                            const PointView& rows) const {
  constexpr double rounding = 1e-9;
  const auto& sides = surface.sides();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    double &present = rows(s, 0), &factor = rows(s, 1);
    if (penalty > 0) {
      present = penalty;
      factor = 0;
      continue;
    }
    const bool automatic = present > 0 && factor > 0;
    if (automatic && std::abs(factor / penalty_factor - 1) < rounding) continue;
    present = automatic ? present * (penalty_factor / factor)
                        : penalty_factor * stiffness(sides[s].block, sides[s].element) / sides[s].height;
    factor = penalty_factor;
  }
}

void MisfitSums::add(int node, double length, double penalty, double normal_sum, const Point& shear_sum) {
  normal[node] += normal_sum;
  for (std::size_t i = 0; i < shear.size(); ++i) shear[i][node] += shear_sum[i];
  lengths[node] += length;
  stiffnesses[node] += length * penalty;
}

Misfit::Misfit(const ContactSurface& surface, MisfitSums sums, double tangential_factor) : spring(sums.spring) {
  gap = surface.mean(sums.normal, sums.stiffnesses);
  normal = surface.mean(std::move(sums.normal), sums.lengths);
  if (tangential_factor == 0) return;
  stretch.assign(normal.size(), 0.0);
  for (std::vector<double>& component : sums.shear) {
    const std::vector<double> part = surface.mean(component, sums.stiffnesses);
    for (std::size_t node = 0; node < part.size(); ++node) stretch[node] = std::hypot(stretch[node], part[node]);
    shear.push_back(surface.mean(std::move(component), sums.lengths));
  }
  for (double& value : stretch) value /= tangential_factor;
}

Misfit::Largest Misfit::largest(const Comm& comm) const {
  std::array<double, 3> here{0, 0, spring}, everywhere{};
  for (double value : gap) here[0] = std::max(here[0], std::abs(value));
  for (double value : stretch) here[1] = std::max(here[1], std::abs(value));
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 3, here.data(), everywhere.data());
  return {everywhere[0], everywhere[1], everywhere[2]};
}

std::optional<Augmentation> end_of_augmentation(const std::string& contact, const EnforcementParameters& deck,
                                                double gap_tolerance, const Misfit& misfit, int count,
                                                const Comm& comm) {
  const auto [gap, stretch, spring] = misfit.largest(comm);
  constexpr double share = 0.01;  // share of the stretch that the largest pressure would cause
  const bool automatic = deck.gap_tolerance == 0;
  const double stretch_tolerance = automatic ? std::max(gap_tolerance, share * spring) : gap_tolerance;
  char text[480];
  std::snprintf(text, sizeof text, "    contact/%s: after %d augmentations weighted gap %.3g m, stretch %.3g m",
                contact.c_str(), count, gap, stretch);
  log::detail(text);
  if (gap <= gap_tolerance && stretch <= stretch_tolerance) return Augmentation{};
  if (count < deck.most_augmentations) return std::nullopt;
  std::snprintf(
      text, sizeof text,
      "contact '%s' misses its gap tolerance of %.3g m after %d augmentations: weighted gap %.3g m, stretch of "
      "what sticks %.3g m (allowed %.3g m); 'contacts/%s/gap tolerance'%s allows more, a larger 'penalty' or "
      "'penalty factor' converges faster",
      contact.c_str(), gap_tolerance, count, gap, stretch, stretch_tolerance, contact.c_str(),
      automatic ? " (automatic here)" : "");
  return Augmentation{false, text};
}

std::vector<double> in_shapes(const ContactSurface& surface, const std::vector<double>& weighted,
                              const ShapeMass& mass) {
  // relative to its lumped form the mass matrix has eigenvalues between 0.4 (three nodes; 1/3 with two) and 1
  constexpr int sweeps = 12;
  std::vector<double> result = weighted;
  for (int sweep = 1; sweep < sweeps; ++sweep) {
    std::vector<double> product(result.size(), 0.0), lengths(result.size(), 0.0);
    mass(result, product, lengths);
    product = surface.mean(std::move(product), std::move(lengths));
    for (std::size_t node = 0; node < result.size(); ++node) result[node] += weighted[node] - product[node];
  }
  return result;
}

}  // namespace mudline
