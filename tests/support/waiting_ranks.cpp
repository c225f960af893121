// Loaded before the ranks of a test: it replaces the wait of Open MPI, which gives its core away at each look for a
// message. On a busy machine the rank gets its core back only after several milliseconds, and MUMPS looks often while
// it has work. So a rank keeps its core for the first looks of a wait, and sleeps between the later ones.
#include <sched.h>
#include <sys/prctl.h>

#include <ctime>

namespace {

constexpr long patience = 100000;  // [ns] a wait that is longer sleeps
constexpr long pause = 20000;      // [ns] of one sleep
constexpr long work = 10000;       // [ns] between two looks: the rank has worked, and another wait begins

long now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * 1000000000L + time.tv_nsec;
}

}  // namespace

int sched_yield() noexcept {
  [[maybe_unused]] static const int set =
      prctl(PR_SET_TIMERSLACK, 1000);  // [ns] by which Linux lengthens a sleep, 50000 by default
  static long begin = 0;
  static long last = 0;
  const long look = now();
  if (look - last > work) begin = look;
  last = look;
  if (look - begin < patience) return 0;
  const timespec moment{0, pause};
  const int interrupted = nanosleep(&moment, nullptr);
  last = now();
  return interrupted;
}
