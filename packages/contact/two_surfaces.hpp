#pragma once

#include <memory>
#include <string>

#include "contact/contact_laws.hpp"
#include "contact/contact_surface.hpp"
#include "contact/master_surface.hpp"
#include "contact/uzawa.hpp"

namespace mudline {

/// What the deck says of all contacts of two deformable surfaces, besides friction.
struct TwoSurfaceParameters : EnforcementParameters {
  std::string slave, master;
  double capture_distance = 0;  // [m] 0: the slave's longest side
  double reach = 0;             // [m] 0: any two may meet
  double advance_limit = 0.25;  // [-] of the slave's shortest side
  double damping = 0;           // [s/m]

  explicit TwoSurfaceParameters(Enforcement usual) : EnforcementParameters{usual} {}
  void parameters(Parameters& p);
};

/// Whether nodes or points exert the share of their force that does the work of the penalty spring, or what the
/// integrator interpolates.
enum class PairImpact { conserving, interpolated };
void declare_impact(Parameters& p, PairImpact& impact);
void declare_corner_angle(Parameters& p, double& angle);  // [deg]

/// What all contacts of two deformable surfaces ask of the deck's "slave" and "master": two side sets without a common
/// node, of a mesh of the dimension that the contact is for. InputError. Collective.
void check_two_sets(const Mesh& mesh, int dimension, const Section& section, const std::string& slave,
                    const std::string& master);

/// The deck's "friction" and "normal law". InputError for laws that read the pore pressure.
void read_laws_of_two(const ContactContext& context, const Section& section, ContactLaws& laws);

/// InputError where the slave is deeper in the master at the start than half its shortest side; `least_gap`: this
/// rank's [m]. Collective.
void check_overlap_of_two(const ContactSurface& slave, const Section& section, const std::string& name,
                          double least_gap);

/// Step in which two surfaces come nearer by at most `advance_limit` times the slave's shortest side, or by half their
/// distance while they are far apart [s], at the speeds of the committed state. Collective.
double closing_limit(const Space& space, const ContactSurface& slave, const MasterSurface& master, double advance_limit,
                     const State& committed);

/// The advice where surfaces met that the matrix has no place for; `here`: on this rank. Collective.
std::string beyond_reach_hint(const Comm& comm, const std::string& name, bool here);

/// Sums over this rank's part of the slave, and its deepest point.
struct SlaveSums {
  Point force{};       // [N]
  double area = 0;     // [m2]
  double slides = 0;   // [m] length
  double heat = 0;     // [J]
  double damped = 0;   // [J] heat of damping
  double deepest = 0;  // [m] >= 0
};

/// Writes the columns that all contacts of two surfaces have under the contact's name; the other sums of all ranks are
/// returned. Collective.
SlaveSums report_slave(const Comm& comm, int axes, const std::string& contact, const TwoSurfaceParameters& deck,
                       const SlaveSums& here, Report& values);

}  // namespace mudline
