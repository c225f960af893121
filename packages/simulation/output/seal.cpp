#include "simulation/output/seal.hpp"

#include <cstdio>
#include <fstream>
#include <vector>

#include "simulation/output/collective.hpp"

namespace mudline {

namespace {

std::string title(const std::string& kind) { return "mudline " + kind + ", format "; }

/// Fingerprint of a file's content after its first `begin` bytes.
std::uint64_t content_fingerprint(std::istream& file, std::size_t begin = seal_size) {
  file.seekg(static_cast<std::streamoff>(begin));
  std::vector<char> piece(1 << 20);
  std::uint64_t hash = fingerprint(nullptr, 0);
  while (file) {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    hash = fingerprint(piece.data(), static_cast<std::size_t>(file.gcount()), hash);
  }
  file.clear();
  return hash;
}

std::string seal_text(const std::string& kind, int version, std::uint64_t hash) {
  char sum[32];
  std::snprintf(sum, sizeof sum, "%016llx", static_cast<unsigned long long>(hash));
  std::string text = title(kind) + std::to_string(version) + ", FNV-1a of what follows byte " +
                     std::to_string(seal_size) + ": " + sum + "\n";
  text.resize(seal_size, '\0');
  return text;
}

}  // namespace

std::string write_seal(const std::string& path, const std::string& kind, int version) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  const std::string text = seal_text(kind, version, content_fingerprint(file));
  file.seekp(0);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  return file ? "" : "cannot write the checksum of '" + path + "'";
}

std::string broken_seal(const std::string& path, const std::string& kind, int version) {
  std::ifstream file(path, std::ios::binary);
  std::string found(seal_size, '\0');
  file.read(found.data(), static_cast<std::streamsize>(found.size()));
  if (!file) return "the " + kind + " is cut short, or cannot be read";
  if (found == seal_text(kind, version, content_fingerprint(file))) return "";
  const std::string begin = title(kind), mine = begin + std::to_string(version) + ",";
  if (found.rfind(begin, 0) == 0 && found.rfind(mine, 0) != 0)
    return "the " + kind + " is of another format than this program's, " + std::to_string(version);
  if (found.rfind(begin, 0) != 0)
    return "not a " + kind + " of this version of mudline, or its first bytes are damaged";
  return "the " + kind + " is damaged: its checksum does not fit its content";
}

std::optional<std::uint64_t> file_fingerprint(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return {};
  return content_fingerprint(file, 0);
}

}  // namespace mudline
