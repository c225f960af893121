#include "core/text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

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

/// Number of bytes of the UTF-8 character at `at`; 0 where there is none. Only characters of XML 1.0 in their shortest
/// form count.
std::size_t character_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 && first < 0xf8 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc0 || first >= 0xf8) return 0;
  unsigned code = first & (0xff >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code < least[length] || code > 0x10ffff || surrogate || code == 0xfffe || code == 0xffff ? 0 : length;
}

/// Whether the character there is a control character, which a terminal would obey instead of showing.
bool is_control(const std::string& text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  const auto next = static_cast<unsigned char>(at + 1 < text.size() ? text[at + 1] : 0);
  return first < 0x20 || first == 0x7f || (first == 0xc2 && next >= 0x80 && next < 0xa0);
}

std::string hexadecimal(char byte) {
  char text[8];
  std::snprintf(text, sizeof text, "x%02x", static_cast<unsigned>(static_cast<unsigned char>(byte)));
  return text;
}

/// `bytes`, or a few less, so that no character is cut.
std::size_t whole_characters(const std::string& text, std::size_t bytes) {
  while (bytes > 0 && bytes < text.size() && (static_cast<unsigned char>(text[bytes]) & 0xc0) == 0x80) --bytes;
  return bytes;
}

}  // namespace

std::string unfit(const std::string& text, bool lines, std::size_t* place) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = character_length(text, at);
    const bool blank = text[at] == '\t' || text[at] == '\n' || text[at] == '\r';
    const bool control = length > 0 && is_control(text, at) && !(lines && blank);
    if (length == 0 || control) {
      if (place != nullptr) *place = at;
      const std::string byte = "0" + hexadecimal(text[at + length - (length > 0 ? 1 : 0)]);
      return control ? "the control character " + byte : "the byte " + byte + ", which is not UTF-8";
    }
    at += length;
  }
  return "";
}

std::string beginning(const std::string& text, std::size_t bytes) {
  return text.size() <= bytes ? text : text.substr(0, whole_characters(text, bytes)) + " ...";
}

std::string printable(const std::string& message) {
  constexpr std::size_t begin = 1500, end = 500;  // [bytes] shown of a longer one
  std::string shown = message;
  if (message.size() > begin + end + 100) {
    const std::size_t first = whole_characters(message, begin), last = whole_characters(message, message.size() - end);
    shown = message.substr(0, first) + " ... (" + std::to_string(last - first) + " bytes left out) ... " +
            message.substr(last);
  }
  std::string result;
  for (std::size_t at = 0; at < shown.size();) {
    const std::size_t length = character_length(shown, at);
    if (length == 0 || is_control(shown, at)) {
      for (std::size_t i = 0; i < std::max<std::size_t>(length, 1); ++i) result += "\\" + hexadecimal(shown[at + i]);
    } else {
      result.append(shown, at, length);
    }
    at += std::max<std::size_t>(length, 1);
  }
  return result;
}

std::string trim(const std::string& text) {
  const char* blanks = " \t\r\n";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
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
  int depth = 0;
  std::string item;
  const auto take = [&] {
    items.push_back(trim(item));
    item.clear();
    return !items.back().empty();
  };
  for (const char c : inside) {
    depth += (c == '{' || c == '(') - (c == '}' || c == ')');
    if (c != ',' || depth > 0)
      item += c;
    else if (!take())
      return {};
  }
  if (!take()) return {};
  return items;
}

std::string join_path(const std::string& parent, const std::string& name) {
  if (parent.empty()) return name;
  return name.empty() ? parent : parent + "/" + name;
}

std::optional<std::string> file_content(const std::string& path) {
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path, ignored)) return {};
  return std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
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
