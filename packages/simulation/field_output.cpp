#include "simulation/field_output.hpp"

#include <cmath>

#include "simulation/output/collective.hpp"
#include "simulation/stage.hpp"
#include "simulation/state_fields.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Outline of a body in its initial position, as it is drawn; it does not depend on the mesh.
BodyOutline outline_of(const RigidBody& body) {
  BodyOutline outline;
  if (body.surface()) {
    outline = body.surface()->triangles(5e-4 * body.reach());
  } else {
    for (const PlanePoint& point : body.contour().sample(2e-4 * body.reach()))
      outline.points.push_back({point[0], point[1], 0});
    // a half contour is closed along its axis, so that pictures fill the body
    if (body.contour().extent() == ContourExtent::half && !outline.points.empty())
      outline.points.push_back({0, outline.points.back()[1], 0});
  }
  const BodyPlacement start = body.initial_placement();
  const Point at = body.initial_position();
  for (Point& point : outline.points) point = start.turn(point) + at;
  return outline;
}

BodyPose pose_of(const RigidBody& body, const State& state) {
  const BodyPlacement now = body.placement(state), start = body.initial_placement();
  return {now.centre - start.centre, now.turn * start.turn.inverse(), start.centre};
}

}  // namespace

void FieldOutput::open(const Model& model) {
  file_ = std::make_unique<FieldFile>(model.mesh(), settings_.stem(), restart_,
                                      model.remeshed() ? model.remeshed()->number : 0);
  file_->set_metadata("deck", origin_.deck);
  file_->set_metadata("deck file", origin_.deck_file);
  file_->set_metadata("program", origin_.program);
  file_->set_metadata("geometry", mudline::name(model.mesh().geometry()));
  for (const auto& [name, body] : model.bodies()) file_->add_body(name, outline_of(*body));
}

void FieldOutput::begin_run(const RunView& run) {
  open(run.model);
  if (!run.resumed) write(run, "start");
}

void FieldOutput::begin_stage(const RunView& run) { next_time_ = time_after(run); }

double FieldOutput::time_after(const RunView& run) const {
  const double interval = settings_.field_interval, time = run.state.time;
  if (interval <= 0) return time;
  const double passed = std::floor((time - run.stage_start) / interval * (1 + 1e-12));
  // an interval below the resolution of the time counts as reached at every moment
  return passed < 1e12 ? run.stage_start + (passed + 1) * interval : time;
}

void FieldOutput::step(const RunView& run) {
  const bool by_time = settings_.field_interval > 0 && run.state.time >= next_time_ * (1 - 1e-12);
  const bool by_step = settings_.field_steps > 0 && run.step % settings_.field_steps == 0;
  if (by_time || by_step || run.at_end) write(run, run.stage.name);
  if (by_time) next_time_ = time_after(run);
}

void FieldOutput::end_stage(const RunView& run) {
  if (run.lost_factor > 0 && written_step_ != run.step) write(run, run.stage.name);
}

void FieldOutput::remeshed(const RunView& run) {
  restart_ = FieldRestart{num_steps(), run.state.time, false, marks(), true};
  file_.reset();
  open(run.model);
}

void FieldOutput::end_run(const RunView& run, RunEnd end) {
  if (end == RunEnd::failed) write(run, run.stage.name);
  if (end == RunEnd::done) {
    const Comm& comm = *run.model.mesh().comm();
    std::string lost = comm.getRank() == 0 ? file_->missing() : "";
    if (!lost.empty()) lost += ": the file was removed by another program while the run went on";
    end_where_lost(raw_communicator(comm), lost);
  }
  file_->complete();
}

void FieldOutput::write(const RunView& run, const std::string& stage) {
  written_step_ = run.step;
  const Mesh& mesh = run.model.mesh();
  std::vector<double> coordinates;
  for (int node = 0; node < mesh.num_owned_nodes(); ++node)
    for (int i = 0; i < mesh.dimension(); ++i) coordinates.push_back(run.state.coordinates(node, i));
  std::map<std::string, BodyPose> bodies;
  for (const auto& [name, body] : run.model.bodies()) bodies[name] = pose_of(*body, run.state);
  std::vector<OutputField> cells = mudline::cell_fields(run.model);
  for (const auto& observer : observers_)
    call(*observer, run.model, [&](Observer& one) { one.cell_fields(run, cells); });
  file_->write(run.state.time, run.step, stage, coordinates, nodal_fields(run.model, run.pressure), cells, bodies);
}

}  // namespace mudline
