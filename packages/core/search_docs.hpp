#pragma once

#include <string>
#include <vector>

#include "core/registry.hpp"

namespace mudline {

/// What the documentation says about some words, best first, a line each: types, sections and parameters whose names,
/// choices or meaning hold all of the words, or that are called otherwise in practice ("water table" is the parameter
/// "water level"). At most `most` lines, of which the last one may count those that were left out. InputError, with the
/// nearest name, where there is nothing.
std::vector<std::string> search_docs(const std::vector<EntryDoc>& entries, const std::string& words,
                                     std::size_t most = 15);

}  // namespace mudline
