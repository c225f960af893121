#pragma once

#include <Kokkos_Core.hpp>

namespace mudline {

/// Local overlap dofs of every element of one group: (element, dof). One group per element block and field combination.
using ElementDofs = Kokkos::View<const int**, Kokkos::LayoutRight>;

/// Number of elements in a batch: few enough that their buffer stays in the cache of each thread.
int elements_of_batch();

/// The elements of a group in batches, and for each batch the rows that its elements touch. Where several threads work,
/// the elements of a batch write their vectors or matrices to a buffer, and then each row adds its own entries, element
/// after element: in the same order and with the same bits as one thread. Empty where one thread works, which adds at
/// once.
struct RowLists {
  int batch = 0;                                          // number of elements in a batch; 0: empty
  Kokkos::View<const int*, Kokkos::HostSpace> first_row;  // by batch: its first place in `rows`; and the end
  Kokkos::View<const int*> rows;                          // overlap dof
  Kokkos::View<const int*> begin;    // by place in `rows`: its first place in `entries`; and the end
  Kokkos::View<const int*> entries;  // (element - first of its batch) * columns of a group + column

  RowLists() = default;
  /// Builds the lists for the number of threads in use.
  explicit RowLists(const ElementDofs& dofs);
  RowLists(const ElementDofs& dofs, int elements_of_batch);
};

/// The contributions of a batch's elements, stored until the rows add them.
struct ElementBuffer {
  Kokkos::View<double***, Kokkos::LayoutRight> values;  // (element of the batch, row, column)
  int first = 0;                                        // first element of the batch
  KOKKOS_INLINE_FUNCTION bool used() const { return values.data() != nullptr; }
};

/// The kernel on the rows of a batch: each row adds its entries from the buffer, in the order of elements.
template <class Target>
struct AddRows {
  Target to;
  RowLists lists;
  int entries;  // number of entries of the elements in work
  KOKKOS_INLINE_FUNCTION void operator()(int i) const {
    for (int k = lists.begin(i); k < lists.begin(i + 1) && lists.entries(k) < entries; ++k)
      to.take(lists.rows(i), lists.entries(k));
  }
};

/// The rows add what the elements [begin, end) of one batch have left in the buffer of `to`.
template <class Target>
void add_rows(const char* label, const RowLists& lists, int begin, int end, const Target& to) {
  const int batch = begin / lists.batch;
  Kokkos::parallel_for(label, Kokkos::RangePolicy<>(lists.first_row(batch), lists.first_row(batch + 1)),
                       AddRows<Target>{to, lists, (end - begin) * static_cast<int>(to.dofs.extent(1))});
}

/// Calls work(first, last, to) for the elements [first, last): all at once, or, where several threads work, batch after
/// batch; after each batch the rows add from the buffer of `to`. `first` begins a batch.
template <class Target, class Work>
void in_order(const char* label, const RowLists& lists, int first, int last, Target to, Work&& work) {
  const bool batches = lists.batch > 0;
  const int step = batches && lists.batch < last - first ? lists.batch : last - first;
  if (batches) to.open_buffer(step);
  for (int begin = first; begin < last; begin += step) {
    const int end = begin + step < last ? begin + step : last;
    to.buffer.first = begin;
    work(begin, end, to);
    if (batches) add_rows(label, lists, begin, end, to);
  }
}

}  // namespace mudline
