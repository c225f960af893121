#include "discretisation/msh_input.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/errors.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

constexpr std::string_view white = " \t\r\f\v";

std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

}  // namespace

MshInput::MshInput(const std::string& file) : name_(std::filesystem::path(file).filename().string()) {
  std::optional<std::string> content = file_content(file);
  if (!content) throw InputError("'" + name_ + "' cannot be read");
  bytes_ = std::move(*content);
}

bool MshInput::next_line() {
  while (next_ < bytes_.size()) {
    start_ = next_;
    const std::size_t end = std::min(bytes_.find('\n', next_), bytes_.size());
    line_ = std::string_view(bytes_).substr(next_, end - next_);
    next_ = std::min(end + 1, bytes_.size());
    ++line_number_;
    const std::size_t first = line_.find_first_not_of(white);
    if (first == std::string_view::npos) continue;
    line_ = line_.substr(first, line_.find_last_not_of(white) + 1 - first);
    return true;
  }
  start_ = bytes_.size();
  line_ = {};
  return false;
}

const std::vector<std::string_view>& MshInput::words() {
  words_.clear();
  for (std::size_t at = 0; at < line_.size();) {
    const std::size_t end = std::min(line_.find_first_of(white, at), line_.size());
    words_.push_back(line_.substr(at, end - at));
    at = std::min(line_.find_first_not_of(white, end), line_.size());
  }
  return words_;
}

void MshInput::set_binary(bool swapped) {
  binary_ = true;
  swapped_ = swapped;
}

void MshInput::take(void* value, std::size_t size) {
  start_ = next_;
  if (left() < size) fail("the file ends here, within the numbers that it announces");
  char* const to = static_cast<char*>(value);
  std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(next_),
            bytes_.begin() + static_cast<std::ptrdiff_t>(next_ + size), to);
  if (swapped_) std::reverse(to, to + size);
  next_ += size;
}

int MshInput::integer() {
  static_assert(sizeof(int) == 4, "Gmsh's files have integers of four bytes");
  int value = 0;
  take(&value, sizeof value);
  return value;
}

double MshInput::number() {
  double value = 0;
  take(&value, sizeof value);
  return value;
}

std::string MshInput::place_text(std::size_t place) const {
  return (binary_ ? "byte " : "line ") + std::to_string(place);
}

void MshInput::fail_at(std::size_t place, const std::string& message) const {
  throw InputError(name_ + (binary_ ? ": byte " : ":") + std::to_string(place) + ": " + message);
}

std::optional<long long> msh_integer(std::string_view word) {
  word = without_plus(word);
  long long value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || stop != word.data() + word.size()) return {};
  return value;
}

std::optional<double> msh_number(std::string_view word) {
  word = without_plus(word);
  double value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (stop != word.data() + word.size()) return {};
  if (error == std::errc::result_out_of_range) value = std::strtod(std::string(word).c_str(), nullptr);  // 1e-400
  if ((error != std::errc() && error != std::errc::result_out_of_range) || !std::isfinite(value)) return {};
  return value;
}

}  // namespace mudline
