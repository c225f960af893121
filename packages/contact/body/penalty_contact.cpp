#include "contact/body/penalty_contact.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "core/guarded.hpp"
#include "core/told.hpp"
#include "discretisation/mesh_topology.hpp"
#include "tensor/vec.hpp"

namespace mudline {

void PenaltyParameters::parameters(Parameters& p) {
  p.required("body", body, "Entry of 'bodies' that touches the soil");
  p.required("surface", surface, "Side set of the soil that the body may touch");
  p.choice("method", method, {{"surface quadrature", SideRule::At::gauss}, {"nodes", SideRule::At::nodes}},
           "Where contact is checked: at Gauss points of the sides, or at the nodes with their tributary areas");
  p.add("quadrature degree", quadrature_degree, "-", closed(1, 11),
        "Polynomial degree that the integration over a side is exact for");
  EnforcementParameters::parameters(p);
  p.add("capture distance", capture_distance, "m", non_negative(),
        "Sides farther away than this at the start of a step are skipped in it; 0: two sides and the body's advance");
  drainage.parameters(p);
  initial_gap.parameters(p);
  p.choice(
      "impact", impact,
      {{"automatic", Impact::automatic}, {"conserving", Impact::conserving}, {"interpolated", Impact::interpolated}},
      "Forces over a dynamic step. conserving: points exert the share of their force that adds no "
      "energy, whatever the step and the spectral radius; interpolated: the integrator's mean of start and end, "
      "smoother where a body is pushed "
      "steadily; automatic: conserving for a body that may be free in a contact by penalty, interpolated otherwise");
  p.add("damping", damping, "s/m", non_negative(), damping_documentation);
  ContactLaws::declare_normal_law(p);
  p.add("advance limit", advance_limit, "-", positive(),
        "Largest advance of the body in one step, as a fraction of the surface's shortest side; while the body is far "
        "away, half the distance to the surface");
}

void PenaltyContact::document(Parameters& p) {
  PenaltyParameters().parameters(p);
  declare_friction(p);
}

void PenaltyContact::parameters(Parameters& p) {
  deck_.parameters(p);
  declare_friction(p);
}

void PenaltyContact::check(const Section& section) {
  const Mesh& mesh = context_.space.mesh();
  const auto body = context_.bodies.find(deck_.body);
  if (body == context_.bodies.end()) {
    std::vector<std::string> names;
    for (const auto& entry : context_.bodies) names.push_back(entry.first);
    section.fail("unknown body '" + deck_.body + "'" + suggestion(deck_.body, names), "body");
  }
  body_ = body->second;
  read(section);
  require_boundary(mesh, section, "surface", deck_.surface);
  if (deck_.penalty == 0 && !context_.stiffness)
    throw std::logic_error("an automatic penalty needs the soil's stiffness");
  check_enforcement(section);
  check_quadrature(section);
  laws_.read(context_, section);
  laws_.check_linear(section, deck_.augmented(), deck_.impact == PenaltyParameters::Impact::conserving);
  check_parts(section, deck_.impact == PenaltyParameters::Impact::conserving, deck_.damping > 0);
  damping_ = deck_.damping;
  auto target = std::make_unique<RigidTarget>(body_);
  rigid_ = target.get();
  target_ = std::move(target);
  make_points(deck_.surface, deck_.method, deck_.quadrature_degree);
  if (surface_->num_global_sides() == 0) section.fail("side set '" + deck_.surface + "' has no sides", "surface");
  gap_tolerance_ = deck_.gap_tolerance > 0 ? deck_.gap_tolerance : 1e-6 * surface_->shortest(mesh.coordinates());
  candidates_.assign(sides().size(), {0});
  if (context_.remeshed) return;
  check_overlap(section);
  check_above(section);
}

void PenaltyContact::check_enforcement(const Section& section) const {
  deck_.check(section);
  if (!deck_.augmented()) return;
  if (deck_.impact == PenaltyParameters::Impact::conserving)
    section.fail(
        "conserving is for 'enforcement' = penalty: its shares are those of the penalty spring's energy, which "
        "multipliers "
        "do not have; allowed with augmented Lagrangian: automatic, interpolated",
        "impact");
}

void PenaltyContact::check_quadrature(const Section& section) const {
  const Mesh& mesh = context_.space.mesh();
  if (mesh.dimension() == 2) return;
  if (deck_.method == SideRule::At::nodes)
    section.fail("nodes has no tributary areas on quadratic triangles; allowed in space: surface quadrature", "method");
  constexpr int most = 8;  // largest degree of the rules for triangles
  for (const ElementBlock& block : mesh.blocks())
    for (int s = 0; s < num_sides(block.shape); ++s)
      if (is_simplex(side_shape(block.shape, s)) && deck_.quadrature_degree > most)
        section.fail("on triangles the largest 'quadrature degree' is " + std::to_string(most) + ", given " +
                         std::to_string(deck_.quadrature_degree),
                     "quadrature degree");
}

void PenaltyContact::check_above(const Section& section) const {
  const Mesh& mesh = context_.space.mesh();
  const Teuchos::Comm<int>& comm = *mesh.comm();
  const int up = axes() - 1;
  double lowest = 1e300, everywhere = 0, upwards = 0, faces_up = 0;
  for (const SurfaceSide& side : surface_->sides()) {
    for (int a = 0; a < side.count; ++a) lowest = std::min(lowest, mesh.place(side.node[a])[up]);
    const Point first = mesh.place(side.node[0]), along = mesh.place(side.node[1]) - first;
    // outward: in the plane on the right of the side's direction; in space the corners are counter-clockwise seen from
    // outside
    upwards += up == 1 ? -along[0] : cross(along, mesh.place(side.node[2]) - first)[2];
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, lowest, Teuchos::outArg(everywhere));
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, upwards, Teuchos::outArg(faces_up));
  if (body_->surface() && !std::isfinite(body_->surface()->bounds().extent())) return;  // it goes on for ever
  double top = -1e300;
  for (const Point& point : body_->outline(body_->initial_placement())) top = std::max(top, point[up]);
  if (top >= everywhere - 0.5 * surface_->shortest(mesh.coordinates()) || faces_up <= 0) return;
  char text[160];
  std::snprintf(
      text, sizeof text,
      "' lies below the surface: its top is at %.6g m, the surface reaches down to %.6g m; move its 'position'", top,
      everywhere);
  section.fail("body '" + deck_.body + text, "body");
}

