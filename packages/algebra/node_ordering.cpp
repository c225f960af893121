#include "algebra/node_ordering.hpp"

#include <metis.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "algebra/over_ranks.hpp"

namespace mudline {

std::vector<GlobalOrdinal> nodes_of_rows(const DofMap& dofs) {
  GlobalOrdinal here = 0;
  for (int f = 0; f < dofs.num_fields(); ++f)
    if (!dofs.field(f).apart)
      for (const GlobalOrdinal node : dofs.field(f).node_ids) here = std::max(here, node + 1);
  const GlobalOrdinal most = max_over_ranks(*dofs.comm(), here);
  std::vector<GlobalOrdinal> nodes(dofs.num_owned_dofs());
  for (int f = 0; f < dofs.num_fields(); ++f) {
    const FieldLayout& field = dofs.field(f);
    for (int dof = dofs.owned_begin(f); dof < dofs.owned_end(f); ++dof)
      nodes[dof] = field.apart ? most + dofs.owned()->getGlobalElement(dof)
                               : field.node_ids[(dof - dofs.owned_begin(f)) / field.components];
  }
  return nodes;
}

std::vector<int> nested_dissection(const std::vector<int>& rows, const std::vector<int>& columns,
                                   const std::vector<GlobalOrdinal>& node_of_row) {
  std::vector<GlobalOrdinal> nodes(node_of_row);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<idx_t> node(node_of_row.size());
  for (std::size_t row = 0; row < node.size(); ++row)
    node[row] = static_cast<idx_t>(std::lower_bound(nodes.begin(), nodes.end(), node_of_row[row]) - nodes.begin());

  std::vector<std::vector<idx_t>> around(nodes.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const idx_t a = node[rows[k] - 1], b = node[columns[k] - 1];
    if (a == b) continue;
    if (around[a].empty() || around[a].back() != b) around[a].push_back(b);
    if (around[b].empty() || around[b].back() != a) around[b].push_back(a);
  }
  std::vector<idx_t> begin{0}, neighbours;
  for (std::vector<idx_t>& list : around) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    neighbours.insert(neighbours.end(), list.begin(), list.end());
    begin.push_back(static_cast<idx_t>(neighbours.size()));
    std::vector<idx_t>().swap(list);
  }
  auto count = static_cast<idx_t>(nodes.size());
  std::vector<idx_t> order(nodes.size()), place(nodes.size());
  if (METIS_NodeND(&count, begin.data(), neighbours.data(), nullptr, nullptr, order.data(), place.data()) != METIS_OK)
    throw std::runtime_error("METIS could not order the matrix");

  std::vector<int> sorted(node.size()), result(node.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  std::stable_sort(sorted.begin(), sorted.end(), [&](int a, int b) { return place[node[a]] < place[node[b]]; });
  for (std::size_t k = 0; k < sorted.size(); ++k) result[sorted[k]] = static_cast<int>(k) + 1;
  return result;
}

}  // namespace mudline
