#pragma once

#include <Kokkos_Core.hpp>

#include <optional>
#include <string>
#include <vector>

#include "core/parameters.hpp"
#include "materials/skeleton.hpp"

namespace mudline {

/// Numbers of a law that the deck gives as functions of the place. A point takes its own values where it starts and
/// keeps them while it moves: they stand in its state, behind the law's own variables.
class NumbersOfPlace {
 public:
  /// Where Parameters::let_vary collects the functions.
  std::vector<NumberOfPlace>& collected() { return numbers_; }
  bool empty() const { return numbers_.empty(); }
  int size() const { return static_cast<int>(numbers_.size()); }
  /// Call it when all are collected. `law`: the object of `bytes` whose members they are; `variables`: the law's own
  /// state variables, to which those of the numbers are added. `prefix` goes before their names.
  void settle(const void* law, std::size_t bytes, std::vector<StateVariable>& variables,
              const std::string& prefix = "");
  /// Keeps the law's section, for checks across numbers at each place.
  void keep(const Section& section) { section_ = section; }
  const Section& section() const { return *section_; }
  /// Writes the values of a place. Returns "" or which of them is out of range there.
  std::string at(const Point& place, double* values) const;

  /// The members of a law that take the values of a point; for kernels.
  struct Members {
    Kokkos::View<const std::size_t*> offsets;  // [byte] from the beginning of the law
    int first = 0;                             // column of the first value in the state

    KOKKOS_INLINE_FUNCTION bool none() const { return offsets.extent(0) == 0; }
    /// Sets the members of `law` to the values that stand in a point's state.
    template <class Law>
    KOKKOS_INLINE_FUNCTION void give(Law& law, const double* state) const {
      for (std::size_t k = 0; k < offsets.extent(0); ++k)
        *reinterpret_cast<double*>(reinterpret_cast<char*>(&law) + offsets(k)) = state[first + k];
    }
    /// Takes them over into the new state.
    KOKKOS_INLINE_FUNCTION void keep(const double* state_old, double* state) const {
      for (std::size_t k = 0; k < offsets.extent(0); ++k) state[first + k] = state_old[first + k];
    }
  };
  const Members& members() const { return members_; }

 private:
  std::vector<NumberOfPlace> numbers_;
  Members members_;
  std::optional<Section> section_;
};

}  // namespace mudline
