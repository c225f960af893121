// Loaded before the ranks of a test: where a wait of Open MPI would give its core away, it sleeps. Ranks that only
// yield take their turns again and again, and the rank that they wait for gets a core late.
#include <sched.h>

#include <ctime>

int sched_yield() noexcept {
  const timespec moment{0, 20000};  // [s, ns]
  return nanosleep(&moment, nullptr);
}
