#include "algebra/row_lists.hpp"

#include <algorithm>
#include <vector>

#include "algebra/device_copy.hpp"

namespace mudline {

int elements_of_batch() { return 64 * Kokkos::DefaultExecutionSpace().concurrency(); }

RowLists::RowLists(const ElementDofs& dofs)
    : RowLists(dofs, Kokkos::DefaultExecutionSpace().concurrency() > 1 ? elements_of_batch() : 0) {}

RowLists::RowLists(const ElementDofs& dofs, int elements_of_batch) : batch(elements_of_batch) {
  if (batch == 0) return;
  const auto of_element = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), dofs);
  const int elements = static_cast<int>(dofs.extent(0)), columns = static_cast<int>(dofs.extent(1));
  struct Entry {
    int row, entry;
    bool operator<(const Entry& other) const { return row != other.row ? row < other.row : entry < other.entry; }
  };
  std::vector<int> first_of_batch, row, begin_of_row, entry;
  std::vector<Entry> of_batch;
  for (int first = 0; first < elements; first += batch) {
    of_batch.clear();
    for (int e = first; e < std::min(first + batch, elements); ++e)
      for (int a = 0; a < columns; ++a) of_batch.push_back({of_element(e, a), (e - first) * columns + a});
    std::sort(of_batch.begin(), of_batch.end());
    first_of_batch.push_back(static_cast<int>(row.size()));
    for (std::size_t i = 0; i < of_batch.size(); ++i) {
      if (i == 0 || of_batch[i].row != of_batch[i - 1].row) {
        row.push_back(of_batch[i].row);
        begin_of_row.push_back(static_cast<int>(entry.size()));
      }
      entry.push_back(of_batch[i].entry);
    }
  }
  first_of_batch.push_back(static_cast<int>(row.size()));
  begin_of_row.push_back(static_cast<int>(entry.size()));
  const Kokkos::View<int*, Kokkos::HostSpace> batches("batches", first_of_batch.size());
  std::copy(first_of_batch.begin(), first_of_batch.end(), batches.data());
  first_row = batches;
  rows = device_copy(row);
  begin = device_copy(begin_of_row);
  entries = device_copy(entry);
}

}  // namespace mudline
