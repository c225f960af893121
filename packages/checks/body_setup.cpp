#include "checks/body_setup.hpp"

#include <algorithm>
#include <cmath>

#include "discretisation/element_map.hpp"
#include "integrator/overlap.hpp"
#include "physics/soil_points.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// A side of the mesh in its reference coordinates.
struct SideFigures {
  std::vector<Point> corners;
  Point middle{}, normal{};  // outward, unit
  double shortest = any_size, longest = 0;
};

SideFigures figures(const Mesh& mesh, const Side& side) {
  const ElementBlock& block = mesh.blocks()[side.block];
  const std::vector<int> local = side_nodes(block.shape, side.side);
  const int count = num_corners(side_shape(block.shape, side.side));
  SideFigures result;
  result.middle = middle_of(mesh, side);
  for (int c = 0; c < count; ++c) result.corners.push_back(mesh.place(block.nodes(side.element, local[c])));
  for (int c = 0; c < (count == 2 ? 1 : count); ++c) {
    const double edge = length(result.corners[(c + 1) % count] - result.corners[c]);
    result.shortest = std::min(result.shortest, edge);
    result.longest = std::max(result.longest, edge);
  }
  const Point along = result.corners[1] - result.corners[0];
  const Point across = count == 2 ? Point{along[1], -along[0], 0} : cross(along, result.corners[2] - result.corners[0]);
  const double size = length(across);
  if (size > 0) result.normal = 1 / size * across;
  return result;
}

/// Gap [m] of a place from the body at its start, and the body's outward normal there.
std::pair<double, Point> nearest(const RigidBody& body, const Point& x) {
  const BodyPlacement placement = body.initial_placement();
  if (body.dimension() == 3) {
    const SurfaceProjection projection = body.projection(placement, x);
    return {projection.gap, projection.normal};
  }
  const ContourProjection projection = body.closest(placement, {x[0], x[1]});
  return {projection.gap, {projection.normal[0], projection.normal[1], 0}};
}

}  // namespace

StartingExtent::StartingExtent(const RigidBody& body) {
  const BodyPlacement start = body.initial_placement();
  for (const Point& p : body.outline(start)) box.enclose(p);
  Point vertical{};
  vertical[body.dimension() - 1] = 1;
  shadow = body.shadow(start, vertical);
}

BodySetup::BodySetup(const Setup& setup, const RigidBody& body)
    : BodyWay(setup.model(), body, setup.deck()),
      model(setup.model()),
      entry(setup.deck().section("bodies").section(body.name())),
      dim(body.dimension()),
      up(body.dimension() - 1),
      soil_gravity(setup.gravity_vector()) {
  find_box();
  find_surfaces();
}

void BodySetup::find_box() {
  const StartingExtent extent(body);
  box = extent.box;
  shadow = extent.shadow;
  for (int i = 0; i < dim; ++i) size = std::max(size, length_of(i));
  width = shadow.width;
}

