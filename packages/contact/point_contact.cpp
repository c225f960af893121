#include "contact/point_contact.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "contact/conjugate_position.hpp"
#include "contact/parts/in_situ_contact.hpp"

namespace mudline {

void PointContact::read(const Section& section) {
  name_ = section.name();
  displacement_ = context_.space.find("displacement");
  temperature_ = context_.space.find("temperature");
  if (displacement_ < 0) section.fail("contact needs a model with the field 'displacement'", "type");
}

void PointContact::check_parts(const Section& section, bool conserving, bool damping) const {
  parts_.initial_gap.check(section);
  parts_.drainage.check(section, laws_.pressure() >= 0);
  if (!parts_.drainage.has_film()) return;
  if (enforcement_.augmented()) section.fail("a film has no multipliers; allowed with it: penalty", "enforcement");
  if (conserving) section.fail("a film takes energy; allowed with it: automatic, interpolated", "impact");
  if (damping) section.fail("a film damps by itself; it takes no 'damping'", "damping");
}

void PointContact::make_points(const std::string& surface, SideRule::At kind, int quadrature_degree) {
  set_ = surface;
  if (parts_.drainage.has_film()) laws_.ask_for_pore_pressure();
  surface_ = std::make_unique<SlavePoints>(context_.space.mesh(), surface, kind, quadrature_degree);
  if (parts_.drainage.leaks())
    leak_ = std::make_unique<LeakySurface>(context_.space, *surface_, parts_.drainage.conductance(),
                                           parts_.drainage.outside());
}

void PointContact::declare_points(StateStore& store) {
  laws_.declare_state(store);
  const std::string prefix = name() + "/";
  rows_.declare_state(store, prefix, surface_->places(), axes(), target_->columns(), laws_.friction() != nullptr,
                      enforcement_.augmented());
  if (parts_.drainage.has_film()) parts_.drainage.film.declare_state(store, prefix, surface_->places(), axes());
  parts_.initial_gap.declare_state(store, prefix, surface_->places());
  penalties_ = enforcement_.declare_penalties(store, prefix, surface_->mesh(), set_);
}

void PointContact::begin_parts(const StepView& view) {
  enforcement_.start_penalties(*surface_, context_.stiffness, view.trial->arrays[penalties_]);
  start_multipliers(view);
  if (parts_.drainage.has_film()) parts_.drainage.film.cover(covered_sides(*view.committed));
  if (leak_) leak_->open(view.flow ? covered_sides(*view.committed) : std::vector<char>());
}

void PointContact::sparsity(Assembler& assembler) {
  const auto& x = surface_->mesh().coordinates();
  for (std::size_t s = 0; s < sides().size(); ++s)
    for (int piece : target_->near(surface_->box(s, x), reach_)) {
      const SurfaceSide& side = sides()[s];
      const int pressures = laws_.pressure_nodes(side);
      std::vector<int> dofs(axes() * side.count + target_->num_dofs(piece) + pressures);
      int* to = context_.space.write_dofs(displacement_, side.node, side.count, dofs.data());
      to = target_->write_dofs(piece, to);
      context_.space.write_dofs(laws_.pressure(), side.node, pressures, to);
      pairs_.add(s, piece, std::move(dofs));
    }
  pairs_.sparsity(assembler);
  if (leak_) leak_->sparsity(assembler);
}

bool PointContact::measure(std::size_t side, const SideCoordinates& x_old, const SideCoordinates& x, bool slopes,
                           PointAreas& areas) const {
  const ContactRule& points = rule(sides()[side]);
  const Geometry geometry = context_.space.mesh().geometry();
  if (parts_.drainage.has_film() && !point_areas(points, x_old, geometry, areas.old)) return false;
  if (!slopes) return point_areas(points, x, geometry, areas.now);
  return point_areas(points, x, geometry, areas.now, areas.slope);
}

ContactPointLaw PointContact::law(const StepView& view, std::size_t side) const {
  ContactPointLaw result = laws_.in_step(view, damping_);
  result.penalty = penalty(*view.trial, side);
  result.first_guess = predicting_;
  result.touch = touch_;
  result.conserves = conserves(view);
  return result;
}

/// A side of the slave in an evaluation.
struct PointContact::SideInStep {
  std::size_t side;
  bool tangent;
  ConstCoordinateView x_old, x_end;  // [m] of the mesh at both ends of the step
  SideCoordinates before, now;       // [m] of its nodes there
  SideFilm water;
  ContactPointLaw law;
  PointAreas& areas;
};

/// What the entries of a PointInStep point to.
struct PointContact::PointBuffers {
  double leaving[SideAction::most];
  Point pressure_slope[max_side_nodes];
};

PointInStep PointContact::point_in_step(const StepView& view, const SideInStep& here, int c, PointBuffers& to) const {
  const SurfaceSide& side = sides()[here.side];
  const ContactRule& points = rule(side);
  const PointAreas& areas = here.areas;
  const int row = surface_->first_row(here.side) + c;
  const Point at = points.place(c, here.now);
  PointInStep point{here.law,    here.water, candidates_[here.side],       capture_,
                    here.x_old,  here.x_end, points.place(c, here.before), at,
                    outward(row)};
  point.old = history(view, here.side, row, point.place_old);
  point.area = areas.now[c];
  point.area_old = areas.fixed ? areas.now[c] : areas.old[c];
  if (here.tangent && !areas.fixed) point.area_slope = areas.slope[c];
  point.far = areas.fixed ? length(at) : farthest(here.now);
  point.nodes = points.nodes;
  point.pressures = laws_.pressure_nodes(side);
  point.shape = &points.shape(c, 0);
  point.pressure_shape = laws_.pressure_shape(side, points, c);
  point.pore_pressure = point.old.soil.pore_pressure + laws_.pore_pressure(side, points, c, view.value_end);
  point.old_columns = rows_.more(*view.committed, row);
  point.reach = close_;
  // the force that moves a body until it touches is not known: every linearisation lets it move ten times as far
  point.reach_share = std::pow(0.1, view.linearisation);
  if (!here.water.flows) return point;
  pressure_slopes(points, c, here.before, point.pressures, to.pressure_slope);
  point.drive = -here.water.weight;
  for (int a = 0; a < point.pressures; ++a)
    point.drive += view.value_end(context_.space.node_dof(laws_.pressure())(side.node[a])) * to.pressure_slope[a];
  point.pressure_slope = to.pressure_slope;
  return point;
}

bool PointContact::find(const SideInStep& here, int c, TargetPlace& place) const {
  if (here.areas.fixed && !(here.areas.now[c] > 0)) return false;
  return target_->find(candidates_[here.side], rule(sides()[here.side]).place(c, here.now),
                       outward(surface_->first_row(here.side) + c), capture_, here.x_end, place);
}

template <class Take>
int PointContact::evaluate(const StepView& view, bool tangent, const Take& take) {
  const bool ahead = conserves(view);
  const ConstCoordinateView x_old = ahead ? moved_ahead(context_.space, view.x_old, view.impact.ahead_old) : view.x_old,
                            x_end = ahead ? moved_ahead(context_.space, view.x_end, view.impact.ahead_end) : view.x_end;
  target_->move(view, ahead);
  SideAction action;
  action.tangent = tangent;
  PointAreas areas;
  PointBuffers buffers;
  int failures = 0;
  for (std::size_t s = 0; s < sides().size(); ++s) {
    const SurfaceSide& side = sides()[s];
    SideInStep here{s,
                    tangent,
                    x_old,
                    x_end,
                    side_coordinates(side, x_old),
                    side_coordinates(side, x_end),
                    film(view, s),
                    law(view, s),
                    areas};
    here.law.film = here.water.acts;
    const bool near = !candidates_[s].empty(), sound = near && measure(s, here.before, here.now, tangent, areas);
    failures += near && !sound;
    int open = -1;  // entry of `action`
    for (int c = 0; c < rule(side).points; ++c) {
      const int row = surface_->first_row(s) + c;
      TargetPlace place;
      if (!sound || !find(here, c, place)) {
        if (tangent) continue;
        write_away(view, row);
        leave(view, s, row, capture_);
        continue;
      }
      const int entry = pairs_.row(s, place.piece);
      if (entry != open || entry < 0) {
        if (open >= 0) take(s, open, action);
        action.open(axes() * side.count, target_->num_dofs(place.piece), laws_.pressure_nodes(side));
        open = entry;
      }
      here.law.turned = tangent && turned(*view.trial, row);
      PointInStep point = point_in_step(view, here, c, buffers);
      const bool stays =
          ahead && rows_.pressure(*view.committed, row) > 0 && target_->old_piece(point.old_columns) == place.piece;
      if (stays) {
        target_->old_forces(point.old_columns, point.old.force, buffers.leaving);
        point.leaving = buffers.leaving;
      }
      const ContactPoint result = target_->act(point, place, action);
      if (tangent) continue;
      if (!stays) leave(view, s, row, result.gap);
      if (entry < 0) {
        failures += result.active || here.water.acts;
        write_away(view, row);
        continue;
      }
      write(*view.trial, row, place, result);
      damped_ += result.damped;
      damping_force_ += result.damping;
    }
    if (open >= 0) take(s, open, action);
  }
  return failures;
}

int PointContact::residual(const StepView& view, const ResidualView& f) {
  later_.clear();
  damped_ = 0;
  damping_force_ = {};
  const int failures =
      evaluate(view, false, [&](std::size_t s, int e, const SideAction& action) { add_forces(view, s, e, action, f); });
  beyond_reach_ = failures > 0;
  return failures;
}

void PointContact::add_forces(const StepView& view, std::size_t side, int entry, const SideAction& action,
                              const ResidualView& f) {
  const double far = farthest(side_coordinates(sides()[side], view.x_end));
  for (int a = 0; a < action.dofs(); ++a) {
    const int dof = pairs_.dofs()(entry, a);
    if (a >= action.first_pressure()) {  // rate of water into a film, all of it added later
      later_.emplace_back(dof, -action.f[a]);
      if (action.f[a] != 0) f.cancelled(dof, action.area * far / view.dt);
      continue;
    }
    const double size = std::abs(action.f[a]);
    f.add(dof, -action.f[a], size, size + action.cancelled[a]);
    if (action.later[a] != 0) later_.emplace_back(dof, action.later[a]);
  }
}

void PointContact::correction(const StepView& view, const ResidualView& f) {
  for (const auto& [dof, force] : later_) f.add(dof, -force);
  if (leak_) leak_->add(view, f);
  if (laws_.friction() && temperature_ >= 0 && view.flow) add_heat(view, f);
}

void PointContact::add_heat(const StepView& view, const ResidualView& f) const {
  const auto& dofs = context_.space.node_dof(temperature_);
  const double slave = heat_share(), target = 1 - slave;
  for (std::size_t s = 0; s < sides().size(); ++s) {
    const SurfaceSide& side = sides()[s];
    for (int row = surface_->first_row(s); row < surface_->end_row(s); ++row) {
      const double heat = rows_.shear(*view.trial, row).dissipated - rows_.shear(*view.committed, row).dissipated,
                   rate = heat / view.dt;
      if (rate == 0) continue;
      const double* const share = &rule(side).corner(row - surface_->first_row(s), 0);
      for (int a = 0; a < num_corners(side.shape); ++a) f.add(dofs(side.node[a]), -slave * share[a] * rate);
      if (target == 0) continue;
      for (const auto& [node, part] : target_->vertices(rows_.more(*view.trial, row)))
        f.add(dofs(node), -target * part * rate);
    }
  }
}

void PointContact::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const MatrixScatter to = assembler.scatter(pairs_.group());
  const double moved = conserves(view) ? view.impact.conjugate : 1.0;
  if (view.linearisation == 0) slid_.assign(laws_.friction() ? surface_->rows() : 0, Point{});
  evaluate(view, true, [&](std::size_t, int entry, SideAction& action) {
    const int dofs = action.dofs(), first = action.first_pressure();
    for (int a = 0; a < first; ++a)
      for (int b = 0; b < dofs; ++b) action.k[a * dofs + b] *= -weight * (b >= first ? 1.0 : moved);
    to.add(entry, dofs, action.k);
  });
  if (leak_) leak_->jacobian(view, assembler);
}

