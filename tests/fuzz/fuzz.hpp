#pragma once

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "core/errors.hpp"

/// Drivers that mutate seeds and feed them to a reader: fuzz_deck, fuzz_checkpoint, fuzz_msh.
namespace mudline::fuzz {

inline std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Calls `read` on an input and returns its fault, or "": the fault that `read` names, or an exception other than an
/// InputError of one line.
template <class Read>
std::string fault_of(Read&& read) {
  try {
    return read();
  } catch (const InputError& error) {
    const std::string line = error.what();
    if (line.empty() || line.find_first_of("\r\n") != std::string::npos) return "no message of one line: " + line;
  } catch (const std::exception& error) {
    return std::string("an exception that is no error of the input: ") + error.what();
  }
  return "";
}

/// The current input, and the file in which it is saved when the reader crashes, hangs or fails.
struct Current {
  static std::string& input() {
    static std::string text;
    return text;
  }
  static const char*& file() {
    static const char* path = "fuzz_failure";
    return path;
  }
  static void keep() {
    const int out = ::open(file(), O_CREAT | O_TRUNC | O_WRONLY, 0644);
    if (out < 0) return;
    const auto written = write(out, input().data(), input().size());
    if (written != static_cast<ssize_t>(input().size())) std::cerr << "the input could not be kept whole\n";
    close(out);
  }
  static void on_signal(int number) {
    keep();
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
};

/// Makes one to four edits: flips a bit, replaces a byte, removes, doubles or moves a piece, or inserts a word of
/// `words`.
inline std::string mutated(std::string text, const std::vector<std::string>& words, std::mt19937_64& rng) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(rng() % n); };
  for (std::size_t edits = 1 + below(4); edits > 0 && !text.empty(); --edits) {
    const std::size_t at = below(text.size()), length = std::min(text.size() - at, 1 + below(80));
    const std::string piece = text.substr(at, length);
    switch (below(words.empty() ? 5 : 7)) {
      case 0:
        text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 1:
        text[at] = static_cast<char>(below(256));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(at, piece);
        break;
      case 4:
        text.erase(at, length).insert(below(text.size() + 1), piece);
        break;
      default:
        text.insert(at, words[below(words.size())]);
    }
  }
  return text;
}

/// Feeds mutations of the seeds to `read` for `seconds` seconds. `read` returns its fault, or "". A crash, a hang of 20
/// s or a wrong answer saves the input in the file `kept`. Returns the exit code.
inline int run(const std::vector<std::string>& seeds, const std::vector<std::string>& words, double seconds,
               std::uint64_t seed, const char* kept, const std::function<std::string(const std::string&)>& read) {
  Current::file() = kept;
  for (const int number : {SIGSEGV, SIGABRT, SIGALRM, SIGFPE, SIGBUS, SIGILL}) std::signal(number, Current::on_signal);
  std::mt19937_64 rng(seed);
  const auto start = std::chrono::steady_clock::now();
  const auto spent = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  long tried = 0;
  for (; spent() < seconds; ++tried) {
    Current::input() = mutated(seeds[rng() % seeds.size()], words, rng);
    alarm(20);
    const std::string wrong = read(Current::input());
    alarm(0);
    if (wrong.empty()) continue;
    Current::keep();
    std::cerr << "input " << tried << ": " << wrong << "; kept in " << kept << std::endl;
    return 1;
  }
  std::cout << tried << " inputs in " << spent() << " s, nothing wrong" << std::endl;
  return 0;
}

/// The main() of a fuzzer called `name` with the arguments SECONDS SEED and files, which are the seeds. An input that
/// fails is saved as fuzz_failure with the file name's `ending`.
inline int run_on_files(int argc, char** argv, const std::string& name, const std::string& ending,
                        const std::vector<std::string>& words,
                        const std::function<std::string(const std::string&)>& read) {
  if (argc < 4) {
    std::cerr << name << " SECONDS SEED FILE" << ending << "...\n";
    return 2;
  }
  std::vector<std::string> seeds;
  for (int i = 3; i < argc; ++i) seeds.push_back(read_file(argv[i]));
  const std::string kept = "fuzz_failure" + ending;
  return run(seeds, words, std::atof(argv[1]), std::strtoull(argv[2], nullptr, 10), kept.c_str(), read);
}

}  // namespace mudline::fuzz
