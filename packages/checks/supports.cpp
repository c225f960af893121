#include "checks/supports.hpp"

#include <Teuchos_LAPACK.hpp>

#include <algorithm>
#include <cmath>

#include "algebra/over_ranks.hpp"
#include "core/told.hpp"
#include "integrator/overlap.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

Point axis(int direction) {
  Point along{};
  along[direction] = 1;
  return along;
}

/// Unit normal of the plane through the first corners of a side.
Point side_normal(const Mesh& mesh, const std::vector<int>& nodes) {
  const Point a = mesh.place(nodes[0]), b = mesh.place(nodes[1]);
  return unit(cross(b - a, mesh.dimension() == 3 ? mesh.place(nodes[2]) - a : axis(2)));
}

}  // namespace

/// Sum of the rows' products with themselves; a motion is free where v^T G v = 0.
class Supports::Gram {
 public:
  explicit Gram(int size) : size_(size), entries_(static_cast<std::size_t>(size) * size, 0.0) {}
  void add(const Row& row) {
    for (int i = 0; i < size_; ++i)
      if (row[i] != 0)
        for (int j = 0; j < size_; ++j) entries_[i * size_ + j] += row[i] * row[j];
  }
  /// Sums the entries over the ranks.
  void sum(const Comm& comm) { entries_ = sum_over_ranks(comm, entries_); }
  /// Index of the largest amplitude of a free motion in the chosen amplitudes; -1: none is free.
  int free(const std::vector<int>& chosen) const;

 private:
  int size_;
  std::vector<double> entries_;
};

int Supports::Gram::free(const std::vector<int>& chosen) const {
  const int n = static_cast<int>(chosen.size());
  if (n == 0) return -1;
  std::vector<double> matrix(static_cast<std::size_t>(n) * n), values(n), work(8 * n);
  const auto diagonal = [&](int i) { return entries_[chosen[i] * (size_ + 1)]; };
  for (int i = 0; i < n; ++i) {
    if (diagonal(i) == 0) return chosen[i];
    for (int j = 0; j < n; ++j)
      matrix[i * n + j] = entries_[chosen[i] * size_ + chosen[j]] / std::sqrt(diagonal(i) * diagonal(j));
  }
  int info = 0;
  Teuchos::LAPACK<int, double>().SYEV('V', 'U', n, matrix.data(), n, values.data(), work.data(),
                                      static_cast<int>(work.size()), &info);
  if (info != 0 || values[0] > 1e-12) return -1;
  int largest = 0;
  const auto amplitude = [&](int i) { return std::abs(matrix[i]) / std::sqrt(diagonal(i)); };
  for (int i = 1; i < n; ++i)
    if (amplitude(i) > amplitude(largest)) largest = i;
  return chosen[largest];
}

Supports::Supports(Model& model, const MeshParts& parts) : model_(model), mesh_parts_(parts) { find_parts(); }

void Supports::find_parts() {
  const Mesh& mesh = model_.mesh();
  const std::size_t count = mesh_parts_.places.size();
  std::vector<double> here(6 * count, -1e300);  // of each part: minus the lowest and the highest coordinates
  for (int node = 0; node < mesh.num_nodes(); ++node) {
    const Point x = mesh.place(node);
    double* mine = &here[6 * mesh_parts_.of_node[node]];
    for (int i = 0; i < 3; ++i) {
      mine[i] = std::max(mine[i], -x[i]);
      mine[3 + i] = std::max(mine[3 + i], x[i]);
    }
  }
  const std::vector<double> box = max_over_ranks(*mesh.comm(), here);
  for (std::size_t part = 0; part < count; ++part) {
    const double* range = &box[6 * part];
    Mover mover;
    for (int i = 0; i < 3; ++i) mover.centre[i] = 0.5 * (range[3 + i] - range[i]);
    mover.size = 0.5 * std::hypot(range[3] + range[0], range[4] + range[1], range[5] + range[2]);
    mover.name = count == 1 ? "the soil" : "the part of the mesh around " + place_text(mover.centre, dimension());
    parts_.push_back(mover);
  }
}

std::vector<Supports::Mover> Supports::movers(const Stage& stage) const {
  std::vector<Mover> all = parts_;
  for (const auto& [name, body] : model_.bodies()) {
    const auto motion = model_.motion_in(stage, name);
    if (!motion || !motion->released()) continue;
    all.push_back({"body '" + name + "'", body.get(), body->initial_placement().centre, body->reach()});
  }
  return all;
}

std::vector<Supports::Motion> Supports::motions(const Stage& stage, const std::vector<Mover>& movers) const {
  std::vector<Motion> all;
  for (std::size_t m = 0; m < movers.size(); ++m) {
    const RigidBody* body = movers[m].body;
    for (int direction = 0; direction < directions(); ++direction)
      if (body ? model_.motion_in(stage, body->name())->released()->releases(direction)
               : may_move(model_.mesh().geometry(), direction))
        all.push_back({static_cast<int>(m), direction});
  }
  return all;
}

/// The rows of one stage, collected from what acts in it.
class Supports::Collector {
 public:
  Collector(const Supports& supports, const Stage& stage)
      : supports_(supports),
        stage_(stage),
        movers_(supports.movers(stage)),
        motions_(supports.motions(stage, movers_)),
        gram_(static_cast<int>(motions_.size())) {}

  void add_prescribed(double time);
  void add_contact(const ContactPartners& contact, bool pressed_in);
  void add_body_springs(double time);
  /// Text on what is free to move; "": nothing. Collective.
  std::string free();