bool PointContact::turned(const State& trial, int row) {
  if (slid_.empty()) return false;
  const ShearState now = rows_.shear(trial, row);
  const Point before = std::exchange(slid_[row], now.slides ? now.shear : Point{});
  return std::inner_product(before.begin(), before.end(), slid_[row].begin(), 0.0) < 0;
}

void PointContact::leave(const StepView& view, std::size_t side, int row, double gap) {
  const State& committed = *view.committed;
  if (!conserves(view) || !(rows_.pressure(committed, row) > 0)) return;
  const double* const columns = rows_.more(committed, row);
  const int piece = target_->old_piece(columns), there = pairs_.row(side, piece);
  if (there < 0) return;
  const double share = start_share(rows_.gap(committed, row), gap, view.impact.damping) - (1 - view.end_weight);
  const Point force = rows_.force(committed, row);
  const SurfaceSide& at = sides()[side];
  const double* const shape = &rule(at).shape(row - surface_->first_row(side), 0);
  double on_target[SideAction::most];
  target_->old_forces(columns, force, on_target);
  for (int a = 0; a < at.count; ++a)
    for (int i = 0; i < axes(); ++i)
      later_.emplace_back(pairs_.dofs()(there, axes() * a + i), share * shape[a] * force[i]);
  for (int r = 0; r < target_->num_dofs(piece); ++r)
    later_.emplace_back(pairs_.dofs()(there, axes() * at.count + r), share * on_target[r]);
}

