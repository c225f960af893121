#pragma once

#include <vector>

#include "simulation/excess_pressure.hpp"
#include "simulation/model.hpp"
#include "simulation/output/field_file.hpp"
#include "simulation/output/history_file.hpp"

namespace mudline {

/// The committed state as fields at the nodes: unknowns with their rates, excess pore pressures, tractions of contacts,
/// and the arrays that are not hidden and whose rows are at nodes or on surfaces. Collective.
std::vector<OutputField> nodal_fields(const Model& model, const ExcessPressure& pressure);

/// Sums and single rows of the committed state that are not hidden, "<array>/<variable>". Collective.
std::vector<HistoryValue> state_sums(const Model& model);

/// The committed state as means over the points of each element: stresses, void ratios, all variables of laws.
std::vector<OutputField> cell_fields(const Model& model);

}  // namespace mudline
