// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace telehug {

// Stands for journald: where programs send entries to (systemd.io/JOURNAL_NATIVE_PROTOCOL).
class JournalSocket {
 public:
  using Entry = std::map<std::string, std::string>;

  explicit JournalSocket(std::filesystem::path path)
      : path_(std::move(path)), fd_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path_.string().copy(address.sun_path, sizeof address.sun_path - 1);
    if (::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("no socket at " + path_.string());
  }
  ~JournalSocket() {
    ::shutdown(fd_, SHUT_RDWR);
    if (reader_.joinable()) reader_.join();
    ::close(fd_);
  }
  JournalSocket(const JournalSocket&) = delete;
  JournalSocket& operator=(const JournalSocket&) = delete;

  // Before a program's command line: it finds this socket where journald's would be, and its stderr is the journal.
  [[nodiscard]] std::vector<std::string> prefix() const {
    return {"/usr/bin/unshare",
            "--mount",
            "/bin/sh",
            "-c",
            "mount -t tmpfs none /run && mkdir -p /run/systemd/journal && ln -s \"$0\" /run/systemd/journal/socket && "
            "JOURNAL_STREAM=$(stat -L -c %d:%i /proc/self/fd/2) && export JOURNAL_STREAM && exec \"$@\"",
            path_.string()};
  }
  [[nodiscard]] static bool can_stand_in() { return ::system("unshare --mount true 2>/dev/null") == 0; }

  // Until then it hangs, as a journald that waits for its disk.
  void read() {
    reader_ = std::thread([this] {
      std::array<char, 65536> buffer{};
      for (ssize_t size = 0; (size = ::recv(fd_, buffer.data(), buffer.size(), 0)) > 0;) {
        const std::lock_guard lock(mutex_);
        entries_.push_back(entry_in({buffer.data(), static_cast<std::size_t>(size)}));
      }
    });
  }
  // All that has come so far.
  [[nodiscard]] std::vector<Entry> entries() const {
    const std::lock_guard lock(mutex_);
    return entries_;
  }

 private:
  // A field is "NAME=value\n", or "NAME\n", its size in eight bytes, "value\n".
  static Entry entry_in(std::string_view text) {
    Entry entry;
    while (!text.empty()) {
      const std::string_view first = text.substr(0, text.find('\n'));
      const auto equals = first.find('=');
      if (equals != std::string_view::npos) {
        entry.emplace(first.substr(0, equals), first.substr(equals + 1));
        text.remove_prefix(std::min(first.size() + 1, text.size()));
        continue;
      }
      std::uint64_t size = 0;
      if (text.size() < first.size() + 1 + sizeof size) throw std::runtime_error("an entry is cut off");
      std::memcpy(&size, text.data() + first.size() + 1, sizeof size);
      text.remove_prefix(first.size() + 1 + sizeof size);
      entry.emplace(first, text.substr(0, size));
      text.remove_prefix(std::min<std::size_t>(size + 1, text.size()));
    }
    return entry;
  }

  std::filesystem::path path_;
  int fd_;
  std::thread reader_;
  mutable std::mutex mutex_;
  std::vector<Entry> entries_;  // guarded by mutex_
};

}  // namespace telehug