void BodySetup::find_surfaces() {
  const Comm& comm = *model.mesh().comm();
  std::vector<SideFigures> sides;
  for (const auto& [name, contact] : model.contacts())
    if (contact->partners().body == &body)
      for (const Side& side : model.mesh().side_sets().at(contact->partners().surface))
        sides.push_back(figures(model.mesh(), side));
  Surfaces& s = surfaces;
  double count = 0, under = 0, top = -any_size;
  for (const SideFigures& side : sides) {
    bool within = true;
    for (int i = 0; i < dim; ++i)
      within = within && (i == up || (side.middle[i] >= box.low[i] && side.middle[i] <= box.high[i]));
    count += 1;
    under += within;
    s.shortest = std::min(s.shortest, side.shortest);
    s.longest = std::max(s.longest, side.longest);
    s.gap = std::min(s.gap, nearest(body, side.middle).first);
    for (const Point& x : side.corners) {
      s.gap = std::min(s.gap, nearest(body, x).first);
      s.box.enclose(x);
      top = std::max(top, x[up]);
    }
  }
  s.sides = static_cast<int>(sum_over_ranks(comm, count));
  s.under = static_cast<int>(sum_over_ranks(comm, under));
  s.gap = min_over_ranks(comm, s.gap);
  s.shortest = min_over_ranks(comm, s.shortest);
  s.longest = max_over_ranks(comm, s.longest);
  top = max_over_ranks(comm, top);
  for (int i = 0; i < 3; ++i) {
    s.box.low[i] = min_over_ranks(comm, s.box.low[i]);
    s.box.high[i] = max_over_ranks(comm, s.box.high[i]);
  }
  if (s.sides == 0) return;
  // the sides nearest to the body should face it, and the sides of a hole in which it lies should touch it
  const bool touches = s.gap < 0.5 * s.shortest;
  for (const SideFigures& side : sides) {
    const auto [gap, normal] = nearest(body, side.middle);
    const double facing = -dot(side.normal, normal);
    if (gap <= s.gap + s.longest) s.facing = std::max(s.facing, facing);
    const double away = std::abs(side.middle[0] - 0.5 * (box.low[0] + box.high[0]));
    const bool in_hole = side.middle[up] < top - 2 * side.longest && away < 0.75 * shadow.length && facing > 0.5 &&
                         side.middle[up] < box.high[up];
    if (!touches || !in_hole) continue;
    // on a curved shape the middles of sides are off by the arc's height, but corners are not
    double corners = 0;
    for (const Point& x : side.corners) corners = std::max(corners, std::abs(nearest(body, x).first));
    const double misfit = std::min(std::abs(gap), corners);
    if (misfit > s.misfit) {
      s.misfit = misfit;
      s.reach = side.longest;
    }
  }
  s.facing = max_over_ranks(comm, s.facing);
  const double misfit = max_over_ranks(comm, s.misfit);
  s.reach = max_over_ranks(comm, misfit == s.misfit ? s.reach : 0.0);
  s.misfit = misfit;
}

SoilBehind soil_behind(const Model& model, const std::string& surface) {
  SoilBehind behind;
  enum { count, edges, moduli, springs, sums };
  std::vector<double> sum(sums, 0.0);
  for (const Side& s : model.mesh().side_sets().at(surface)) {
    const SideFigures at = figures(model.mesh(), s);
    const SoilBlock& b = model.soil()->blocks[s.block];
    const SoilPoints points(*model.soil(), b, model.store().committed());
    for (int row = s.element * b.points; row < (s.element + 1) * b.points; ++row)
      behind.strength = std::max(behind.strength, points.soil_state(row).undrained_strength.value_or(0.0));
    const ElementBlock& block = model.mesh().blocks()[s.block];
    std::vector<Point> nodes;
    for (int a = 0; a < num_nodes(block.shape); ++a) nodes.push_back(model.mesh().place(block.nodes(s.element, a)));
    sum[count] += 1;
    sum[edges] += 0.5 * (at.shortest + at.longest);
    const double modulus = model.constrained_modulus(s.block, s.element);
    sum[moduli] += modulus;
    sum[springs] += modulus / ElementMap(block.shape, [&](int a) { return nodes[a].data(); }).size().height;
    for (const Point& x : at.corners) behind.top = std::max(behind.top, x[model.mesh().dimension() - 1]);
  }
  const Comm& comm = *model.mesh().comm();
  sum = sum_over_ranks(comm, sum);
  behind.strength = max_over_ranks(comm, behind.strength);
  behind.top = max_over_ranks(comm, behind.top);
  if (sum[count] == 0) return behind;
  behind.side = sum[edges] / sum[count];
  behind.modulus = sum[moduli] / sum[count];
  behind.stiffness = sum[springs] / sum[count];
  return behind;
}

ContactSetup::ContactSetup(const Setup& setup, const std::string& name, const Contact& contact)
    : name(name),
      model(setup.model()),
      partners(contact.partners()),
      entry(setup.deck().section("contacts").section(name)),
      deck(setup.deck()),
      soil(soil_behind(model, partners.surface)) {}

double number_in(const Section& section, const std::string& name, double fallback) {
  double value = fallback;
  if (section.has_parameter(name)) Parameters(section).add(name, value, "", any(), "");
  return value;
}

void declare_body_checks(Doubts& doubts) {
  for (const auto& check : body_checks()) doubts.declare(check.quantity);
  for (const auto& check : contact_checks()) doubts.declare(check.quantity);
}

void look_at_bodies(const Setup& setup, Doubts& doubts) {
  for (const auto& [name, body] : setup.model().bodies()) look(body_checks(), BodySetup(setup, *body), doubts);
  for (const auto& [name, contact] : setup.model().contacts())
    look(contact_checks(), ContactSetup(setup, name, *contact), doubts);
}

}  // namespace mudline
