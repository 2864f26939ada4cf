// SPDX-License-Identifier: Apache-2.0
#include "pairing/secret_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "files/private_file.hpp"

namespace telehug {
namespace {

void must(const Status& done) {
  if (!done) throw std::runtime_error(done.error().message);
}

// In its own blocks, where a new file would leave them as they are.
bool overwrite(const std::filesystem::path& file, const std::string& content) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool written = ::write(descriptor, content.data(), content.size()) == static_cast<ssize_t>(content.size());
  const bool synced = ::fsync(descriptor) == 0;
  return ::close(descriptor) == 0 && written && synced;
}

}  // namespace

void make_secret_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (std::filesystem::is_directory(folder, ignored)) return;
  if (folder.has_parent_path()) std::filesystem::create_directories(folder.parent_path(), ignored);
  must(make_private_folder(folder));
}

void write_secret(const std::filesystem::path& file, const std::string& content) {
  must(keep_private_file(file, content));
}

std::string read_secret(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void wipe(const std::filesystem::path& file) {
  std::error_code none;
  const auto size = std::filesystem::file_size(file, none);
  if (none) return;
  if (!overwrite(file, std::string(size, '\0')))
    throw std::runtime_error(fmt::format("{} can't be overwritten: {}", file.string(), std::strerror(errno)));
  std::filesystem::remove(file);
}

}  // namespace telehug
