#include "contact/pointwise_pair.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

void PointwiseParameters::declare_rest(Parameters& p) {
  p.choice("impact", impact, {{"conserving", Impact::conserving}, {"interpolated", Impact::interpolated}},
           "Dynamic steps, 'enforcement' = penalty: nodes or points exert the share of their force that does the work "
           "of the penalty spring (no impact adds energy), or what the integrator interpolates");
  drainage.parameters(p);
  initial_gap.parameters(p);
}

void PointwiseParameters::declare_corner_angle(Parameters& p) {
  p.add("corner angle [deg]", corner_angle, "deg", Range{0, 180, true, false},
        "Where straight lines between the master's nodes, in space its faces, turn by more than this at the start, it "
        "has a corner, which stays one");
}

void PointwisePairContact::check_entries(const Section& section, int dimension) {
  read(section);
  check_two_sets(context_.space.mesh(), dimension, section, deck_.slave, deck_.master);
  deck_.check(section);
  if (deck_.augmented() && section.has_parameter("impact"))
    section.fail("has a meaning only with 'enforcement' = penalty: its shares are those of the penalty spring's energy",
                 "impact");
  laws_.read(context_, section);
  check_heat_share(context_, section, laws_);
  const bool conserving = deck_.impact == PointwiseParameters::Impact::conserving;
  check_parts(section, section.has_parameter("impact") && conserving, deck_.damping > 0);
  laws_.check_linear(section, deck_.augmented(), conserving);
}

void PointwisePairContact::bind(const Section& section, std::unique_ptr<DeformableTarget> target, SideRule::At kind,
                                int quadrature_degree, double reach) {
  const ConstCoordinateView x = context_.space.mesh().coordinates();
  target->bind(context_.space, displacement_);
  master_ = target.get();
  target_ = std::move(target);
  damping_ = deck_.damping;
  at_nodes_ = kind == SideRule::At::nodes;
  make_points(deck_.slave, kind, quadrature_degree);
  points_.resize(surface_->rows());
  measure_points(x);
  const double longest = surface_->longest(x);
  reach_ = reach;
  gap_tolerance_ = deck_.gap_tolerance > 0 ? deck_.gap_tolerance : 1e-6 * surface_->shortest(x);
  capture_ = deck_.capture_distance > 0 ? deck_.capture_distance : longest;
  double least = 0;
  for (std::size_t s = 0; s < sides().size(); ++s) {
    candidates_.push_back(target_->near(surface_->box(s, x), 4 * longest));
    for (int row = surface_->first_row(s); row < surface_->end_row(s); ++row) {
      const Point at = rule(sides()[s]).place(row - surface_->first_row(s), side_coordinates(sides()[s], x));
      TargetPlace place;
      if (points_[row].area > 0 && target_->find(candidates_[s], at, points_[row].outward, 4 * longest, x, place))
        least = std::min(least, place.gap);
    }
  }
  if (!context_.remeshed) check_overlap_of_two(*surface_, section, deck_.slave, least);
}

void PointwisePairContact::declare_state(StateStore& store) {
  declare_points(store);
  if (deck_.damping > 0) heat_ = store.declare(ArrayInfo::of_sum(name() + "/damping", {{"heat", 1, "J"}}).not_shown());
}

void PointwisePairContact::measure_points(const ConstCoordinateView& x) {
  std::size_t row = 0;
  for (const SurfaceSide& side : sides()) {
    const ContactRule& points = rule(side);
    const SideCoordinates at = side_coordinates(side, x);
    double areas[max_contact_points], lengths[max_contact_points];
    point_areas(points, at, context_.space.mesh().geometry(), areas);
    if (at_nodes_) point_areas(points, at, Geometry::plane_strain, lengths);
    for (int c = 0; c < points.points; ++c, ++row) {
      SlavePoint& here = points_[row];
      here.area = areas[c];
      if (at_nodes_) {
        here.share = lengths[c];
        // a corner of a quadratic side on the axis has no area: nothing can press there
        if (areas[c] < 1e-9 * lengths[c] * lengths[c]) here.area = 0;
      }
      here.outward = points.outward(c, at);
    }
  }
}

