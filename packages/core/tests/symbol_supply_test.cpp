#include "core/symbol_supply.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace mudline {
namespace {

int answer() { return 42; }
double twice(double x) { return 2 * x; }

template <class Function>
Function* symbol(void* library, const char* name) {
  return reinterpret_cast<Function*>(dlsym(library, name));
}

TEST(SymbolSupply, DefinesFunctionsBesideThoseOfOneLibrary) {
  const int file = supplying_library("libm.so.6", {{"mudline_answer_", reinterpret_cast<void*>(answer)},
                                                   {"mudline_twice_", reinterpret_cast<void*>(twice)}});
  void* const library = dlopen(supply_path(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(library, nullptr) << dlerror();
  EXPECT_EQ(symbol<int()>(library, "mudline_answer_")(), 42);
  EXPECT_EQ(symbol<double(double)>(library, "mudline_twice_")(3), 6);
  EXPECT_EQ(symbol<double(double)>(library, "cos")(0), 1);
  EXPECT_EQ(dlsym(library, "mudline_other_"), nullptr);
  EXPECT_EQ(dlsym(RTLD_DEFAULT, "mudline_answer_"), nullptr);  // other libraries do not see it
}

TEST(SymbolSupply, ALibraryThatIsNotThereIsNamed) {
  const int file = supplying_library("/nowhere/none.so", {});
  EXPECT_EQ(dlopen(supply_path(file).c_str(), RTLD_NOW | RTLD_LOCAL), nullptr);
  EXPECT_NE(std::string(dlerror()).find("/nowhere/none.so"), std::string::npos);
  close(file);
}

}  // namespace
}  // namespace mudline
