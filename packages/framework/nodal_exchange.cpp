#include "framework/nodal_exchange.hpp"

#include "algebra/types.hpp"

namespace mudline {

struct NodalExchange::Plan {
  RCP<const Map> owned, overlap;
  RCP<const Import> import;
};

NodalExchange::NodalExchange(const Mesh& mesh, Nodes nodes) : plan_(std::make_unique<Plan>()) {
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  std::vector<GlobalOrdinal> ids;
  int owned = 0;
  for (int node = 0; node < mesh.num_nodes(); ++node) {
    if (nodes == Nodes::vertices && !mesh.is_vertex()[node]) continue;
    ids.push_back(mesh.node_ids()[node]);
    if (node < mesh.num_owned_nodes()) ++owned;
  }
  const Teuchos::ArrayView<const GlobalOrdinal> all(ids.data(), ids.size());
  plan_->owned = rcp(new Map(invalid, all.view(0, owned), 0, mesh.comm()));
  plan_->overlap = rcp(new Map(invalid, all, 0, mesh.comm()));
  plan_->import = rcp(new Import(plan_->owned, plan_->overlap));
}

NodalExchange::~NodalExchange() = default;

void NodalExchange::sum_shared(std::vector<double>& values, int columns) const {
  MultiVector overlap(plan_->overlap, columns), owned(plan_->owned, columns);
  const std::size_t rows = overlap.getLocalLength();
  {
    const auto to = overlap.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < rows; ++i)
      for (int c = 0; c < columns; ++c) to(i, c) = values[i * columns + c];
  }
  owned.doExport(overlap, *plan_->import, Tpetra::ADD);
  overlap.doImport(owned, *plan_->import, Tpetra::INSERT);
  const auto from = overlap.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t i = 0; i < rows; ++i)
    for (int c = 0; c < columns; ++c) values[i * columns + c] = from(i, c);
}

}  // namespace mudline
