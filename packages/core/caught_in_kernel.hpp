#pragma once

#include <Kokkos_Macros.hpp>

#include <atomic>
#include <exception>

namespace mudline {

/// The first exception thrown in a kernel on host threads: none may leave a parallel region.
class CaughtInKernel {
 public:
  /// action(), or false where it throws. On a device, which knows no exceptions, just action().
  template <class Action>
  KOKKOS_INLINE_FUNCTION static bool run(CaughtInKernel* caught, const Action& action) {
#if defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__) || defined(__SYCL_DEVICE_ONLY__)
    (void)caught;
    return action();
#else
    try {
      return action();
    } catch (...) {
      if (!caught->taken_.test_and_set()) caught->thrown_ = std::current_exception();
      return false;
    }
#endif
  }
  /// After the kernel: throws what was caught.
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  std::atomic_flag taken_ = ATOMIC_FLAG_INIT;
  std::exception_ptr thrown_;
};

}  // namespace mudline
