#include "contact/master_surface.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <unordered_map>

namespace mudline {

MasterSurface::MasterSurface(const Mesh& mesh, const std::string& side_set) {
  constexpr int width = 10;  // shape, then global nodes
  std::vector<long long> mine;
  for (const Side& side : mesh.side_sets().at(side_set)) {
    const ElementBlock& block = mesh.blocks()[side.block];
    const std::vector<int> nodes = side_nodes(block.shape, side.side);
    mine.push_back(static_cast<long long>(side_shape(block.shape, side.side)));
    for (int i = 0; i < width - 1; ++i)
      mine.push_back(i < static_cast<int>(nodes.size()) ? mesh.node_ids()[block.nodes(side.element, nodes[i])] : -1);
  }
  const Teuchos::Comm<int>& comm = *mesh.comm();
  const int ranks = comm.getSize(), here = static_cast<int>(mine.size());
  std::vector<int> sizes(ranks);
  Teuchos::gatherAll(comm, 1, &here, ranks, sizes.data());
  const int largest = *std::max_element(sizes.begin(), sizes.end());
  mine.resize(std::max(1, largest), -1);
  std::vector<long long> all(mine.size() * ranks);
  Teuchos::gatherAll(comm, static_cast<int>(mine.size()), mine.data(), static_cast<int>(all.size()), all.data());
  std::vector<std::array<long long, width>> rows;
  for (int rank = 0; rank < ranks; ++rank)
    for (int i = 0; i < sizes[rank]; i += width) {
      std::array<long long, width> row{};
      std::copy_n(all.begin() + rank * mine.size() + i, width, row.begin());
      rows.push_back(row);
    }
  std::sort(rows.begin(), rows.end());
  std::unordered_map<long long, int> local;
  for (int node = 0; node < mesh.num_nodes(); ++node) local[mesh.node_ids()[node]] = node;
  for (const auto& row : rows) {
    const auto shape = static_cast<CellShape>(row[0]);
    MasterSide side{num_nodes(shape), {}, shape};
    for (int a = 0; a < side.count; ++a) {
      const auto found = local.find(row[1 + a]);
      if (found == local.end()) {
        sides_.clear();
        return;
      }
      side.node[a] = found->second;
    }
    sides_.push_back(side);
  }
}

void MasterSurface::update(const ConstCoordinateView& x) {
  std::vector<Bounds> boxes;
  for (const MasterSide& side : sides_) boxes.push_back(side_box(side.node, side.count, x));
  boxes_ = BoxTree(std::move(boxes));
}

}  // namespace mudline
