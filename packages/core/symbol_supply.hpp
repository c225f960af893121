#pragma once

#include <string>
#include <vector>

namespace mudline {

/// A function of this program, under the name by which foreign libraries may call it.
struct SuppliedFunction {
  std::string name;
  void* address;
};

/// Makes, in memory, a shared library that needs the library `path` and defines `functions` for it, and returns its
/// open file. Once it is loaded, code of `path` and of what that needs finds these functions, no other code does, and a
/// function that the library has itself is not replaced: symbols that the program exports would go before those of
/// every library. The loader knows it by `supply_path`, so the file stays open as long as it is loaded. Throws
/// std::runtime_error.
int supplying_library(const std::string& path, const std::vector<SuppliedFunction>& functions);

/// The path by which an open file of this process can be loaded.
std::string supply_path(int file);

}  // namespace mudline