PointHistory PointContact::history(const StepView& view, std::size_t side, int row, const Point& place_old) const {
  const State& committed = *view.committed;
  PointHistory old;
  old.offset = parts_.initial_gap.offset(*view.trial, row);
  old.gap = rows_.gap(committed, row);
  old.shear = rows_.shear(committed, row);
  old.force = rows_.force(committed, row);
  old.normal_force = rows_.pressure(committed, row) * rows_.area(committed, row);
  old.soil = laws_.soil(committed, sides()[side], rule(sides()[side]).xi[row - surface_->first_row(side)].data());
  if (parts_.drainage.has_film()) parts_.drainage.film.start(view, row, place_old, old);
  if (!enforcement_.augmented()) return old;
  const double stiffness = penalty(*view.trial, side);
  old.shift = rows_.normal_multiplier(*view.trial, row) / stiffness;
  old.shift_old = rows_.normal_multiplier(committed, row) / stiffness;
  if (laws_.friction())
    old.shear.shear =
        old.shear.shear + rows_.shear_multiplier(*view.trial, row) - initial_shear_multiplier(committed, row);
  return old;
}

SideFilm PointContact::film(const StepView& view, std::size_t side) const {
  if (!parts_.drainage.has_film()) return {};
  const Point weight = context_.water_weight ? context_.water_weight(sides()[side].block, view.time_end) : Point{};
  return parts_.drainage.film.of_side(view, side, weight);
}

