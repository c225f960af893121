#include "simulation/output/history_file.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "core/log.hpp"
#include "core/run_error.hpp"
#include "core/text.hpp"
#include "simulation/output/atomic_file.hpp"
#include "simulation/output/collective.hpp"

namespace mudline {

namespace {

constexpr const char* time_column = "time [s]";

}  // namespace

const HistoryValue* find_value(const std::vector<HistoryValue>& row, const std::string& name) {
  const auto found =
      std::find_if(row.begin(), row.end(), [&](const HistoryValue& value) { return value.name == name; });
  return found == row.end() ? nullptr : &*found;
}

HistoryFile::HistoryFile(Teuchos::RCP<const Teuchos::Comm<int>> comm, std::string path,
                         std::optional<HistoryRestart> restart)
    : comm_(std::move(comm)), path_(std::move(path)) {
  mark_.fingerprint = fingerprint(nullptr, 0);
  if (!restart) return;
  accept_loss_ = restart->accept_loss;
  const MPI_Comm mpi = raw_communicator(*comm_);
  const std::string error = agreed_message(mpi, comm_->getRank() == 0 ? truncate(*restart) : "");
  if (!error.empty()) throw InputError(error);
  header_ = broadcast(mpi, header_);
  continued_ = !header_.empty();
}

void HistoryFile::count(const std::string& text) {
  mark_.rows += std::count(text.begin(), text.end(), '\n');
  mark_.bytes += static_cast<long long>(text.size());
  mark_.fingerprint = fingerprint(text.data(), text.size(), mark_.fingerprint);
}

/// Drops the rows after the restart and opens the file behind the last row, on rank 0. Returns what is wrong, or "".
std::string HistoryFile::truncate(const HistoryRestart& restart) {
  const std::optional<std::string> old = file_content(path_);
  const std::string text = old.value_or("");
  const auto expected = static_cast<std::size_t>(restart.mark.bytes);
  std::string kept = text.substr(0, expected);
  if (kept.size() != expected || fingerprint(kept.data(), kept.size()) != restart.mark.fingerprint) {
    const std::string found = !old                     ? "the file is missing"
                              : text.empty()           ? "the file is empty"
                              : text.size() < expected ? "the file was shortened"
                                                       : "the file was changed";
    if (!restart.accept_loss)
      return path_ + ": " + found + ", which should hold the " + std::to_string(restart.mark.rows) +
             " lines up to the checkpoint; put a copy of it back, run without --restart, or go on with rows lost by "
             "--accept-changes";
    kept.clear();
    if (const std::string error = keep_rows_until(restart.time, text, kept); !error.empty()) return error;
    log::warn(path_ + ": " + found + "; going on with " + std::to_string(std::count(kept.begin(), kept.end(), '\n')) +
              " of the " + std::to_string(restart.mark.rows) + " lines");
  }
  if (kept.empty()) return "";
  header_ = kept.substr(0, kept.find('\n'));
  count(kept);
  if (const std::string error = write_atomically(path_, kept); !error.empty()) return error;
  return open();
}

/// Opens the file at its end, on rank 0. Rows are appended, so that a file that another program has emptied stays
/// shorter than what was written. Returns what is wrong, or "".
std::string HistoryFile::open() {
  file_.open(path_, std::ios::binary | std::ios::app);
  struct stat found {};
  if (!file_ || stat(path_.c_str(), &found) != 0) return "cannot write '" + path_ + "'";
  inode_ = found.st_ino;
  return "";
}

std::string HistoryFile::lost() const {
  if (!file_.is_open()) return "";
  struct stat found {};
  const std::string begin = path_ + ": the history was ", end = " by another program while the run went on";
  if (stat(path_.c_str(), &found) != 0) return begin + "removed" + end;
  if (static_cast<std::uint64_t>(found.st_ino) != inode_) return begin + "replaced" + end;
  return found.st_size == mark_.bytes ? "" : begin + "changed" + end;
}

std::string HistoryFile::keep_rows_until(double time, const std::string& text, std::string& kept) const {
  for (std::size_t start = 0, line = 1; start < text.size(); ++line) {
    const std::size_t end = text.find('\n', start);
    if (end == std::string::npos) break;  // a last line cut short is dropped
    const std::string row = text.substr(start, end - start + 1);
    start = end + 1;
    if (line == 1) {
      if (row.rfind(time_column, 0) != 0)
        return path_ + ":1: not a history of mudline (the first column is not '" + time_column +
               "'); move the file away";
    } else {
      double at = 0;
      const auto read = std::from_chars(row.data(), row.data() + row.size(), at);
      if (read.ec != std::errc() || (*read.ptr != ',' && *read.ptr != '\n'))
        return path_ + ":" + std::to_string(line) + ": the row does not begin with a time; move the file away";
      if (at > time) continue;
    }
    kept += row;
  }
  return "";
}

/// Renames the file of before the restart to a free name, on rank 0. Returns what is wrong, or "".
std::string HistoryFile::set_aside() {
  file_.close();
  const std::filesystem::path path(path_);
  std::filesystem::path other;
  int k = 0;
  do {
    other = path.parent_path() / (path.stem().string() + "." + std::to_string(++k) + path.extension().string());
  } while (std::filesystem::exists(other));
  log::warn(path_ + ": the columns are others from here on; the rows so far are kept in " + other.string());
  return rename_file(path_, other.string());
}

void HistoryFile::fix_columns(const std::string& header, const std::vector<HistoryValue>& values) {
  if (header == header_) return;
  std::set<std::string> names;
  for (const HistoryValue& value : values)
    if (!names.insert(value.name).second)
      throw InputError(path_ + ": two columns of the history would be called '" + value.name +
                       "'; an observer or a state array of a plugin needs another name");
  if (continued_ && !accept_loss_)
    throw InputError(path_ +
                     ": the history has other columns than this run; restart with the outputs of the first run, or "
                     "begin a new file by --accept-changes");
  if (!header_.empty() && !continued_)
    throw std::logic_error(path_ + ": the columns of a history changed during the run");
  std::string error;
  if (comm_->getRank() == 0) {
    if (continued_) error = set_aside();
    mark_ = {0, 0, fingerprint(nullptr, 0)};
    if (error.empty() && !std::ofstream(path_, std::ios::binary | std::ios::trunc))
      error = "cannot write '" + path_ + "'";
    if (error.empty()) error = open();
    if (error.empty()) error = append(header + '\n');
  }
  header_ = header;
  continued_ = false;
  error = agreed_message(raw_communicator(*comm_), error);
  if (!error.empty()) throw RunError(error);
}

/// Appends a line, on rank 0. Returns what is wrong, or "".
std::string HistoryFile::append(const std::string& line) {
  if (const std::string error = lost(); !error.empty()) return error;
  file_ << line << std::flush;
  if (!file_) return "cannot write '" + path_ + "' (disk full?)";
  count(line);
  return "";
}

void HistoryFile::write(double time, const std::vector<HistoryValue>& values) {
  std::string header = time_column;
  for (const auto& value : values) header += ',' + csv_cell(value.name + " [" + value.unit + "]");
  fix_columns(header, values);

  std::string error;
  if (comm_->getRank() == 0) {
    std::string row = number_text(time);
    for (const auto& value : values) row += ',' + number_text(value.value);
    error = append(row + '\n');
  }
  error = agreed_message(raw_communicator(*comm_), error);
  if (!error.empty()) throw RunError(error);
}

}  // namespace mudline
