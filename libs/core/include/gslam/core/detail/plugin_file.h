// The entry of a plugin, read from its file, so that none of its code runs before it is known to
// fit. The format is ELF (System V ABI, "Object Files").
#ifndef GSLAM_CORE_DETAIL_PLUGIN_FILE_H
#define GSLAM_CORE_DETAIL_PLUGIN_FILE_H

#include <gslam/base/error.h>
#include <gslam/core/plugin.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#if defined(__linux__)
#include <link.h>
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

// What the file of a shared library says about the plugin in it.
struct PluginInFile {
  bool is_library = false;  // a shared library for this processor
  bool is_read = false;     // `entry` was read; else there is no way to read it here
  PluginEntry entry{};      // its functions are null
  std::string problem;      // why it is no plugin; empty: it is one
};

#if defined(__linux__)

class ElfFile {
 public:
  explicit ElfFile(const std::string& path) : stream_(path, std::ios::binary) {
    if (!stream_) throw FileError(path, "cannot be opened, expected a plugin");
    stream_.seekg(0, std::ios::end);
    const std::streamoff end = stream_.tellg();
    size_ = end > 0 ? std::uint64_t(end) : 0;
  }

  // What is wrong with the head of the file; empty: it is a shared library for this processor.
  std::string readHead() {
    unsigned char own[4] = {};
    static const unsigned char kMagic[4] = {0x7F, 'E', 'L', 'F'};
    if (size_ == 0) return "is empty, expected a shared library";
    if (!read(0, own, sizeof(own)) || std::memcmp(own, kMagic, sizeof(own)) != 0) {
      return "is no shared library (it does not begin as an ELF file), expected a plugin";
    }
    if (!read(0, &head_, sizeof(head_))) return "ends within its head: it was cut off";
    const int pointer_class = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
    const int order = GSLAM_DETAIL_BYTE_ORDER == 1 ? ELFDATA2LSB : ELFDATA2MSB;
    const bool is_ours = head_.e_ident[EI_CLASS] == pointer_class &&
                         head_.e_ident[EI_DATA] == order &&
                         (machine() == 0 || head_.e_machine == machine());
    if (!is_ours) return "was built for another kind of processor: rebuild it for this one";
    if (head_.e_type != ET_DYN) return "is an ELF file, but no shared library";
    return "";
  }

  // The bytes of an exported object, up to `most`; a problem where there is none.
  std::string readObject(const char* name, std::size_t most, std::vector<char>& bytes) {
    std::vector<ElfW(Shdr)> sections;
    if (!readTable(head_.e_shoff, head_.e_shnum, head_.e_shentsize, sections) || sections.empty()) {
      return "has no list of sections, or was cut off, so that its facts cannot be read";
    }
    for (const ElfW(Shdr) & section : sections) {
      if (section.sh_type != SHT_DYNSYM || section.sh_link >= sections.size()) continue;
      ElfW(Sym) symbol = {};
      if (!findSymbol(section, sections[section.sh_link], name, symbol)) continue;
      return readSymbol(symbol, sections, most, bytes);
    }
    return std::string("is a shared library, but no plugin: it does not export `") + name +
           "`, which GSLAM_PLUGIN makes";
  }

 private:
  static constexpr unsigned machine() {
#if defined(__x86_64__)
    return EM_X86_64;
#elif defined(__aarch64__)
    return EM_AARCH64;
#elif defined(__i386__)
    return EM_386;
#elif defined(__arm__)
    return EM_ARM;
#else
    return 0;
#endif
  }

  bool read(std::uint64_t offset, void* data, std::uint64_t size) {
    if (offset > size_ || size > size_ - offset) return false;
    stream_.clear();
    stream_.seekg(std::streamoff(offset));
    stream_.read(static_cast<char*>(data), std::streamsize(size));
    return bool(stream_);
  }

  template <class T>
  bool readTable(std::uint64_t offset, std::uint64_t count, std::uint64_t entry_size,
                 std::vector<T>& table) {
    if (entry_size != sizeof(T) || count > size_ / sizeof(T)) return false;
    table.resize(std::size_t(count));
    return read(offset, table.data(), count * sizeof(T));
  }

