#include "contact/pointwise_pair.hpp"

#include <algorithm>
#include <cmath>

#include "contact/conjugate_position.hpp"
#include "contact/laws/impact_share.hpp"

namespace mudline {

namespace {

/// Columns that points against a deformable target have: where on it they are, and in space its normal.
namespace column {
enum : int { piece, at, normal = at + 2 };
}

}  // namespace

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
  read_laws_of_two(context_, section, laws_);
  const bool conserving = deck_.impact == PointwiseParameters::Impact::conserving;
  check_parts(section, section.has_parameter("impact") && conserving, deck_.damping > 0);
  laws_.check_linear(section, deck_.augmented(), conserving);
}

void PointwisePairContact::bind(const Section& section, std::unique_ptr<Target> target, ContactPoints kind,
                                int quadrature_degree, double reach) {
  const ConstCoordinateView x = context_.space.mesh().coordinates();
  target_ = std::move(target);
  at_nodes_ = kind == ContactPoints::nodes;
  make_points(deck_.slave, BodyUnknowns(), kind, quadrature_degree);
  for (std::size_t s = 0; s < sides().size(); ++s)
    for (int c = 0; c < PointContact::rule(sides()[s]).points; ++c) points_.push_back({static_cast<int>(s), c});
  measure(x);
  const double longest = surface_->longest(x);
  reach_ = reach;
  gap_tolerance_ = deck_.gap_tolerance > 0 ? deck_.gap_tolerance : 1e-6 * surface_->shortest(x);
  capture_ = 4 * longest;
  for (const SurfaceSide& side : sides())
    candidates_.push_back(target_->near(side_box(side.node, side.count, x), capture_));
  double least = 0;
  Seen seen;
  for (int row = 0; row < rows(); ++row)
    if (look(row, x, seen)) least = std::min(least, seen.closest.gap);
  if (!context_.remeshed) check_overlap_of_two(*surface_, section, deck_.slave, least);
  capture_ = deck_.capture_distance > 0 ? deck_.capture_distance : longest;
}

void PointwisePairContact::declare_state(StateStore& store) {
  std::vector<StateVariable> more;
  for (const char* of_target : {"piece", "place 1", "place 2", "normal x", "normal y", "normal z"})
    if (axes() == 3 || more.size() < 2) more.push_back({of_target, 1, "-", Transfer::nearest});
  declare_points(store, more);
  if (deck_.damping > 0)
    damping_ = store.declare(ArrayInfo::of_sum(name() + "/damping", {{"heat", 1, "J"}}).not_shown());
}

int PointwisePairContact::entry(int row, int piece) const {
  const auto found = entries_.find(static_cast<long long>(points_[row].side) << 32 | piece);
  return found == entries_.end() ? -1 : found->second;
}

void PointwisePairContact::sparsity(Assembler& assembler) {
  // every side and piece within reach have their matrix entries from the start: the graph, and with it the order of all
  // sums, never changes
  const auto& x = surface_->mesh().coordinates();
  std::vector<std::pair<const SurfaceSide*, TargetNodes>> pairs;
  int most = 0;
  for (std::size_t s = 0; s < sides().size(); ++s) {
    const SurfaceSide& side = sides()[s];
    for (int piece : target_->near(side_box(side.node, side.count, x), reach_)) {
      entries_[static_cast<long long>(s) << 32 | piece] = static_cast<int>(pairs.size());
      pairs.emplace_back(&side, target_->nodes(piece));
      most = std::max(most, axes() * (side.count + pairs.back().second.count) + surface_->pressure_nodes(side.shape));
    }
  }
  Kokkos::View<int**, Kokkos::LayoutRight> table("contact dofs", pairs.size(), most);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto& [side, piece] = pairs[p];
    int* const first = &table(p, 0);
    int* to = context_.space.write_dofs(displacement_, side->node, side->count, first);
    to = context_.space.write_dofs(displacement_, piece.node, piece.count, to);
    to = context_.space.write_dofs(pressure_, side->node, surface_->pressure_nodes(side->shape), to);
    std::fill(to, first + most, *first);  // nothing is added there
  }
  dofs_ = table;
  group_ = assembler.add_group(dofs_);
  if (leak_) leak_->sparsity(assembler);
}

