#include "contact/point_contact.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

#include "tensor/midpoint_rule.hpp"

namespace mudline {

namespace {

/// Unit normal of a side at a point of its rule, out of the soil.
template <int D>
Point outward_normal(const ContactRule& rule, int c, const SideCoordinates& x) {
  SideMap<D> map;
  map.compute(rule.nodes, &rule.shape(c, 0), &rule.shape_slope(c, 0), [&](int a, int i) { return x[a][i]; });
  Point result{};
  for (int i = 0; i < D; ++i) result[i] = map.normal[i] / map.stretch;
  return result;
}

Point outward_normal(const ContactRule& rule, int c, const SideCoordinates& x) {
  return dimension(rule.side) == 1 ? outward_normal<2>(rule, c, x) : outward_normal<3>(rule, c, x);
}

}  // namespace

void PointContact::read(const Section& section) {
  name_ = section.name();
  displacement_ = context_.space.find("displacement");
  pressure_ = context_.space.find("pore pressure");
  temperature_ = context_.space.find("temperature");
  if (displacement_ < 0) section.fail("contact needs a model with the field 'displacement'", "type");
}

void PointContact::check_parts(const Section& section, bool conserving, bool damping) const {
  parts_.initial_gap.check(section);
  parts_.drainage.check(section, pressure_ >= 0);
  if (!parts_.drainage.has_film()) return;
  if (enforcement_.augmented()) section.fail("a film has no multipliers; allowed with it: penalty", "enforcement");
  if (conserving) section.fail("a film takes energy; allowed with it: automatic, interpolated", "impact");
  if (damping) section.fail("a film damps by itself; it takes no 'damping'", "damping");
}

void PointContact::make_points(const std::string& surface, const BodyUnknowns& body, ContactPoints kind,
                               int quadrature_degree) {
  set_ = surface;
  if (parts_.drainage.has_film()) laws_.ask_for_pore_pressure();
  surface_ = std::make_unique<ContactSurface>(context_.space, surface, laws_.read_pore_pressure(), body);
  if (parts_.drainage.leaks())
    leak_ = std::make_unique<LeakySurface>(context_.space, *surface_, parts_.drainage.conductance(),
                                           parts_.drainage.outside());
  places_ = std::make_shared<SurfacePoints>(
      surface_->mesh(), surface, kind == ContactPoints::nodes ? SurfacePoints::At::nodes : SurfacePoints::At::gauss,
      quadrature_degree);
  rules_.clear();
  for (CellShape shape : surface_->shapes()) rules_.emplace(shape, ContactRule(kind, shape, quadrature_degree));
  first_row_.assign(1, 0);
  for (const SurfaceSide& side : sides()) first_row_.push_back(first_row_.back() + rule(side).points);
}

void PointContact::declare_points(StateStore& store, const std::vector<StateVariable>& more) {
  laws_.declare_state(store);
  const std::string prefix = name() + "/";
  rows_.declare_state(store, prefix, places_, axes(), more, laws_.friction() != nullptr, enforcement_.augmented());
  if (parts_.drainage.has_film()) parts_.drainage.film.declare_state(store, prefix, places_, axes());
  parts_.initial_gap.declare_state(store, prefix, places_);
  penalties_ = enforcement_.declare_penalties(store, prefix, surface_->mesh(), set_);
}

void PointContact::begin_parts(const StepView& view) {
  enforcement_.start_penalties(*surface_, context_.stiffness, view.trial->arrays[penalties_]);
  start_multipliers(view);
  if (parts_.drainage.has_film()) parts_.drainage.film.cover(covered_sides(*view.committed));
  if (leak_) leak_->open(view.flow ? covered_sides(*view.committed) : std::vector<char>());
}

ContactPointLaw PointContact::law(const StepView& view, std::size_t side, double damping) const {
  ContactPointLaw result = laws_.in_step(view, damping);
  result.penalty = penalty(*view.trial, side);
  result.first_guess = predicting_;
  return result;
}

PointHistory PointContact::history(const StepView& view, std::size_t side, int row, const Point& place_old) const {
  const State& committed = *view.committed;
  PointHistory old;
  old.offset = parts_.initial_gap.offset(*view.trial, row);
  old.shear = rows_.shear(committed, row);
  old.force.force = rows_.force(committed, row);
  old.normal_force = rows_.pressure(committed, row) * rows_.area(committed, row);
  old.soil = laws_.soil(committed, sides()[side], rule(sides()[side]).xi[row - first_row_[side]].data());
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

void PointContact::write_point(const State& trial, int row, const ContactPoint& point) const {
  rows_.write(trial, row, point);
  if (parts_.drainage.has_film()) parts_.drainage.film.write(trial, row, point);
}

ContactPoint PointContact::away(const State& committed, int row, double gap) const {
  ContactPoint point{};
  point.gap = gap;
  point.shear = rows_.shear(committed, row);
  point.shear.shear = {};
  point.shear.slides = false;
  return point;
}

const double* PointContact::pressure_shape(const SurfaceSide& side, int point) const {
  const ContactRule& points = rule(side);
  return surface_->pressure_nodes(side.shape) < points.nodes ? &points.corner(point, 0) : &points.shape(point, 0);
}

double PointContact::pore_pressure(std::size_t side, int point, const ConstNodalView& values) const {
  const SurfaceSide& at = sides()[side];
  const int nodes = surface_->pressure_nodes(at.shape);
  if (nodes == 0) return 0;
  const double* const shape = pressure_shape(at, point);
  double result = 0;
  for (int a = 0; a < nodes; ++a) result += shape[a] * values(surface_->dofs(at.shape)(at.row, axes() * at.count + a));
  return result;
}

bool PointContact::lengths(std::size_t side, const State& state, double* of_points) const {
  return contact_areas(rule(sides()[side]), side_coordinates(sides()[side], state.coordinates), Geometry::plane_strain,
                       of_points);
}

Point PointContact::initial_shear_multiplier(const State& committed, int row) const {
  // a point that slides or is off the body starts unstretched; one that sticks is stretched by the difference of its
  // stress and its multiplier
  return rows_.sticks(committed, row) ? rows_.shear_multiplier(committed, row) : rows_.shear(committed, row).shear;
}

void PointContact::start_multipliers(const StepView& view) const {
  if (!enforcement_.augmented() || !laws_.friction()) return;
  for (int row = 0; row < first_row_.back(); ++row)
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
      const int row = first_row_[s] + c;
      sums.spring = std::max(sums.spring, rows_.pressure(state, row) / stiffness);
      const double normal = rows_.pressure(state, row) - rows_.normal_multiplier(state, row);
      const Point shear =
          rows_.sticks(state, row) ? rows_.shear(state, row).shear - rows_.shear_multiplier(state, row) : Point{};
      for (int a = 0; a < sides()[s].count; ++a) {
        const double weight = r.shape(c, a) * here[c];
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
        for (int a = 0; a < r.nodes; ++a) value += r.shape(c, a) * values[sides()[s].node[a]];
        for (int a = 0; a < r.nodes; ++a) {
          product[sides()[s].node[a]] += r.shape(c, a) * here[c] * value;
          whole[sides()[s].node[a]] += r.shape(c, a) * here[c];
        }
      }
    }
  };
  const std::vector<double> normal = in_shapes(*surface_, rest.normal, masses);
  std::vector<std::vector<double>> tangential;
  for (const std::vector<double>& component : rest.shear) tangential.push_back(in_shapes(*surface_, component, masses));
  for (std::size_t s = 0; s < sides().size(); ++s)
    for (int row = first_row_[s]; row < first_row_[s + 1]; ++row) {
      const double* const shape = &rule(sides()[s]).shape(row - first_row_[s], 0);
      for (int a = 0; a < sides()[s].count; ++a)
        rows_.normal_multiplier(trial, row) += shape[a] * normal[sides()[s].node[a]];
      if (!laws_.friction()) continue;
      const bool sticks = rows_.sticks(trial, row);
      Point shear = sticks ? rows_.shear_multiplier(trial, row) : rows_.shear(trial, row).shear;
      if (sticks)
        for (std::size_t i = 0; i < tangential.size(); ++i)
          for (int a = 0; a < sides()[s].count; ++a) shear[i] += shape[a] * tangential[i][sides()[s].node[a]];
      rows_.set_shear_multiplier(trial, row, shear);
    }
  return {true, ""};
}