bool PointwisePairContact::measure(std::size_t side, const SideCoordinates&, const SideCoordinates&, bool,
                                   PointAreas& areas) const {
  areas.fixed = true;
  for (int row = surface_->first_row(side); row < surface_->end_row(side); ++row)
    areas.now[row - surface_->first_row(side)] = points_[row].area;
  return true;
}

void PointwisePairContact::begin(const StepView& view) {
  begin_parts(view);
  target_->look_at(*view.committed);
  measure_points(view.x_old);
  const double longest = surface_->longest(view.x_old);
  capture_ = deck_.capture_distance > 0 ? deck_.capture_distance : longest;
  touch_ = deck_.drainage.has_film() ? 0 : 1e-9 * longest;  // a film is stiff where surfaces just touch
  for (std::size_t s = 0; s < candidates_.size(); ++s)
    candidates_[s] = target_->near(surface_->box(s, view.x_old), 2 * capture_);
}

bool PointwisePairContact::conserves(const StepView& view) const {
  return view.inertia && view.kind == StepView::Kind::step && !deck_.augmented() && !deck_.drainage.has_film() &&
         deck_.impact == PointwiseParameters::Impact::conserving;
}

int PointwisePairContact::residual(const StepView& view, const ResidualView& f) {
  const int failures = PointContact::residual(view, f);
  if (heat_ >= 0) view.trial->arrays[heat_](0, 0) = view.committed->arrays[heat_](0, 0) + damped_;
  return failures;
}

bool PointwisePairContact::lengths(std::size_t side, const State& state, double* of_points) const {
  if (!at_nodes_) return PointContact::lengths(side, state, of_points);
  for (int row = surface_->first_row(side); row < surface_->end_row(side); ++row)
    of_points[row - surface_->first_row(side)] = share(row);
  return true;
}

Point PointwisePairContact::initial_shear_multiplier(const State& committed, int row) const {
  return at_nodes_ ? rows_.shear(committed, row).shear : PointContact::initial_shear_multiplier(committed, row);
}

Augmentation PointwisePairContact::augment(const StepView& view, int count) {
  if (!deck_.augmented() || !at_nodes_) return PointContact::augment(view, count);
  const State& trial = *view.trial;
  const Comm& comm = *context_.space.mesh().comm();
  if (const auto end = end_of_augmentation(name_, deck_, gap_tolerance_, misfit(trial), count, comm)) return *end;
  for (int row = 0; row < surface_->rows(); ++row) {
    rows_.normal_multiplier(trial, row) = rows_.pressure(trial, row);
    if (laws_.friction()) rows_.set_shear_multiplier(trial, row, rows_.shear(trial, row).shear);
  }
  return {true, ""};
}

std::string PointwisePairContact::hint(const StepView&) const {
  return beyond_reach_hint(*context_.space.mesh().comm(), name_, beyond_reach_);
}

void PointwisePairContact::histories(const StepView& view, Report& values) {
  const State& state = *view.committed;
  SlaveSums here;
  for (int row = 0; row < surface_->rows(); ++row) {
    const ShearState shear = rows_.shear(state, row);
    here.force += rows_.force(state, row);
    here.slides += shear.slides;
    here.heat += shear.dissipated;
    if (!rows_.active(state, row)) continue;
    here.area += rows_.area(state, row);
    here.deepest = std::max(here.deepest, -rows_.gap(state, row));
  }
  if (heat_ >= 0) here.damped = state.arrays[heat_](0, 0);
  const SlaveSums all = report_slave(*context_.space.mesh().comm(), axes(), name(), deck_, here, values);
  report_parts(state, 1.0, values);
  if (laws_.friction()) values[name() + "/friction heat"] = {"J", all.heat};
  if (laws_.friction() && axes() == 3) values[name() + "/sliding points"] = {"-", all.slides};
}

double PointwisePairContact::step_limit(const State& committed, double) const {
  return closing_limit(context_.space, *surface_, master_->sides(), deck_.advance_limit, committed);
}

}  // namespace mudline