 private:
  int mover_of(const RigidBody* body) const;
  /// Adds `factor` times the displacement of a mover's point along a direction; a mover of -1 does not move.
  void displace(int mover, const Point& at, const Point& along, double factor, Row& row) const;
  void resist(int first, int second, const Point& at, const Point& along);

  const Supports& supports_;
  const Stage& stage_;
  std::vector<Mover> movers_;
  std::vector<Motion> motions_;
  Gram gram_;
};

int Supports::Collector::mover_of(const RigidBody* body) const {
  for (std::size_t m = 0; m < movers_.size(); ++m)
    if (body && movers_[m].body == body) return static_cast<int>(m);
  return -1;
}

void Supports::Collector::displace(int mover, const Point& at, const Point& along, double factor, Row& row) const {
  const int axes = supports_.dimension();
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    if (motions_[k].mover != mover) continue;
    const Mover& m = movers_[mover];
    const int direction = motions_[k].direction;
    const Point moment = cross(at - m.centre, along);
    row[k] += factor * (direction < axes ? along[direction] : moment[axes == 2 ? 2 : direction - 3] / m.size);
  }
}

void Supports::Collector::resist(int first, int second, const Point& at, const Point& along) {
  Row row(motions_.size(), 0.0);
  displace(first, at, along, 1, row);
  if (second != first) displace(second, at, along, -1, row);
  gram_.add(row);
}

void Supports::Collector::add_prescribed(double time) {
  const Space& space = supports_.model_.space();
  const Mesh& mesh = space.mesh();
  Constraints held(space.dofs()->num_overlap_dofs());
  supports_.model_.prescribe(stage_, time, time + stage_.duration, supports_.model_.store().committed(), held);
  const auto& dof = space.node_dof(space.find("displacement"));
  for (int node = 0; node < mesh.num_owned_nodes(); ++node)
    for (int i = 0; i < supports_.dimension(); ++i)
      if (held.mask(dof(node) + i)) resist(supports_.mesh_parts_.of_node[node], -1, mesh.place(node), axis(i));
}

void Supports::Collector::add_contact(const ContactPartners& contact, bool pressed_in) {
  const Mesh& mesh = supports_.model_.mesh();
  const int body = mover_of(contact.body);
  const bool all_directions = contact.shear || pressed_in || body >= 0;
  for (const Side& side : mesh.side_sets().at(contact.surface)) {
    const ElementBlock& block = mesh.blocks()[side.block];
    std::vector<int> nodes;
    for (int local : side_nodes(block.shape, side.side)) nodes.push_back(block.nodes(side.element, local));
    const Point normal = side_normal(mesh, nodes);
    for (int node : nodes) {
      const int part = supports_.mesh_parts_.of_node[node];
      const Point p = mesh.place(node);
      const int other = contact.body ? body : supports_.nearest_part(contact.opposite, p);
      if (all_directions)
        for (int i = 0; i < supports_.dimension(); ++i) resist(part, other, p, axis(i));
      else
        resist(part, other, p, normal);
    }
  }
}

void Supports::Collector::add_body_springs(double time) {
  if (supports_.model_.mesh().comm()->getRank() != 0) return;  // every rank knows all bodies
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    const RigidBody* body = movers_[motions_[k].mover].body;
    if (!body) continue;
    const ReleasedMotion& motion = *supports_.model_.motion_in(stage_, body->name())->released();
    const int direction = motions_[k].direction;
    BodyInstant at = body->initial_instant();
    at.time = time;
    if (direction < body->dimension()) at.position[direction].d[direction] = 1;
    Row row(motions_.size(), 0.0);
    row[k] = along(motion.load(body->properties(), at), body->dimension(), direction).d[direction] != 0 ? 1 : 0;
    gram_.add(row);
  }
}

std::string Supports::Collector::free() {
  gram_.sum(*supports_.model_.mesh().comm());
  const int axes = supports_.dimension();
  for (int direction = 0; direction <= axes; ++direction) {
    std::vector<int> chosen;  // pure translations first, then anything
    for (std::size_t k = 0; k < motions_.size(); ++k)
      if (direction == axes || motions_[k].direction == direction) chosen.push_back(static_cast<int>(k));
    const int found = gram_.free(chosen);
    if (found < 0) continue;
    const Motion& motion = motions_[found];
    const std::string way = motion.direction < axes ? std::string("move in ") + axis_names[motion.direction]
                            : axes == 2             ? "rotate"
                                                    : std::string("rotate about ") + axis_names[motion.direction - 3];
    return movers_[motion.mover].name + " is free to " + way;
  }
  return "";
}

int Supports::nearest_part(const std::string& set, const Point& at) const {
  int nearest = 0;
  double least = 1e300;
  for (int node : model_.mesh().nodes_of_set(set)) {
    const double here = length(model_.mesh().place(node) - at);
    if (here >= least) continue;
    least = here;
    nearest = mesh_parts_.of_node[node];
  }
  return nearest;
}

std::string Supports::missing(const Stage& stage, double time, bool pressed_in) const {
  Collector rows(*this, stage);
  rows.add_prescribed(time);
  for (const auto& [name, contact] : model_.contacts())
    if (std::find(stage.contacts.begin(), stage.contacts.end(), name) != stage.contacts.end())
      rows.add_contact(contact->partners(), pressed_in);
  rows.add_body_springs(time);
  return rows.free();
}

}  // namespace mudline
