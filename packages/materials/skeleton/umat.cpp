#include "materials/skeleton/umat.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/foreign_library.hpp"
#include "core/guarded.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

/// The Fortran interface; the hidden length of CMNAME comes last (gfortran: size_t).
using Routine = void (*)(double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* scd,
                         double* rpl, double* ddsddt, double* drplde, double* drpldt, const double* stran,
                         const double* dstran, const double* time, const double* dtime, const double* temp,
                         const double* dtemp, const double* predef, const double* dpred, const char* cmname,
                         const int* ndi, const int* nshr, const int* ntens, const int* nstatv, const double* props,
                         const int* nprops, const double* coords, const double* drot, double* pnewdt,
                         const double* celent, const double* dfgrd0, const double* dfgrd1, const int* noel,
                         const int* npt, const int* layer, const int* kspt, const int* kstep, const int* kinc,
                         std::size_t cmname_length);

constexpr int strain_size = 6;               // the state begins with the strain so far
constexpr int ours[6] = {0, 1, 2, 5, 4, 3};  // 11 22 33 12 13 23 in xx yy zz yz xz xy; its own inverse
const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

}  // namespace

/// What one call needs; Fortran code may write behind what it should, so nothing of the run lies here.
struct Umat::Scratch {
  double stress[6], ddsdde[36], stran[6], dstran[6], ddsddt[6], drplde[6];
  std::vector<double> statev, props;
  std::string name;
};

void Umat::parameters(Parameters& p) {
  p.required_file("library", library_, "shared library with the subroutine");
  p.add("symbol", symbol_, "name of the subroutine in the library; gfortran writes UMAT as umat_");
  p.add("material name", name_, "passed as CMNAME, padded to 80 characters");
  p.add("components", components_, "-", closed(4, 6), "NTENS: 4 (plane strain and axisymmetry) or 6");
  p.add("properties", properties_, "as the subroutine says", any(), "PROPS, the constants that the subroutine reads");
  p.add("state variables", state_count_, "-", closed(0, 10000), "NSTATV, the number of STATEV");
  p.add("initial state", initial_state_, "as the subroutine says", any(), "STATEV at the start; left out: zeros");
  p.add("tensor state", tensor_state_, "-", positive(),
        "first positions, from 1, of tensors in STATEV with 6 components 11 22 33 12 13 23; mudline rotates them");
  p.required("bulk modulus", bulk_, "Pa", positive(),
             "of the elastic response: wave speed, penalties, preconditioners; not seen by the subroutine");
  p.required("shear modulus", shear_, "Pa", positive(), "of the elastic response, for the same uses");
  p.add("K0", k0_, "-", any(),
        "earth pressure coefficient at rest of a geostatic start; negative: the deck gives it there");
  make_variables();
}

/// STATEV in its own order, except that tensors become one variable each.
void Umat::make_variables() {
  variables_ = {{"accumulated strain", strain_size, "-", RemapRule::tensor}};
  source_.clear();
  tensors_.clear();
  for (int i = 0; i < state_count_;) {
    const bool tensor =
        std::find(tensor_state_.begin(), tensor_state_.end(), i + 1) != tensor_state_.end() && i + 6 <= state_count_;
    const std::string name = "statev " + std::to_string(i + 1);
    if (tensor) {
      tensors_.push_back(i);
      variables_.push_back({name, 6, "-", RemapRule::tensor});
      for (const int c : ours) source_.push_back(i + c);
      i += 6;
    } else {
      variables_.push_back({name, 1, "-", RemapRule::value});
      source_.push_back(i++);
    }
  }
}

void Umat::check(const Section& section) {
  if (components_ == 5) section.fail("5 is no number of stress components; allowed: 4, 6", "components");
  if (!initial_state_.empty() && static_cast<int>(initial_state_.size()) != state_count_)
    section.fail("expected " + std::to_string(state_count_) + " numbers (see 'state variables'), given " +
                     std::to_string(initial_state_.size()),
                 "initial state");
  if (tensor_state_.size() > 7)
    section.fail(std::to_string(tensor_state_.size()) + " tensors are more than can be rotated; allowed: up to 7",
                 "tensor state");
  double free = 1;
  for (const double first : tensor_state_) {
    if (first != std::floor(first) || first < free || first + 5 > state_count_)
      section.fail("no six components from " + number_text(first) + " among " + std::to_string(state_count_) +
                       " state variables behind the tensor before; positions must be whole and increase",
                   "tensor state");
    free = first + 6;
  }
  routine_ = guarded(section, "library", "the library cannot be loaded",
                     [&] { return ForeignLibrary(library_).function(symbol_); });
  if (routine_ == nullptr)
    section.fail("the library '" + std::filesystem::path(library_).filename().string() + "' holds no subroutine '" +
                     symbol_ + "'; compilers usually write UMAT as umat_",
                 section.has_parameter("symbol") ? "symbol" : "library");
}

