#pragma once

#include <Kokkos_Core.hpp>

#include <vector>

namespace mudline {

/// Copies a list of plain values from the host to memory that kernels read.
template <class T>
Kokkos::View<const T*> device_copy(const std::vector<T>& from) {
  const Kokkos::View<T*> to(Kokkos::view_alloc("list", Kokkos::WithoutInitializing), from.size());
  Kokkos::deep_copy(to, Kokkos::View<const T*, Kokkos::HostSpace>(from.data(), from.size()));
  return to;
}

}  // namespace mudline
