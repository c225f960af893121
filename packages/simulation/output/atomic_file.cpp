#include "simulation/output/atomic_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace mudline {

std::string write_atomically(const std::string& path, const std::string& text) {
  const std::string temporary = path + ".part";
  errno = 0;
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file) return "cannot write '" + temporary + "'" + (errno != 0 ? std::string(": ") + std::strerror(errno) : "");
  return rename_file(temporary, path);
}

std::string rename_file(const std::string& from, const std::string& to) {
  std::error_code error;
  std::filesystem::rename(from, to, error);
  return error ? "cannot rename '" + from + "' to '" + to + "': " + error.message() : "";
}

std::string link_file(const std::string& from, const std::string& to) {
  const std::string temporary = to + ".part";
  std::error_code error;
  std::filesystem::remove(temporary, error);
  std::filesystem::create_hard_link(from, temporary, error);
  if (error) std::filesystem::copy_file(from, temporary, error);
  return error ? "cannot copy '" + from + "' to '" + temporary + "': " + error.message() : rename_file(temporary, to);
}

}  // namespace mudline