bool PointContact::covered(std::size_t side, const State& committed) const {
  // The criterion is the distance: with the pressure alone single points along a stretched side would lift off by
  // micrometres, and a vertex that is drained for a step loses its pore pressure.
  const SurfaceSide& at = sides()[side];
  const double near = parts_.drainage.sealing_gap() * edges(at, committed.coordinates).second;
  if (!may_be_near(committed, side, near)) return false;
  const SideCoordinates x = side_coordinates(at, committed.coordinates);
  const ContactRule& points = rule(at);
  int count = 0;
  for (int c = 0; c < points.points; ++c) {
    const double offset = parts_.initial_gap.offset(committed, first_row_[side] + c);
    const auto there =
        nearest(committed, side, points.place(c, x), outward_normal(points, c, x), near + std::abs(offset));
    count += there && there->gap - offset < near;
  }
  return 2 * count > points.points;
}

std::vector<char> PointContact::covered_sides(const State& committed) const {
  look_at(committed);
  std::vector<char> flags;
  for (std::size_t s = 0; s < sides().size(); ++s) flags.push_back(covered(s, committed));
  return flags;
}

void PointContact::close(const State& committed, ClosedSides& closed) const {
  if (!parts_.drainage.closes() || pressure_ < 0) return;
  closed.possible = true;
  const std::vector<Side>& set = surface_->mesh().side_sets().at(set_);
  const std::vector<char> flags = covered_sides(committed);
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
  look_at(committed);
  FirstTouch found;
  for (std::size_t s = 0; s < sides().size(); ++s) touch_first(s, committed, found);
  found.everywhere(comm).tell(name_, parts_.initial_gap.presses());
}

