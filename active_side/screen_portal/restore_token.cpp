// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/restore_token.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace telehug {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t longest_token = 1024;  // those of today's desktops are UUIDs

bool may_be_a_token(const std::string& text) {
  return !text.empty() && text.size() <= longest_token &&
         std::all_of(text.begin(), text.end(), [](char letter) { return letter > ' ' && letter <= '~'; });
}

bool write_private_file(const fs::path& file, const std::string& content) {
  // Made anew, so that neither a link nor the permissions of what lay there before are taken over.
  ::unlink(file.c_str());
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (fd < 0) return false;
  const bool written = ::write(fd, content.data(), content.size()) == static_cast<ssize_t>(content.size());
  return ::close(fd) == 0 && written;
}

}  // namespace

std::string read_restore_token(const fs::path& file) {
  const int fd = ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return {};
  std::array<char, longest_token + 2> bytes{};
  const ssize_t count = ::read(fd, bytes.data(), bytes.size());
  ::close(fd);
  std::string token(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  if (!token.empty() && token.back() == '\n') token.pop_back();
  return may_be_a_token(token) ? token : std::string{};
}

Status write_restore_token(const fs::path& file, const std::string& token) {
  if (!may_be_a_token(token)) {
    remove_restore_token(file);
    return Error{"The desktop's portal gave a consent to keep that can't be kept; it will ask again."};
  }
  std::error_code ignored;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), ignored);
  const fs::path unfinished = file.string() + ".new";
  errno = 0;
  if (write_private_file(unfinished, token + '\n') && ::rename(unfinished.c_str(), file.c_str()) == 0) return Done{};
  const int code = errno;
  ::unlink(unfinished.c_str());
  return Error{
      fmt::format("Your consent to share the screen can't be kept in {} ({}); make the folder writable, or "
                  "the desktop asks at each start.",
                  file.string(), std::strerror(code))};
}

void remove_restore_token(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
}

}  // namespace telehug
