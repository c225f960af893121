#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/element_loop.hpp"

namespace mudline {

/// A term that consists of laws at points (PointLaw): its residual and its Jacobian follow from the laws.
///
/// Laws is a function object, called with a step and a function add(block, level, law). It calls `add` once for every
/// law and every block of elements on which the law acts, with the level at which it acts; in a step without a law it
/// does not call it:
///     [soil](const StepView& view, auto&& add) {
///       if (!view.flow) return;  // a geostatic stage takes no time
///       for (const SoilBlock& b : soil->blocks) add(b, loop_level(view, view.balance, b), MyLaw{...});
///     }
template <class Laws>
class LoopTerm : public Term {
 public:
  using Blocks = std::shared_ptr<std::vector<FieldBlock>>;
  LoopTerm(std::string name, Role role, Geometry geometry, Laws laws, Blocks own)
      : name_(std::move(name)), role_(role), geometry_(geometry), laws_(std::move(laws)), own_(std::move(own)) {}
  std::string name() const override { return name_; }
  Role role() const override { return role_; }
  void sparsity(Assembler& assembler) override {
    if (own_)
      for (FieldBlock& block : *own_) block.group = assembler.add_group(block.dofs);
  }
  int residual(const StepView& view, const ResidualView& f) override {
    int failures = 0;
    laws_(view, [&](const FieldBlock& block, const LoopLevel& level, const auto& law) {
      failures += add_residual(geometry_, block, level, law, f);
    });
    return failures;
  }
  void jacobian(const StepView& view, Assembler& assembler, double weight) override {
    laws_(view, [&](const FieldBlock& block, const LoopLevel& level, const auto& law) {
      add_tangent(geometry_, block, level, law, assembler.scatter(block.group), weight);
    });
  }

 private:
  std::string name_;
  Role role_;
  Geometry geometry_;
  Laws laws_;
  Blocks own_;
};

/// Makes such a term. `own`: blocks that no other term has; the term gives them their places in the matrix. Without
/// them the blocks are those of the soil, which has done so.
template <class Laws>
std::unique_ptr<Term> loop_term(std::string name, Role role, Geometry geometry, Laws laws,
                                std::shared_ptr<std::vector<FieldBlock>> own = nullptr) {
  return std::make_unique<LoopTerm<Laws>>(std::move(name), role, geometry, std::move(laws), std::move(own));
}

}  // namespace mudline
