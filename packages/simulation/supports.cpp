#include "simulation/supports.hpp"

#include <Teuchos_LAPACK.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/text.hpp"

namespace mudline {

namespace {

using Vec = std::array<double, 2>;

std::vector<int> nodes_of(const WholeMesh& mesh, const WholeMesh::ElementSide& at) {
  const WholeMesh::Element& element = mesh.elements()[at.element];
  std::vector<int> nodes;
  for (int k : side_nodes(element.shape, at.side)) nodes.push_back(element.nodes[k]);
  return nodes;
}

/// The representative of a node in a forest of parents, whose paths get shorter on the way.
int root(std::vector<int>& parent, int node) {
  while (parent[node] != node) node = parent[node] = parent[parent[node]];
  return node;
}

}  // namespace

/// Sum of the rows' products with themselves; a motion is free where v^T G v = 0.
class Supports::Gram {
 public:
  explicit Gram(int size) : size_(size), entries_(static_cast<std::size_t>(size) * size, 0.0) {}
  void add(const Row& row) {
    for (int i = 0; i < size_; ++i)
      for (int j = 0; row[i] != 0 && j < size_; ++j) entries_[i * size_ + j] += row[i] * row[j];
  }
  /// A free motion in the chosen amplitudes only: the largest of its amplitudes is that of the returned index; -1:
  /// none.
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

Supports::Supports(Model& model)
    : model_(model), mesh_(model.mesh()), positions_(mesh_.gather(model.mesh().coordinates())) {
  find_parts();
}

void Supports::find_parts() {
  std::vector<int> parent(mesh_.num_nodes());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<int>(i);
  for (const WholeMesh::Element& element : mesh_.elements())
    for (int a = 1; a < num_nodes(element.shape); ++a)
      parent[root(parent, element.nodes[a])] = root(parent, element.nodes[0]);
  std::map<int, std::array<double, 4>> boxes;
  std::map<int, int> index;
  part_of_.resize(parent.size());
  for (std::size_t i = 0; i < parent.size(); ++i) {
    const auto [at, anew] = index.emplace(root(parent, static_cast<int>(i)), static_cast<int>(index.size()));
    part_of_[i] = at->second;
    const Vec& p = positions_[i];
    auto& box = boxes[at->second];
    if (anew) box = {p[0], p[0], p[1], p[1]};
    box = {std::min(box[0], p[0]), std::max(box[1], p[0]), std::min(box[2], p[1]), std::max(box[3], p[1])};
  }
  for (const auto& [part, box] : boxes) {
    Mover mover;
    mover.centre = {0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3])};
    mover.size = 0.5 * std::hypot(box[1] - box[0], box[3] - box[2]);
    mover.name = boxes.size() == 1 ? "the soil"
                                   : "the part of the mesh around (" + number_text(mover.centre[0]) + ", " +
                                         number_text(mover.centre[1]) + ")";
    parts_.push_back(mover);
  }
}

std::vector<Supports::Mover> Supports::movers(const Stage& stage) const {
  std::vector<Mover> all = parts_;
  for (const auto& [name, body] : model_.bodies()) {
    const auto motion = model_.motion_in(stage, name);
    if (!motion || !motion->released()) continue;
    const auto centre = body->initial_placement().centre;
    all.push_back({"body '" + name + "'", body.get(), {centre[0], centre[1]}, 0.5 * body->contour().length()});
  }
  return all;
}