void PenaltyContact::check_overlap(const Section& section) const {
  const auto& x = context_.space.mesh().coordinates();
  const Teuchos::Comm<int>& comm = *context_.space.mesh().comm();
  double deepest = 0;
  Point worst{};
  for (const SurfaceSide& side : surface_->sides())
    for (int a = 0; a < side.count; ++a) {
      const Point at = surface_->mesh().place(side.node[a]);
      const double gap = body_->gap(body_->initial_placement(), at);
      if (gap >= deepest) continue;
      deepest = gap;
      worst = at;
    }
  double everywhere = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, deepest, Teuchos::outArg(everywhere));
  const double edge = surface_->shortest(x);
  // A side that is straight between its nodes reaches a little into a round contour that it follows.
  if (-everywhere <= 0.5 * edge) return;
  const int mine = deepest == everywhere ? comm.getRank() : comm.getSize();
  int teller = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(teller));
  Teuchos::broadcast(comm, teller, 3, worst.data());
  char text[200];
  std::snprintf(text, sizeof text,
                "' overlaps the surface by %.4g m at %s at the start, more than half of its shortest side, %.4g m; "
                "move its 'position'",
                -everywhere, place_text(worst, axes()).c_str(), edge);
  section.fail("body '" + deck_.body + text, "body");
}

void PenaltyContact::declare_state(StateStore& store) {
  body_->declare_state(store);
  declare_points(store);
  std::vector<StateVariable> sums = {{"work", 1, "J"}, {"damping heat", 1, "J"}};
  for (int i = 0; i < axes(); ++i) sums.push_back({std::string("damping ") + axis_names[i], 1, "N"});
  work_ = store.declare(ArrayInfo::of_sum(name() + "/work", sums).not_shown());
}

