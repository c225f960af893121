// Test main with MPI, Kokkos and Tpetra alive; ranks other than 0 print only failures.
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#ifdef __SANITIZE_ADDRESS__
/// MPI's modules stay loaded, so that the leak checker knows whose the memory is that they keep (cmake/leaks.supp).
extern "C" int dlclose(void*) { return 0; }
#endif

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  Tpetra::ScopeGuard scope(&argc, &argv);
  const auto comm = Tpetra::getDefaultComm();
  if (comm->getRank() != 0) {
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
  }
  return RUN_ALL_TESTS();
}
