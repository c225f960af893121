#pragma once

#include "core/function.hpp"
#include "core/registry.hpp"

namespace mudline {

/// The parameters of an entry of the deck's section "functions", from which a Function is made.
class FunctionDefinition {
 public:
  virtual ~FunctionDefinition() = default;
  virtual Function make() const = 0;
};

/// Registers the types "table", "profile", "expression" and "constant".
void register_functions(Registry<FunctionDefinition>& functions);

/// Reads every sublist of the deck's section "functions"; Throws InputError with path and line for errors in them.
FunctionLibrary read_functions(const Section& functions, const Registry<FunctionDefinition>& types);

}  // namespace mudline
