#include "simulation/output/history_file.hpp"

#include <charconv>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "simulation/output/atomic_file.hpp"
#include "simulation/output/collective.hpp"

namespace mudline {

namespace {

constexpr const char* time_column = "time [s]";

std::string number(double value) {
  char text[32];
  const auto result = std::to_chars(text, text + sizeof text, value);
  return std::string(text, result.ptr);
}

/// A cell of a CSV (RFC 4180): quoted where its content would break the line.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

HistoryFile::HistoryFile(Teuchos::RCP<const Teuchos::Comm<int>> comm, std::string path,
                         std::optional<double> restart_time)
    : comm_(std::move(comm)), path_(std::move(path)) {
  if (!restart_time) return;
  const MPI_Comm mpi = raw_communicator(*comm_);
  const std::string error = agreed_message(mpi, comm_->getRank() == 0 ? truncate(*restart_time) : "");
  if (!error.empty()) throw InputError(error);
  header_ = broadcast(mpi, header_);
  continued_ = !header_.empty();
}

/// Rank 0: drops what lies after the restart and opens the file behind the last row. Returns what is wrong, or "".
std::string HistoryFile::truncate(double restart_time) {
  std::ifstream old(path_, std::ios::binary);
  if (!old) return "";
  std::ostringstream content;
  content << old.rdbuf();
  const std::string text = content.str();

  std::string kept;
  for (std::size_t start = 0, line = 1; start < text.size(); ++line) {
    const std::size_t end = text.find('\n', start);
    if (end == std::string::npos) break;  // a last line cut short is dropped
    const std::string row = text.substr(start, end - start + 1);
    start = end + 1;
    if (line == 1) {
      if (row.rfind(time_column, 0) != 0)
        return path_ + ":1: not a history of mudline (the first column is not '" + time_column +
               "'); move the file away";
      header_ = row.substr(0, row.size() - 1);
    } else {
      double time = 0;
      const auto read = std::from_chars(row.data(), row.data() + row.size(), time);
      if (read.ec != std::errc() || (*read.ptr != ',' && *read.ptr != '\n'))
        return path_ + ":" + std::to_string(line) + ": the row does not begin with a time; move the file away";
      if (time > restart_time) continue;
    }
    kept += row;
  }
  if (header_.empty()) return "";
  if (const std::string error = write_atomically(path_, kept); !error.empty()) return error;
  file_.open(path_, std::ios::binary | std::ios::app);
  return file_ ? "" : "cannot append to '" + path_ + "'";
}

void HistoryFile::fix_columns(const std::string& header) {
  if (header == header_) return;
  if (continued_)
    throw InputError(path_ +
                     ": the history has other columns than this run; move it away, or restart with the outputs "
                     "of the first run");
  if (!header_.empty()) throw std::logic_error(path_ + ": the columns of a history changed during the run");
  header_ = header;
  std::string error;
  if (comm_->getRank() == 0) {
    file_.open(path_, std::ios::binary | std::ios::trunc);
    file_ << header_ << '\n';
    if (!file_) error = "cannot write '" + path_ + "'";
  }
  error = agreed_message(raw_communicator(*comm_), error);
  if (!error.empty()) throw std::runtime_error(error);
}

void HistoryFile::write(double time, const std::vector<HistoryValue>& values) {
  std::string header = time_column;
  for (const auto& value : values) header += ',' + cell(value.name + " [" + value.unit + "]");
  fix_columns(header);

  std::string error;
  if (comm_->getRank() == 0) {
    std::string row = number(time);
    for (const auto& value : values) row += ',' + number(value.value);
    file_ << row << '\n' << std::flush;
    if (!file_) error = "cannot write '" + path_ + "' (disk full?)";
  }
  error = agreed_message(raw_communicator(*comm_), error);
  if (!error.empty()) throw std::runtime_error(error);
}

}  // namespace mudline
