#pragma once

#include "simulation/model.hpp"

namespace mudline {

/// Report of the last step: active terms, contacts that do not act, reactions of conditions, what drives bodies.
/// Collective.
Report report_of_step(Model& model);

/// Report of the contacts alone, in the committed state. Collective.
Report report_of_contacts(const Model& model);

}  // namespace mudline