std::vector<Supports::Motion> Supports::motions(const Stage& stage, const std::vector<Mover>& movers) const {
  std::vector<Motion> all;
  for (std::size_t m = 0; m < movers.size(); ++m) {
    const RigidBody* body = movers[m].body;
    for (Direction direction : {x, y, rotation})
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
  /// What is free to move; "": nothing.
  std::string free() const;

 private:
  int mover_of(const RigidBody* body) const;
  /// Adds `factor` times the displacement of a mover's point along a direction; a mover of -1 does not move.
  void displace(int mover, const Vec& at, const Vec& along, double factor, Row& row) const;
  void resist(int first, int second, const Vec& at, const Vec& along);

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

void Supports::Collector::displace(int mover, const Vec& at, const Vec& along, double factor, Row& row) const {
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    if (motions_[k].mover != mover) continue;
    const Mover& m = movers_[mover];
    const double arm = ((at[0] - m.centre[0]) * along[1] - (at[1] - m.centre[1]) * along[0]) / m.size;
    const double by_direction[3] = {along[0], along[1], arm};
    row[k] += factor * by_direction[motions_[k].direction];
  }
}

void Supports::Collector::resist(int first, int second, const Vec& at, const Vec& along) {
  Row row(motions_.size(), 0.0);
  displace(first, at, along, 1, row);
  if (second != first) displace(second, at, along, -1, row);
  gram_.add(row);
}

void Supports::Collector::add_prescribed(double time) {
  const Space& space = supports_.model_.space();
  const int n = space.dofs()->num_overlap_dofs(), u = space.find("displacement");
  Constraints held(n);
  supports_.model_.prescribe(stage_, time, time + stage_.duration, supports_.model_.store().committed(), held);
  NodalView mask("held", n);
  for (int i = 0; i < n; ++i) mask(i) = held.mask(i);
  const std::vector<double> table = supports_.mesh_.gather(space, u, mask);
  for (int node = 0; node < supports_.mesh_.num_nodes(); ++node)
    for (int i = 0; i < 2; ++i)
      if (table[2 * node + i] != 0)
        resist(supports_.part_of_[node], -1, supports_.positions_[node], {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0});
}

void Supports::Collector::add_contact(const ContactPartners& contact, bool pressed_in) {
  const WholeMesh& mesh = supports_.mesh_;
  const int body = mover_of(contact.body);
  const bool all_directions = contact.shear || pressed_in || body >= 0;
  for (const auto& at : mesh.side_sets().at(contact.surface)) {
    const std::vector<int> nodes = nodes_of(mesh, at);
    const Vec &a = supports_.positions_[nodes[0]], &b = supports_.positions_[nodes[1]];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    const Vec tangent{(b[0] - a[0]) / length, (b[1] - a[1]) / length}, normal{tangent[1], -tangent[0]};
    for (int node : nodes) {
      const Vec& p = supports_.positions_[node];
      const int other = contact.body ? body : supports_.nearest_part(contact.opposite, p);
      resist(supports_.part_of_[node], other, p, normal);
      if (all_directions) resist(supports_.part_of_[node], other, p, tangent);
    }
  }
}

void Supports::Collector::add_body_springs(double time) {
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    const RigidBody* body = movers_[motions_[k].mover].body;
    if (!body) continue;
    const auto& at = body->initial_position();
    const ReleasedMotion& motion = *supports_.model_.motion_in(stage_, body->name())->released();
    const BodyLoad load = motion.load(body->properties(), {time, {at[0], at[1], 0}, {}});
    Row row(motions_.size(), 0.0);
    row[k] = load.by_position[motions_[k].direction][motions_[k].direction] != 0 ? 1 : 0;
    gram_.add(row);
  }
}

std::string Supports::Collector::free() const {
  const char* const ways[3] = {" is free to move in x", " is free to move in y", " is free to rotate"};
  for (Direction direction : {x, y, rotation}) {
    std::vector<int> chosen;  // pure translations first, then anything
    for (std::size_t k = 0; k < motions_.size(); ++k)
      if (direction == rotation || motions_[k].direction == direction) chosen.push_back(static_cast<int>(k));
    const int found = gram_.free(chosen);
    if (found >= 0) return movers_[motions_[found].mover].name + ways[direction];
  }
  return "";
}

int Supports::nearest_part(const std::string& set, const Vec& at) const {
  int nearest = 0;
  double least = 1e300;
  for (const auto& side : mesh_.side_sets().at(set))
    for (int node : nodes_of(mesh_, side)) {
      const double distance = std::hypot(positions_[node][0] - at[0], positions_[node][1] - at[1]);
      if (distance >= least) continue;
      least = distance;
      nearest = part_of_[node];
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
