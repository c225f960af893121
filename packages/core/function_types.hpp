#pragma once

#include "core/function.hpp"
#include "core/registry.hpp"

namespace mudline {

/// What an entry of the deck's section "functions" holds until it becomes a Function.
class FunctionDefinition {
 public:
  virtual ~FunctionDefinition() = default;
  virtual Function make() const = 0;
};

/// The types "table", "expression" and "constant".
void register_functions(Registry<FunctionDefinition>& functions);

/// Reads every sublist of the deck's section "functions"; InputError with path and line for what is wrong.
FunctionLibrary read_functions(const Section& functions, const Registry<FunctionDefinition>& types);

}  // namespace mudline
