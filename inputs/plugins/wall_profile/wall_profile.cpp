// At the end of every stage a CSV file with the profile along the wall of a contact: from the top down the place,
// depth, normal and shear traction, and the pore pressure, at the vertices of the mesh.
#include <algorithm>
#include <array>
#include <fstream>

#include "algebra/raw_communicator.hpp"
#include "simulation/model.hpp"
#include "simulation/observer.hpp"
#include "simulation/plugin.hpp"

namespace {

class WallProfile : public mudline::Observer {
 public:
  void parameters(mudline::Parameters& p) {
    p.required("contact", contact_, "Entry of 'contacts' along whose surface the profile runs");
    p.add("mudline", mudline_, "m", mudline::any(), "Height from which depths are counted");
  }
  void bind(const mudline::Model& model, const mudline::Section& section) override {
    std::vector<std::string> known;
    for (const auto& entry : model.contacts()) known.push_back(entry.first);
    if (std::find(known.begin(), known.end(), contact_) == known.end())
      section.fail("unknown contact '" + contact_ + "'" + mudline::suggestion(contact_, known), "contact");
  }
  void end_stage(const mudline::RunView& run) override {
    const std::vector<double> all = mudline::all_gather(*run.model.mesh().comm(), own_rows(run));
    if (run.model.mesh().comm()->getRank() != 0) return;
    std::vector<Row> rows(all.size() / columns);
    for (std::size_t i = 0; i < all.size(); ++i) rows[i / columns][i % columns] = all[i];
    std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a[depth] < b[depth]; });
    const std::string path = run.stem + "." + name + "." + run.stage.name + ".csv";
    std::ofstream file(path);
    file.precision(12);
    file << "x [m],y [m],z [m],depth [m],normal traction [Pa],shear traction [Pa],pore pressure [Pa]\n";
    for (const Row& row : rows)
      for (int c = 0; c < columns; ++c) file << row[c] << (c + 1 < columns ? "," : "\n");
    if (!file.flush()) throw std::runtime_error("cannot write " + path);
  }

 private:
  enum Column { x, y, z, depth, normal, shear, pore, columns };
  using Row = std::array<double, columns>;

  /// The rows of the vertices that this rank owns, one after the other.
  std::vector<double> own_rows(const mudline::RunView& run) const {
    const mudline::Mesh& mesh = run.model.mesh();
    const auto& contacts = run.model.contacts();
    const auto& contact = *std::find_if(contacts.begin(), contacts.end(), [&](const auto& entry) {
                             return entry.first == contact_;
                           })->second;
    const std::vector<double> pressure = contact.nodal_pressure(run.state), friction = contact.nodal_shear(run.state);
    const int water = run.model.space().find("pore pressure");
    std::vector<double> rows;
    for (int node : mesh.nodes_of_set(contact.partners().surface)) {
      if (node >= mesh.num_owned_nodes() || !mesh.is_vertex()[node]) continue;
      Row row{};
      for (int i = 0; i < mesh.dimension(); ++i) row[x + i] = run.state.coordinates(node, i);
      row[depth] = mudline_ - row[mesh.dimension() - 1];
      row[normal] = pressure[node];
      row[shear] = friction.empty() ? 0 : friction[node];
      row[pore] = water < 0 ? 0 : run.state.value(run.model.space().node_dof(water)(node));
      rows.insert(rows.end(), row.begin(), row.end());
    }
    return rows;
  }

  std::string contact_;
  double mudline_ = 0;
};

}  // namespace

MUDLINE_PLUGIN(registries) {
  registries.observers.add<WallProfile>("wall profile", "A CSV file per stage with tractions along a wall");
}
