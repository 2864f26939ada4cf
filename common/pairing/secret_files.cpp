// SPDX-License-Identifier: Apache-2.0
#include "pairing/secret_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace telehug {
namespace {

class File {
 public:
  File(const std::filesystem::path& path, int flags) : path_(path), fd_(open(path.c_str(), flags | O_CLOEXEC, 0600)) {
    if (fd_ < 0) fail("opened");
  }
  ~File() { close(fd_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  void write_and_sync(const std::string& content) const {
    std::size_t written = 0;
    while (written < content.size()) {
      const ssize_t more = ::write(fd_, content.data() + written, content.size() - written);
      if (more < 0 && errno == EINTR) continue;
      if (more <= 0) fail("written");
      written += static_cast<std::size_t>(more);
    }
    if (fsync(fd_) != 0) fail("written");
  }

  [[noreturn]] void fail(const char* what) const {
    throw std::runtime_error(fmt::format("{} can't be {}: {}", path_.string(), what, std::strerror(errno)));
  }

 private:
  std::filesystem::path path_;
  int fd_;
};

}  // namespace

void make_secret_folder(const std::filesystem::path& folder) {
  std::error_code problem;
  if (std::filesystem::is_directory(folder, problem)) return;
  if (folder.has_parent_path()) std::filesystem::create_directories(folder.parent_path(), problem);
  if (mkdir(folder.c_str(), 0700) != 0) {
    throw std::runtime_error(fmt::format("the folder {} can't be made: {}", folder.string(), std::strerror(errno)));
  }
}

void write_secret(const std::filesystem::path& file, const std::string& content) {
  const std::filesystem::path fresh = file.string() + ".new";
  {
    const File written(fresh, O_WRONLY | O_CREAT | O_TRUNC);
    if (chmod(fresh.c_str(), 0600) != 0) written.fail("protected");
    written.write_and_sync(content);
  }
  std::error_code problem;
  std::filesystem::rename(fresh, file, problem);
  if (problem) throw std::runtime_error(fmt::format("{} can't be written: {}", file.string(), problem.message()));
}

std::string read_secret(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void wipe(const std::filesystem::path& file) {
  std::error_code none;
  const auto size = std::filesystem::file_size(file, none);
  if (none) return;
  File(file, O_WRONLY).write_and_sync(std::string(size, '\0'));
  std::filesystem::remove(file);
}

}  // namespace telehug