void PenaltyContact::begin(const StepView& view) {
  begin_parts(view);
  const BodyPlacement from = body_->placement(*view.committed), to = body_->placement(*view.trial);
  // what a free body will do in the step is not known yet
  const double advance = body_->released() ? body_->speed(*view.committed, view.dt) * view.dt
                                           : length(to.centre - from.centre) +
                                                 body_->reach() * length((to.turn * from.turn.inverse()).vector());
  capture_ = deck_.capture_distance > 0 ? deck_.capture_distance : 2 * surface_->longest(view.x_old) + advance;
  rigid_->move(view, false);
  for (std::size_t s = 0; s < sides().size(); ++s)
    candidates_[s] = rigid_->near(surface_->box(s, view.x_old), capture_);
}

bool PenaltyContact::conserves(const StepView& view) const {
  if (!view.inertia || view.kind != StepView::Kind::step) return false;
  if (deck_.impact == PenaltyParameters::Impact::automatic)
    return !deck_.augmented() && !deck_.drainage.has_film() && laws_.normal().linear() && body_->unknowns().count > 0;
  return deck_.impact == PenaltyParameters::Impact::conserving;
}

PenaltyContact::Load PenaltyContact::load_on_soil(const State& state) const {
  Load sum;
  for (int row = 0; row < surface_->rows(); ++row) {
    sum.force += rows_.force(state, row);
    sum.moment += rigid_->moment(rows_.more(state, row));
  }
  return sum;
}

double PenaltyContact::work(const Load& before, const Load& now, const BodyPlacement& from, const BodyPlacement& to) {
  const Point turned = (to.turn * from.turn.inverse()).vector(), moved = to.centre - from.centre;
  return 0.5 * (dot(before.force + now.force, moved) + dot(before.moment + now.moment, turned));
}

int PenaltyContact::residual(const StepView& view, const ResidualView& f) {
  const int failures = PointContact::residual(view, f);
  const State &committed = *view.committed, &trial = *view.trial;
  const PointView &done = trial.arrays[work_], &before = committed.arrays[work_];
  done(0, 0) = before(0, 0) +
               work(load_on_soil(committed), load_on_soil(trial), body_->placement(committed), body_->placement(trial));
  done(0, 1) = before(0, 1) + damped_;
  for (int i = 0; i < axes(); ++i) done(0, 2 + i) = damping_force_[i];
  set_reach(view);
  return failures;
}

void PenaltyContact::set_reach(const StepView& view) {
  close_ = 0;
  if (view.inertia || !body_->released()) return;
  const State& trial = *view.trial;
  double nearest = 1e300, everywhere = 0;
  for (int row = 0; row < surface_->rows(); ++row)
    if (rows_.area(trial, row) > 0)
      nearest = std::min(nearest, rows_.active(trial, row) ? -1.0 : rows_.gap(trial, row));
  Teuchos::reduceAll(*context_.space.mesh().comm(), Teuchos::REDUCE_MIN, nearest, Teuchos::outArg(everywhere));
  if (everywhere >= 0 && everywhere < 1e300) close_ = everywhere + 1e-3 * surface_->shortest(view.x_old);
}

void PenaltyContact::mark_pressed(const State& state, std::vector<char>& nodes) const {
  for (std::size_t s = 0; s < sides().size(); ++s) {
    bool presses = false;
    for (int row = surface_->first_row(s); row < surface_->end_row(s); ++row)
      presses = presses || rows_.active(state, row);
    if (!presses) continue;
    const SurfaceSide& side = sides()[s];
    for (int a = 0; a < side.count; ++a) nodes[side.node[a]] = 1;
  }
}

double PenaltyContact::step_limit(const State& committed, double dt) const {
  const double edge = surface_->shortest(committed.coordinates);
  const double speed = body_->speed(committed, dt);
  rigid_->look_at(committed);
  double nearest = 1e300, everywhere = 0;
  for (std::size_t s = 0; s < sides().size(); ++s)
    nearest = std::min(nearest, rigid_->least_gap(surface_->box(s, committed.coordinates)));
  Teuchos::reduceAll(*context_.space.mesh().comm(), Teuchos::REDUCE_MIN, nearest, Teuchos::outArg(everywhere));
  // a body that is still far away may cover half the distance
  return speed > 0 ? std::max(deck_.advance_limit * edge, 0.5 * everywhere) / speed : 1e300;
}

