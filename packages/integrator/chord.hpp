#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace mudline {

/// Decides whether the Jacobian of an earlier iteration may serve once more (a chord instead of a tangent). A chord
/// iteration costs a residual and a solve with factors that exist, about a fifth of assembling and factoring; so it
/// pays when the contraction so far promises convergence within two or three iterations. A chord that did worse than
/// that in the same iteration of an earlier step is not tried there again for some steps: a first iteration takes waves
/// away and contracts well, and what contact and yielding leave for the next one needs a new Jacobian. Ratios: residual
/// over its tolerance, worst field.
class ChordControl {
 public:
  bool enabled = false;

  /// Key: what the matrix depends on apart from the state, that is step size, scheme and free unknowns.
  bool belongs_to(const std::vector<double>& key) const { return key == key_; }
  void start_step(const std::vector<double>& key) {
    key_ = key;
    count_ = 0;
    for (Trial& trial : trials_) trial.steps_left = std::max(trial.steps_left - 1, 0.0);
  }
  /// Starts another solve within the step.
  void start_solve() { count_ = 0; }
  /// save() appends all that the next step needs for a checkpoint; restore() reads it and removes it from the end;
  /// std::logic_error if it is incomplete.
  void save(std::vector<double>& to) const {
    to.insert(to.end(), key_.begin(), key_.end());
    for (const Trial& trial : trials_) to.insert(to.end(), {trial.contraction, trial.steps_left});
    to.push_back(valid_ ? 1.0 : 0.0);
    to.push_back(first_contraction_);
    to.push_back(static_cast<double>(key_.size()));
  }
  void restore(std::vector<double>& from) {
    constexpr std::size_t fixed = 3 + 2 * remembered;
    if (from.size() < fixed || !(from.back() >= 0 && from.back() <= static_cast<double>(from.size() - fixed)))
      throw std::logic_error("the checkpoint's memory of the last Jacobian is incomplete");
    const auto size = static_cast<std::size_t>(from.back());
    first_contraction_ = from[from.size() - 2];
    valid_ = from[from.size() - 3] != 0;
    auto place = from.end() - fixed;
    key_.assign(place - size, place);
    for (Trial& trial : trials_) {
      trial = {place[0], place[1]};
      place += 2;
    }
    from.resize(from.size() - fixed - size);
  }

  /// The matrix no longer belongs to the coming steps (other step size, unknowns, scheme), or must not be relied on.
  void forget() {
    valid_ = false;
    first_contraction_ = 1;
  }
  /// Forgets earlier steps too.
  void forget_all() {
    forget();
    trials_ = {};
  }
  void refreshed() { valid_ = fresh_ = true; }
  /// Residual ratios of the next iterate and of the one before it, relative to the same tolerance.
  void observe(double ratio, double before) {
    if (count_ > 0) contraction_ = ratio / before;
    if (count_ == 1) first_contraction_ = contraction_;
    if (count_ > 0 && count_ <= remembered && !fresh_) trials_[count_ - 1] = {contraction_, lasting};
    fresh_ = false;
    last_ = ratio;
    ++count_;
  }
  bool may_reuse() const { return serves(expected_contraction(), last_, count_); }
  /// Whether a new Jacobian is likely to be needed at the next iterate. It is not if the residual, falling at the
  /// present rate, will then have converged or be small enough for the present Jacobian, if that is `usable`.
  bool expects_jacobian(bool usable) const {
    const double c = expected_contraction();
    if (count_ == 0) return !(usable && serves(c, 1, 1));
    return !(last_ * c <= 1) && !(usable && serves(c, last_ * c, count_ + 1));
  }

 private:
  /// The first iteration of a step is judged by the first one of the previous step, because later ones always contract
  /// well.
  double expected_contraction() const { return count_ <= 1 ? first_contraction_ : contraction_; }
  /// Whether the matrix serves for the iteration after so many iterates, with this ratio at the last of them.
  bool serves(double contraction, double ratio, int iterates) const {
    if (iterates >= 1 && iterates <= remembered && trials_[iterates - 1].steps_left > 0)
      contraction = std::max(contraction, trials_[iterates - 1].contraction);
    if (!enabled || !valid_ || !(contraction < 0.1)) return false;
    return ratio <= 1 || std::log(ratio) <= -2.5 * std::log(contraction);
  }

  static constexpr int remembered = 4;   // iterations of a step
  static constexpr double lasting = 10;  // steps
  /// The last chord in an iteration of a step.
  struct Trial {
    double contraction = 0, steps_left = 0;
  };

  std::vector<double> key_;
  std::array<Trial, remembered> trials_;
  bool valid_ = false, fresh_ = false;  // fresh: formed since the last iterate
  int count_ = 0;
  double last_ = 0, contraction_ = 1, first_contraction_ = 1;
};

}  // namespace mudline