Point PointwisePairContact::place(int row, const ConstCoordinateView& x) const {
  return rule(row).place(points_[row].point, side_coordinates(side(row), x));
}

void PointwisePairContact::measure(const ConstCoordinateView& x) {
  std::size_t row = 0;
  for (const SurfaceSide& side : sides()) {
    const ContactRule& points = PointContact::rule(side);
    const SideCoordinates at = side_coordinates(side, x);
    double areas[max_contact_points], lengths[max_contact_points];
    contact_areas(points, at, context_.space.mesh().geometry(), areas);
    if (at_nodes_) contact_areas(points, at, Geometry::plane_strain, lengths);
    for (int c = 0; c < points.points; ++c, ++row) {
      SlavePoint& here = points_[row];
      here.area = areas[c];
      if (at_nodes_) {
        here.share = lengths[c];
        // a corner of a quadratic side on the axis has no area: nothing can press there
        if (areas[c] < 1e-9 * lengths[c] * lengths[c]) here.area = 0;
      }
      if (axes() == 2) {
        here.outward = {at[1][1] - at[0][1], at[0][0] - at[1][0], 0};
      } else {
        SideMap<3> map;
        map.compute(side.count, &points.shape(c, 0), &points.shape_slope(c, 0), [&](int a, int i) { return at[a][i]; });
        here.outward = {map.normal[0], map.normal[1], map.normal[2]};
      }
    }
  }
}

void PointwisePairContact::begin(const StepView& view) {
  begin_parts(view);
  target_->update(view.x_old);
  measure(view.x_old);
  const double longest = surface_->longest(view.x_old);
  capture_ = deck_.capture_distance > 0 ? deck_.capture_distance : longest;
  touch_ = deck_.drainage.has_film() ? 0 : 1e-9 * longest;  // a film is stiff where surfaces just touch
  for (std::size_t s = 0; s < candidates_.size(); ++s) {
    const SurfaceSide& side = sides()[s];
    candidates_[s] = target_->near(side_box(side.node, side.count, view.x_old), 2 * capture_);
  }
}

bool PointwisePairContact::may_be_near(const State& committed, std::size_t side, double distance) const {
  const SurfaceSide& at = sides()[side];
  return !target_->near(side_box(at.node, at.count, committed.coordinates), distance).empty();
}

std::optional<PointContact::Nearest> PointwisePairContact::nearest(const State& committed, std::size_t,
                                                                   const Point& place, const Point& outward,
                                                                   double distance) const {
  const ConstCoordinateView x = committed.coordinates;
  TargetPlace at;
  if (!target_->find(target_->near({place, place}, distance), place, outward, distance, x, at)) return std::nullopt;
  const ClosestPoint closest = target_->closest(at, place, x);
  return Nearest{closest.gap, closest.normal, at};
}

void PointwisePairContact::write_first(const State& committed, int row, const Point&, const Nearest& nearest,
                                       ContactPoint& point) const {
  write(committed, row, point, nearest.at, nearest.normal);
}

bool PointwisePairContact::conserves(const StepView& view) const {
  return view.inertia && view.kind == StepView::Kind::step && !deck_.augmented() && !deck_.drainage.has_film() &&
         deck_.impact == PointwiseParameters::Impact::conserving;
}

PointwisePairContact::Positions PointwisePairContact::positions(const StepView& view) const {
  if (!conserves(view)) return {view.x_old, view.x_end};
  return {moved_ahead(context_.space, view.x_old, view.impact.ahead_old),
          moved_ahead(context_.space, view.x_end, view.impact.ahead_end)};
}

bool PointwisePairContact::look(int row, const ConstCoordinateView& x, Seen& seen) const {
  const SlavePoint& here = points_[row];
  const Point at = place(row, x);
  if (!(here.area > 0) || !target_->find(candidates_[here.side], at, here.outward, capture_, x, seen.at)) return false;
  seen.closest = target_->closest(seen.at, at, x);
  seen.entry = entry(row, seen.at.piece);
  return true;
}