  bool findSymbol(const ElfW(Shdr) & table, const ElfW(Shdr) & names, const char* name,
                  ElfW(Sym) & found) {
    std::vector<ElfW(Sym)> symbols;
    std::vector<char> text;
    if (!readTable(table.sh_offset, table.sh_size / sizeof(ElfW(Sym)), sizeof(ElfW(Sym)),
                   symbols) ||
        !readTable(names.sh_offset, names.sh_size, 1, text)) {
      return false;
    }
    const std::size_t length = std::strlen(name) + 1;  // with its zero byte
    for (const ElfW(Sym) & symbol : symbols) {
      if (symbol.st_shndx == SHN_UNDEF || symbol.st_name > text.size() ||
          length > text.size() - symbol.st_name) {
        continue;
      }
      if (std::memcmp(text.data() + symbol.st_name, name, length) != 0) continue;
      found = symbol;
      return true;
    }
    return false;
  }

  std::string readSymbol(const ElfW(Sym) & symbol, const std::vector<ElfW(Shdr)>& sections,
                         std::size_t most, std::vector<char>& bytes) {
    if ((symbol.st_info & 0xF) != STT_OBJECT || symbol.st_shndx >= sections.size()) {
      return "exports `gslam_plugin`, but not as data: it was not made by GSLAM_PLUGIN";
    }
    const ElfW(Shdr)& section = sections[symbol.st_shndx];
    const std::uint64_t size = std::min<std::uint64_t>(symbol.st_size, most);
    const std::uint64_t place = std::uint64_t(symbol.st_value) - section.sh_addr;
    bytes.assign(std::size_t(size), '\0');
    const bool is_inside = section.sh_type != SHT_NOBITS && symbol.st_value >= section.sh_addr &&
                           place <= section.sh_size && size <= section.sh_size - place;
    if (!is_inside || !read(section.sh_offset + place, bytes.data(), size)) {
      return "exports `gslam_plugin`, but its bytes are not in the file: it was cut off or damaged";
    }
    return "";
  }

  std::ifstream stream_;
  std::uint64_t size_ = 0;
  ElfW(Ehdr) head_{};
};

inline PluginInFile readPluginFile(const std::string& path) {
  PluginInFile result;
  ElfFile file(path);
  result.problem = file.readHead();
  result.is_library = result.problem.empty();
  if (!result.is_library) return result;
  std::vector<char> bytes;
  result.problem = file.readObject("gslam_plugin", sizeof(PluginEntry), bytes);
  result.is_read = result.problem.empty();
  if (!result.is_read) return result;
  // Its functions are addresses that nobody has relocated yet.
  std::memcpy(static_cast<void*>(&result.entry), bytes.data(),
              std::min(bytes.size(), offsetof(PluginEntry, add_factories)));
  return result;
}

#else

// No format is known here: the dynamic linker reads the file, and runs its static constructors.
inline PluginInFile readPluginFile(const std::string& path) {
  if (!std::ifstream(path)) throw FileError(path, "cannot be opened, expected a plugin");
  PluginInFile result;
  result.is_library = true;
  return result;
}

#endif

// Why an entry is not for this host: a sentence without its subject. Empty: it is.
inline std::string entryProblem(const PluginEntry& entry, const BuildFacts& host) {
  if (std::memcmp(entry.magic, "GSLAMPG", sizeof(entry.magic)) != 0) {
    return "exports a `gslam_plugin` that does not begin with GSLAMPG: it was not made by "
           "GSLAM_PLUGIN";
  }
  if (entry.interface_version != kPluginInterface || entry.size != sizeof(PluginEntry)) {
    return "has version " + std::to_string(entry.interface_version) + " of the plugin interface (" +
           std::to_string(entry.size) + " bytes), this program has version " +
           std::to_string(kPluginInterface) + " (" + std::to_string(sizeof(PluginEntry)) +
           " bytes): rebuild it with GSLAM core " + std::to_string(host.core.major) + ".x";
  }
  return buildProblem(entry.built, host);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_PLUGIN_FILE_H
