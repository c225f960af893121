#pragma once

#include "simulation/model.hpp"
#include "simulation/output_settings.hpp"

namespace mudline {

/// Refuses a deck whose entries are right one by one but not together: conditions that contradict each other on a
/// shared node, motions that a stage cannot give, parts of the mesh and released bodies that nothing holds, and entries
/// that nothing uses. Asks for the model before its first step. InputError on every rank alike. Collective.
void check_deck(Model& model, const Section& deck);

/// Refuses what the section "output" asks of a model that cannot give it: probes outside the mesh or at nodes that
/// remeshing loses, and error estimates without soil. InputError.
void check_output(const Model& model, const OutputSettings& output, const Section& deck);

}  // namespace mudline
