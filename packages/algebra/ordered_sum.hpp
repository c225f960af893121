#pragma once

#include <Kokkos_Core.hpp>

#include <algorithm>
#include <array>

namespace mudline {

/// Number of consecutive items that one thread sums.
inline constexpr int items_of_sum = 512;

/// The kernel that sums one stretch of consecutive items.
template <int N, class Add>
struct StretchSum {
  Add add;
  int begin, end;
  Kokkos::View<double**, Kokkos::LayoutRight> parts;  // (stretch, sum)
  KOKKOS_INLINE_FUNCTION void operator()(int stretch) const {
    const int first = begin + stretch * items_of_sum, last = end - first < items_of_sum ? end : first + items_of_sum;
    double sum[N] = {};
    for (int i = first; i < last; ++i) add(i, sum);
    for (int n = 0; n < N; ++n) parts(stretch, n) = sum[n];
  }
};

/// N sums over the items [begin, end), to which add(item, sums) adds: the same bits on any number of threads, because
/// stretches of a fixed length are summed first, and then their sums in their order.
template <int N, class Add>
std::array<double, N> ordered_sum(const char* label, int begin, int end, const Add& add) {
  const int stretches = (std::max(end - begin, 0) + items_of_sum - 1) / items_of_sum;
  const Kokkos::View<double**, Kokkos::LayoutRight> parts(Kokkos::view_alloc("parts", Kokkos::WithoutInitializing),
                                                          stretches, N);
  Kokkos::parallel_for(label, Kokkos::RangePolicy<>(0, stretches), StretchSum<N, Add>{add, begin, end, parts});
  const auto here = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), parts);
  std::array<double, N> sum{};
  for (int stretch = 0; stretch < stretches; ++stretch)
    for (int n = 0; n < N; ++n) sum[n] += here(stretch, n);
  return sum;
}

}  // namespace mudline