void PointContact::write(const State& trial, int row, const TargetPlace& place, const ContactPoint& point) const {
  rows_.write(trial, row, point);
  if (parts_.drainage.has_film()) parts_.drainage.film.write(trial, row, point);
  target_->write(place, point, rows_.more(trial, row));
}

void PointContact::write_away(const StepView& view, int row) const {
  ContactPoint point{};
  point.gap = capture_;
  point.shear = rows_.shear(*view.committed, row);
  point.shear.shear = {};
  point.shear.slides = false;
  write(*view.trial, row, TargetPlace(), point);
}

bool PointContact::lengths(std::size_t side, const State& state, double* of_points) const {
  return point_areas(rule(sides()[side]), side_coordinates(sides()[side], state.coordinates), Geometry::plane_strain,
                     of_points);
}

Point PointContact::initial_shear_multiplier(const State& committed, int row) const {
  // a point that slides or is off the body starts unstretched; one that sticks is stretched by the difference of its
  // stress and its multiplier
  return rows_.sticks(committed, row) ? rows_.shear_multiplier(committed, row) : rows_.shear(committed, row).shear;
}

void PointContact::start_multipliers(const StepView& view) const {
  if (!enforcement_.augmented() || !laws_.friction()) return;
  for (int row = 0; row < surface_->rows(); ++row)
    rows_.set_shear_multiplier(*view.trial, row, initial_shear_multiplier(*view.committed, row));
}

