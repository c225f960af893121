#include "core/text.hpp"

#include <algorithm>
#include <charconv>

namespace mudline {

namespace {

/// std::from_chars refuses a leading plus, which people write.
template <class Number>
std::optional<Number> parse(const std::string& text) {
  std::string digits = trim(text);
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.erase(0, 1);
  Number value{};
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (digits.empty() || error != std::errc() || stop != end) return {};
  return value;
}

}  // namespace

std::string trim(const std::string& text) {
  const char* blanks = " \t\r\n";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string number_text(double value) {
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, result.ptr);
}

std::string tuple_text(const double* numbers, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "(" : ", ") + number_text(numbers[i]);
  return text + ")";
}

std::optional<double> parse_number(const std::string& text) { return parse<double>(text); }

std::optional<int> parse_integer(const std::string& text) { return parse<int>(text); }

std::optional<bool> parse_bool(const std::string& text) {
  const std::string word = trim(text);
  if (word == "true") return true;
  if (word == "false") return false;
  return {};
}

std::optional<std::vector<std::string>> parse_array(const std::string& text) {
  const std::string whole = trim(text);
  if (whole.size() < 2 || whole.front() != '{' || whole.back() != '}') return {};
  const std::string inside = trim(whole.substr(1, whole.size() - 2));
  std::vector<std::string> items;
  if (inside.empty()) return items;
  std::size_t begin = 0;
  while (begin <= inside.size()) {
    const auto comma = std::min(inside.find(',', begin), inside.size());
    items.push_back(trim(inside.substr(begin, comma - begin)));
    if (items.back().empty()) return {};
    begin = comma + 1;
  }
  return items;
}

std::string join_path(const std::string& parent, const std::string& name) {
  if (parent.empty()) return name;
  return name.empty() ? parent : parent + "/" + name;
}

std::string xml_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace mudline
