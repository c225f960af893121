// Plugin: the contact "timed penalty" is `penalty` with timers around its parts: search (begin), residual, Jacobian,
// augmentation, relocation. At the end of the run it prints how long that took, and how long from its first step to its
// last.
#include <chrono>
#include <cstdio>

#include "contact/body/penalty_contact.hpp"
#include "simulation/plugin.hpp"

namespace {

using Clock = std::chrono::steady_clock;

struct Part {
  double seconds = 0;
  long calls = 0;
};

class Timer {
 public:
  explicit Timer(Part& part) : part_(part), start_(Clock::now()) { ++part_.calls; }
  ~Timer() { part_.seconds += std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  Part& part_;
  Clock::time_point start_;
};

class TimedContact : public mudline::PenaltyContact {
 public:
  using PenaltyContact::PenaltyContact;
  ~TimedContact() override {
    double sum = 0;
    const char* names[] = {"search", "residual", "Jacobian", "augmentation"};
    for (int i = 0; i < 4; ++i) {
      std::printf("contact %s: %ld calls, %.3f s\n", names[i], parts_[i].calls, parts_[i].seconds);
      sum += parts_[i].seconds;
    }
    const double all = std::chrono::duration<double>(last_ - first_).count();
    std::printf("contact: %.3f s of %.3f s of stepping, %.2f %%\n", sum, all, 100 * sum / all);
  }
  void begin(const mudline::StepView& view) override {
    if (parts_[0].calls == 0) first_ = Clock::now();
    const Timer timer(parts_[0]);
    PenaltyContact::begin(view);
  }
  int residual(const mudline::StepView& view, const mudline::ResidualView& f) override {
    const Timer timer(parts_[1]);
    return PenaltyContact::residual(view, f);
  }
  void jacobian(const mudline::StepView& view, mudline::Assembler& assembler, double weight) override {
    const Timer timer(parts_[2]);
    PenaltyContact::jacobian(view, assembler, weight);
  }
  mudline::Augmentation augment(const mudline::StepView& view, int count) override {
    const Timer timer(parts_[3]);
    last_ = Clock::now();
    return PenaltyContact::augment(view, count);
  }

 private:
  Part parts_[4];
  Clock::time_point first_ = Clock::now(), last_ = first_;
};

}  // namespace

MUDLINE_PLUGIN(registries) { registries.contacts.add<TimedContact>("timed penalty", "penalty, with a clock"); }
