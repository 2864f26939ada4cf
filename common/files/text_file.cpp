// SPDX-License-Identifier: Apache-2.0
#include "files/text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace telehug {

std::size_t too_long_line(std::string_view text) {
  std::size_t number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > longest_line_bytes) return number;
    begin = end + 1;
  }
  return 0;
}

Result<std::string> read_text_file(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  if (stream) {
    text.resize(most_text_bytes + 1);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
  }
  // Reaching the end sets failbit and eofbit; anything else is a failure to open or to read.
  if (!stream.is_open() || stream.bad() || (stream.fail() && !stream.eof()))
    return Error{fmt::format("can't be read: {}", std::strerror(errno))};
  if (text.size() > most_text_bytes) return Error{"is larger than 1 MiB, so it is none of telehug's files"};
  if (const auto line = too_long_line(text); line != 0)
    return Error{fmt::format("its line {} is longer than {} bytes", line, longest_line_bytes)};
  return text;
}

}  // namespace telehug