Misfit PointContact::misfit(const State& state) const {
  MisfitSums sums(surface_->mesh(), rows_.shears());
  for (std::size_t s = 0; s < sides().size(); ++s) {
    const ContactRule& r = rule(sides()[s]);
    double here[max_contact_points];
    if (!lengths(s, state, here)) continue;
    const double stiffness = penalty(state, s);
    for (int c = 0; c < r.points; ++c) {
      const int row = surface_->first_row(s) + c;
      sums.spring = std::max(sums.spring, rows_.pressure(state, row) / stiffness);
      const double normal = rows_.pressure(state, row) - rows_.normal_multiplier(state, row);
      const Point shear =
          rows_.sticks(state, row) ? rows_.shear(state, row).shear - rows_.shear_multiplier(state, row) : Point{};
      for (int a = 0; a < r.multipliers; ++a) {
        const double weight = r.multiplier_shape(c)[a] * here[c];
        sums.add(sides()[s].node[a], weight, stiffness, weight * normal, weight * shear);
      }
    }
  }
  return {*surface_, std::move(sums), laws_.tangential_factor()};
}

Augmentation PointContact::augment(const StepView& view, int count) {
  const State& trial = *view.trial;
  if (!enforcement_.augmented()) return {};
  const Misfit rest = misfit(trial);
  if (const auto end =
          end_of_augmentation(name_, enforcement_, gap_tolerance_, rest, count, *context_.space.mesh().comm()))
    return *end;
  const ShapeMass masses = [&](const std::vector<double>& values, std::vector<double>& product,
                               std::vector<double>& whole) {
    for (std::size_t s = 0; s < sides().size(); ++s) {
      const ContactRule& r = rule(sides()[s]);
      double here[max_contact_points];
      if (!lengths(s, trial, here)) continue;
      for (int c = 0; c < r.points; ++c) {
        double value = 0;
        const double* const shape = r.multiplier_shape(c);
        for (int a = 0; a < r.multipliers; ++a) value += shape[a] * values[sides()[s].node[a]];
        for (int a = 0; a < r.multipliers; ++a) {
          product[sides()[s].node[a]] += shape[a] * here[c] * value;
          whole[sides()[s].node[a]] += shape[a] * here[c];
        }
      }
    }
  };
  const std::vector<double> normal = in_shapes(*surface_, rest.normal, masses);
  std::vector<std::vector<double>> tangential;
  for (const std::vector<double>& component : rest.shear) tangential.push_back(in_shapes(*surface_, component, masses));
  for (std::size_t s = 0; s < sides().size(); ++s)
    for (int row = surface_->first_row(s); row < surface_->end_row(s); ++row) {
      const ContactRule& r = rule(sides()[s]);
      const double* const shape = r.multiplier_shape(row - surface_->first_row(s));
      for (int a = 0; a < r.multipliers; ++a)
        rows_.normal_multiplier(trial, row) += shape[a] * normal[sides()[s].node[a]];
      if (!laws_.friction()) continue;
      const bool sticks = rows_.sticks(trial, row);
      Point shear = sticks ? rows_.shear_multiplier(trial, row) : rows_.shear(trial, row).shear;
      if (sticks)
        for (std::size_t i = 0; i < tangential.size(); ++i)
          for (int a = 0; a < r.multipliers; ++a) shear[i] += shape[a] * tangential[i][sides()[s].node[a]];
      rows_.set_shear_multiplier(trial, row, shear);
    }
  return {true, ""};
}

