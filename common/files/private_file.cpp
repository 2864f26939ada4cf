// SPDX-License-Identifier: Apache-2.0
#include "files/private_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace telehug {
namespace fs = std::filesystem;
namespace {

Error failure(const fs::path& path, int code) {
  const char* advice = "choose a folder that you may write to";
  if (code == ENOSPC || code == EDQUOT || code == EFBIG) advice = "free some space on the disk";
  if (code == EEXIST) advice = "choose another folder or name";
  return Error{fmt::format("{} can't be written ({}); {}", path.string(), std::strerror(code), advice)};
}

// The new name survives a power cut, too. Not every file system can say so.
void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

Status write_whole(const fs::path& path, const fs::path& unfinished, std::span<const std::uint8_t> bytes, bool sync) {
  auto file = PrivateFile::create(unfinished);
  if (!file) return file.error();
  Status written = file->append(bytes);
  if (written && sync) written = file->sync();
  if (written) written = file->close();
  std::error_code problem;
  if (written) fs::rename(unfinished, path, problem);
  if (written && !problem) {
    if (sync) sync_folder(path.parent_path());
    return Done{};
  }
  std::error_code ignored;
  fs::remove(unfinished, ignored);
  return written ? failure(path, problem.value()) : written;
}

}  // namespace

PrivateFile::PrivateFile(fs::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

PrivateFile::PrivateFile(PrivateFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), bytes_(other.bytes_) {}

PrivateFile::~PrivateFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<PrivateFile> PrivateFile::create(fs::path path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (descriptor < 0) return failure(path, errno);
  return PrivateFile(std::move(path), descriptor);
}

Status PrivateFile::append(std::string_view text) {
  return append({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Status PrivateFile::append(std::span<const std::uint8_t> bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (written > 0) {
      done += static_cast<std::size_t>(written);
      continue;
    }
    const int code = written < 0 ? errno : ENOSPC;
    if (code == EINTR) continue;
    // What can't be cut off stays: the error is the same.
    if (::ftruncate(descriptor_, bytes_) == 0) ::lseek(descriptor_, bytes_, SEEK_SET);
    return failure(path_, code);
  }
  bytes_ += static_cast<std::int64_t>(bytes.size());
  return Done{};
}

Status PrivateFile::sync() {
  if (::fsync(descriptor_) != 0) return failure(path_, errno);
  return Done{};
}

Status PrivateFile::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0) return failure(path_, errno);
  return Done{};
}

Status make_private_folder(const fs::path& folder) {
  if (::mkdir(folder.c_str(), 0700) != 0) return failure(folder, errno);
  return Done{};
}

Status write_private_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
  return write_whole(path, path.string() + ".part", bytes, false);
}

Status keep_private_file(const fs::path& path, std::string_view text) {
  const fs::path unfinished = path.string() + ".new";
  std::error_code ignored;
  fs::remove(unfinished, ignored);  // of a program that was killed
  return write_whole(path, unfinished, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, true);
}

}  // namespace telehug
