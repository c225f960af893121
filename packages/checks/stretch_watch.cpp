#include "checks/stretch_watch.hpp"

#include "core/log.hpp"
#include "integrator/overlap.hpp"
#include "simulation/pressed_sides.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

const char* const stretch = "stretched sides";

/// Whether the length of the sides is that of the mesh at the start, stretched.
bool keeps_topology(const Model& model) { return model.ale() == nullptr || model.ale()->remeshing() == nullptr; }

}  // namespace

void StretchWatch::declare(Doubts& doubts) {
  doubts.declare({stretch,
                  "-",
                  {0, 8},
                  "of the soil's surface at a body that moves, on a mesh that is not remeshed: length of the longest "
                  "over that in the mesh at the start"});
}

StretchWatch::Record StretchWatch::longest(const Model& model, const Contact& contact) {
  const State& state = model.store().committed();
  Record own;
  for (const Side& side : pressed_sides(model, contact)) {
    const ElementBlock& block = model.mesh().blocks()[side.block];
    const std::vector<int>& local = side_nodes(block.shape, side.side);
    const int corners = num_corners(side_shape(block.shape, side.side)), edges = corners == 2 ? 1 : corners;
    for (int c = 0; c < edges; ++c) {
      const int node = block.nodes(side.element, local[c]), next = block.nodes(side.element, local[(c + 1) % corners]);
      const double before = length(model.mesh().place(node) - model.mesh().place(next)),
                   now = length(place_of(state.coordinates, node) - place_of(state.coordinates, next));
      if (now > own.ratio * before) own = {now / before, before, now, state.time};
    }
  }
  const Comm& comm = *model.mesh().comm();
  const double most = max_over_ranks(comm, own.ratio);
  const bool here = own.ratio == most && most > 0;
  // where several ranks have it, that with the shortest side tells
  constexpr double none = 1e300;
  const double before = min_over_ranks(comm, here ? own.before : none);
  return {most, before, most * before, state.time};
}

void StretchWatch::step(const RunView& run) {
  if (!keeps_topology(run.model) || run.stage.type == Stage::Type::geostatic) return;
  for (const auto& [name, contact] : run.model.contacts()) {
    const RigidBody* const body = contact->partners().body;
    if (body == nullptr || !(length(body->velocity(run.state)) > 0)) continue;
    const Record now = longest(run.model, *contact);
    if (now.ratio > records_[name].ratio) records_[name] = now;
  }
}

void StretchWatch::end_run(const RunView&, RunEnd end) {
  if (end != RunEnd::done) return;
  for (const auto& [name, record] : records_) {
    const std::string line =
        doubts_.line(stretch, record.ratio,
                     "contact '" + name +
                         "': the length of the longest side at the body over that in the mesh at the "
                         "start, " +
                         readable(record.now, "m", 3) + " over " + readable(record.before, "m", 3) + " at t " +
                         told(record.time, "%.6g") + " s on a mesh that keeps its topology,",
                     "pressures and friction along the wall are not to be read; give 'mesh motion/remeshing' a 'wall "
                     "size', with which the sides there keep their length");
    if (!line.empty()) log::warn(line);
  }
}

}  // namespace mudline
