#include "algebra/dof_map.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <stdexcept>
#include <utility>

#include "algebra/over_ranks.hpp"
#include "algebra/tpetra_compat.hpp"

namespace mudline {

namespace {

/// The owner rank of each ghost node of a field, and the node's index on that rank.
struct GhostOwners {
  std::vector<int> rank;
  std::vector<LocalOrdinal> index;
};

GhostOwners find_owners(const FieldLayout& field, const RCP<const Comm>& comm) {
  const std::vector<GlobalOrdinal> owned(field.node_ids.begin(), field.node_ids.begin() + field.num_owned);
  const std::size_t ghosts = field.node_ids.size() - owned.size();
  GhostOwners owners{std::vector<int>(ghosts), std::vector<LocalOrdinal>(ghosts)};
  const RCP<const Map> nodes = make_map(owned, comm);
  const auto status =
      nodes->getRemoteIndexList(Teuchos::ArrayView<const GlobalOrdinal>(field.node_ids.data() + owned.size(), ghosts),
                                Teuchos::ArrayView<int>(owners.rank.data(), ghosts),
                                Teuchos::ArrayView<LocalOrdinal>(owners.index.data(), ghosts));
  if (on_any_rank(*comm, ghosts > 0 && status == Tpetra::IDNotPresent))
    throw std::logic_error("field '" + field.name + "' has a shared node that no rank owns");
  return owners;
}

}  // namespace

DofMap::DofMap(RCP<const Comm> comm, std::vector<FieldLayout> fields) : fields_(std::move(fields)) {
  const int num_fields = static_cast<int>(fields_.size());
  for (const FieldLayout& field : fields_) {
    owned_begin_.push_back(static_cast<int>(num_owned_dofs_));
    num_owned_dofs_ += static_cast<std::size_t>(field.num_owned) * field.components;
  }
  num_overlap_dofs_ = num_owned_dofs_;
  for (const FieldLayout& field : fields_) {
    ghost_begin_.push_back(static_cast<int>(num_overlap_dofs_));
    num_overlap_dofs_ += (field.node_ids.size() - field.num_owned) * field.components;
  }

  // The first global id of every field on every rank.
  owned_ = make_dense_map(num_owned_dofs_, comm);
  const GlobalOrdinal first_here = num_owned_dofs_ > 0 ? owned_->getMinGlobalIndex() : 0;
  std::vector<GlobalOrdinal> begin_here(num_fields), begin(static_cast<std::size_t>(num_fields) * comm->getSize());
  for (int f = 0; f < num_fields; ++f) begin_here[f] = first_here + owned_begin_[f];
  Teuchos::gatherAll<int, GlobalOrdinal>(*comm, num_fields, begin_here.data(), static_cast<int>(begin.size()),
                                         begin.data());

  std::vector<GlobalOrdinal> overlap_ids(local_ids(*owned_).begin(), local_ids(*owned_).end());
  field_of_.resize(num_overlap_dofs_);
  for (int f = 0; f < num_fields; ++f) {
    const int components = fields_[f].components;
    for (int dof = owned_begin(f); dof < owned_end(f); ++dof) field_of_[dof] = f;
    const GhostOwners owners = find_owners(fields_[f], comm);
    for (std::size_t g = 0; g < owners.rank.size(); ++g)
      for (int c = 0; c < components; ++c) {
        field_of_[overlap_ids.size()] = f;
        overlap_ids.push_back(begin[owners.rank[g] * num_fields + f] + GlobalOrdinal(owners.index[g]) * components + c);
      }
  }
  overlap_ = make_map(overlap_ids, comm);
  import_ = rcp(new Import(owned_, overlap_));
  for (int f = 0; f < num_fields; ++f)
    field_maps_.push_back(make_map({overlap_ids.begin() + owned_begin(f), overlap_ids.begin() + owned_end(f)}, comm));
}

int DofMap::find(const std::string& name) const {
  for (int f = 0; f < num_fields(); ++f)
    if (fields_[f].name == name) return f;
  return -1;
}

}  // namespace mudline