bool PointContact::covered(std::size_t side, const State& committed) const {
  // The criterion is the distance: with the pressure alone single points along a stretched side would lift off by
  // micrometres, and a vertex that is drained for a step loses its pore pressure.
  const SurfaceSide& at = sides()[side];
  const double near = parts_.drainage.sealing_gap() * edges(at, committed.coordinates).second;
  const Bounds around = surface_->box(side, committed.coordinates);
  if (target_->near(around, near).empty()) return false;
  const SideCoordinates x = side_coordinates(at, committed.coordinates);
  const ContactRule& points = rule(at);
  double counted = 0;
  for (int c = 0; c < points.points; ++c)
    counted = std::max(counted, std::abs(parts_.initial_gap.offset(committed, surface_->first_row(side) + c)));
  const std::vector<int> candidates = target_->near(around, near + counted);
  int count = 0;
  for (int c = 0; c < points.points; ++c) {
    const double offset = parts_.initial_gap.offset(committed, surface_->first_row(side) + c);
    TargetPlace there;
    count += target_->find(candidates, points.place(c, x), points.outward(c, x), near + std::abs(offset),
                           committed.coordinates, there) &&
             there.gap - offset < near;
  }
  return 2 * count > points.points;
}

std::vector<char> PointContact::covered_sides(const State& committed) const {
  target_->look_at(committed);
  std::vector<char> flags;
  for (std::size_t s = 0; s < sides().size(); ++s) flags.push_back(covered(s, committed));
  return flags;
}

void PointContact::close(const State& committed, ClosedSides& closed) const {
  if (!parts_.drainage.closes() || laws_.pressure() < 0) return;
  closed.possible = true;
  (parts_.drainage.seals() ? closed.may_be_sealed : closed.may_leak).insert(set_);
  const std::vector<Side>& set = surface_->mesh().side_sets().at(set_);
  std::vector<char> flags = covered_sides(committed);
  for (std::size_t s = 0; s < set.size(); ++s)
    if (flags[s]) closed.sides.insert({set[s].block, set[s].element, set[s].side});
}

void PointContact::first_act(State& committed) {
  if (!parts_.initial_gap.adjusts()) return;
  const Comm& comm = *context_.space.mesh().comm();
  const PointView& penalties = committed.arrays[penalties_];
  const int acted = penalties.extent(0) > 0 && penalties(0, 0) > 0;
  int anywhere = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, acted, Teuchos::outArg(anywhere));
  if (anywhere > 0) return;
  enforcement_.start_penalties(*surface_, context_.stiffness, penalties);
  target_->look_at(committed);
  FirstTouch found;
  const InSituContact start{context_,
                            laws_,
                            *surface_,
                            *target_,
                            parts_.initial_gap,
                            rows_,
                            committed,
                            penalties,
                            enforcement_.augmented(),
                            parts_.drainage.has_film()};
  const auto write = [&](int row, const TargetPlace& place, const ContactPoint& point) {
    this->write(committed, row, place, point);
  };
  for (std::size_t s = 0; s < sides().size(); ++s) start.touch(s, found, write);
  found.everywhere(comm).tell(name_, parts_.initial_gap.presses());
}

void PointContact::report_parts(const State& state, double sign, Report& values) const {
  if (enforcement_.augmented()) {
    const auto [gap, stretch, spring] = misfit(state).largest(*context_.space.mesh().comm());
    values[name() + "/weighted gap"] = {"m", gap};
    if (laws_.friction()) values[name() + "/stretch"] = {"m", stretch};
  }
  if (!parts_.drainage.has_film()) return;
  const WaterFilm::Sums sums = parts_.drainage.film.sums(state);
  double local[] = {sums.water, sums.vapour, sums.force[0], sums.force[1], sums.force[2]}, all[5];
  Teuchos::reduceAll(*context_.space.mesh().comm(), Teuchos::REDUCE_SUM, 5, local, all);
  values[name() + "/film water"] = {"m3", all[0]};
  values[name() + "/film vapour"] = {"m3", all[1]};
  for (int i = 0; i < axes(); ++i) values[name() + "/film force " + axis_names[i]] = {"N", sign * all[2 + i]};
}

std::vector<double> PointContact::nodal_pressure(const State& state) const {
  return nodal_mean([&](int row) { return rows_.pressure(state, row); });
}

std::vector<double> PointContact::nodal_shear(const State& state) const {
  if (!laws_.friction()) return {};
  return nodal_mean([&](int row) {
    const Point shear = rows_.shear(state, row).shear;
    return axes() == 2 ? shear[0] : length(shear);
  });
}

}  // namespace mudline
