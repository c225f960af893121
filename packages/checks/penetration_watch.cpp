#include "checks/penetration_watch.hpp"

#include <algorithm>
#include <cmath>

#include "core/log.hpp"
#include "discretisation/element_map.hpp"
#include "integrator/overlap.hpp"
#include "simulation/pressed_sides.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

const char* const of_displacement = "penetration of way";
const char* const of_side = "penetration of side";
const char* const of_width = "penetration of width";

double depth_of(const std::string& contact, const Report& report) {
  const auto found = report.find("contact/" + contact + "/maximum penetration");
  return found == report.end() ? 0.0 : found->second.value;
}

}  // namespace

void PenetrationWatch::declare(Doubts& doubts) {
  doubts.declare(
      {of_displacement,
       "-",
       {0, 0.15},
       "of a contact during the run: penetration over the distance that the body has moved since it touched (two "
       "surfaces: over the distance that their nodes have moved)"});
  doubts.declare({of_side,
                  "-",
                  {0, 0.5},
                  "of a contact during the run: penetration over the length of the sides that it presses"});
  doubts.declare({of_width, "-", {0, 0.1}, "of a contact during the run: penetration over the body's half width"});
}

std::vector<Point> PenetrationWatch::places(const Model& model, const ContactPartners& partners) const {
  const State& state = model.store().committed();
  std::vector<Point> result;
  if (partners.body != nullptr) return result;
  for (const std::string& set : {partners.surface, partners.opposite})
    for (int node : model.mesh().nodes_of_set(set)) result.push_back(place_of(state.coordinates, node));
  return result;
}

double PenetrationWatch::displacement(const Model& model, const ContactPartners& partners, const Record& record) const {
  if (partners.body != nullptr)
    return partners.body->largest_displacement(record.placement, partners.body->placement(model.store().committed()));
  const std::vector<Point> now = places(model, partners);
  double farthest = 0;
  for (std::size_t i = 0; i < std::min(now.size(), record.places.size()); ++i)
    farthest = std::max(farthest, length(now[i] - record.places[i]));
  return max_over_ranks(*model.mesh().comm(), farthest);
}

double PenetrationWatch::shortest_side(const Model& model, const std::string& surface) const {
  const State& state = model.store().committed();
  double shortest = any_size;
  for (const Side& side : model.mesh().side_sets().at(surface)) {
    const ElementBlock& block = model.mesh().blocks()[side.block];
    const std::vector<int> local = side_nodes(block.shape, side.side);
    const int corners = num_corners(side_shape(block.shape, side.side));
    for (int c = 0; c < (corners == 2 ? 1 : corners); ++c)
      shortest =
          std::min(shortest, length(place_of(state.coordinates, block.nodes(side.element, local[c])) -
                                    place_of(state.coordinates, block.nodes(side.element, local[(c + 1) % corners]))));
  }
  return min_over_ranks(*model.mesh().comm(), shortest);
}

PenetrationWatch::Pressed PenetrationWatch::pressed(const Model& model, const std::string& name,
                                                    const Contact& contact) const {
  const State& state = model.store().committed();
  const std::vector<double> pressure = contact.nodal_pressure(state);
  const int array = model.store().find("contact/" + name + "/penalty");
  const auto& sides = model.mesh().side_sets().at(contact.partners().surface);
  enum { count, length_sum, penalty, stiffness, sums };
  std::vector<double> all(sums, 0.0);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const ElementBlock& block = model.mesh().blocks()[sides[s].block];
    const std::vector<int> local = side_nodes(block.shape, sides[s].side);
    const int corners = num_corners(side_shape(block.shape, sides[s].side)), edges = corners == 2 ? 1 : corners;
    double edge = 0, most = 0;
    for (int c = 0; c < corners; ++c) {
      const int node = block.nodes(sides[s].element, local[c]),
                next = block.nodes(sides[s].element, local[(c + 1) % corners]);
      most = std::max(most, pressure[node]);
      if (c < edges) edge += length(place_of(state.coordinates, node) - place_of(state.coordinates, next)) / edges;
    }
    if (!(most > 0)) continue;
    const double height =
        ElementMap(block.shape, [&](int a) { return &state.coordinates(block.nodes(sides[s].element, a), 0); })
            .size()
            .height;
    all[count] += 1;
    all[length_sum] += edge;
    if (array >= 0 && s < state.arrays[array].extent(0)) all[penalty] += state.arrays[array](s, 0);
    all[stiffness] += model.constrained_modulus(sides[s].block, sides[s].element) / height;
  }
  all = sum_over_ranks(*model.mesh().comm(), all);
  if (!(all[count] > 0)) return {};
  return {all[length_sum] / all[count], all[penalty] / all[count], all[stiffness] / all[count]};
}

