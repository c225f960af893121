#include "materials/skeleton/umat_utilities.hpp"

#include <Teuchos_LAPACK.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

#include "core/foreign_library.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
#include "tensor/sym6.hpp"

namespace mudline {

namespace {

const UmatCaller* calling = nullptr;
int reported_errors = 0, told_lines = 0;
constexpr int most_lines = 200;            // of all laws, per rank: a law may complain at every point of every step
constexpr std::size_t longest_text = 500;  // of STRING, as Abaqus has it
constexpr int place_in_six[6] = {0, 1, 2, 5, 4, 3};  // 11 22 33 12 13 23 in xx yy zz yz xz xy

std::string caller_text() { return calling ? calling->text() : "a UMAT"; }

/// A tensor of Fortran code as six stress-like components xx yy zz yz xz xy, and back.
class FortranTensor {
 public:
  FortranTensor(const char* routine, int lstr, int ndi, int nshr) : direct_(ndi), shear_(nshr), factor_(lstr) {
    if (lstr < 1 || lstr > 2) refuse(routine, "LSTR", lstr, "1 for stresses, 2 for strains");
    if (ndi < 0 || ndi > 3) refuse(routine, "NDI", ndi, "0 to 3");
    if (nshr < 0 || nshr > 3) refuse(routine, "NSHR", nshr, "0 to 3");
  }
  std::array<double, 6> read(const double* s) const {
    std::array<double, 6> six{};
    for (int i = 0; i < direct_; ++i) six[i] = s[i];
    for (int i = 0; i < shear_; ++i) six[place_in_six[3 + i]] = s[direct_ + i] / factor_;
    return six;
  }
  void write(const double* six, double* s) const {
    for (int i = 0; i < direct_; ++i) s[i] = six[i];
    for (int i = 0; i < shear_; ++i) s[direct_ + i] = six[place_in_six[3 + i]] * factor_;
  }

 private:
  static void refuse(const char* routine, const char* argument, int given, const char* allowed) {
    end_with_error(caller_text() + ": it calls " + routine + " with " + argument + " = " + std::to_string(given) +
                       "; allowed: " + allowed,
                   1);
  }

  int direct_, shear_;
  double factor_;  // engineering shear is twice the component
};

/// Principal values, ascending, and their directions as rows; NaN for a tensor that is not finite.
struct PrincipalAxes {
  double values[3], axes[9];

  explicit PrincipalAxes(const std::array<double, 6>& s) {
    const double full[9] = {s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2]};
    std::copy_n(full, 9, axes);
    double work[24], sum = 0;
    for (const double x : full) sum += 0.0 * x;
    int info = sum == 0.0 ? 0 : 1;
    if (info == 0) Teuchos::LAPACK<int, double>().SYEV('V', 'U', 3, axes, 3, values, work, 24, &info);
    if (info != 0) {
      std::fill_n(values, 3, std::numeric_limits<double>::quiet_NaN());
      std::fill_n(axes, 9, std::numeric_limits<double>::quiet_NaN());
      return;
    }
    const double* a = axes;
    const double orientation =
        a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) + a[2] * (a[3] * a[7] - a[4] * a[6]);
    if (orientation < 0)
      for (int i = 6; i < 9; ++i) axes[i] = -axes[i];
  }
};

/// A Fortran text: blanks at its ends and what follows a control character do not belong to it.
std::string fortran_text(const char* text, std::size_t length) {
  std::size_t end = 0;
  while (end < std::min(length, longest_text) && !std::iscntrl(static_cast<unsigned char>(text[end]))) ++end;
  return trim(std::string(text, end));
}

