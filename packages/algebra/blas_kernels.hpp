#pragma once

#include <functional>
#include <string>

namespace mudline {

// OpenBLAS picks its kernels by the model of the processor. A version that is older than the processor does not know
// the model and takes kernels of 2004 (Prescott), two to four times slower. Kernels for AVX-512 of old versions were
// wrong on some processors. Other kernels are chosen by the environment variable OPENBLAS_CORETYPE, which the library
// reads when it is loaded, so a program that wants other kernels has to restart itself.

/// Restarts this program with better kernels, where there are some, and does not return then. A value that the user has
/// set in OPENBLAS_CORETYPE is kept. Programs that are started from this one choose for themselves. Throws
/// std::runtime_error where results are wrong and the program cannot be restarted.
void use_best_blas_kernels(char** argv);

/// Names of OpenBLAS's kernels in this process.
struct BlasKernels {
  std::string in_use;    // "" where the BLAS is not OpenBLAS
  std::string replaced;  // OpenBLAS's pick before use_best_blas_kernels; "" where it is still in use
};
BlasKernels blas_kernels();

/// The kernels that suit a processor better than `picked`, or "": Haswell's, where the processor has AVX2 and fused
/// multiply-adds and the picked ones use less, or where the picked ones use more (AVX-512) and compute wrong results.
/// `results_are_right` is called only for kernels that are in no list of known ones.
std::string better_kernels(const std::string& picked, bool processor_has_avx2,
                           const std::function<bool()>& results_are_right);

/// True where products and triangular solves of this process' BLAS agree with plain loops to rounding, for sizes on
/// both sides of the blocks of its kernels.
bool dense_products_are_right();

}  // namespace mudline
