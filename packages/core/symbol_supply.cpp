#include "core/symbol_supply.hpp"

#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>

/// The ELF header of this program, which the linker names.
extern "C" __attribute__((visibility("hidden"))) const ElfW(Ehdr) __ehdr_start;

namespace mudline {

namespace {

/// A table of strings, each ended by a zero, that begins with the empty one.
class StringTable {
 public:
  std::size_t add(const std::string& text) {
    const std::size_t place = text_.size();
    text_ += text + '\0';
    return place;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_ = std::string(1, '\0');
};

template <class T>
std::size_t append(std::vector<char>& image, const T* items, std::size_t count) {
  image.resize((image.size() + 7) / 8 * 8);
  const std::size_t place = image.size();
  image.resize(place + count * sizeof(T));
  if (count > 0) std::memcpy(&image[place], items, count * sizeof(T));
  return place;
}

ElfW(Phdr) segment(std::uint32_t type, std::size_t begin, std::size_t size, std::size_t alignment) {
  ElfW(Phdr) entry{};
  entry.p_type = type;
  entry.p_flags = PF_R | PF_W;
  entry.p_offset = entry.p_vaddr = entry.p_paddr = begin;
  entry.p_filesz = entry.p_memsz = size;
  entry.p_align = alignment;
  return entry;
}

/// The bytes of the shared library: one segment at the address 0 with header, symbols and dynamic section, as the
/// System V ABI describes them.
std::vector<char> image_of(const std::string& needed, const std::vector<SuppliedFunction>& functions) {
  StringTable strings;
  std::vector<ElfW(Sym)> symbols(1);  // the first one is empty
  for (const SuppliedFunction& f : functions) {
    ElfW(Sym) symbol{};
    symbol.st_name = strings.add(f.name);
    symbol.st_info = ELF64_ST_INFO(STB_GLOBAL, STT_FUNC);
    symbol.st_shndx = SHN_ABS;  // an address, wherever the library is loaded
    symbol.st_value = reinterpret_cast<std::uintptr_t>(f.address);
    symbols.push_back(symbol);
  }
  // one bucket, whose chain has all symbols
  std::vector<std::uint32_t> hash{1, static_cast<std::uint32_t>(symbols.size()), symbols.size() > 1 ? 1u : 0u, 0};
  for (std::uint32_t i = 1; i < symbols.size(); ++i) hash.push_back(i + 1 < symbols.size() ? i + 1 : 0);
  const std::size_t name = strings.add(needed);

  std::vector<char> image;
  ElfW(Ehdr) header = __ehdr_start;  // class, byte order and machine
  constexpr int segments = 3, entries = 7;
  const std::size_t page = sysconf(_SC_PAGESIZE), table = sizeof header;
  append(image, &header, 1);
  image.resize(table + segments * sizeof(ElfW(Phdr)));
  const std::size_t symbols_at = append(image, symbols.data(), symbols.size());
  const std::size_t hash_at = append(image, hash.data(), hash.size());
  const std::size_t strings_at = append(image, strings.text().data(), strings.text().size());
  ElfW(Dyn) dynamic[entries]{};
  const std::size_t values[entries][2] = {{DT_NEEDED, name},
                                          {DT_STRTAB, strings_at},
                                          {DT_STRSZ, strings.text().size()},
                                          {DT_SYMTAB, symbols_at},
                                          {DT_SYMENT, sizeof(ElfW(Sym))},
                                          {DT_HASH, hash_at},
                                          {DT_NULL, 0}};
  for (int i = 0; i < entries; ++i) {
    dynamic[i].d_tag = values[i][0];
    dynamic[i].d_un.d_val = values[i][1];
  }
  const std::size_t dynamic_at = append(image, dynamic, entries);

  header.e_type = ET_DYN;
  header.e_entry = header.e_shoff = 0;
  header.e_shentsize = header.e_shnum = header.e_shstrndx = 0;
  header.e_phoff = table;
  header.e_phnum = segments;
  std::memcpy(image.data(), &header, sizeof header);
  const ElfW(Phdr)
      all[segments] = {segment(PT_LOAD, 0, image.size(), page), segment(PT_DYNAMIC, dynamic_at, sizeof dynamic, 8),
                       segment(PT_GNU_STACK, 0, 0, 16)};  // without it the stack becomes executable
  std::memcpy(&image[table], all, sizeof all);
  return image;
}

}  // namespace

int supplying_library(const std::string& path, const std::vector<SuppliedFunction>& functions) {
  const std::vector<char> image = image_of(path, functions);
  const int file = memfd_create("supplied functions", MFD_CLOEXEC);
  if (file < 0 || write(file, image.data(), image.size()) != static_cast<ssize_t>(image.size())) {
    const int number = errno;
    if (file >= 0) close(file);
    throw std::runtime_error("its missing functions cannot be supplied: " + std::string(std::strerror(number)));
  }
  return file;
}

std::string supply_path(int file) { return "/proc/self/fd/" + std::to_string(file); }

}  // namespace mudline
