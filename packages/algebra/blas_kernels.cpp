#include "algebra/blas_kernels.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <Teuchos_BLAS.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <vector>

namespace mudline {

namespace {

constexpr const char* chosen_kernels = "OPENBLAS_CORETYPE";
constexpr const char* replaced_kernels = "MUDLINE_REPLACED_BLAS_KERNELS";
std::string replaced_in_this_process;

template <std::size_t n>
bool is_one_of(const std::string& name, const std::array<const char*, n>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A matrix of pseudo-random numbers between -1 and 1, the same in every run.
std::vector<double> scattered(int size, unsigned seed) {
  std::vector<double> values(size);
  for (double& value : values) {
    seed = 1664525u * seed + 1013904223u;
    value = static_cast<double>(seed) / 2147483648.0 - 1.0;
  }
  return values;
}

/// Compares A B + beta C with plain loops. Matrices are stored by columns; A and B may be given as their transposes.
bool product_is_right(int rows, int columns, int inner, bool a_transposed, bool b_transposed, double beta) {
  const std::vector<double> a = scattered(rows * inner, 1), b = scattered(inner * columns, 2);
  const std::vector<double> start = scattered(rows * columns, 3);
  std::vector<double> c = start;
  Teuchos::BLAS<int, double>().GEMM(a_transposed ? Teuchos::TRANS : Teuchos::NO_TRANS,
                                    b_transposed ? Teuchos::TRANS : Teuchos::NO_TRANS, rows, columns, inner, 1.0,
                                    a.data(), a_transposed ? inner : rows, b.data(), b_transposed ? columns : inner,
                                    beta, c.data(), rows);
  const double allowed = 4 * (inner + 2) * std::numeric_limits<double>::epsilon();
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) {
      double sum = beta * start[i + rows * j];
      for (int k = 0; k < inner; ++k)
        sum += (a_transposed ? a[k + inner * i] : a[i + rows * k]) *
               (b_transposed ? b[j + columns * k] : b[k + inner * j]);
      if (!(std::abs(c[i + rows * j] - sum) <= allowed)) return false;
    }
  return true;
}

/// Solves L X = B and compares L X with B. L is a lower triangle with a large diagonal, or the transpose of one.
bool triangular_solve_is_right(int rows, int columns, bool transposed) {
  std::vector<double> triangle = scattered(rows * rows, 4);
  for (int i = 0; i < rows; ++i) triangle[i + rows * i] = rows + 1.0;
  const std::vector<double> right = scattered(rows * columns, 5);
  std::vector<double> x = right;
  Teuchos::BLAS<int, double>().TRSM(Teuchos::LEFT_SIDE, Teuchos::LOWER_TRI,
                                    transposed ? Teuchos::TRANS : Teuchos::NO_TRANS, Teuchos::NON_UNIT_DIAG, rows,
                                    columns, 1.0, triangle.data(), rows, x.data(), rows);
  const double allowed = 8 * (rows + 2) * std::numeric_limits<double>::epsilon();
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) {
      double sum = 0;
      for (int k = transposed ? i : 0; k < (transposed ? rows : i + 1); ++k)
        sum += (transposed ? triangle[k + rows * i] : triangle[i + rows * k]) * x[k + rows * j];
      if (!(std::abs(sum - right[i + rows * j]) <= allowed)) return false;
    }
  return true;
}

bool processor_has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#else
  return false;
#endif
}

}  // namespace

std::string better_kernels(const std::string& picked, bool processor_has_avx2,
                           const std::function<bool()>& results_are_right) {
  // OpenBLAS's names for x86 kernels without AVX2, or without fused multiply-adds
  static const std::array<const char*, 20> older{
      "Katmai", "Coppermine", "Northwood",  "Prescott",    "Banias",  "Atom",         "Core2",
      "Penryn", "Dunnington", "Nehalem",    "Athlon",      "Opteron", "Opteron_SSE3", "Barcelona",
      "Bobcat", "Bulldozer",  "Piledriver", "Steamroller", "Nano",    "Sandybridge"};
  static const std::array<const char*, 3> avx2{"Haswell", "Zen", "Excavator"};
  if (picked.empty() || !processor_has_avx2 || is_one_of(picked, avx2)) return "";
  return is_one_of(picked, older) || !results_are_right() ? "Haswell" : "";
}

bool dense_products_are_right() {
  for (const int size : {1, 5, 16, 33, 71})
    for (const bool a_transposed : {false, true})
      for (const bool b_transposed : {false, true})
        for (const double beta : {0.0, 1.0, -0.5})
          if (!product_is_right(size, size + 3, 2 * size + 1, a_transposed, b_transposed, beta)) return false;
  for (const int size : {1, 7, 32, 65})
    for (const bool transposed : {false, true})
      if (!triangular_solve_is_right(size, size + 2, transposed)) return false;
  return true;
}

BlasKernels blas_kernels() {
  void* name = dlsym(RTLD_DEFAULT, "openblas_get_corename");
  return {name == nullptr ? "" : reinterpret_cast<const char* (*)()>(name)(), replaced_in_this_process};
}

void use_best_blas_kernels(char** argv) {
  if (const char* replaced = std::getenv(replaced_kernels)) {  // the program has been restarted
    replaced_in_this_process = replaced;
    unsetenv(replaced_kernels);
    unsetenv(chosen_kernels);
    return;
  }
  if (std::getenv(chosen_kernels) != nullptr) return;
  const std::string picked = blas_kernels().in_use;
  bool right = true;
  const std::string better =
      better_kernels(picked, processor_has_avx2(), [&] { return right = dense_products_are_right(); });
  if (better.empty()) return;
  setenv(chosen_kernels, better.c_str(), 1);
  setenv(replaced_kernels, picked.c_str(), 1);
  execv("/proc/self/exe", argv);
  unsetenv(chosen_kernels);
  unsetenv(replaced_kernels);
  if (!right)
    throw std::runtime_error("the kernels '" + picked + "' of this OpenBLAS compute wrong results here; set " +
                             chosen_kernels + " to " + better);
}

}  // namespace mudline
