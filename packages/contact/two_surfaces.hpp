#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "contact/conjugate_position.hpp"
#include "contact/contact_laws.hpp"
#include "contact/contact_surface.hpp"
#include "contact/master_surface.hpp"
#include "contact/uzawa.hpp"

namespace mudline {

/// Deck entries of all contacts of two deformable surfaces, besides friction.
struct TwoSurfaceParameters : EnforcementParameters {
  std::string slave, master;
  double capture_distance = 0;  // [m] 0: the slave's longest side
  double reach = 0;             // [m] 0: any two sides may meet
  double advance_limit = 0.25;  // [-] of the slave's shortest side
  double damping = 0;           // [s/m]

  explicit TwoSurfaceParameters(Enforcement usual) : EnforcementParameters{usual} {}
  void parameters(Parameters& p);
};

/// Force of nodes or points in a dynamic step. conserving: the share of it that does the work of the penalty spring.
/// interpolated: what the integrator interpolates.
enum class PairImpact { conserving, interpolated };
void declare_impact(Parameters& p, PairImpact& impact);
void declare_corner_angle(Parameters& p, double& angle);  // [deg]

/// InputError unless the deck's "slave" and "master" are two side sets without a common node, and the mesh has the
/// dimension that the contact is for. Collective.
void check_two_sets(const Mesh& mesh, int dimension, const Section& section, const std::string& slave,
                    const std::string& master);

/// Reads the deck's "friction" and "normal law". InputError for laws that read the pore pressure.
void read_laws_of_two(const ContactContext& context, const Section& section, ContactLaws& laws);

/// InputError where the slave is deeper in the master at the start than half its shortest side; `least_gap`: this
/// rank's [m]. Collective.
void check_overlap_of_two(const ContactSurface& slave, const Section& section, const std::string& name,
                          double least_gap);

/// Time step [s] in which two surfaces approach each other by at most `advance_limit` times the slave's shortest side,
/// or by half their distance while they are far apart, at the speeds of the committed state. Collective.
double closing_limit(const Space& space, const ContactSurface& slave, const MasterSurface& master, double advance_limit,
                     const State& committed);

/// Advice to raise "reach" where surfaces met for which the matrix has no entries; else "". `here`: they met on this
/// rank. Collective.
std::string beyond_reach_hint(const Comm& comm, const std::string& name, bool here);

/// Base of the contacts of two deformable surfaces: deck entries, laws and name, and what follows from these alone.
/// Deck derives from TwoSurfaceParameters.
template <class Deck>
class TwoSurfaceContact : public Contact {
 public:
  static void document(Parameters& p) {
    Deck().parameters(p);
    declare_friction(p);
  }
  void parameters(Parameters& p) {
    deck_.parameters(p);
    declare_friction(p);
  }
  std::string name() const override { return "contact/" + name_; }
  ContactPartners partners() const override {
    return {deck_.slave, deck_.master, nullptr, laws_.friction() != nullptr};
  }
  bool asks_for_prediction() const override { return laws_.friction() != nullptr; }
  std::string hint(const StepView&) const override {
    return beyond_reach_hint(*context_.space.mesh().comm(), name_, beyond_reach_);
  }

 protected:
  explicit TwoSurfaceContact(const ContactContext& context) : context_(context) {}
  /// First part of every check(): finds the displacement field and calls check_two_sets().
  void check_surfaces(const Section& section, int dimension) {
    name_ = section.name();
    displacement_ = context_.space.find("displacement");
    if (displacement_ < 0) section.fail("contact needs a model with the field 'displacement'", "type");
    check_two_sets(context_.space.mesh(), dimension, section, deck_.slave, deck_.master);
  }

  ContactContext context_;
  Deck deck_;
  ContactLaws laws_;
  std::string name_;
  int displacement_ = -1;
  bool beyond_reach_ = false;  // surfaces met in this step for which the matrix has no entries
};

/// Base of the contacts of two surfaces whose points press one by one: the slave's nodes or its Gauss points. Impact of
/// such a point adds no energy, see end_share(). Deck has an `impact`, a PairImpact.
template <class Deck>
class PointwisePairContact : public TwoSurfaceContact<Deck> {
 public:
  void predicting(bool on) override { predicting_ = on; }
  void correction(const StepView&, const ResidualView& f) override {
    for (const auto& [dof, share] : correction_) f.add(dof, -share);
  }

 protected:
  using TwoSurfaceContact<Deck>::TwoSurfaceContact;
  /// Positions in which gaps are measured, at both ends of the step.
  struct Positions {
    ConstCoordinateView old, end;
  };
  bool conserves(const StepView& view) const {
    return view.inertia && view.kind == StepView::Kind::step && !this->deck_.augmented() &&
           this->deck_.impact == PairImpact::conserving;
  }
  Positions positions(const StepView& view) const {
    if (!conserves(view)) return {view.x_old, view.x_end};
    const Space& space = this->context_.space;
    return {moved_ahead(space, view.x_old, view.impact.ahead_old),
            moved_ahead(space, view.x_end, view.impact.ahead_end)};
  }

  std::vector<std::pair<int, double>> correction_;  // (dof, share) of the last residual call
  bool predicting_ = false;
};

/// Sums over this rank's part of the slave, and its deepest point.
struct SlaveSums {
  Point force{};       // [N]
  double area = 0;     // [m2]
  double slides = 0;   // [m] length that slides
  double heat = 0;     // [J]
  double damped = 0;   // [J] heat of damping
  double deepest = 0;  // [m] >= 0
};

/// Writes the history columns that all contacts of two surfaces have, under the contact's name. Returns the sums over
/// all ranks. Collective.
SlaveSums report_slave(const Comm& comm, int axes, const std::string& contact, const TwoSurfaceParameters& deck,
                       const SlaveSums& here, Report& values);

}  // namespace mudline
