#pragma once

#include <string>

#include "core/parameters.hpp"

namespace mudline {

/// The deck's section "start": the end of a stage of another run from which this run goes on.
class RunStart {
 public:
  /// `own_stem`: of the names of this run's files. InputError where the other results are this run's own.
  static RunStart read(const Section& section, const std::string& own_stem);
  /// The end of a stage that a text names, 'results/pile@push'. InputError, in the second form at that entry.
  static RunStart named(const std::string& from);
  static RunStart named(const Section& section, const std::string& entry, const std::string& from);
  /// The end of a stage of the run whose files begin with `stem`.
  static RunStart at(const std::string& stem, const std::string& stage);
  /// Looks for the checkpoint. InputError at the entry of `section` where there is none.
  void find(const Section& section, const std::string& entry = "from") const;
  bool exists() const;
  /// Why there is no checkpoint, or "".
  std::string missing() const;
  void parameters(Parameters& p);

  /// The checkpoint to go on from; "": the run starts anew.
  const std::string& checkpoint() const { return checkpoint_; }

 private:
  std::string from_, stem_, stage_, checkpoint_;
};

/// File of the checkpoint at the end of a stage of the run whose files begin with `stem`.
std::string stage_checkpoint(const std::string& stem, const std::string& stage);

/// Names of the stages at whose ends such checkpoints are, in the order of their names.
std::vector<std::string> checkpointed_stages(const std::string& stem);

}  // namespace mudline