std::string PenaltyContact::hint(const StepView& view) const {
  if (view.inertia || close_ == 0) return "";
  return "body '" + deck_.body + "' touches nothing in contact '" + name_ +
         "' and has no inertia in a quasi-static stage: hold it, or release it in a dynamic stage";
}

/// Sums of a history over the points of all ranks.
struct PenaltyContact::Sums {
  enum : int {
    reaction,
    friction = 3,
    damping = 6,
    tip = 9,
    area,
    active,
    work,
    heat,
    sliding,
    damping_heat,
    moment,
    count = moment + 3
  };
  double of[count] = {}, deepest = 0;
};

PenaltyContact::Sums PenaltyContact::sums(const State& state) const {
  const PointView& done = state.arrays[work_];
  const Load force = load_on_soil(state);
  Sums here, all;
  double* const local = here.of;
  for (int i = 0; i < axes(); ++i) {
    local[Sums::reaction + i] = -force.force[i];
    local[Sums::damping + i] = -done(0, 2 + i);
  }
  // the points' moments are about the centre of mass
  const Point arm = body_->placement(state).centre - body_->position(state);
  const Point moment = force.moment + cross(arm, force.force);
  for (int i = 0; i < 3; ++i) local[Sums::moment + i] = -moment[i];
  local[Sums::work] = done(0, 0);
  local[Sums::damping_heat] = done(0, 1);
  for (int row = 0; row < surface_->rows(); ++row) {
    const ShearState shear = rows_.shear(state, row);
    for (int i = 0; i < axes(); ++i) local[Sums::friction + i] -= rows_.friction(state, row)[i];
    local[Sums::heat] += shear.dissipated;
    local[Sums::sliding] += shear.slides;
    if (!rows_.active(state, row)) continue;
    if (rigid_->height(rows_.more(state, row)) < body_->tip_height())
      local[Sums::tip] -= rows_.force(state, row)[axes() - 1];
    local[Sums::area] += rows_.area(state, row);
    local[Sums::active] += 1;
    here.deepest = std::max(here.deepest, -rows_.gap(state, row));
  }
  const Teuchos::Comm<int>& comm = *context_.space.mesh().comm();
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(Sums::count), here.of, all.of);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, here.deepest, Teuchos::outArg(all.deepest));
  return all;
}

void PenaltyContact::histories(const StepView& view, Report& values) {
  const State& state = *view.committed;
  const Sums all = sums(state);
  const double* const sum = all.of;
  const auto add_vector = [&](const char* what, int first, const char* unit = "N") {
    for (int i = 0; i < axes(); ++i) values[name() + "/" + what + " " + axis_names[i]] = {unit, sum[first + i]};
  };
  const std::string up = axis_names[axes() - 1];
  add_vector("reaction", Sums::reaction);
  values[name() + "/tip reaction " + up] = {"N", sum[Sums::tip]};
  values[name() + "/shaft reaction " + up] = {"N", sum[Sums::reaction + axes() - 1] - sum[Sums::tip]};
  const bool half = axes() == 2 && body_->contour().extent() == ContourExtent::half;
  if (axes() == 3) add_vector("moment", Sums::moment, "N m");
  if (axes() == 2 && !half) values[name() + "/moment"] = {"N m", sum[Sums::moment + 2]};
  values[name() + "/contact area"] = {"m2", sum[Sums::area]};
  values[name() + "/active points"] = {"-", sum[Sums::active]};
  values[name() + "/maximum penetration"] = {"m", all.deepest};
  values[name() + "/work"] = {"J", sum[Sums::work], true};
  report_parts(state, -1.0, values);
  if (deck_.damping > 0) {
    values[name() + "/damping heat"] = {"J", sum[Sums::damping_heat]};
    add_vector("damping", Sums::damping);
  }
  if (!laws_.friction()) return;
  add_vector("friction", Sums::friction);
  values[name() + "/friction heat"] = {"J", sum[Sums::heat]};
  values[name() + "/sliding points"] = {"-", sum[Sums::sliding]};
}

}  // namespace mudline
