#pragma once

#include <string>
#include <utility>
#include <vector>

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
  double heat_share = 0.5;      // [-] of the heat of friction, for the slave

  explicit TwoSurfaceParameters(Enforcement usual) : EnforcementParameters{usual} {}
  void parameters(Parameters& p);
};

/// InputError unless the deck's "slave" and "master" are two side sets without a common node, and the mesh has the
/// dimension that the contact is for. Collective.
void check_two_sets(const Mesh& mesh, int dimension, const Section& section, const std::string& slave,
                    const std::string& master);

/// InputError where 'slave heat share' has no meaning: without friction or without a temperature.
void check_heat_share(const ContactContext& context, const Section& section, const ContactLaws& laws);

/// InputError where the slave is deeper in the master at the start than half its shortest side; `least_gap`: this
/// rank's [m]. Collective.
void check_overlap_of_two(const ContactSurface& slave, const Section& section, const std::string& name,
                          double least_gap);

/// Time step [s] in which two surfaces approach each other by at most `advance_limit` times the slave's shortest side,
/// or by half their distance while they are far apart, at the speeds of the committed state. Collective.
double closing_limit(const Space& space, const ContactSurface& slave,
                     const std::vector<MasterSurface::MasterSide>& master, double advance_limit,
                     const State& committed);

/// Advice to raise "reach" where surfaces met for which the matrix has no entries; else "". `here`: they met on this
/// rank. Collective.
std::string beyond_reach_hint(const Comm& comm, const std::string& name, bool here);

/// Declares the entries of a contact of two surfaces, of the type Deck, and "friction".
template <class Deck>
void declare_with_friction(Parameters& p, Deck&& deck) {
  deck.parameters(p);
  declare_friction(p);
}

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