/// Replaces %I, %R and %S by the next integer, number and text.
std::string filled(const std::string& text, const int* integers, const double* numbers, const char* texts,
                   std::size_t text_length) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char kind = text[i] == '%' && i + 1 < text.size() ? text[i + 1] : ' ';
    if (kind == 'I') result += std::to_string(*integers++);
    if (kind == 'R') result += number_text(*numbers++);
    if (kind == 'S') result += fortran_text(texts, text_length);
    if (kind == 'S') texts += text_length;
    if (kind == 'I' || kind == 'R' || kind == 'S')
      ++i;
    else
      result += text[i];
  }
  return result;
}

}  // namespace

// The routines themselves; all arguments by reference, the hidden lengths of texts last (gfortran, ifort: size_t).
extern "C" {

static void umat_sinv(const double* stress, double* sinv1, double* sinv2, const int* ndi, const int* nshr) {
  const sym6::Invariants found = sym6::invariants(FortranTensor("SINV", 1, *ndi, *nshr).read(stress).data());
  *sinv1 = -found.p;
  *sinv2 = found.q;
}

static void umat_sprinc(const double* s, double* ps, const int* lstr, const int* ndi, const int* nshr) {
  const PrincipalAxes found(FortranTensor("SPRINC", *lstr, *ndi, *nshr).read(s));
  std::copy_n(found.values, 3, ps);
}

static void umat_sprind(const double* s, double* ps, double* an, const int* lstr, const int* ndi, const int* nshr) {
  const PrincipalAxes found(FortranTensor("SPRIND", *lstr, *ndi, *nshr).read(s));
  std::copy_n(found.values, 3, ps);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) an[k + 3 * i] = found.axes[3 * k + i];  // AN(K, I)
}

static void umat_rotsig(const double* s, const double* r, double* sprime, const int* lstr, const int* ndi,
                        const int* nshr) {
  const FortranTensor tensor("ROTSIG", *lstr, *ndi, *nshr);
  double rotation[9], turned[6];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotation[3 * i + j] = r[i + 3 * j];
  sym6::rotate(rotation, tensor.read(s).data(), turned);
  tensor.write(turned, sprime);
}

static void umat_xit() { end_with_error(caller_text() + ": it ends the run by XIT", 1); }

static void umat_stdb_abqerr(const int* lop, const char* string, const int* intv, const double* realv,
                             const char* charv, std::size_t string_length, std::size_t charv_length) {
  const std::string from = caller_text() + ": ";
  const std::string text = filled(fortran_text(string, string_length), intv, realv, charv, charv_length);
  if (*lop == -3) end_with_error(from + "it ends the run: " + text, 1);
  if (*lop != 1 && *lop != -1 && *lop != -2)
    end_with_error(from + "it calls STDB_ABQERR with LOP = " + std::to_string(*lop) + "; allowed: 1, -1, -2, -3", 1);
  if (*lop == -2) ++reported_errors;
  if (++told_lines > most_lines) return;
  if (*lop == 1) log::info_here(from + text);
  if (*lop == -1) log::warn_here(from + text);
  if (*lop == -2) log::warn_here(from + "error " + std::to_string(reported_errors) + ": " + text);
  if (told_lines == most_lines) log::warn_here("no more messages of UMATs are shown; errors are still counted");
}
}

std::vector<SuppliedFunction> umat_utilities() {
  return {
      {"sinv_", reinterpret_cast<void*>(umat_sinv)},     {"sprinc_", reinterpret_cast<void*>(umat_sprinc)},
      {"sprind_", reinterpret_cast<void*>(umat_sprind)}, {"rotsig_", reinterpret_cast<void*>(umat_rotsig)},
      {"xit_", reinterpret_cast<void*>(umat_xit)},       {"stdb_abqerr_", reinterpret_cast<void*>(umat_stdb_abqerr)}};
}

std::string UmatCaller::text() const {
  return "law '" + law + "' of the library '" + library + "', element " + std::to_string(element) + ", point " +
         std::to_string(point);
}

UmatCall::UmatCall(const UmatCaller& caller) { calling = &caller; }

UmatCall::~UmatCall() { calling = nullptr; }

int take_reported_errors() { return std::exchange(reported_errors, 0); }

}  // namespace mudline
