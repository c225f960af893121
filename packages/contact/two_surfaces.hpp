#pragma once

#include <memory>
#include <string>

#include "contact/contact.hpp"
#include "contact/contact_surface.hpp"
#include "contact/master_surface.hpp"

namespace mudline {

/// What all contacts of two deformable surfaces ask of the deck's "slave" and "master": two side sets without a common node.
/// InputError. Collective.
void check_two_sets(const Mesh& mesh, const Section& section, const std::string& slave, const std::string& master);

/// The deck's "friction"; null where there is none. InputError for friction on the effective traction of surfaces with pore
/// pressure, which two surfaces do not know.
std::unique_ptr<const Friction> friction_of_two(const ContactContext& context, const Section& section);

/// InputError where the slave is deeper in the master at the start than half its shortest side; `least_gap`: this rank's [m].
/// Collective.
void check_overlap_of_two(const ContactSurface& slave, const Section& section, const std::string& name, double least_gap);

/// Step in which two surfaces come nearer by at most `advance_limit` times the slave's shortest side, or by half their distance
/// while they are far apart [s], at the speeds of the committed state. Collective.
double closing_limit(const Space& space, const ContactSurface& slave, const MasterSurface& master, double advance_limit, const State& committed);

}  // namespace mudline