void PenetrationWatch::start_record(const Model& model, const ContactPartners& partners, Record& record) const {
  record.places = places(model, partners);
  if (partners.body != nullptr) record.placement = partners.body->placement(model.store().committed());
}

void PenetrationWatch::begin_stage(const RunView& run) {
  for (const auto& [name, contact] : run.model.contacts()) {
    Record& record = records_[name];
    start_record(run.model, contact->partners(), record);
    record.depth = depth_of(name, run.report);
    record.displacement = 0;
    record.told = false;
  }
}

void PenetrationWatch::look(const RunView& run, double least) {
  if (run.stage.type == Stage::Type::geostatic) return;
  for (const auto& [name, contact] : run.model.contacts()) {
    const auto found = records_.find(name);
    if (found == records_.end()) continue;
    Record& record = found->second;
    const double depth = depth_of(name, run.report);
    if (depth > 0) {
      look_at(run.model, name, *contact, depth, least, record);
    } else if (record.displacement == 0) {
      start_record(run.model, contact->partners(), record);
      record.depth = 0;
    }
  }
}

void PenetrationWatch::look_at(const Model& model, const std::string& name, const Contact& contact, double depth,
                               double least, Record& record) {
  const ContactPartners partners = contact.partners();
  record.displacement = std::max(record.displacement, displacement(model, partners, record));
  const double more = depth - record.depth,
               share_of_displacement = record.displacement > 0 ? more / record.displacement : 0.0;
  const double width = partners.body != nullptr ? pressed_half_width(model, contact) : 0.0;
  const double share_of_width = width > 0 ? depth / width : 0.0;
  const double time = model.store().committed().time;
  if (record.told) {
    const double share = record.quantity == of_displacement ? share_of_displacement
                         : record.quantity == of_side       ? depth / record.side
                                                            : share_of_width;
    if (share > record.worst) record.keep(depth, share, time);
    return;
  }
  const double shortest = shortest_side(model, partners.surface);
  const bool far = more > least * shortest && !doubts_.usual(of_displacement, share_of_displacement);
  const bool deep = !doubts_.usual(of_side, depth / shortest), wide = !doubts_.usual(of_width, share_of_width);
  if (!far && !deep && !wide) return;
  const Pressed at = pressed(model, name, contact);
  const double side = at.side > 0 ? at.side : shortest;
  const std::string numbers = "its penetration, " + readable(depth, "m", 3) + " at t " + told(time, "%.6g") +
                              " s after a distance of " + readable(record.displacement, "m", 3) + " in sides of " +
                              readable(side, "m", 3) + ",";
  const std::string soil = "the penalty of " + readable(at.penalty, "Pa/m", 3) +
                           " deforms, not the soil, whose stiffness over height is " +
                           readable(at.stiffness, "Pa/m", 3);
  const auto advice = [&](double share, const std::string& quantity) {
    const double wanted = std::max(at.penalty * share / (0.5 * doubts_.highest(quantity)), 10 * at.stiffness);
    return soil + "; give a 'penalty' of " + readable(wanted, "Pa/m", 3) +
           " or more, or 'enforcement' = augmented Lagrangian, or refine the surface, and doubt the forces from "
           "there on";
  };
  const struct {
    const char* quantity;
    double share;
    bool applies;
    const char* over;
  } shares[] = {{of_displacement, share_of_displacement, far && more > least * side, "the distance"},
                {of_side, depth / side, true, "the side"},
                {of_width, share_of_width, true, "the body's half width"}};
  for (const auto& [quantity, share, applies, over] : shares) {
    if (!applies) continue;
    const std::string line =
        doubts_.line(quantity, share, "contact '" + name + "': " + numbers + " over " + over, advice(share, quantity));
    if (line.empty()) continue;
    record.told = true;
    record.quantity = quantity;
    record.side = side;
    record.over = over;
    record.keep(depth, share, time);
    log::warn(line);
    return;
  }
}

void PenetrationWatch::Record::keep(double depth, double share, double time) {
  worst = share;
  worst_depth = depth;
  worst_time = time;
}

void PenetrationWatch::end_run(const RunView&, RunEnd end) {
  if (end != RunEnd::done) return;
  for (const auto& [name, record] : records_)
    if (record.worst > 0)
      log::warn("contact '" + name + "' was too soft during the run: its penetration was " +
                readable(record.worst_depth, "m", 3) + ", " + told(record.worst) + " of " + record.over + ", at t " +
                told(record.worst_time, "%.6g") + " s (see plausibility/" + record.quantity + ")");
}

}  // namespace mudline