std::string Umat::initialise(const InitialPoint&, double* state) const {
  std::fill(state, state + state_size(), 0.0);
  if (!initial_state_.empty())
    for (int i = 0; i < state_count_; ++i) state[strain_size + i] = initial_state_[source_[i]];
  return "";
}

bool Umat::update(const SkeletonWorkset& w, int point, Scratch& s) const {
  if (components_ == 4 && (w.strain(point, 3) != 0.0 || w.strain(point, 4) != 0.0)) return false;
  const double* old = &w.state_old(point, 0);
  for (int i = 0; i < 6; ++i) {
    s.stress[i] = w.stress_old(point, ours[i]);
    s.stran[i] = (i < 3 ? 1.0 : 2.0) * old[ours[i]];
    s.dstran[i] = w.strain(point, ours[i]);
    s.ddsddt[i] = s.drplde[i] = 0.0;
  }
  std::fill(s.ddsdde, s.ddsdde + 36, 0.0);
  s.statev.assign(state_count_ + 1, 0.0);
  for (int i = 0; i < state_count_; ++i) s.statev[source_[i]] = old[strain_size + i];
  s.props = properties_;
  s.props.push_back(0.0);  // an address also without properties
  s.name = name_;
  s.name.resize(80, ' ');

  double sse = 0, spd = 0, scd = 0, rpl = 0, drpldt = 0, pnewdt = 1;
  const double begin = w.time - w.dt, time[2] = {begin, begin}, zero[3] = {0, 0, 0}, celent = 1;
  const int ndi = 3, nshr = components_ - 3, one = 1, nprops = static_cast<int>(properties_.size());
  reinterpret_cast<Routine>(routine_)(
      s.stress, s.statev.data(), s.ddsdde, &sse, &spd, &scd, &rpl, s.ddsddt, s.drplde, &drpldt, s.stran, s.dstran, time,
      &w.dt, zero, zero, zero, zero, s.name.data(), &ndi, &nshr, &components_, &state_count_, s.props.data(), &nprops,
      zero, identity, &pnewdt, &celent, identity, identity, &one, &one, &one, &one, &one, &one, s.name.size());

  for (int i = 0; i < 6; ++i) w.stress(point, ours[i]) = i < components_ ? s.stress[i] : w.stress_old(point, ours[i]);
  for (int i = 0; i < 6; ++i) w.state(point, i) = old[i] + (i < 3 ? 1.0 : 0.5) * w.strain(point, i);
  for (int i = 0; i < state_count_; ++i) w.state(point, strain_size + i) = s.statev[source_[i]];
  if (w.want_tangent) {
    for (int c = 0; c < 36; ++c) w.tangent(point, c) = 0.0;
    for (int i = 0; i < components_; ++i)
      for (int j = 0; j < components_; ++j) w.tangent(point, 6 * ours[i] + ours[j]) = s.ddsdde[i + components_ * j];
    for (int c = 3; c < 5 && components_ == 4; ++c) w.tangent(point, 7 * c) = shear_;  // never strained, but regular
  }
  return !(pnewdt < 1.0);
}

int Umat::evaluate(const SkeletonWorkset& w) const {
  Scratch scratch;
  int failures = 0;
  for (int i = 0; i < w.points; ++i) {
    const bool ok = update(w, i, scratch);
    w.failed(i) = ok ? 0 : 1;
    if (ok) continue;
    ++failures;  // a failed point shows its old state
    for (int c = 0; c < 6; ++c) w.stress(i, c) = w.stress_old(i, c);
    for (std::size_t c = 0; c < w.state.extent(1); ++c) w.state(i, c) = w.state_old(i, c);
    for (int c = 0; c < 36 && w.want_tangent; ++c) w.tangent(i, c) = 0.0;
  }
  return failures;
}

}  // namespace mudline