ContactPointLaw PointwisePairContact::law(const StepView& view, int row) const {
  ContactPointLaw result = PointContact::law(view, points_[row].side, deck_.damping);
  result.touch = touch_;
  result.conserves = conserves(view);
  return result;
}

TargetForce PointwisePairContact::evaluate(const StepView& view, const Positions& at, int row, const Seen& seen,
                                           const SideFilm& film, bool want_tangent) const {
  ContactPointLaw acting = law(view, row);
  const SlavePoint& here = points_[row];
  const TargetNodes nodes = target_->nodes(seen.at.piece);
  Point before[max_target_nodes];
  for (int a = 0; a < nodes.count; ++a) before[a] = place_of(at.old, nodes.node[a]);
  TargetPoint point{acting, seen.closest, before, place(row, at.old), here.area};
  point.old = history(view, here.side, row, point.place_old);
  point.gap_old = rows_.gap(*view.committed, row);
  point.pore_pressure = point.old.soil.pore_pressure + pore_pressure(here.side, here.point, view.value_end);
  point.film = film;
  acting.film = film.acts;
  if (film.flows) {
    Seen start;
    point.gap_old = look(row, at.old, start) ? start.closest.gap - point.old.offset : capture_;
  }
  if (axes() == 2) return target_force<2>(point, want_tangent);
  const double* const normal = rows_.more(*view.committed, row) + column::normal;
  point.normal_old = {normal[0], normal[1], normal[2]};
  return target_force<3>(point, want_tangent);
}

TargetColumns PointwisePairContact::columns(int row, int piece, const double* of_target) const {
  const int slave = side(row).count, target = target_->nodes(piece).count;
  TargetColumns result{slave, slave + target, {}};
  std::copy_n(&rule(row).shape(points_[row].point, 0), slave, result.weight);
  for (int a = 0; a < target; ++a) result.weight[slave + a] = -of_target[a];
  return result;
}

void PointwisePairContact::write(const State& trial, int row, const ContactPoint& point, const TargetPlace& at,
                                 const Point& normal) const {
  write_point(trial, row, point);
  double* const more = rows_.more(trial, row);
  more[column::piece] = at.piece;
  std::copy_n(at.at, axes() - 1, more + column::at);
  if (axes() == 3) std::copy_n(normal.data(), 3, more + column::normal);
}

void PointwisePairContact::write_away(const StepView& view, int row) const {
  write(*view.trial, row, away(*view.committed, row, capture_), TargetPlace(), {});
}

void PointwisePairContact::remember(int entry, const TargetColumns& columns, double factor, const Point& force) {
  for (int k = 0; k < columns.count; ++k)
    for (int i = 0; i < axes(); ++i)
      correction_.emplace_back(dofs_(entry, axes() * k + i), factor * columns.weight[k] * force[i]);
}

int PointwisePairContact::residual(const StepView& view, const ResidualView& f) {
  correction_.clear();
  const Positions at = positions(view);
  int failures = 0;
  double damped = 0;
  for (int row = 0; row < rows(); ++row) {
    Seen seen;
    if (!look(row, at.end, seen)) {
      write_away(view, row);
      add_old_share(view, row, start_share(rows_.gap(*view.committed, row), capture_, view.impact.damping));
      continue;
    }
    const SideFilm water = film(view, points_[row].side);
    const TargetForce force = evaluate(view, at, row, seen, water, false);
    const ContactPoint& point = force.point;
    add_old_share(view, row, force.start_share);
    if (seen.entry < 0) {
      failures += force.acts;
      write_away(view, row);
      continue;
    }
    const TargetColumns w = columns(row, seen.at.piece, seen.closest.weight);
    if (force.acts) {
      const bool pressed = point.active || !water.acts;
      const double cancelled =
          pressed ? stiffness(*view.trial, row) * points_[row].area * length(place(row, at.end)) : 0.0;
      for (int k = 0; k < w.count; ++k)
        for (int i = 0; i < axes(); ++i) {
          if (w.weight[k] == 0) continue;
          const int dof = dofs_(seen.entry, axes() * k + i);
          f.add(dof, -w.weight[k] * point.total.force[i]);
          f.cancelled(dof, std::abs(w.weight[k]) * cancelled);
        }
      if (force.share != 1) remember(seen.entry, w, view.end_weight * (force.share - 1), point.total.force);
    }
    if (point.damped != 0) remember(seen.entry, w, 1, point.damping);
    add_film(view, row, seen, water, force, f);
    damped += point.damped;
    write(*view.trial, row, point, seen.at, seen.closest.normal);
  }
  if (damping_ >= 0) view.trial->arrays[damping_](0, 0) = view.committed->arrays[damping_](0, 0) + damped;
  beyond_reach_ = failures > 0;
  return failures;
}

