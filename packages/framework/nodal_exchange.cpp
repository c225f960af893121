#include "framework/nodal_exchange.hpp"

#include "algebra/types.hpp"

namespace mudline {

struct NodalExchange::Plan {
  RCP<const Map> owned, overlap;
  RCP<const Import> import;
};

NodalExchange::NodalExchange(const Mesh& mesh) : plan_(std::make_unique<Plan>()) {
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  std::vector<GlobalOrdinal> ids(mesh.node_ids().begin(), mesh.node_ids().end());
  const Teuchos::ArrayView<const GlobalOrdinal> all(ids.data(), ids.size());
  plan_->owned = rcp(new Map(invalid, all.view(0, mesh.num_owned_nodes()), 0, mesh.comm()));
  plan_->overlap = rcp(new Map(invalid, all, 0, mesh.comm()));
  plan_->import = rcp(new Import(plan_->owned, plan_->overlap));
}

NodalExchange::~NodalExchange() = default;

void NodalExchange::sum_shared(std::vector<double>& values) const {
  Vector overlap(plan_->overlap, Teuchos::ArrayView<const double>(values.data(), values.size())), owned(plan_->owned);
  owned.doExport(overlap, *plan_->import, Tpetra::ADD);
  overlap.doImport(owned, *plan_->import, Tpetra::INSERT);
  overlap.get1dCopy(Teuchos::ArrayView<double>(values.data(), values.size()));
}

}  // namespace mudline
