#include "discretisation/geometry_commands.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "core/text.hpp"

namespace mudline {

namespace {

bool permission = false;

const char* const writes = "writes a file";
const char* const starts = "starts a program";

/// Commands of Gmsh's scripts, and what they do to the system.
const std::map<std::string, const char*>& commands() {
  static const std::map<std::string, const char*> all = {{"SystemCall", starts},
                                                         {"NonBlockingSystemCall", starts},
                                                         {"System", starts},
                                                         {"OnelabRun", starts},
                                                         {"Save", writes},
                                                         {"Print", writes},
                                                         {"CreateDir", "makes a folder"},
                                                         {"Exit", "ends Gmsh, and the mesh is lost"}};
  return all;
}

/// Settings that do so wherever they are given: those of a size field, and options (behind a dot).
const std::map<std::string, const char*>& values() {
  static const std::map<std::string, const char*> all = {{"ExternalProcess", starts}, {"CommandLine", starts}};
  return all;
}
const std::map<std::string, const char*>& options() {
  static const std::map<std::string, const char*> all = {
      {"LogFileName", writes},     {"ErrorFileName", writes},    {"TmpFileName", writes},
      {"OptionsFileName", writes}, {"SessionFileName", writes},  {"SaveOptions", writes},
      {"SaveSession", writes},     {"AutoSaveDatabase", writes}, {"AutoArchiveOutputFiles", writes},
      {"TextEditor", starts},      {"WebBrowser", starts},       {"ExecutableFileName", starts},
      {"WatchFilePattern", starts}};
  return all;
}

const std::set<std::string> prints = {"Printf", "Error", "Warning"};  // "> file" may follow
const std::set<std::string> reads = {"Include", "Merge", "MergeWithBoundingBox"};
/// Gmsh goes back to the beginning of the line after one of these.
const std::set<std::string> jumps = {
    "For", "EndFor", "Macro", "Function", "Call", "Return", "Include", "Merge", "MergeWithBoundingBox"};
/// Words that end a passage that Gmsh skips, in strings and comments too.
const std::vector<std::string> stretch_ends = {"EndIf", "Else", "EndFor", "Return"};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// One state that Gmsh's parser may be in at some place of the file.
struct Reading {
  char within = 0;                        // in a string: its quote; in a comment: '*'
  bool printing = false, plugin = false;  // the statement has such a word
  int depth = 0;                          // of parentheses in that statement
  bool operator<(const Reading& b) const {
    return std::tie(within, printing, plugin, depth) < std::tie(b.within, b.printing, b.plugin, b.depth);
  }
};

class Scanner {
 public:
  /// The first command found, or "".
  std::string look_through(const std::filesystem::path& file, bool included);
  /// The files that were scanned, and those that are data.
  const std::set<std::filesystem::path>& reached() const { return reached_; }

 private:
  struct Place {
    std::filesystem::path file;
    int line;
  };
  void script(const std::filesystem::path& file);
  void line(const std::string& text, const Place& at);
  void follow(const std::string& text, std::size_t from, Reading reading, const Place& at);
  std::size_t code(const std::string& text, std::size_t at_char, Reading& reading, const Place& at);
  void word(const std::string& text, std::size_t begin, std::size_t end, Reading& reading, const Place& at);
  void read_file(const std::string& command, const std::string& rest, const Place& at);
  /// Passes over a string or comment and returns its end `to`; Gmsh may resume reading within it.
  std::size_t passed_over(const std::string& text, std::size_t from, std::size_t to);
  void note(const Place& at, const std::string& what) {
    if (found_.empty()) found_ = at.file.filename().string() + ":" + std::to_string(at.line) + ": " + what;
  }