void PointwisePairContact::correction(const StepView& view, const ResidualView& f) {
  for (const auto& [dof, force] : correction_) f.add(dof, -force);
  if (leak_) leak_->add(view, f);
}

int PointwisePairContact::old_piece(const State& committed, int row) const {
  return static_cast<int>(rows_.more(committed, row)[column::piece]);
}

TargetColumns PointwisePairContact::old_columns(const State& committed, int row) const {
  double weight[max_target_nodes];
  const int piece = old_piece(committed, row);
  target_->weights(piece, rows_.more(committed, row) + column::at, weight);
  return columns(row, piece, weight);
}

void PointwisePairContact::add_old_share(const StepView& view, int row, double share) {
  const State& committed = *view.committed;
  if (!conserves(view) || !(rows_.pressure(committed, row) > 0)) return;
  if (const int there = entry(row, old_piece(committed, row)); there >= 0)
    remember(there, old_columns(committed, row), share - (1 - view.end_weight), rows_.force(committed, row));
}

int PointwisePairContact::first_pressure(int row, const Seen& seen) const {
  return axes() * (side(row).count + seen.closest.nodes);
}

void PointwisePairContact::pressure_slopes_at(const StepView& view, int row, Point* slope) const {
  const SideCoordinates x_old = side_coordinates(side(row), view.x_old);
  const int nodes = surface_->pressure_nodes(side(row).shape);
  if (axes() == 2)
    pressure_slopes<2>(rule(row), points_[row].point, x_old, nodes, slope);
  else
    pressure_slopes<3>(rule(row), points_[row].point, x_old, nodes, slope);
}

Point PointwisePairContact::drive(const StepView& view, int row, const SideFilm& film, const Point* slope) const {
  const SurfaceSide& at = side(row);
  Point result = -film.weight;
  for (int a = 0; a < surface_->pressure_nodes(at.shape); ++a)
    result += view.value_end(surface_->dofs(at.shape)(at.row, axes() * at.count + a)) * slope[a];
  return result;
}

void PointwisePairContact::add_film(const StepView& view, int row, const Seen& seen, const SideFilm& film,
                                    const TargetForce& force, const ResidualView& f) {
  if (!film.flows) return;
  Point slope[max_side_nodes];
  pressure_slopes_at(view, row, slope);
  const Point along = drive(view, row, film, slope);
  const double* const shape = pressure_shape(side(row), points_[row].point);
  const double cancelled = points_[row].area * length(place(row, view.x_end)) / view.dt;
  for (int a = 0; a < surface_->pressure_nodes(side(row).shape); ++a) {
    const int dof = dofs_(seen.entry, first_pressure(row, seen) + a);
    correction_.emplace_back(dof, -force.growth * shape[a] - force.conduction * dot(slope[a], along));
    f.cancelled(dof, cancelled);
  }
}

void PointwisePairContact::add_film_tangent(const StepView& view, const MatrixScatter& to, int row, const Seen& seen,
                                            const SideFilm& film, const TargetForce& force) const {
  if (!film.flows) return;
  Point slope[max_side_nodes];
  pressure_slopes_at(view, row, slope);
  const Point along = drive(view, row, film, slope);
  const double* const shape = pressure_shape(side(row), points_[row].point);
  const int first = first_pressure(row, seen), nodes = surface_->pressure_nodes(side(row).shape);
  const TargetColumns w = columns(row, seen.at.piece, seen.closest.weight);
  for (int a = 0; a < nodes; ++a) {
    double by[TargetForce::unknowns];
    for (int j = 0; j < TargetForce::unknowns; ++j)
      by[j] = force.growth_slope[j] * shape[a] + force.conduction_slope[j] * dot(slope[a], along);
    const auto add = [&](int b, int j, double value) { to.add(seen.entry, first + a, axes() * b + j, value); };
    if (axes() == 2)
      spread_slopes<2>(w, seen.closest, by, add);
    else
      spread_slopes<3>(w, seen.closest, by, add);
    for (int b = 0; b < nodes; ++b)
      to.add(seen.entry, first + a, first + b,
             by[ClosestPoint::motions] * shape[b] + force.conduction * dot(slope[a], slope[b]));
  }
}

