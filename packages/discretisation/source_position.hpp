#pragma once

#include <optional>
#include <string>

#include "core/errors.hpp"
#include "core/parameters.hpp"

namespace mudline {

/// The deck section a mesh source was read from, so that generate() can say where an error is.
class SourcePosition {
 public:
  void remember(const Parameters& p) {
    if (!p.documenting()) section_ = p.deck();
  }
  const Section& section() const { return section_.value(); }
  [[noreturn]] void fail(const std::string& message, const std::string& entry = "") const {
    if (section_) section_->fail(message, entry);
    throw InputError(message);
  }

 private:
  std::optional<Section> section_;
};

}  // namespace mudline
