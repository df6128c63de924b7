#include "files/text_reader.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

struct CloseTextFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

void refuseCompressed(const std::string& path, const std::string& text) {
  const bool is_bzip2 = text.compare(0, 3, "BZh") == 0;
  const bool is_gzip = text.compare(0, 2, "\x1f\x8b") == 0;
  if (!is_bzip2 && !is_gzip) return;
  throw FileError(path, std::string("is compressed by ") + (is_gzip ? "gzip" : "bzip2") +
                            ", expected text: decompress it first");
}

}  // namespace

std::string readTextFile(const std::string& path) {
  errno = 0;
  const std::unique_ptr<std::FILE, CloseTextFile> file(std::fopen(path.c_str(), "rb"));
  if (file == nullptr) throw FileError(path, "cannot be opened", errno);
  std::setvbuf(file.get(), nullptr, _IONBF, 0);
  std::error_code unknown;
  const bool has_size = std::filesystem::is_regular_file(path, unknown);
  const std::uintmax_t size = has_size ? std::filesystem::file_size(path, unknown) : 0;
  // One byte more, so that the end is seen without growing.
  std::string text(unknown ? 1 : static_cast<std::size_t>(size) + 1, '\0');
  std::size_t used = 0;
  while (true) {
    const std::size_t count = std::fread(&text[used], 1, text.size() - used, file.get());
    if (count == 0) break;
    used += count;
    if (used == text.size()) text.resize(2 * used + 4096);
  }
  if (std::ferror(file.get()) != 0) throw FileError(path, "cannot be read", errno);
  text.resize(used);
  refuseCompressed(path, text);
  return text;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