template <int D>
void PointwisePairContact::add_tangent(const StepView& view, const MatrixScatter& to, int row, const Seen& seen,
                                       const TargetForce& force, double weight, double moved) const {
  const State& committed = *view.committed;
  // the matrix has no entries that couple the point with another piece, on which its old force acted
  const bool leaves =
      conserves(view) && rows_.pressure(committed, row) > 0 && old_piece(committed, row) == seen.at.piece;
  if (!leaves && !force.acts && force.point.damped == 0) return;
  const TargetColumns w = columns(row, seen.at.piece, seen.closest.weight),
                      before = leaves ? old_columns(committed, row) : TargetColumns{w.slave, w.count, {}};
  const Point leaving = 1 / view.end_weight * rows_.force(committed, row);
  const int first = first_pressure(row, seen), pressures = surface_->pressure_nodes(side(row).shape);
  const double* const shape = pressure_shape(side(row), points_[row].point);
  node_slopes<D>(w, seen.closest, force, before, leaving, [&](int a, int i, const double* by) {
    spread_slopes<D>(w, seen.closest, by, [&](int b, int j, double slope) {
      to.add(seen.entry, D * a + i, D * b + j, -weight * moved * slope);
    });
    for (int p = 0; p < pressures; ++p)
      to.add(seen.entry, D * a + i, first + p, -weight * by[ClosestPoint::motions] * shape[p]);
  });
}

void PointwisePairContact::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const MatrixScatter to = assembler.scatter(group_);
  const double moved = conserves(view) ? view.impact.conjugate : 1.0;
  const Positions at = positions(view);
  for (int row = 0; row < rows(); ++row) {
    Seen seen;
    if (!look(row, at.end, seen) || seen.entry < 0) continue;
    const SideFilm water = film(view, points_[row].side);
    const TargetForce force = evaluate(view, at, row, seen, water, true);
    if (axes() == 2)
      add_tangent<2>(view, to, row, seen, force, weight, moved);
    else
      add_tangent<3>(view, to, row, seen, force, weight, moved);
    add_film_tangent(view, to, row, seen, water, force);
  }
  if (leak_) leak_->jacobian(view, assembler);
}

bool PointwisePairContact::lengths(std::size_t side, const State& state, double* of_points) const {
  if (!at_nodes_) return PointContact::lengths(side, state, of_points);
  for (int row = first_row_[side]; row < first_row_[side + 1]; ++row) of_points[row - first_row_[side]] = share(row);
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
  for (int row = 0; row < rows(); ++row) {
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
  for (int row = 0; row < rows(); ++row) {
    const ShearState shear = rows_.shear(state, row);
    here.force += rows_.force(state, row);
    here.slides += shear.slides;
    here.heat += shear.dissipated;
    if (!rows_.active(state, row)) continue;
    here.area += rows_.area(state, row);
    here.deepest = std::max(here.deepest, -rows_.gap(state, row));
  }
  if (damping_ >= 0) here.damped = state.arrays[damping_](0, 0);
  const SlaveSums all = report_slave(*context_.space.mesh().comm(), axes(), name(), deck_, here, values);
  report_parts(state, 1.0, values);
  if (laws_.friction()) values[name() + "/friction heat"] = {"J", all.heat};
  if (laws_.friction() && axes() == 3) values[name() + "/sliding points"] = {"-", all.slides};
}

double PointwisePairContact::step_limit(const State& committed, double) const {
  return closing_limit(context_.space, *surface_, target_->sides(), deck_.advance_limit, committed);
}

}  // namespace mudline