  std::string found_;
  std::set<std::filesystem::path> seen_, reached_;
  std::set<Reading> readings_, next_;
  std::set<std::pair<std::size_t, Reading>> begun_;
  std::vector<std::pair<std::size_t, Reading>> waiting_;
  bool jumped_ = false;
};

std::string Scanner::look_through(const std::filesystem::path& file, bool included) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return found_;  // Gmsh reports that
  reached_.insert(file);
  const std::filesystem::path beside = file.string() + ".opt";  // Gmsh reads it with the file
  if (!included && std::filesystem::is_regular_file(beside, none)) look_through(beside, true);
  if ((included || gmsh_content(file.string()) == GmshContent::commands) &&
      seen_.insert(std::filesystem::weakly_canonical(file, none)).second)
    script(file);
  return found_;
}

void Scanner::script(const std::filesystem::path& file) {
  const std::string text = file_content(file).value_or("");
  Place at{file, 1};
  const std::set<Reading> outside = std::exchange(readings_, {Reading{}});
  for (std::size_t from = 0; from < text.size(); ++at.line) {
    if (!found_.empty()) break;
    const std::size_t end = std::min(text.find('\n', from), text.size());
    std::string here = text.substr(from, end - from);
    if (!here.empty() && here.back() == '\r') here.pop_back();
    from = end + 1;
    if (here.find('\0') != std::string::npos || here.find('\r') != std::string::npos)
      note(at, "a byte that is no text (NUL or a lone carriage return) may hide commands");
    line(here, at);
  }
  readings_ = outside;
}

void Scanner::line(const std::string& text, const Place& at) {
  next_.clear();
  begun_.clear();
  jumped_ = false;
  for (const Reading& reading : readings_) waiting_.emplace_back(0, reading);
  while (!waiting_.empty()) {
    const auto [from, reading] = waiting_.back();
    waiting_.pop_back();
    if (begun_.insert({from, reading}).second) follow(text, from, reading, at);
  }
  if (jumped_) next_.insert(Reading{});
  constexpr std::size_t most = 64;
  if (next_.size() > most) note(at, "texts and comments are too entangled to tell commands from them");
  readings_ = next_;
}

void Scanner::follow(const std::string& text, std::size_t from, Reading reading, const Place& at) {
  while (from < text.size()) {
    if (reading.within == 0) {
      from = code(text, from, reading, at);
      continue;
    }
    const std::string end = reading.within == '*' ? "*/" : std::string(1, reading.within);
    const std::size_t found = text.find(end, from);
    passed_over(text, from, std::min(found, text.size()));
    if (found == std::string::npos) break;
    from = found + end.size();
    reading.within = 0;
  }
  next_.insert(reading);
}

std::size_t Scanner::passed_over(const std::string& text, std::size_t from, std::size_t to) {
  for (const std::string& end : stretch_ends)
    for (std::size_t k = text.find(end, from); k < to; k = text.find(end, k + 1))
      waiting_.emplace_back(k + end.size(), Reading{});
  return to;
}

std::size_t Scanner::code(const std::string& text, std::size_t k, Reading& reading, const Place& at) {
  const char c = text[k];
  if (text.compare(k, 2, "//") == 0) return passed_over(text, k, text.size());
  if (text.compare(k, 2, "/*") == 0) {
    reading.within = '*';
    return k + 2;
  }
  if (c == '"' || c == '\'') {
    constexpr std::size_t most = 1000;  // Gmsh cuts a longer string off and reads on behind that
    const std::size_t end = std::min(text.find(c, k + 1), text.size());
    if (end - k > most)
      note(at, "a text of more than " + std::to_string(most) +
                   " characters, of which Gmsh would read the rest as commands");
    reading.within = c;
    return k + 1;
  }
  if (is_letter(c)) {
    std::size_t end = k;
    while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
    word(text, k, end, reading, at);
    return end;
  }
  if (is_digit(c)) {
    while (k < text.size() && (is_digit(text[k]) || text[k] == '.')) ++k;
    if (k < text.size() && (text[k] == 'e' || text[k] == 'E')) {
      const std::size_t digits = k + 1 + (k + 1 < text.size() && (text[k + 1] == '-' || text[k + 1] == '+') ? 1 : 0);
      if (digits < text.size() && is_digit(text[digits])) {
        k = digits;
        while (k < text.size() && is_digit(text[k])) ++k;
      }
    }
    return k;
  }
  if (reading.printing) {
    if (c == '(' || c == '[') ++reading.depth;
    if (c == ')' || c == ']') --reading.depth;
    if (c == '>' && reading.depth <= 0) note(at, "'Printf' with '>' writes a file");
  }
  if (c == ';' && reading.depth <= 0) reading = Reading{};
  return k + 1;
}

void Scanner::word(const std::string& text, std::size_t begin, std::size_t end, Reading& reading, const Place& at) {
  const std::string word = text.substr(begin, end - begin);
  const std::size_t next = text.find_first_not_of(" \t\f", end);
  const std::size_t last = begin == 0 ? std::string::npos : text.find_last_not_of(" \t\f", begin - 1);
  const char following = next == std::string::npos ? '\0' : text[next];
  const bool of_something = last != std::string::npos && text[last] == '.';  // Print.Background
  // a variable of that name, as an operand or assigned to
  const bool variable =
      word != "Exit" && following != '\0' && std::string("=.),;]}+-*<>:?").find(following) != std::string::npos;
  const auto refuse = [&](const std::map<std::string, const char*>& words) {
    const auto known = words.find(word);
    if (known != words.end()) note(at, "'" + word + "' " + known->second);
  };
  if (!of_something && !variable) refuse(commands());
  refuse(values());
  if (of_something) refuse(options());
  if (word == "Solver" && following == '.') note(at, "options of 'Solver' start a program");
  if (word.find("DoubleClicked") == 0) note(at, "'" + word + "' starts a program");
  if (of_something && reading.plugin &&
      (word.find("File") != std::string::npos || word.find("file") != std::string::npos))
    note(at, "the option '" + word + "' of a plugin may write a file");
  if (word == "Plugin") reading.plugin = true;
  if (prints.count(word) > 0) {
    reading.printing = true;
    reading.depth = 0;
  }
  if (of_something) return;
  if (jumps.count(word) > 0) jumped_ = true;
  if (!variable && reads.count(word) > 0) read_file(word, text.substr(end), at);
}

/// The value of a string expression without variables: "a", CurrentDirectory, StrCat[a, b]; removes it from `rest`.
std::optional<std::string> constant_text(std::string& rest, const std::filesystem::path& folder) {
  const auto skip = [&] { rest.erase(0, std::min(rest.find_first_not_of(" \t\f"), rest.size())); };
  const auto take = [&](const std::string& word) {
    skip();
    if (rest.compare(0, word.size(), word) != 0) return false;
    if (is_letter(word.back()) && rest.size() > word.size() &&
        (is_letter(rest[word.size()]) || is_digit(rest[word.size()])))
      return false;
    rest.erase(0, word.size());
    return true;
  };
  skip();
  if (!rest.empty() && (rest[0] == '"' || rest[0] == '\'')) {
    const std::size_t end = rest.find(rest[0], 1);
    if (end == std::string::npos) return std::nullopt;
    const std::string value = rest.substr(1, end - 1);
    rest.erase(0, end + 1);
    return value;
  }
  if (take("CurrentDirectory") || take("CurrentDir")) return folder.string() + "/";
  if (!take("StrCat") && !take("Str")) return std::nullopt;
  if (!take("[") && !take("(")) return std::nullopt;
  std::string value;
  do {
    const auto part = constant_text(rest, folder);
    if (!part) return std::nullopt;
    value += *part;
  } while (take(","));
  if (!take("]") && !take(")")) return std::nullopt;
  return value;
}

void Scanner::read_file(const std::string& command, const std::string& text, const Place& at) {
  std::string rest = text;
  const std::filesystem::path folder = at.file.parent_path();
  const auto name = constant_text(rest, folder);
  const std::size_t next = rest.find_first_not_of(" \t\f");
  if (!name || (next != std::string::npos && rest[next] != ';')) {
    note(at, "the name of the file to '" + command +
                 "' is worked out, so that its commands cannot be looked at; give it as a text");
    return;
  }
  // scans a script within a script; the state of the outer one is restored afterwards
  const auto next_readings = next_;
  const auto begun = begun_;
  const auto waiting = std::exchange(waiting_, {});
  look_through(folder / *name, command == "Include");
  next_ = next_readings;
  begun_ = begun;
  waiting_ = waiting;
  jumped_ = true;
}

}  // namespace

