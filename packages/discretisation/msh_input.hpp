#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mudline {

/// Reads a mesh file of Gmsh from a current position: the next line of words, or the next binary number.
class MshInput {
 public:
  /// Reads the whole file. InputError where it cannot be read.
  explicit MshInput(const std::string& file);

  /// Goes to the next line with something in it; false at the end of the file.
  bool next_line();
  /// The current line without white space at its ends, and its words.
  std::string_view line() const { return line_; }
  const std::vector<std::string_view>& words();

  /// Makes all following numbers binary; `swapped`: their byte order is not the machine's.
  void set_binary(bool swapped);
  bool binary() const { return binary_; }
  /// The next binary number. Throws InputError where the file ends within it.
  int integer();
  double number();
  /// How many bytes are left.
  std::size_t left() const { return bytes_.size() - next_; }

  /// Position of the last line or number: its line number, in a binary file its byte.
  std::size_t place() const { return binary_ ? start_ : line_number_; }
  /// "line 12", "byte 340".
  std::string place_text(std::size_t place) const;
  /// Throws InputError "<file>:<line>: <message>", of a binary file "<file>: byte <place>: <message>".
  [[noreturn]] void fail(const std::string& message) const { fail_at(place(), message); }
  [[noreturn]] void fail_at(std::size_t place, const std::string& message) const;

 private:
  void take(void* value, std::size_t size);

  std::string name_, bytes_;
  std::size_t next_ = 0, start_ = 0, line_number_ = 0;
  bool binary_ = false, swapped_ = false;
  std::string_view line_;
  std::vector<std::string_view> words_;
};

/// The whole of a word as a number; none where it is something else or not finite. Independent of the locale.
std::optional<long long> msh_integer(std::string_view word);
std::optional<double> msh_number(std::string_view word);

}  // namespace mudline
