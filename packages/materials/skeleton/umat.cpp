#include "materials/skeleton/umat.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <new>

#include "core/foreign_library.hpp"
#include "core/guarded.hpp"
#include "core/text.hpp"
#include "materials/skeleton/umat_utilities.hpp"

namespace mudline {

namespace {

/// The Fortran interfaces; the hidden lengths of texts come last (gfortran: size_t).
using Routine = void (*)(double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* scd,
                         double* rpl, double* ddsddt, double* drplde, double* drpldt, const double* stran,
                         const double* dstran, const double* time, const double* dtime, const double* temp,
                         const double* dtemp, const double* predef, const double* dpred, const char* cmname,
                         const int* ndi, const int* nshr, const int* ntens, const int* nstatv, const double* props,
                         const int* nprops, const double* coords, const double* drot, double* pnewdt,
                         const double* celent, const double* dfgrd0, const double* dfgrd1, const int* noel,
                         const int* npt, const int* layer, const int* kspt, const int* kstep, const int* kinc,
                         std::size_t cmname_length);
using StateRoutine = void (*)(double* statev, const double* coords, const int* nstatv, const int* ncrds,
                              const int* noel, const int* npt, const int* layer, const int* kspt);
using StressRoutine = void (*)(double* sigma, const double* coords, const int* ntens, const int* ncrds, const int* noel,
                               const int* npt, const int* layer, const int* kspt, const int* lrebar, const char* names,
                               std::size_t names_length);

// The state begins with the accumulated strain and the deformation gradient, row-major.
constexpr int strain_size = 6, own_size = strain_size + 9;
constexpr int ours[6] = {0, 1, 2, 5, 4, 3};  // 11 22 33 12 13 23 in xx yy zz yz xz xy; its own inverse
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

/// The arrays of one call, and who makes it. Fortran does not check array bounds, so guards of NaN lie between the
/// arrays: reading there shows in the result, and writing there is detected. The memory behind them is not accessible.
class Umat::Arguments {
 public:
  enum Array {
    stress,
    statev,
    ddsdde,
    ddsddt,
    drplde,
    stran,
    dstran,
    time,
    predef,
    dpred,
    props,
    coords,
    drot,
    dfgrd0,
    dfgrd1,
    count
  };
  static const char* name(int array) {
    static const char* const names[count] = {"STRESS", "STATEV", "DDSDDE", "DDSDDT", "DRPLDE",
                                             "STRAN",  "DSTRAN", "TIME",   "PREDEF", "DPRED",
                                             "PROPS",  "COORDS", "DROT",   "DFGRD0", "DFGRD1"};
    return names[array];
  }

  Arguments(int components, int state, int properties) {
    const std::size_t n = components;
    sizes_ = {n, std::size_t(state), n * n, n, n, n, n, 2, 1, 1, std::size_t(properties), 3, 9, 9, 9};
    std::size_t total = guard;
    for (int a = 0; a < count; ++a) {
      begins_[a] = total;
      total += sizes_[a] + guard;
    }
    const std::size_t page = sysconf(_SC_PAGESIZE);
    bytes_ = (total * sizeof(double) + page - 1) / page * page;
    memory_ =
        mmap(nullptr, bytes_ + behind, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    mprotect(static_cast<char*>(memory_) + bytes_, behind, PROT_NONE);
    std::fill_n(static_cast<double*>(memory_), total, unknown);
  }
  ~Arguments() { munmap(memory_, bytes_ + behind); }
  Arguments(const Arguments&) = delete;
  Arguments& operator=(const Arguments&) = delete;

  UmatCaller caller;

  double* operator[](Array a) { return static_cast<double*>(memory_) + begins_[a]; }
  std::size_t size(Array a) const { return sizes_[a]; }

  /// "" or the place of a write outside of the arrays: "before the begin of STRESS", "past the end of STATEV".
  std::string overrun() const {
    const double* all = static_cast<const double*>(memory_);
    for (int a = 0; a < count; ++a) {
      const double *from = all + begins_[a] + sizes_[a], *first = find_written(from, guard);
      if (first == nullptr) continue;
      // the guard lies between two arrays; a write near the next one is taken to belong to it
      if (a + 1 < count && first - from > static_cast<std::ptrdiff_t>(guard - guard / 8))
        return "before the begin of " + std::string(name(a + 1));
      return "past the end of " + std::string(name(a)) + ", whose size is " + std::to_string(sizes_[a]);
    }
    return find_written(all, guard) == nullptr ? "" : "before the begin of STRESS";
  }

 private:
  static constexpr std::size_t guard = 512;         // numbers per guard
  static constexpr std::size_t behind = 64u << 20;  // bytes of address space without memory
  static const double* find_written(const double* from, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i)
      if (std::memcmp(from + i, &unknown, sizeof unknown) != 0) return from + i;
    return nullptr;
  }