GmshContent gmsh_content(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  const auto all = [&](int (*is)(int)) {
    return std::all_of(extension.begin() + (extension.empty() ? 0 : 1), extension.end(),
                       [&](unsigned char c) { return is(c) != 0; });
  };
  const bool one_case = all(std::islower) || all(std::isupper);  // Gmsh knows only these
  extension = lower_case(extension);
  for (const char* model : {".step", ".stp", ".brep", ".iges", ".igs", ".stl"})
    if (one_case && extension == model) return GmshContent::data;
  if (extension == ".gz") return GmshContent::commands;  // Gmsh unpacks it by a program
  std::string head(11, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  for (const char* mesh : {"$MeshFormat", "$Comments", "$NOD"})
    if (head.compare(0, std::string(mesh).size(), mesh) == 0) return GmshContent::data;
  return GmshContent::commands;
}

std::string system_command(const std::string& file) { return Scanner().look_through(file, false); }

std::vector<std::string> files_reached(const std::string& file) {
  Scanner scanner;
  scanner.look_through(file, false);
  std::vector<std::string> result;
  for (const std::filesystem::path& reached : scanner.reached()) result.push_back(reached.string());
  return result;
}

void permit_commands(bool permitted) { permission = permitted; }
bool commands_permitted() { return permission; }

}  // namespace mudline