void PointContact::touch_first(std::size_t side, const State& committed, FirstTouch& found) const {
  constexpr double facing = 0.7;  // [-] cosine: a side that does not face the target does not touch it
  const SurfaceSide& at = sides()[side];
  const ContactRule& points = rule(at);
  const SideCoordinates x = side_coordinates(at, committed.coordinates);
  const double edge = edges(at, committed.coordinates).second, reach = parts_.initial_gap.reach(edge);
  double area[max_contact_points];
  if (!contact_areas(points, x, context_.space.mesh().geometry(), area)) return;
  found.reach = std::max(found.reach, reach);
  for (int c = 0; c < points.points; ++c) {
    ++found.points;
    const Point place = points.place(c, x), outward = outward_normal(points, c, x);
    const auto there = nearest(committed, side, place, outward, std::max(edge, reach));
    if (!there || -dot(outward, there->normal) < facing) continue;
    const double gap = there->gap;
    if (std::abs(gap) > reach) {
      found.deep += gap < 0;
      found.deepest = std::max(found.deepest, -gap);
      continue;
    }
    double pressure = 0;
    if (parts_.initial_gap.presses()) pressure = in_situ_pressure(side, c, committed, place, outward, there->normal);
    found.pulled += pressure < 0;
    const double depth = in_situ_penetration(side, c, committed, std::max(0.0, pressure));
    const bool bears = pressure > 0 && std::isfinite(depth);
    found.beyond += pressure > 0 && !bears;
    found.close(gap, bears ? pressure : 0.0);
    const int row = first_row_[side] + c;
    parts_.initial_gap.set_offset(committed, row, gap + (bears ? depth : 0.0));
    if (!bears) continue;
    if (enforcement_.augmented()) rows_.normal_multiplier(committed, row) = pressure;
    ContactPoint point{};
    point.gap = -depth;
    point.active = true;
    point.area = area[c];
    point.pressure = pressure;
    if (parts_.drainage.has_film()) point.pressure += pore_pressure(side, c, committed.value);
    point.total.force = point.pressure * area[c] * there->normal;
    write_first(committed, row, place, *there, point);
  }
}

double PointContact::in_situ_penetration(std::size_t side, int point, const State& committed, double pressure) const {
  if (enforcement_.augmented()) return 0;  // multipliers carry it
  const SurfaceSide& at = sides()[side];
  TouchingSoil soil = laws_.soil(committed, at, rule(at).xi[point].data());
  soil.pore_pressure += pore_pressure(side, point, committed.value);
  return penetration_under(laws_.normal(), pressure, penalty(committed, side), soil);
}

double PointContact::in_situ_pressure(std::size_t side, int point, const State& committed, const Point& at,
                                      const Point& outward, const Point& normal) const {
  const SurfaceSide& here = sides()[side];
  const auto stress = context_.stress(committed, here.block, here.element, at);
  double pressure = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) pressure += normal[i] * stress[six(i, j)] * outward[j];
  // the film's pressure is the pore pressure; the rest is the law's
  return parts_.drainage.has_film() ? pressure - pore_pressure(side, point, committed.value) : pressure;
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

std::vector<double> PointContact::nodal_mean(const std::function<double(int row)>& quantity) const {
  const int nodes = context_.space.mesh().num_nodes();
  std::vector<double> weighted(nodes, 0.0), weights(nodes, 0.0);
  for (std::size_t s = 0; s < sides().size(); ++s) {
    const ContactRule& r = rule(sides()[s]);
    for (int a = 0; a < sides()[s].count; ++a)
      for (int c = 0; c < r.points; ++c) {
        const double near = share(first_row_[s] + c) * nearness(r, c, a);
        weighted[sides()[s].node[a]] += near * quantity(first_row_[s] + c);
        weights[sides()[s].node[a]] += near;
      }
  }
  return surface_->mean(std::move(weighted), std::move(weights));
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
