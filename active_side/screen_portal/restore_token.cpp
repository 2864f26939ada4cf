// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/restore_token.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "files/private_file.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t longest_token = 1024;  // those of today's desktops are UUIDs

bool may_be_a_token(const std::string& text) {
  return !text.empty() && text.size() <= longest_token &&
         std::all_of(text.begin(), text.end(), [](char letter) { return letter > ' ' && letter <= '~'; });
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
  if (const Status kept = keep_private_file(file, token + '\n'); !kept) {
    return Error{
        fmt::format("Your consent to share the screen can't be kept in {}: {}, or the desktop asks at each start.",
                    file.parent_path().string(), kept.error().message)};
  }
  return Done{};
}

void remove_restore_token(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
}

}  // namespace telehug
