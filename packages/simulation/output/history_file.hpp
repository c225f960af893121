#pragma once

#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>

#include <cstdint>
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

/// The column of this name in a row; null where there is none.
const HistoryValue* find_value(const std::vector<HistoryValue>& row, const std::string& name);

/// Length and fingerprint of a history, as a checkpoint keeps them.
struct HistoryMark {
  long long rows = 0, bytes = 0;
  std::uint64_t fingerprint = 0;  // of these bytes
};

/// Point at which a history is continued. `accept_loss`: a file that does not fit the mark is continued with what is
/// left of it up to `time` [s]; where the columns differ, a new file is begun and the old one is kept under another
/// name.
struct HistoryRestart {
  HistoryMark mark;
  double time = 0;
  bool accept_loss = false;
};

/// A CSV of scalars over time, written by rank 0 and flushed with each row. The first row fixes the columns; the header
/// reads "time [s],body/cone/force y [N],...". Numbers are the shortest text that reads back as the same double, so a
/// restarted run leaves the same bytes as one that was never stopped.
class HistoryFile {
 public:
  /// Without `restart` an old file is replaced when the first row is written. With it the bytes that its mark counts
  /// stay and all that follows is removed. InputError when the file is missing, shortened or changed. Collective.
  HistoryFile(Teuchos::RCP<const Teuchos::Comm<int>> comm, std::string path,
              std::optional<HistoryRestart> restart = {});

  /// Appends a row. Every rank gives the same columns in the same order; the values of rank 0 are written. Throws
  /// std::logic_error when the columns change within a run, InputError when two columns have one name or a restarted
  /// run has other columns than the file, RunError when the file cannot be written; on every rank alike. Collective.
  void write(double time, const std::vector<HistoryValue>& values);

  /// Why the file is not what was written to it, or "": somebody has removed, replaced or cut it. For rank 0; not
  /// collective.
  std::string lost() const;

  /// Right on rank 0 only.
  const HistoryMark& mark() const { return mark_; }
  const std::string& path() const { return path_; }

 private:
  std::string truncate(const HistoryRestart& restart);
  std::string keep_rows_until(double time, const std::string& text, std::string& kept) const;
  void fix_columns(const std::string& header, const std::vector<HistoryValue>& values);
  std::string set_aside();
  std::string open();
  std::string append(const std::string& line);
  void count(const std::string& text);

  Teuchos::RCP<const Teuchos::Comm<int>> comm_;
  std::string path_;
  std::string header_;      // "" until the first row
  bool continued_ = false;  // the header is that of the file found at the restart
  bool accept_loss_ = false;
  HistoryMark mark_;
  std::uint64_t inode_ = 0;  // of the open file
  std::ofstream file_;       // open on rank 0 after the first row
};

}  // namespace mudline
