#pragma once

#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>

#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace mudline {

/// One column of the history file: name such as "body/cone/force y" (groups by "/"), unit such as "N".
struct HistoryValue {
  std::string name, unit;
  double value;
};

/// A CSV of scalars over time, written by rank 0 and flushed with each row. The first row fixes the columns; the header
/// reads "time [s],body/cone/force y [N],...". Numbers are the shortest text that reads back as the same double, so a
/// restarted run leaves the same bytes as one that was never stopped.
class HistoryFile {
 public:
  /// Without `restart_time` an old file is replaced when the first row is written. With it the rows up to and including
  /// that time stay, later ones (and a last line cut short by a crash) go; a missing file is started anew.
  /// Throws InputError when the old file is not a history. Collective.
  HistoryFile(Teuchos::RCP<const Teuchos::Comm<int>> comm, std::string path, std::optional<double> restart_time = {});

  /// Appends a row. Every rank gives the same columns in the same order; the values of rank 0 are written.
  /// Throws std::logic_error when the columns change within a run, InputError when a restarted run has other columns
  /// than the file, std::runtime_error when the disk refuses; on every rank alike. Collective.
  void write(double time, const std::vector<HistoryValue>& values);

  const std::string& path() const { return path_; }

 private:
  std::string truncate(double restart_time);
  void fix_columns(const std::string& header);

  Teuchos::RCP<const Teuchos::Comm<int>> comm_;
  std::string path_;
  std::string header_;      // "" until the first row
  bool continued_ = false;  // the header is that of the file found at the restart
  std::ofstream file_;      // open on rank 0 after the first row
};

}  // namespace mudline