  std::array<std::size_t, count> sizes_{}, begins_{};
  std::size_t bytes_ = 0;
  void* memory_ = nullptr;
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
  p.add("temperature", temperature_, "degC", any(),
        "TEMP where the model has no temperature; left out: not a number, so that a law that uses it fails");
  if (!p.given("temperature")) temperature_ = unknown;
  p.choice("stress unit", unit_, {{"Pa", StressUnit::pa}, {"kPa", StressUnit::kpa}, {"MPa", StressUnit::mpa}},
           "unit of STRESS, DDSDDE and of SIGINI's SIGMA; PROPS, STATEV and what else the subroutine keeps are in the "
           "units that it wants");
  scale_ = unit_ == StressUnit::pa ? 1 : unit_ == StressUnit::kpa ? 1e3 : 1e6;
  dimension_ = p.dimension();
  make_variables();
}

/// STATEV in its own order, except that tensors become one variable each.
void Umat::make_variables() {
  variables_ = {{"accumulated strain", strain_size, "-"}};
  for (int i = 0; i < 9; ++i)
    variables_.push_back({"deformation gradient " + std::to_string(i / 3 + 1) + std::to_string(i % 3 + 1), 1, "-",
                          Transfer::value, -1e300, 1e300, true});
  source_.clear();
  tensors_.clear();
  for (int i = 0; i < state_count_;) {
    const bool tensor =
        std::find(tensor_state_.begin(), tensor_state_.end(), i + 1) != tensor_state_.end() && i + 6 <= state_count_;
    const std::string name = "statev " + std::to_string(i + 1);
    if (tensor) {
      tensors_.push_back(i);
      variables_.push_back({name, 6, "-"});
      for (const int c : ours) source_.push_back(i + c);
      i += 6;
    } else {
      variables_.push_back({name, 1, "-"});
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
  const auto library = guarded(section, "library", "the library cannot be loaded",
                               [&] { return ForeignLibrary(library_, umat_utilities()); });
  const std::string file = std::filesystem::path(library_).filename().string();
  routine_ = library.function(symbol_);
  if (routine_ == nullptr)
    section.fail(
        "the library '" + file + "' holds no subroutine '" + symbol_ + "'; compilers usually write UMAT as umat_",
        section.has_parameter("symbol") ? "symbol" : "library");
  sdvini_ = state_count_ > 0 ? library.function("sdvini_") : nullptr;
  sigini_ = library.function("sigini_");
  if (sdvini_ && !initial_state_.empty())
    section.fail("the SDVINI of the library '" + file + "' gives STATEV at the start; give one of the two",
                 "initial state");
  arguments_ = std::make_shared<Arguments>(components_, state_count_, static_cast<int>(properties_.size()));
  arguments_->caller = {name_, file};
}

std::string Umat::initialise(const InitialPoint& point, double* state) const {
  using A = Arguments;
  std::fill(state, state + state_size(), 0.0);
  for (int i = 0; i < 3; ++i) state[strain_size + 4 * i] = 1.0;
  if (!initial_state_.empty())
    for (int i = 0; i < state_count_; ++i) state[own_size + i] = initial_state_[source_[i]];
  if (!sdvini_) return "";
  A& to = *arguments_;
  std::fill_n(to[A::statev], state_count_, 0.0);
  std::copy_n(point.position.begin(), 3, to[A::coords]);
  to.caller.element = point.element;
  to.caller.point = point.number;
  const int nstatv = state_count_, ncrds = dimension_, one = 1;
  {
    const UmatCall call(to.caller);
    reinterpret_cast<StateRoutine>(sdvini_)(to[A::statev], to[A::coords], &nstatv, &ncrds, &point.element,
                                            &point.number, &one, &one);
  }
  check_overrun("sdvini_");
  for (int i = 0; i < state_count_; ++i) state[own_size + i] = to[A::statev][source_[i]];
  return "";
}

std::string Umat::find_stress(InitialPoint& point) const {
  using A = Arguments;
  A& to = *arguments_;
  std::fill_n(to[A::stress], components_, 0.0);
  std::copy_n(point.position.begin(), 3, to[A::coords]);
  to.caller.element = point.element;
  to.caller.point = point.number;
  const int ntens = components_, ncrds = dimension_, one = 1, no_rebar = 0;
  const std::string names(160, ' ');
  {
    const UmatCall call(to.caller);
    reinterpret_cast<StressRoutine>(sigini_)(to[A::stress], to[A::coords], &ntens, &ncrds, &point.element,
                                             &point.number, &one, &one, &no_rebar, names.data(), 80);
  }
  check_overrun("sigini_");
  point.stress = {};
  for (int i = 0; i < components_; ++i) point.stress[ours[i]] = scale_ * to[A::stress][i];
  return "";
}

bool Umat::tell_surroundings(const SkeletonWorkset& w, int point, Arguments& to) const {
  using A = Arguments;
  for (const A::Array a : {A::coords, A::dfgrd0, A::dfgrd1, A::drot}) std::fill_n(to[a], to.size(a), unknown);
  const double* old = &w.state_old(point, strain_size);
  double* now = &w.state(point, strain_size);
  std::copy_n(old, 9, now);
  if (w.surroundings.extent(0) > 0) {
    const double* around = &w.surroundings(point, 0);
    std::copy_n(around + Surroundings::place, 3, to[A::coords]);
    const double *step = around + Surroundings::deformation, *turn = around + Surroundings::rotation;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        to[A::drot][i + 3 * j] = turn[3 * i + j];
        double& sum = now[3 * i + j] = 0;
        for (int k = 0; k < 3; ++k) sum += step[3 * i + k] * old[3 * k + j];
        to[A::dfgrd0][i + 3 * j] = old[3 * i + j];
        to[A::dfgrd1][i + 3 * j] = sum;
        if (!std::isfinite(sum)) return false;
      }
  }
  if (!tensors_.empty())  // already rotated by mudline
    for (int i = 0; i < 9; ++i) to[A::drot][i] = i % 4 == 0 ? 1.0 : 0.0;
  return true;
}

bool Umat::update(const SkeletonWorkset& w, int point) const {
  using A = Arguments;
  if (components_ == 4 && (w.strain(point, 3) != 0.0 || w.strain(point, 4) != 0.0)) return false;
  A& to = *arguments_;
  const double* old = &w.state_old(point, 0);
  for (int i = 0; i < components_; ++i) {
    to[A::stress][i] = w.stress_old(point, ours[i]) / scale_;
    to[A::stran][i] = (i < 3 ? 1.0 : 2.0) * old[ours[i]];
    to[A::dstran][i] = w.strain(point, ours[i]);
  }
  for (const A::Array a : {A::ddsdde, A::ddsddt, A::drplde}) std::fill_n(to[a], to.size(a), 0.0);
  for (int i = 0; i < state_count_; ++i) to[A::statev][source_[i]] = old[own_size + i];
  std::copy(properties_.begin(), properties_.end(), to[A::props]);
  to[A::predef][0] = to[A::dpred][0] = unknown;
  to[A::time][1] = w.time - w.dt;
  to[A::time][0] = to[A::time][1] - w.increment.stage_start;
  if (!tell_surroundings(w, point, to)) return false;

  std::string name = name_;
  name.resize(80, ' ');
  double sse = 0, spd = 0, scd = 0, rpl = 0, drpldt = 0, pnewdt = 1, celent = unknown, warmth[2] = {temperature_, 0};
  int element = 1, number = 1, stage = w.increment.stage, increment = w.increment.number;
  if (w.surroundings.extent(0) > 0) {
    const double* around = &w.surroundings(point, 0);
    celent = around[Surroundings::length];
    element = static_cast<int>(around[Surroundings::element]);
    number = static_cast<int>(around[Surroundings::point]);
    if (!std::isnan(around[Surroundings::temperature])) std::copy_n(around + Surroundings::temperature, 2, warmth);
  }
  int ndi = 3, nshr = components_ - 3, ntens = components_, nstatv = state_count_,
      nprops = static_cast<int>(properties_.size()), one = 1;
  double dt = w.dt;
  to.caller.element = element;
  to.caller.point = number;
  const UmatCall call(to.caller);
  reinterpret_cast<Routine>(routine_)(
      to[A::stress], to[A::statev], to[A::ddsdde], &sse, &spd, &scd, &rpl, to[A::ddsddt], to[A::drplde], &drpldt,
      to[A::stran], to[A::dstran], to[A::time], &dt, &warmth[0], &warmth[1], to[A::predef], to[A::dpred], name.data(),
      &ndi, &nshr, &ntens, &nstatv, to[A::props], &nprops, to[A::coords], to[A::drot], &pnewdt, &celent, to[A::dfgrd0],
      to[A::dfgrd1], &element, &number, &one, &one, &stage, &increment, name.size());

  for (int i = 0; i < 6; ++i)
    w.stress(point, ours[i]) = i < components_ ? scale_ * to[A::stress][i] : w.stress_old(point, ours[i]);
  for (int i = 0; i < 6; ++i) w.state(point, i) = old[i] + (i < 3 ? 1.0 : 0.5) * w.strain(point, i);
  for (int i = 0; i < state_count_; ++i) w.state(point, own_size + i) = to[A::statev][source_[i]];
  if (w.want_tangent) {
    for (int c = 0; c < 36; ++c) w.tangent(point, c) = 0.0;
    for (int i = 0; i < components_; ++i)
      for (int j = 0; j < components_; ++j)
        w.tangent(point, 6 * ours[i] + ours[j]) = scale_ * to[A::ddsdde][i + components_ * j];
    if (components_ == 4)
      for (int c = 3; c < 5; ++c) w.tangent(point, 7 * c) = shear_;  // no such shear; keeps the matrix regular
  }
  return !(pnewdt < 1.0);
}

int Umat::evaluate(const SkeletonWorkset& w) const {
  int failures = 0;
  for (int i = 0; i < w.points; ++i) {
    const bool ok = update(w, i);
    w.failed(i) = ok ? 0 : 1;
    if (ok) continue;
    ++failures;  // a failed point gets its old state
    for (int c = 0; c < 6; ++c) w.stress(i, c) = w.stress_old(i, c);
    for (std::size_t c = 0; c < w.state.extent(1); ++c) w.state(i, c) = w.state_old(i, c);
    if (w.want_tangent)
      for (int c = 0; c < 36; ++c) w.tangent(i, c) = 0.0;
  }
  check_overrun(symbol_);
  return failures;
}

void Umat::check_overrun(const std::string& symbol) const {
  // other memory of the program may be overwritten too, so it must end
  if (const std::string where = arguments_->overrun(); !where.empty())
    end_with_error("the subroutine '" + symbol + "' in the library '" + arguments_->caller.library + "' writes " +
                       where + "; 'state variables', 'components' and 'properties' say how long its arrays are",
                   1);
}

}  // namespace mudline
